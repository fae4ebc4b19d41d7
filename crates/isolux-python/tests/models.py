"""Models of Honeybee, by its schema."""

from __future__ import annotations

from typing import Any

import isolux
import numpy as np


def model(faces: list[Any], **more: Any) -> dict[str, Any]:
    """A model with one room, by the schema."""
    radiance = {"type": "ModelRadianceProperties", **more.pop("radiance", {})}
    own = {"type": "RoomPropertiesAbridged", "radiance": {"type": "RoomRadiancePropertiesAbridged"}}
    room = {"properties": own, **more.pop("room", {})}
    return {
        "type": "Model",
        "identifier": "model",
        "units": "Meters",
        "rooms": [{"type": "Room", "identifier": "room", "faces": faces, **room}],
        "properties": {"type": "ModelProperties", "radiance": radiance},
        **more,
    }


def face(name: str, kind: str, corners: Any, modifier: str | None = None, **more: Any) -> Any:
    """A face; its normal points out of the room."""
    own = {"type": "FaceRadiancePropertiesAbridged"} | ({"modifier": modifier} if modifier else {})
    return {
        "type": "Face",
        "identifier": name,
        "face_type": kind,
        "geometry": {"type": "Face3D", "boundary": corners},
        "boundary_condition": {"type": "Outdoors"},
        "properties": {"type": "FacePropertiesAbridged", "radiance": own},
        **more,
    }


def box(width: float, depth: float, height: float, scale: float = 1.0) -> list[Any]:
    """The faces of a room."""
    corner = [(x, y, z) for z in (0, height) for y in (0, depth) for x in (0, width)]
    faces = {
        ("floor", "Floor"): (0, 2, 3, 1),
        ("ceiling", "RoofCeiling"): (4, 5, 7, 6),
        ("south", "Wall"): (0, 1, 5, 4),
        ("north", "Wall"): (3, 2, 6, 7),
        ("west", "Wall"): (2, 0, 4, 6),
        ("east", "Wall"): (1, 3, 7, 5),
    }
    return [
        face(name, kind, [[scale * c for c in corner[k]] for k in corners])
        for (name, kind), corners in faces.items()
    ]


def plastic(name: str, *rgb: float) -> dict[str, Any]:
    """A diffuse modifier."""
    own = {"type": "Plastic", "identifier": name, "specularity": 0.0, "roughness": 0.0}
    return own | {f"{c}_reflectance": r for c, r in zip("rgb", rgb)}


def sensors(*places: tuple[float, ...]) -> dict[str, Any]:
    """A grid of sensors: x y z dx dy dz each."""
    return {
        "type": "SensorGrid",
        "identifier": "desk",
        "display_name": "Desk",
        "room_identifier": "room",
        "sensors": [{"type": "Sensor", "pos": p[:3], "dir": p[3:]} for p in places],
    }


def quad(corners: Any, modifier: str, **more: Any) -> dict[str, Any]:
    """A shade."""
    own = {"type": "ShadeRadiancePropertiesAbridged", "modifier": modifier}
    return {
        "type": "Shade",
        "identifier": "shade",
        "geometry": {"type": "Face3D", "boundary": corners},
        "properties": {"type": "ShadePropertiesAbridged", "radiance": own},
        **more,
    }


def square(z: float, half: float = 0.05) -> list[list[float]]:
    """A horizontal square that faces down."""
    return [[-half, -half, z], [-half, half, z], [half, half, z], [half, -half, z]]


def with_window_and_door(faces: list[Any]) -> None:
    """Gives the south wall of a room a window of 1 m2 and a door of 1.6 m2 that stands on the floor."""
    south = next(one for one in faces if one["identifier"] == "south")
    for kind, name, key, (x0, x1, z0, z1) in (
        ("Aperture", "pane", "apertures", (1, 2, 1, 2)),
        ("Door", "door", "doors", (3, 3.8, 0, 2)),
    ):
        corners = [[x0, 0, z0], [x1, 0, z0], [x1, 0, z1], [x0, 0, z1]]
        south[key] = [
            {
                "type": kind,
                "identifier": name,
                "geometry": {"type": "Face3D", "boundary": corners},
                "boundary_condition": {"type": "Outdoors"},
                "properties": {"type": f"{kind}PropertiesAbridged"},
            }
        ]


def by_material(scene: isolux.Scene) -> dict[str, float]:
    """The area of each material, m2."""
    edges = scene.triangles[:, 1:] - scene.triangles[:, :1]
    areas = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    return {
        name: float(areas[scene.triangle_materials == number].sum())
        for number, name in enumerate(scene.materials)
    }
