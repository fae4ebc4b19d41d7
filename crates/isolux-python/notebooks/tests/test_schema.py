"""Outside judges of what is read of Honeybee: its schema, and its own command, a program of its own (AGPL), which translates models to Radiance."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import isolux
import pytest
from conftest import REPOSITORY
from honeybee_schema.model import Model
from isolux.interchange import honeybee

sys.path.append(str(REPOSITORY / "crates" / "isolux-python" / "tests"))
import models as made  # noqa: E402

INSIDE = {"type": "Surface", "boundary_condition_objects": []}


def two_rooms() -> dict[str, Any]:
    """Two rooms with a window between them, a window and a door to the outside, a shade and surroundings."""
    left, right = made.box(4, 5, 3), made.box(4, 5, 3)
    made.with_window_and_door(left)
    for face in right:
        face["identifier"] += "_2"
        corners = face["geometry"]["boundary"]
        face["geometry"]["boundary"] = [[x + 4, y, z] for x, y, z in corners]
    pane = [[4, 1, 1], [4, 2, 1], [4, 2, 2], [4, 1, 2]]
    for faces, own, other, corners in (
        (left, "east", ("pane_2", "west_2", "room_2"), pane),
        (right, "west_2", ("pane_1", "east", "room"), pane[::-1]),
    ):
        face = next(face for face in faces if face["identifier"] == own)
        face["boundary_condition"] = INSIDE | {"boundary_condition_objects": list(other[1:])}
        face["apertures"] = [
            {
                "type": "Aperture",
                "identifier": "pane_1" if own == "east" else "pane_2",
                "geometry": {"type": "Face3D", "boundary": corners},
                "boundary_condition": INSIDE | {"boundary_condition_objects": list(other)},
                "properties": {"type": "AperturePropertiesAbridged"},
            }
        ]
    around = made.quad(made.square(9.0), "white") | {"identifier": "around", "is_detached": True}
    del around["properties"]["radiance"]["modifier"]
    written = made.model(
        left,
        radiance={
            "modifiers": [made.plastic("white", 0.6, 0.6, 0.6)],
            "sensor_grids": [made.sensors((1, 1, 1, 0, 0, 1))],
        },
        orphaned_shades=[made.quad(made.square(7.0), "white"), around],
    )
    written["rooms"].append(written["rooms"][0] | {"identifier": "room_2", "faces": right})
    return written


def test_models_are_of_the_schema() -> None:
    Model.model_validate(two_rooms())


def test_models_are_read_as_their_own_command_writes_them(tmp_path: Path) -> None:
    model, scene = tmp_path / "model.hbjson", tmp_path / "model.rad"
    model.write_text(json.dumps(two_rooms()))
    command = Path(sys.executable).with_name("honeybee-radiance")
    written = subprocess.run(
        [command, "translate", "model-to-rad", model], capture_output=True, text=True, check=True
    )
    scene.write_text(written.stdout)
    right = made.by_material(isolux.load(scene))
    # An accepted difference: the command writes a wall between rooms twice, once for each.
    right["generic_wall_0.50"] -= 5 * 3 - 1
    assert made.by_material(honeybee.read(model).scene) == pytest.approx(right)
