"""Maps as meshes of trimesh and PyVista with their light at vertices; meshes of trimesh as scenes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux._arguments import checked
from isolux._builder import Material
from isolux._map import Map
from isolux._optional import needed
from isolux._scene import Scene


def _facing(m: Map) -> npt.NDArray[np.int64]:
    """Corners of elements, counter-clockwise seen from the side that receives the light."""
    corners = m.triangles.astype(np.int64)
    corners[m.backs] = corners[m.backs][:, ::-1]
    return corners


def _at_vertices(m: Map) -> dict[str, npt.NDArray[np.float64]]:
    return {name: np.ascontiguousarray(m.values[name]) for name in m.values.dtype.names or ()}


@checked
def to_trimesh(m: Map) -> Any:
    """A map as a ``trimesh.Trimesh``: ``vertex_attributes`` has ``illuminance_lx``, ``standard_error_lx`` and the others of
    :data:`isolux.READING`; ``face_attributes`` has ``scene_triangle``. Vertices stay as they are, those of the map."""
    return needed("trimesh").Trimesh(
        vertices=m.vertices,
        faces=_facing(m),
        vertex_normals=m.normals,
        vertex_attributes=_at_vertices(m),
        face_attributes={"scene_triangle": m.scene_triangles.astype(np.int64)},
        metadata={"name": m.scene.name, "up": m.scene.up, "units": "meters"},
        process=False,
    )


@checked
def to_pyvista(m: Map) -> Any:
    """A map as a ``pyvista.PolyData``: point data have ``illuminance_lx`` (active), ``standard_error_lx`` and the others of
    :data:`isolux.READING`, cell data have ``scene_triangle``. Needs a version of PyVista with ``PolyData.from_regular_faces``."""
    mesh = needed("pyvista").PolyData.from_regular_faces(m.vertices, _facing(m))
    for name, values in _at_vertices(m).items():
        mesh.point_data[name] = values
    mesh.point_data["normal"] = m.normals
    mesh.cell_data["scene_triangle"] = m.scene_triangles
    mesh.set_active_scalars("illuminance_lx")
    return mesh


def from_trimesh(
    mesh: Any,
    *,
    materials: Material | Mapping[str, Material] = 0.5,
    **more: Any,
) -> Scene:
    """Make a scene of a ``trimesh.Trimesh`` or a ``trimesh.Scene``.

    ``materials``: one reflectance for all, or a dict by the names of the geometries of a ``trimesh.Scene``. What a name stands for, and
    ``more`` (``luminaires``, ``grids``, ``cameras``, ``name``, ``up``), are as in :meth:`isolux.Scene.from_arrays`. Meshes that tell
    their ``units`` are converted to metres; others are in metres.
    """
    trimesh = needed("trimesh")
    if isinstance(mesh, trimesh.Trimesh):
        parts = [("surface", mesh.vertices, mesh.faces)]
    elif isinstance(mesh, trimesh.Scene):
        parts = list(_placed(mesh, trimesh))
    else:
        raise TypeError(f"a {type(mesh).__name__} is no trimesh.Trimesh or trimesh.Scene")
    if not parts:
        raise ValueError("the trimesh.Scene has no mesh; add one with triangles")
    scale = _metres(mesh, trimesh)
    known = _by_name(materials, [name for name, _, _ in parts])
    offsets = np.cumsum([0] + [len(points) for _, points, _ in parts])
    names = list(known)
    return Scene.from_arrays(
        np.concatenate([scale * np.asarray(points) for _, points, _ in parts]),
        np.concatenate([np.asarray(faces) + at for (_, _, faces), at in zip(parts, offsets)]),
        materials=known,
        triangle_materials=np.concatenate(
            [np.full(len(faces), names.index(name)) for name, _, faces in parts]
        ),
        **more,
    )


def _placed(scene: Any, trimesh: Any) -> Any:
    """Name, vertices and faces of all meshes of a scene where they stand."""
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        geometry = scene.geometry[name]
        if isinstance(geometry, trimesh.Trimesh):
            placed = geometry.copy().apply_transform(transform)
            yield name, placed.vertices, placed.faces


def _metres(mesh: Any, trimesh: Any) -> float:
    return float(trimesh.units.unit_conversion(mesh.units, "meters")) if mesh.units else 1.0


def _by_name(
    materials: Material | Mapping[str, Material], names: list[str]
) -> dict[str, Material]:
    names = list(dict.fromkeys(names))
    if not isinstance(materials, Mapping):
        return dict.fromkeys(names, materials)
    missing = [name for name in names if name not in materials]
    if missing:
        raise ValueError(f"materials lack {missing[0]!r}; give one for each of {names}")
    return {name: materials[name] for name in names}
