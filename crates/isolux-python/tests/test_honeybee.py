"""Models of Honeybee and files of Radiance: what is read has the right light."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import isolux
import numpy as np
import pytest
from conftest import REPOSITORY
from isolux import study
from isolux.interchange import honeybee, radiance
from isolux.interchange._polygons import ring
from models import (
    box,
    by_material,
    face,
    model,
    plastic,
    quad,
    sensors,
    square,
    with_window_and_door,
)

#: Maps are asked for 1 %; points may be off by three times that.
MAP = 0.03


@pytest.mark.filterwarnings("ignore::isolux.IsoluxWarning")
def test_a_lamp_above_a_floor() -> None:
    # A square of 0.1 m of luminance L, 2 m above: E = L A / h2, within (0.1 / 2)2 of that.
    lamp = {"type": "Light", "identifier": "lamp"} | {f"{c}_emittance": 1.0 for c in "rgb"}
    floor = face("floor", "Floor", [[-2, -2, 0], [-2, 2, 0], [2, 2, 0], [2, -2, 0]], "black")
    grid = sensors((0, 0, 0, 0, 0, 1), (2, 0, 0, 0, 0, 1))
    read = honeybee.from_dict(
        model(
            [floor],
            radiance={"modifiers": [lamp, plastic("black", 0, 0, 0)], "sensor_grids": [grid]},
            orphaned_shades=[quad(square(2.0), "lamp")],
        )
    )
    m = isolux.solve(read.scene, accuracy=0.01, progress=False)
    below, aside = read.grids[0].read(m, exact=True)["illuminance_lx"]
    exact = 179.0 * 0.01 / 4
    assert below == pytest.approx(exact, rel=MAP)
    # At 45 degrees: cos^4.
    assert aside == pytest.approx(exact / 4, rel=MAP)


@pytest.mark.filterwarnings("ignore::isolux.IsoluxWarning")
@pytest.mark.parametrize("unit, scale", [("Meters", 1.0), ("Feet", 1 / 0.3048)])
def test_cube_of_the_study_as_a_model(unit: str, scale: float, tmp_path: Path) -> None:
    exact = study.points("cube")
    faces = box(10, 10, 10, scale)
    for one in faces:
        one["properties"]["radiance"]["modifier"] = "white"
    lamp = {
        "type": "Luminaire",
        "identifier": "lamp",
        "ies_content": isotropic(25_000),
        "candela_multiplier": 2.0,
        "luminaire_zone": {"instances": [{"point": dict.fromkeys("xyz", 5 * scale)}]},
    }
    # The face of the study is the floor, with its middle in the origin.
    places = scale * (exact.points + (5, 5, 5))
    grid = sensors(*[(*place, *normal) for place, normal in zip(places.tolist(), exact.normals.tolist())])
    white = plastic("white", *[2 / 3] * 3)
    known = {"modifiers": [white], "luminaires": [lamp], "sensor_grids": [grid]}
    (tmp_path / "cube.hbjson").write_text(json.dumps(model(faces, units=unit, radiance=known)))
    read = honeybee.read(tmp_path / "cube.hbjson")
    m = isolux.solve(read.scene, accuracy=0.01, progress=False)
    (file,) = read.write_results(m, tmp_path / "results")
    assert file.name == "desk.res"
    assert radiance.read_res(file) == pytest.approx(exact.illuminance_lx, rel=MAP)
    (about,) = json.loads((tmp_path / "results" / "grids_info.json").read_text())
    assert about["count"] == 6 and about["full_id"] == "desk" and about["name"] == "Desk"


def isotropic(candela: float) -> str:
    """A photometric file with the same intensity in all directions."""
    head = f"1 {4 * math.pi * candela:.1f} 1 3 1 1 2 0 0 0\n1 1 0\n0 90 180\n0\n"
    return f"IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n{head}{candela} {candela} {candela}\n"


def test_windows_and_doors_are_holes_with_panes() -> None:
    faces = box(4, 5, 3)
    with_window_and_door(faces)
    scene = honeybee.from_dict(model(faces)).scene
    areas = by_material(scene)
    assert areas["generic_wall_0.50"] == pytest.approx(2 * 12 + 2 * 15 - 1 - 1.6)
    assert areas["generic_exterior_window_vis_0.64"] == pytest.approx(1)
    assert areas["generic_opaque_door_0.50"] == pytest.approx(1.6)
    assert areas["generic_floor_0.20"] == areas["generic_ceiling_0.80"] == pytest.approx(20)


def test_modifiers_come_from_the_face_the_room_and_the_model() -> None:
    faces = box(1, 1, 1)
    faces[0]["properties"]["radiance"]["modifier"] = "own"
    own_set = {
        "type": "ModifierSetAbridged",
        "identifier": "set",
        "wall_set": {"type": "WallModifierSetAbridged", "exterior_modifier": "of the room"},
    }
    written = model(
        faces,
        room={"properties": {"radiance": {"modifier_set": "set"}}},
        radiance={
            "modifiers": [plastic("own", 0.1, 0.1, 0.1), plastic("of the room", 0.9, 0.9, 0.9)],
            "modifier_sets": [own_set],
        },
    )
    areas = by_material(honeybee.from_dict(written).scene)
    assert areas == {
        "own": pytest.approx(1),
        "of_the_room": pytest.approx(4),
        "generic_ceiling_0.80": pytest.approx(1),
    }


def test_a_face_between_rooms_counts_once_and_air_never() -> None:
    shared = [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]]

    def beyond(other: str) -> dict[str, Any]:
        return {"type": "Surface", "boundary_condition_objects": [other, "room"]}

    left = face("left", "Wall", shared, boundary_condition=beyond("right"))
    right = face("right", "Wall", shared[::-1], boundary_condition=beyond("left"))
    air = face("air", "AirBoundary", [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]])
    scene = honeybee.from_dict(model([left, right, air])).scene
    assert scene.area_m2 == pytest.approx(1)


@pytest.mark.filterwarnings("ignore::isolux.IsoluxWarning")
def test_luminaires_stand_and_turn_as_placed() -> None:
    content = (REPOSITORY / "scenes" / "photometry" / "own" / "downlight.ies").read_text()
    lamp = {
        "type": "Luminaire",
        "identifier": "down light",
        "ies_content": content,
        "light_loss_factor": 0.5,
        "luminaire_zone": {
            "instances": [
                {"point": {"x": 1, "y": 1, "z": 2.5}, "spin": 0, "tilt": 0, "rotation": 0},
                {"point": [3, 1, 2.5], "spin": 0, "tilt": 180, "rotation": 0},
            ]
        },
    }
    read = honeybee.from_dict(model(box(4, 2, 3), radiance={"luminaires": [lamp]}))
    assert len(read.scene.luminaires) == 2
    alone = isolux.Scene.from_arrays(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
        [(0, 1, 2)],
        luminaires=[
            isolux.Luminaire(REPOSITORY / "scenes/photometry/own/downlight.ies", position=(0, 0, 1))
        ],
    )
    assert read.scene.luminous_flux_lm == pytest.approx(alone.luminous_flux_lm, rel=1e-6)
    m = isolux.solve(read.scene, accuracy=0.02, progress=False)
    (straight,) = alone.probe([(0, 0, 0)])["direct_lx"]
    below_first, below_second = m.probe([(1, 1, 0), (3, 1, 0)])["direct_lx"]
    # Half of the light, from 2.5 m and not 1 m.
    assert below_first == pytest.approx(0.5 * straight / 2.5**2, rel=MAP)
    # The second shines at the ceiling; the first is 2 m to the side.
    assert below_second < 0.2 * below_first


@pytest.mark.parametrize(
    "change, words",
    [
        ({"type": "Room"}, 'its "type" has to be "Model"'),
        ({"units": "Miles"}, "`Miles` is no unit.*Meters"),
        ({"rooms": [{"faces": [{"identifier": "x"}]}]}, "lacks 'face_type'"),
        (
            {"orphaned_shades": [quad(square(1), "nowhere")]},
            "nowhere: a modifier of this name is used; define it",
        ),
        (
            {"orphaned_shades": [quad([[0, 0, 0], [1, 0, 0], [2, 0, 0]], "generic_wall_0.50")]},
            "shade: its corners lie on one line; mend",
        ),
    ],
)
def test_what_is_no_model(change: dict[str, Any], words: str) -> None:
    with pytest.raises(isolux.InputError, match=words):
        honeybee.from_dict(model([]) | change, name="m.hbjson")


def test_bsdfs_are_refused_by_name(tmp_path: Path) -> None:
    blind = {"type": "BSDF", "identifier": "blind", "bsdf_data": "<xml/>"}
    written = model(
        [], radiance={"modifiers": [blind]}, orphaned_shades=[quad(square(1), "blind")]
    )
    with pytest.raises(isolux.InputError, match="blind: .*BSDF are not read; use one of"):
        honeybee.from_dict(written)
    (tmp_path / "m.hbjson").write_text("{")
    with pytest.raises(isolux.InputError, match="m.hbjson: cannot be read"):
        honeybee.read(tmp_path / "m.hbjson")


def test_rings_go_around_every_hole() -> None:
    rng = np.random.default_rng(1)
    outer = np.array([(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)], dtype=float)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    for count in (1, 2, 9):
        cells = rng.permutation(25)[:count]
        holes = []
        for cell in cells:
            low = 2.0 * np.array([cell % 5, cell // 5]) + 0.3
            corners = [low, low + (1, 0), low + (1, 1.2), low + (0, 1.2)]
            hole = np.array([(*corner, 0.0) for corner in corners])
            holes.append(hole[::-1] if rng.random() < 0.5 else hole)
        joined = ring(outer @ turn.T, [hole @ turn.T for hole in holes])
        onward = np.roll(joined, -1, axis=0)
        area = 0.5 * np.linalg.norm(np.cross(joined, onward).sum(axis=0))
        assert area == pytest.approx(100 - 1.2 * count)
        assert len(joined) == 4 + 6 * count


def test_points_of_radiance(tmp_path: Path) -> None:
    path = tmp_path / "desk.pts"
    path.write_text("\ufeff1 2 0.8 0 0 1\r\n\n# comment\n2\t2 .8 0 0 1\n", encoding="utf-8")
    points, directions = radiance.read_pts(path)
    assert points.tolist() == [[1, 2, 0.8], [2, 2, 0.8]]
    assert directions.tolist() == [[0, 0, 1]] * 2
    path.write_text("1 2 3 0 0 1\n1 2 3\n1 2 x 0 0 1\n1 2 3 0 0 0\n1 2 3 0 0 inf\n")
    with pytest.raises(isolux.InputError, match="line 2: 3 numbers; write six") as found:
        radiance.read_pts(path)
    assert [problem.place for problem in found.value.problems] == [f"line {k}" for k in (2, 3, 4, 5)]
    path.write_text("\n")
    with pytest.raises(isolux.InputError, match="holds no point"):
        radiance.read_pts(path)


def test_results_of_radiance(tmp_path: Path, coarse: isolux.Map) -> None:
    path = tmp_path / "desk.res"
    found = coarse.probe([(0, 0, -5), (1, 1, -5)])
    radiance.write_res(path, found)
    assert len(path.read_text().split()) == 2
    # Eight digits are written.
    assert radiance.read_res(path) == pytest.approx(found["illuminance_lx"], rel=1e-7)
    radiance.write_res(path, [np.nan, 3])
    assert path.read_text().splitlines() == ["nan", "3.0000000e+00"]
