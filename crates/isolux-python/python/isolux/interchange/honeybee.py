"""Models of Honeybee (HBJSON) as scenes, and results on their sensor grids.

    model = honeybee.read("office.hbjson")
    m = isolux.solve(model.scene)
    model.write_results(m, "results")

Nothing of Honeybee is needed.
"""

from __future__ import annotations

import json
import os
import re
import tempfile
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from isolux._errors import InputError, IsoluxWarning
from isolux._map import Map
from isolux._readings import Array, Readings
from isolux._scene import Scene, load
from isolux.interchange import radiance
from isolux.interchange._modifiers import Dict, Modifiers, to_radiance
from isolux.interchange._polygons import ring

_METRES = {
    "Meters": 1.0,
    "Millimeters": 1e-3,
    "Centimeters": 1e-2,
    "Feet": 0.3048,
    "Inches": 0.0254,
}


@dataclass(frozen=True)
class SensorGrid:
    """A grid of sensors of a model."""

    #: Its identifier, and the name that is shown.
    identifier: str
    name: str
    #: (n, 3), in metres, and (n, 3), the way that sensors face.
    points: Array
    normals: Array
    #: The identifier of its room.
    room: str | None

    def read(self, m: Map, *, exact: bool = False) -> Readings:
        """Read a map at its sensors: (n,) :data:`isolux.READING`."""
        return m.probe(self.points, self.normals, exact=exact)


@dataclass(frozen=True)
class Model:
    """A model of Honeybee, read."""

    name: str
    scene: Scene
    grids: list[SensorGrid]
    #: What was left out or guessed.
    warnings: list[str]

    def write_results(self, m: Map, folder: str | os.PathLike[str]) -> list[Path]:
        """Write a ``.res`` for each sensor grid, and ``grids_info.json`` beside them, as the recipes of Honeybee leave them: one
        illuminance in lx a line, in the order of the sensors. Returns the ``.res`` files. ``nan`` is not known."""
        into = Path(folder)
        into.mkdir(parents=True, exist_ok=True)
        about, files = [], []
        for grid in self.grids:
            files.append(into / f"{grid.identifier}.res")
            radiance.write_res(files[-1], grid.read(m))
            about.append(
                {
                    "name": grid.name,
                    "identifier": grid.identifier,
                    "count": len(grid.points),
                    "group": "",
                    "full_id": grid.identifier,
                }
            )
        (into / "grids_info.json").write_text(json.dumps(about, indent=2) + "\n", encoding="utf-8")
        return files


def read(path: str | os.PathLike[str]) -> Model:
    """Read a model: rooms, faces, apertures, doors, shades, meshes of shades, modifiers, sensor grids, luminaires.

    Modifiers mean what they mean in Radiance. Faces between two rooms count once. Boundaries of air and void modifiers are no surfaces.
    Sky and sun are no part of a model. What is left out is an :class:`isolux.IsoluxWarning`, and in ``Model.warnings``.
    """
    file = os.fspath(path)
    try:
        model = json.loads(Path(file).read_text(encoding="utf-8-sig"))
    except (OSError, ValueError) as wrong:
        raise _wrong(file, None, f"cannot be read: {wrong}", "give a model as HBJSON") from wrong
    return from_dict(model, name=file)


def from_dict(model: Dict, *, name: str = "model") -> Model:
    """The same of what ``Model.to_dict()`` of Honeybee returns."""
    if not isinstance(model, Mapping) or model.get("type") != "Model":
        raise _wrong(name, None, "is no model of Honeybee", 'its "type" has to be "Model"')
    try:
        writing = _Writing(model, name)
        text = writing.text()
        grids = [writing.grid(grid) for grid in writing.radiance.get("sensor_grids") or []]
    except KeyError as missing:
        remedy = "write the model by the schema of Honeybee"
        raise _wrong(name, None, f"a part of it lacks {missing}", remedy) from missing
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        written = Path(folder) / "model.rad"
        written.write_text(text, encoding="utf-8")
        for own, content in writing.photometry.items():
            (Path(folder) / own).write_text(content, encoding="utf-8", newline="")
        scene = load(written)._named(str(model.get("display_name") or model["identifier"]))
    for told in writing.warnings:
        warnings.warn(told, IsoluxWarning, stacklevel=3)
    return Model(scene._source, scene, grids, [*writing.warnings, *scene.warnings])


