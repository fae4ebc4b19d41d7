"""Maps: values, grids, pictures, sums, files."""

from __future__ import annotations

import pickle
from pathlib import Path

import isolux
import numpy as np
import pytest
from conftest import REPOSITORY, room


def test_arrays_of_a_map(coarse: isolux.Map) -> None:
    count = coarse.receivers
    assert coarse.vertices.shape == coarse.normals.shape == (count, 3)
    assert coarse.triangles.max() == count - 1
    assert len(coarse.triangles) == len(coarse.scene_triangles) == len(coarse.backs)
    assert coarse.scene_triangles.max() < coarse.scene.triangle_count
    assert coarse.values.shape == coarse.areas_m2.shape == (count,)
    assert coarse.vertices is coarse.vertices
    with pytest.raises(ValueError, match="read-only"):
        coarse.values["illuminance_lx"][0] = 1
    # The flux that arrives, by the areas of vertices and by those of elements.
    value = coarse.values["illuminance_lx"]
    corners = coarse.vertices[coarse.triangles]
    edges = corners[:, 1:] - corners[:, :1]
    areas = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    by_elements = (areas * value[coarse.triangles].mean(axis=1)).sum()
    assert (coarse.areas_m2 * value).sum() == pytest.approx(by_elements, rel=1e-9)


def test_probing(coarse: isolux.Map) -> None:
    found = coarse.probe(np.array([(0.5, -5, 0.5), (1, -5, 2)]), (0, 1, 0))
    assert found.shape == (2,) and found.dtype == isolux.READING
    assert (found["illuminance_lx"] > 0).all()
    total = found["direct_lx"] + found["indirect_lx"]
    assert total == pytest.approx(found["illuminance_lx"], rel=1e-12)
    weights = (0.2126, 0.7152, 0.0722)
    assert found["rgb_lx"] @ weights == pytest.approx(found["illuminance_lx"], rel=1e-3)
    assert list(found.frame.columns)[-3:] == ["red_lx", "green_lx", "blue_lx"]
    with pytest.warns(isolux.IsoluxWarning, match="no surface"):
        unknown = coarse.probe([(99.0, 99.0, 99.0)])
    assert np.isnan(unknown["illuminance_lx"]).all()


def test_what_is_no_point(coarse: isolux.Map) -> None:
    for points, normals, words in (
        ([(0, 0)], (0, 0, 1), r"give \(n, 3\)"),
        ([(0, 0, 0)], (0, 0), "normals have the shape"),
        ([(0, 0, 0)], (0, 0, 0), "no direction"),
        ([(0, 0, np.nan)], (0, 0, 1), "point 0: .* not finite"),
    ):
        with pytest.raises(ValueError, match=words):
            coarse.probe(points, normals)
    with pytest.raises(ValueError, match="exclude"):
        coarse.probe([(0, 0, 0)], exact=True, interpolated=True)


def test_grids(tmp_path: Path) -> None:
    desk = {"name": "desk", "corner": (1, 1, 0.8), "u": (2, 0, 0), "v": (0, 1, 0)}
    m = isolux.solve(room(grids=[desk]), accuracy=0.02, progress=False)
    found = m.grid(spacing=0.25, csv=tmp_path / "desk.csv", picture=tmp_path / "desk.png")
    assert found.name == "desk" and found.values.shape == (4, 8)
    assert found.spacing_m == (0.25, 0.25)
    lux = found.values["illuminance_lx"]
    assert found.Em is not None and found.U0 is not None and found.Emin is not None
    assert found.Em.value == pytest.approx(lux.mean())
    assert found.U0.value == pytest.approx(lux.min() / lux.mean())
    assert found.Em.low < found.Em.value < found.Em.high
    assert (found.positions[0, 0] == (1.125, 1.125, 0.8)).all()
    assert len((tmp_path / "desk.csv").read_text().splitlines()) == 33
    assert (tmp_path / "desk.png").stat().st_size > 1000
    plane = m.grid(height=0.8, maintenance_factor=0.5)
    assert plane.maintenance == "maintained"
    assert [grid.name for grid in m.grids()] == ["desk"]
    with pytest.raises(isolux.InputError, match="choose one of"):
        m.grid("table")
    with pytest.raises(isolux.InputError, match="right angles"):
        m.grid(corner=(1, 1, 1), u=(1, 0, 0), v=(1, 1, 0))


