"""Scenes: read, and made of arrays."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import isolux
import numpy as np
import pytest
from conftest import REPOSITORY, room


def test_a_scene_tells_what_it_is(cube: isolux.Scene) -> None:
    assert cube.name == "cube"
    assert cube.triangles.shape == (cube.triangle_count, 3, 3)
    edges = cube.triangles[:, 1:] - cube.triangles[:, :1]
    areas = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    assert cube.area_m2 == pytest.approx(areas.sum(), rel=1e-12)
    low, high = cube.bounds_m
    assert (low == cube.triangles.min(axis=(0, 1))).all()
    assert (high == cube.triangles.max(axis=(0, 1))).all()
    assert len(cube.triangle_materials) == cube.triangle_count
    assert not cube.triangles.flags.writeable
    assert cube.luminous_flux_lm == isolux.info("builtin:cube")["luminous_flux_lm"]
    assert cube.check()["triangles"] == cube.triangle_count


def test_arrays_make_the_scene_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(
        """name = "room"
[materials.floor]
diffuse = 0.3
[materials.paint]
diffuse = 0.7
[[geometry]]
box = { min = [0, 0, 0], max = [4, 4, 3], inward = true }
material = "paint"
materials = { z_min = "floor" }
[[luminaire]]
isotropic = { flux_lm = 4000 }
position = [2, 2, 1.5]
"""
    )
    written, made = isolux.load(tmp_path / "scene.toml"), room()
    assert made.name == "room"
    assert made.triangle_count == written.triangle_count == 12
    assert made.luminous_flux_lm == written.luminous_flux_lm
    assert made.area_m2 == written.area_m2 == 2 * 16 + 4 * 12
    assert (made.bounds_m == written.bounds_m).all()
    # Their triangles come in another order, so that their random numbers differ: readings agree within their errors.
    points = [(1, 1, 0), (3, 1, 0), (2, 3, 0)]
    first, second = (
        isolux.solve(scene, accuracy=0.02, progress=False).probe(points) for scene in (written, made)
    )
    apart = first["illuminance_lx"] - second["illuminance_lx"]
    error = np.hypot(first["standard_error_lx"], second["standard_error_lx"])
    # Five standard errors: once in a million.
    assert (np.abs(apart) < 5 * error).all()


def test_coordinates_are_kept_to_the_last_bit() -> None:
    corners = np.array([[0.1, 0.2, 0.3], [1.1, 0.2, 0.3], [0.1, 1.7, 0.3]]) + [1000.0, 0, 0]
    scene = isolux.Scene.from_arrays(corners, [(0, 1, 2)])
    # Single precision from an origin near the scene.
    assert np.abs(scene.triangles[0] - corners).max() < 2.0**-23


def test_luminaires_of_files(tmp_path: Path) -> None:
    lamp = sorted((REPOSITORY / "scenes" / "photometry").rglob("*.ies"))[0]
    scene = room(
        luminaires=[
            isolux.Luminaire(lamp, position=(2, 2, 2.9), aim=(2, 3, 0), name="wall", group="walls"),
            isolux.Luminaire(spot={"peak_cd": 900, "inner_deg": 10, "outer_deg": 20}, position=(1, 1, 2)),
        ],
        cameras=[{"name": "door", "position": (0.5, 0.5, 1.6), "target": (3, 3, 1)}],
        grids=[{"name": "desk", "corner": (1, 1, 0.8), "u": (2, 0, 0), "v": (0, 1, 0)}],
    )
    assert scene.luminaires[0] == "wall"
    assert scene.groups == ["ungrouped", "walls"]
    assert (scene.cameras, scene.grids) == (["door"], ["desk"])


@pytest.mark.parametrize(
    "arguments, words",
    [
        (dict(vertices=[(0, 0)], triangles=[(0, 0, 0)]), "give (n, 3)"),
        (dict(vertices=np.zeros((3, 3)), triangles=[(0, 1, 3)]), "there are 0 to 2"),
        (dict(vertices=[(0, 0, np.nan)], triangles=[(0, 0, 0)]), "vertices[0] is not finite"),
        (dict(vertices=[(0, 0, 0), (0, 0)], triangles=[(0, 0, 0)]), "vertices is [(0, 0, 0), "),
        (dict(vertices=np.eye(3), triangles=[(0, 1, 2), (0, 1)]), "triangles is [(0, 1, 2), "),
        (dict(vertices=np.zeros((3, 3)), triangles=[(0.0, 1.0, 2.0)]), "integers"),
        (dict(vertices=np.eye(3), triangles=[(0, 1, 2)], materials={}), "give one"),
        (dict(vertices=np.eye(3), triangles=[(0, 1, 2)], materials={"a": 0, "b": 1}), "missing"),
        (
            dict(
                vertices=np.eye(3),
                triangles=[(0, 1, 2)],
                materials={"a": 0.5},
                triangle_materials=["b"],
            ),
            "choose one of",
        ),
        (dict(vertices=np.eye(3), triangles=[(0, 1, 2)], materials=1.5), "diffuse"),
        (dict(vertices=np.eye(3), triangles=[(0, 1, 2)], materials={"a": {"shiny": 1}}), "shiny"),
    ],
)
def test_what_cannot_be_a_scene(arguments: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError) as found:
        isolux.Scene.from_arrays(**arguments)  # type: ignore[arg-type]
    assert words in str(found.value)


def wrong(**arguments: Any) -> list[isolux.Problem]:
    """What is wrong with arguments of a room."""
    with pytest.raises(isolux.InputError) as found:
        room(**arguments)
    return found.value.problems


LAMP: dict[str, Any] = {"isotropic": {"flux_lm": 100}, "position": (2, 2, 1)}


@pytest.mark.parametrize(
    "arguments, place",
    [
        ({"materials": {"floor": 1.5, "paint": 0.5}}, "materials['floor']"),
        ({"materials": {"floor": {"diffuse": 7}, "paint": 0.5}}, "materials['floor'].diffuse"),
        ({"materials": {"floor": {"shiny": 1}, "paint": 0.5}}, "materials['floor'].shiny"),
        ({"luminaires": [LAMP, {**LAMP, "flux": 3}]}, "luminaires[1].flux"),
        ({"luminaires": {**LAMP, "dimming": "much"}}, "luminaires.dimming"),
        ({"luminaires": [{**LAMP, "a b": 3}]}, "luminaires[0].a b"),
        ({"luminaires": [{"position": (0, 0, 1)}]}, "luminaires[0]"),
        ({"luminaires": [isolux.Luminaire("no.ies", position=(1, 1, 1))]}, "luminaires[0].file"),
        ({"grids": [{"name": "a", "corner": (0, 0)}]}, "grids[0].corner"),
        ({"cameras": [{"name": "a"}]}, "cameras[0]"),
        ({"up": "x"}, "up"),
    ],
)
def test_problems_are_told_of_arguments(arguments: dict[str, Any], place: str) -> None:
    problems = wrong(**arguments)
    assert problems[0].place == place and problems[0].file is None
    for problem in problems:
        assert problem.message.startswith("from_arrays: ")
        assert f"{tempfile.gettempdir()}/isolux-" not in problem.message
        assert "scene.toml" not in problem.message
        assert problem.remedy and problem.message.endswith(problem.remedy)
    assert f"from_arrays: {place}: " in problems[0].message


def test_values_that_no_file_holds_are_told_of_arguments() -> None:
    for arguments, words in (
        ({"materials": {"floor": None, "paint": 0.5}}, "materials['floor'] is None; give a number"),
        ({"luminaires": [{**LAMP, "aim": {1, 2}}]}, "luminaires[0].aim is {1, 2}; give a number"),
        ({"luminaires": 3}, "luminaires is 3; give isolux.Luminaire"),
        ({"grids": {"name": "a"}}, "grids is {'name': 'a'}; give a list of dicts"),
        ({"cameras": ["door"]}, "cameras[0] is 'door'; give a dict"),
        ({"triangle_materials": [["floor"], []]}, "triangle_materials"),
    ):
        [problem] = wrong(**arguments)
        assert words in problem.message


def test_warnings_are_told_of_arguments() -> None:
    with pytest.warns(isolux.IsoluxWarning) as found:
        scene = isolux.Scene.from_arrays(
            np.eye(3), [(0, 1, 2)], materials={"a": 0.5, "b": 0.5}, triangle_materials=["a"]
        )
    [unused] = scene.warnings
    assert unused.startswith("from_arrays: materials['b']: nothing is made of")
    assert scene.warnings == [str(warning.message) for warning in found]
    # It points at whoever called.
    assert all(warning.filename == __file__ for warning in found)


def test_failures_have_the_words_of_the_command(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text("colour = 3\n[materials.a]\ndiffuse = 7\n")
    with pytest.raises(isolux.InputError) as found:
        isolux.load(tmp_path / "bad.toml")
    assert len(found.value.problems) > 1
    assert "bad.toml" in str(found.value)
    assert found.value.problems[0].place is not None
    with pytest.raises(ValueError, match="nowhere.toml"):
        isolux.load("nowhere.toml")
    with pytest.raises(isolux.InputError, match="builtin:cube"):
        isolux.load("builtin:nothing")


def test_guesses_are_warnings(tmp_path: Path) -> None:
    (tmp_path / "room.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl missing\nf 1 2 3\n")
    with pytest.warns(isolux.IsoluxWarning) as found:
        scene = isolux.load(tmp_path / "room.obj")
    assert scene.warnings == [str(warning.message) for warning in found]
    # It points at whoever called.
    assert all(warning.filename == __file__ for warning in found)


def test_paths_read_without_a_map(cube: isolux.Scene, coarse: isolux.Map) -> None:
    low, high = cube.bounds_m
    middle = 0.5 * (low + high)
    traced = cube.probe(middle, paths=4096)
    read = coarse.probe(middle, exact=True)
    apart = traced["illuminance_lx"] - read["illuminance_lx"]
    assert abs(apart[0]) < 5 * np.hypot(traced["standard_error_lx"], read["standard_error_lx"])[0]
    with pytest.raises(ValueError, match="at least 32"):
        cube.probe(middle, paths=3)


def test_luminaires_may_be_dicts_or_one() -> None:
    lamp: dict[str, Any] = {"isotropic": {"flux_lm": 100}, "position": (0.5, 0.5, 1)}
    corners, faces = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]
    for luminaires in ([lamp], [isolux.Luminaire(**lamp)], isolux.Luminaire(**lamp)):
        scene = isolux.Scene.from_arrays(corners, faces, luminaires=luminaires)
        assert scene.luminous_flux_lm == pytest.approx(100)
    with pytest.raises(isolux.InputError, match="luminaires hold 3"):
        isolux.Scene.from_arrays(corners, faces, luminaires=[3])  # type: ignore[list-item]


def test_a_map_is_no_scene() -> None:
    m = isolux.solve("builtin:cube", accuracy=0.2, progress=False)
    for wants_a_scene in (isolux.solve, isolux.check):
        with pytest.raises(isolux.InputError, match="a Map is no scene.*m.scene"):
            wants_a_scene(m)  # type: ignore[arg-type]
    with pytest.raises(isolux.InputError, match="--accuracy"):
        isolux.solve("builtin:cube", accuracy=0.2, quality="draft", progress=False)
