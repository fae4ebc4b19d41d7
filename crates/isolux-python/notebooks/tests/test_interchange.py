"""Maps in tables and meshes of other packages; their meshes as scenes."""

from __future__ import annotations

import math
import subprocess
import sys

import isolux
import numpy as np
import pytest
import pyvista
import trimesh
from conftest import FLUX_LM
from isolux.interchange import meshes, tables


def right_lx(points: np.ndarray) -> np.ndarray:
    """Below the lamp: I h / r^3."""
    away = np.linalg.norm(points - (2, 2, 2), axis=-1)
    return FLUX_LM / (4 * math.pi) * 2 / away**3


def test_a_grid_in_xarray(lit: isolux.Map) -> None:
    grid = lit.grid("floor", spacing=0.5)
    data = tables.grid_dataset(grid)
    assert dict(data.sizes) == {"v": 4, "u": 6}
    assert data.u.values == pytest.approx([0.25, 0.75, 1.25, 1.75, 2.25, 2.75])
    assert data.x.values[0] == pytest.approx(0.5 + data.u.values)
    assert data.y.values[:, 0] == pytest.approx(1 + data.v.values)
    assert data.x.attrs["units"] == data.u.attrs["units"] == "m"
    lux = data["illuminance_lx"]
    assert lux.attrs["units"] == "lx"
    assert lux.attrs["ancillary_variables"] in data
    # Only direct light falls on an open floor. Places on an edge are read a hair beside it.
    points = np.stack([data.x, data.y, data.z], axis=-1)
    assert lux.values == pytest.approx(right_lx(points), rel=1e-4)
    assert (data["standard_error_lx"].values < 0.05 * lux.values).all()
    nearest = data.illuminance_lx.sel(u=1.2, v=0.8, method="nearest")
    assert float(nearest) == grid.values["illuminance_lx"][1, 2]
    assert data.attrs["Em"] == grid.Em.value


def test_tables_of_pandas(lit: isolux.Map) -> None:
    grid = lit.grid("floor", spacing=0.5)
    frame = tables.grid_frame(grid)
    assert len(frame) == 24
    assert frame.illuminance_lx.mean() == pytest.approx(grid.Em.value)
    assert frame[["x_m", "y_m", "z_m"]].to_numpy() == pytest.approx(grid.positions.reshape(-1, 3))
    whole = tables.map_frame(lit)
    assert len(whole) == lit.receivers
    assert whole.area_m2.sum() == pytest.approx(lit.areas_m2.sum())
    assert (whole[["normal_x", "normal_y", "normal_z"]].abs().sum(axis=1) > 0).all()
    assert {"illuminance_lx", "standard_error_lx", "blue_lx"} <= set(whole.columns)


def lands(points: np.ndarray, faces: np.ndarray, lux: np.ndarray) -> float:
    """The flux that arrives on a mesh, lm."""
    edges = points[faces][:, 1:] - points[faces][:, :1]
    areas = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    return float((areas * lux[faces].mean(axis=1)).sum())


def test_meshes_carry_the_light(lit: isolux.Map) -> None:
    expected = lands(lit.vertices, lit.triangles, lit.values["illuminance_lx"])
    by_trimesh = meshes.to_trimesh(lit)
    assert isinstance(by_trimesh, trimesh.Trimesh)
    lux = by_trimesh.vertex_attributes["illuminance_lx"]
    assert lands(by_trimesh.vertices, by_trimesh.faces, lux) == pytest.approx(expected)
    assert len(by_trimesh.vertex_attributes["standard_error_lx"]) == lit.receivers
    assert len(by_trimesh.face_attributes["scene_triangle"]) == len(lit.triangles)
    mesh = meshes.to_pyvista(lit)
    assert isinstance(mesh, pyvista.PolyData)
    assert mesh.active_scalars_name == "illuminance_lx"
    # VTK integrates what is linear between vertices exactly, in single or double precision.
    assert mesh.integrate_data()["illuminance_lx"][0] == pytest.approx(expected, rel=1e-5)


def test_elements_face_the_light(lit: isolux.Map) -> None:
    mesh = meshes.to_trimesh(lit)
    toward = mesh.face_normals @ (0, 0, 1)
    above = lit.normals[lit.triangles][:, 0, 2]
    assert np.sign(toward) == pytest.approx(np.sign(above))


def test_a_trimesh_as_a_scene() -> None:
    # A box of black walls, 1 ft wide, with a lamp in its middle: E = I / h2 in the middles of its sides.
    box = trimesh.creation.box(extents=(1, 1, 1))
    box.invert()
    box.units = "feet"
    lamp = isolux.Luminaire(isotropic={"intensity_cd": 10}, position=(0, 0, 0))
    scene = meshes.from_trimesh(box, materials=0.0, luminaires=[lamp])
    half = 0.3048 / 2
    assert scene.bounds_m == pytest.approx(np.array([[-half] * 3, [half] * 3]), rel=1e-6)
    m = isolux.solve(scene, accuracy=0.02, progress=False)
    found = m.probe([(0, 0, -half)], exact=True)["illuminance_lx"][0]
    assert found == pytest.approx(10 / half**2, rel=0.01)


def at(x: float) -> np.ndarray:
    """To where a table stands."""
    return trimesh.transformations.translation_matrix((x, 0, 0.7))


def test_a_scene_of_trimesh_with_names() -> None:
    scene = trimesh.Scene()
    floor = trimesh.creation.box(extents=(4, 4, 0.1))
    table = trimesh.creation.box(extents=(1, 1, 0.1))
    scene.add_geometry(floor, geom_name="floor")
    scene.add_geometry(table, geom_name="table", transform=at(-1))
    scene.graph.update("second", matrix=at(1), geometry="table")
    read = meshes.from_trimesh(scene, materials={"floor": 0.3, "table": (0.4, 0.3, 0.2)})
    assert read.triangle_count == 36 and sorted(read.materials) == ["floor", "table"]
    assert read.bounds_m[1] == pytest.approx((2, 2, 0.75))
    with pytest.raises(ValueError, match="materials lack 'table'"):
        meshes.from_trimesh(scene, materials={"floor": 0.3})
    with pytest.raises(TypeError, match="a list is no trimesh"):
        meshes.from_trimesh([floor])
    with pytest.raises(ValueError, match="has no mesh"):
        meshes.from_trimesh(trimesh.Scene())


def test_nothing_optional_is_imported_before_it_is_used() -> None:
    names = ["anywidget", "honeybee", "matplotlib", "pandas", "pyvista", "trimesh", "xarray"]
    script = (
        "import sys, isolux, isolux.plots, isolux.interchange\n"
        f"print([name for name in {names} if name in sys.modules])\n"
    )
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert found.stdout.strip() == "[]", found.stderr


def test_what_is_missing_has_a_name(monkeypatch: pytest.MonkeyPatch, lit: isolux.Map) -> None:
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match="needs trimesh.*pip install trimesh"):
        meshes.to_trimesh(lit)