def _wrong(file: str, place: str | None, what: str, remedy: str) -> InputError:
    where = f"{file}: {place}: " if place else f"{file}: "
    error = InputError._of([(f"{where}{what}; {remedy}", file, place, remedy)])
    assert isinstance(error, InputError)
    return error


class _Writing:
    """A model on its way to a scene of Radiance."""

    def __init__(self, model: Dict, file: str) -> None:
        self.model, self.file = model, file
        self.radiance: Dict = (model.get("properties") or {}).get("radiance") or {}
        self.modifiers = Modifiers(self.radiance)
        self.warnings: list[str] = []
        self.photometry: dict[str, str] = {}
        self.names: dict[str, str] = {}
        unit = model.get("units", "Meters")
        if unit not in _METRES:
            remedy = f"give one of {', '.join(_METRES)}"
            raise _wrong(file, "units", f"`{unit}` is no unit that is known", remedy)
        self.metres = _METRES[unit]

    def text(self) -> str:
        """All of it."""
        surfaces = list(self._surfaces())
        lamps = [line for lamp in self.radiance.get("luminaires") or [] for line in self._lamp(lamp)]
        materials = []
        for identifier, name in self.names.items():
            modifier = self.modifiers.known.get(identifier)
            if modifier is None:
                remedy = "define it among the modifiers of the model"
                raise _wrong(self.file, identifier, "a modifier of this name is used", remedy)
            if (modifier.get("modifier") or {}).get("type", "Void") != "Void":
                self._warn(identifier, "the pattern on this modifier is left out")
            try:
                materials.append(to_radiance(name, modifier))
            except ValueError as wrong:
                remedy = "use one of plastic, metal, trans, glass, mirror, light, glow"
                raise _wrong(self.file, identifier, str(wrong), remedy) from wrong
        return "\n".join([*materials, *surfaces, *lamps])

    def grid(self, grid: Dict) -> SensorGrid:
        """A grid of sensors."""
        sensors = grid["sensors"]
        rows = np.array([[*sensor["pos"], *sensor["dir"]] for sensor in sensors], dtype=np.float64)
        rows = rows.reshape(-1, 6)
        own = str(grid["identifier"])
        shown = str(grid.get("display_name") or own)
        points = self.metres * rows[:, :3]
        return SensorGrid(own, shown, points, rows[:, 3:], grid.get("room_identifier"))

    def _surfaces(self) -> Iterator[str]:
        model, done = self.model, set[str]()
        for room in model.get("rooms") or []:
            for face in room["faces"]:
                yield from self._face(face, room, done)
            yield from self._shades(room, room)
        for face in model.get("orphaned_faces") or []:
            yield from self._face(face, None, done)
        for aperture in model.get("orphaned_apertures") or []:
            yield from self._polygon(aperture, self.modifiers.of_aperture(aperture, None, None))
            yield from self._shades(aperture, None)
        for door in model.get("orphaned_doors") or []:
            yield from self._polygon(door, self.modifiers.of_door(door, None, None))
            yield from self._shades(door, None)
        for shade in model.get("orphaned_shades") or []:
            yield from self._polygon(shade, self.modifiers.of_shade(shade, False, None))
        for mesh in model.get("shade_meshes") or []:
            yield from self._mesh(mesh, self.modifiers.of_shade(mesh, False, None))

    def _face(self, face: Dict, room: Dict | None, done: set[str]) -> Iterator[str]:
        own = [*(face.get("apertures") or []), *(face.get("doors") or [])]
        if self._is_new(face, done) and face["face_type"] != "AirBoundary":
            holes = [part["geometry"]["boundary"] for part in own]
            yield from self._polygon(face, self.modifiers.of_face(face, room), holes)
        for aperture in face.get("apertures") or []:
            if self._is_new(aperture, done):
                yield from self._polygon(aperture, self.modifiers.of_aperture(aperture, face, room))
            yield from self._shades(aperture, room)
        for door in face.get("doors") or []:
            if self._is_new(door, done):
                yield from self._polygon(door, self.modifiers.of_door(door, face, room))
            yield from self._shades(door, room)
        yield from self._shades(face, room)

    def _is_new(self, thing: Dict, done: set[str]) -> bool:
        """Whether the same surface was not met already, seen from the room on its other side."""
        beyond = (thing.get("boundary_condition") or {}).get("boundary_condition_objects") or [None]
        done.add(thing["identifier"])
        return beyond[0] not in done

    def _shades(self, thing: Dict, room: Dict | None) -> Iterator[str]:
        for key, is_indoor in (("indoor_shades", True), ("outdoor_shades", False)):
            for shade in thing.get(key) or []:
                yield from self._polygon(shade, self.modifiers.of_shade(shade, is_indoor, room))

    def _polygon(self, thing: Dict, modifier: str, holes: list[Any] = []) -> Iterator[str]:
        if ((thing.get("properties") or {}).get("radiance") or {}).get("states"):
            self._warn(thing["identifier"], "its states are left out; its modifier counts")
        if self._is_void(modifier):
            return
        geometry = thing["geometry"]
        inner = [*(geometry.get("holes") or []), *holes]
        try:
            corners = ring(
                self._metres(geometry["boundary"]), [self._metres(hole) for hole in inner]
            )
        except ValueError as wrong:
            raise _wrong(self.file, thing["identifier"], str(wrong), "mend the geometry") from wrong
        yield self._written(thing["identifier"], modifier, corners)

    def _mesh(self, mesh: Dict, modifier: str) -> Iterator[str]:
        if self._is_void(modifier):
            return
        vertices = self._metres(mesh["geometry"]["vertices"])
        for number, face in enumerate(mesh["geometry"]["faces"]):
            yield self._written(f"{mesh['identifier']}.{number}", modifier, vertices[list(face)])

    def _metres(self, points: Any) -> Array:
        return self.metres * np.array(points, dtype=np.float64)

    def _is_void(self, modifier: str) -> bool:
        return modifier == "void" or self.modifiers.known.get(modifier, {}).get("type") == "Void"

    def _written(self, identifier: str, modifier: str, corners: Array) -> str:
        name = self.names.setdefault(modifier, _word(modifier))
        numbers = " ".join(repr(float(number)) for number in corners.reshape(-1))
        return f"{name} polygon {_word(identifier)}\n0\n0\n{corners.size} {numbers}\n"

    def _lamp(self, lamp: Dict) -> Iterator[str]:
        """The instances of a luminaire, with its file; angles are those of ``xform``."""
        own = _word(lamp["identifier"])
        instances = (lamp.get("luminaire_zone") or {}).get("instances") or []
        if not lamp.get("ies_content"):
            remedy = "write the model with the content of its IES files"
            raise _wrong(self.file, lamp["identifier"], "a luminaire without photometry", remedy)
        if not instances:
            self._warn(lamp["identifier"], "no instance of this luminaire is placed; it is left out")
            return
        custom = lamp.get("custom_lamp") or {}
        factor = float(lamp.get("light_loss_factor", 1)) * float(lamp.get("candela_multiplier", 1))
        factor *= float(custom.get("depreciation_factor", 1))
        factor *= float(custom.get("candela_multiplier", 1))
        if any(custom.get(key) for key in ("rgb", "white_xy", "color_temperature")):
            self._warn(lamp["identifier"], "the colour of its lamp is left out; its light is white")
        file = f"{len(self.photometry)}.ies"
        self.photometry[file] = lamp["ies_content"]
        for number, instance in enumerate(instances):
            point = instance["point"]
            at = [point[k] for k in "xyz"] if isinstance(point, Mapping) else point
            x, y, z = (self.metres * float(k) for k in at)
            spin, tilt, turn = (float(instance.get(k, 0)) for k in ("spin", "tilt", "rotation"))
            yield (
                f"!ies2rad -m {factor!r} {file} | xform -n {own}.{number} "
                f"-rz {spin!r} -ry {tilt!r} -rz {turn!r} -t {x!r} {y!r} {z!r}\n"
            )

    def _warn(self, place: str, what: str) -> None:
        self.warnings.append(f"{self.file}: {place}: {what}")


def _word(name: str) -> str:
    """A name as one word of Radiance."""
    return re.sub(r"\s|[!\"'#|]", "_", str(name)) or "_"