def test_pictures(coarse: isolux.Map) -> None:
    inside = coarse.scene.bounds_m.mean(axis=0)
    view = {"eye": inside, "target": inside + (1, 0.1, 0), "width": 64, "height": 48}
    picture = coarse.render(**view)
    assert picture.shape == (48, 64, 3) and picture.dtype == np.uint8
    assert picture.std() > 0
    luminance = coarse.render(**view, luminance=True)
    assert luminance.shape == (48, 64, 3) and luminance.dtype == np.float32
    assert (luminance >= 0).all() and luminance.max() > 1
    chart = coarse.render(**view, false_colour=True, limits=(0, 500), contours=True)
    assert chart.dtype == np.uint8 and chart.shape[1] > 64
    with pytest.raises(isolux.InputError, match="camera"):
        coarse.render("door")


def test_an_audit(coarse: isolux.Map) -> None:
    audit = coarse.audit(places=256)
    assert audit["contradicts"] is False
    assert audit["told"] == coarse.accuracy


def test_files(coarse: isolux.Map, tmp_path: Path) -> None:
    path = tmp_path / "map.glb"
    coarse.save(path)
    again = isolux.open_map(path)
    assert again.to_bytes() == coarse.to_bytes()
    assert again.info()["kind"] == "map"
    assert pickle.loads(pickle.dumps(again)).to_bytes() == coarse.to_bytes()
    for name in ("map.csv", "map.ply", "map.vtu", "map.x3d"):
        told = coarse.export(tmp_path / name)
        assert (tmp_path / name).stat().st_size == told["bytes"]
    with pytest.raises(isolux.InputError, match="html"):
        coarse.export(tmp_path / "map.doc")
    with pytest.raises(isolux.InputError, match="missing.glb"):
        isolux.open_map(tmp_path / "missing.glb")


def test_groups_are_dimmed(tmp_path: Path) -> None:
    lamps = [
        isolux.Luminaire(isotropic={"flux_lm": 900}, position=(x, 2, 2), group=group)
        for x, group in ((1, "left"), (3, "right"))
    ]
    both = room(luminaires=lamps)
    m = isolux.solve(both, accuracy=0.03, group=True, progress=False, output=tmp_path / "m.glb")
    assert list(m.groups) == ["left", "right"]
    points = [(1, 1, 0), (3, 3, 0)]
    left, right, total = (of.probe(points)["illuminance_lx"] for of in (*m.groups.values(), m))
    # Sums of the same numbers; where a reading gathers depends on the map.
    assert left + right == pytest.approx(total, rel=0.05)
    dimmed = m.mix({"right": 0})
    assert dimmed.probe(points)["illuminance_lx"] == pytest.approx(left, rel=0.05)
    opened = isolux.open_map(tmp_path / "m.glb").mix({"right": 0})
    assert opened.to_bytes() == dimmed.to_bytes()
    files = isolux.mix({tmp_path / "m.left.glb": 1.0, tmp_path / "m.right.glb": 0.0})
    assert files.to_bytes() == dimmed.to_bytes()
    unkept = isolux.solve(both, accuracy=0.03, group=True, progress=False)
    assert unkept.mix({"right": 0}).to_bytes() == dimmed.to_bytes()
    with pytest.raises(isolux.InputError, match="there are left, right"):
        m.mix({"middle": 0.5})


def test_photometric_files() -> None:
    lamp = sorted((REPOSITORY / "scenes" / "photometry").rglob("*.ies"))[0]
    assert isolux.info(lamp)["kind"] == "photometric file"
    assert isolux.lint(lamp)["files"]
    assert isolux.check("builtin:cube")["triangles"] == 12


def test_a_saved_map_keeps_its_groups(tmp_path: Path) -> None:
    lamps = [
        isolux.Luminaire(isotropic={"flux_lm": 100}, position=(x, 0.5, 1), group=name)
        for x, name in ((0.3, "left"), (0.7, "right one"))
    ]
    corners, faces = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]
    scene = isolux.Scene.from_arrays(corners, faces, luminaires=lamps)
    m = isolux.solve(scene, accuracy=0.1, group=True, progress=False)
    m.save(tmp_path / "two.glb")
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["two.glb", "two.left.glb", "two.right-one.glb"]
    dimmed = isolux.open_map(tmp_path / "two.glb").mix({"left": 0.5})
    assert dimmed.to_bytes() == m.mix({"left": 0.5}).to_bytes()
    with pytest.raises(isolux.InputError, match="end its name so"):
        m.save(tmp_path / "two.exr")
    with pytest.raises(isolux.InputError, match="there is no directory"):
        m.save(tmp_path / "none" / "two.glb")
