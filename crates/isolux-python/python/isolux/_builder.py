"""Scenes from arrays: written as a ``scene.toml`` with meshes, which the reader of scenes reads."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux._arguments import Point, checked, misfit
from isolux._errors import public, wrong
from isolux._readings import numbers
from isolux._written import Written


@public
class Luminaire:
    """A luminaire of a scene that is made of arrays.

    ``Luminaire("lamp.ies", position=(2, 2, 2.7))`` has the light of an IES or EULUMDAT file and hangs straight down;
    ``Luminaire(isotropic={"flux_lm": 800}, position=(2, 2, 2))`` has one of the simple distributions ``isotropic``, ``cosine``,
    ``spot`` and ``directional``.

    ``position`` is in metres, ``aim`` a point that its axis aims at. All other keys are those of ``[[luminaire]]`` in a
    ``scene.toml``: ``name``, ``group``, ``direction``, ``rotate_deg``, ``dimming``, ``flux_lm``, ``maintenance_factor``,
    ``colour``, ``cct_k``, ``luminous_area``, ``array``, ...
    """

    @checked
    def __init__(
        self,
        file: str | os.PathLike[str] | None = None,
        *,
        position: Point | None = None,
        aim: Point | None = None,
        **keys: Any,
    ) -> None:
        self.keys: dict[str, Any] = dict(keys)
        #: What arguments keys were, where that is another name.
        self._names: dict[str, str] = {}
        if file is not None:
            path = Path(file).absolute()
            kind = "ldt" if path.suffix.lower() == ".ldt" else "ies"
            self.keys[kind] = path.as_posix()
            self._names[kind] = ".file"
        if position is not None:
            self.keys["position"] = position
        if aim is not None:
            self.keys["target"] = aim
            self._names["target"] = ".aim"

    def __repr__(self) -> str:
        return f"Luminaire({', '.join(f'{key}={value!r}' for key, value in self.keys.items())})"


Material = float | Sequence[float] | Mapping[str, Any]


def write(
    folder: Path,
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    materials: Material | Mapping[str, Material],
    triangle_materials: npt.ArrayLike | None,
    luminaires: Luminaire | Sequence[Luminaire | Mapping[str, Any]],
    rows: Mapping[str, Sequence[Mapping[str, Any]]],
    sky: Mapping[str, Any] | None,
    name: str,
    up: str,
) -> Written:
    """Write the files of a scene; ``rows`` are those of its tables by their names."""
    points, corners = _mesh(vertices, triangles)
    known = _materials(materials)
    chosen = _chosen(triangle_materials, list(known), len(corners))
    written = Written(folder, "from_arrays")
    written.table("# A scene of arrays.", {"name": name, "up": up}, "", {"name": "name", "up": "up"})
    for number, (material, (keys, place, names)) in enumerate(known.items()):
        written.table(f"[materials.{json.dumps(material)}]", keys, place, names)
        own = corners[chosen == number]
        if len(own):
            of = f"triangles of {material!r}"
            file = written.beside(f"{number}.ply", of)
            _write_ply(file, points, own)
            # Coordinates are the scene's own: they are not turned.
            keys = {"name": material, "file": file.name, "material": material, "up": up}
            written.table("[[geometry]]", keys, of, dict.fromkeys(keys, ""))
    for place, keys, names in _luminaires(luminaires):
        written.table("[[luminaire]]", keys, place, names)
    for table, several in rows.items():
        for place, row in _rows(f"{table}s", several):
            written.table(f"[[{table}]]", row, place)
    if sky is not None:
        written.table("[sky]", sky, "sky")
    written.save()
    return written


def _luminaires(
    luminaires: Luminaire | Sequence[Luminaire | Mapping[str, Any]],
) -> Iterator[tuple[str, Mapping[str, Any], Mapping[str, str]]]:
    """Where each stands among the arguments, its keys, and what arguments the keys were."""
    is_one = isinstance(luminaires, (Luminaire, Mapping))
    several = [luminaires] if is_one else luminaires
    if not isinstance(several, Iterable):
        raise misfit("luminaires", luminaires, "isolux.Luminaire(...) or dicts in a list")
    for number, luminaire in enumerate(several):
        place = "luminaires" if is_one else f"luminaires[{number}]"
        if isinstance(luminaire, Luminaire):
            yield place, luminaire.keys, luminaire._names
        elif isinstance(luminaire, Mapping):
            yield place, luminaire, {}
        else:
            raise wrong(f"luminaires hold {luminaire!r}; give isolux.Luminaire(...) or dicts")


def _rows(argument: str, rows: Any) -> Iterator[tuple[str, Mapping[str, Any]]]:
    if not isinstance(rows, Sequence):
        raise misfit(argument, rows, "a list of dicts")
    for number, row in enumerate(rows):
        if not isinstance(row, Mapping):
            raise misfit(f"{argument}[{number}]", row, "a dict")
        yield f"{argument}[{number}]", row


def _mesh(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    points = numbers("vertices", vertices, "(n, 3)")
    try:
        corners = np.asarray(triangles)
    except ValueError:
        raise misfit("triangles", triangles, "(m, 3) integers") from None
    if points.ndim != 2 or points.shape[1] != 3:
        raise wrong(f"vertices have the shape {points.shape}; give (n, 3), in metres")
    endless = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(endless):
        raise wrong(f"vertices[{endless[0]}] is not finite; give finite numbers, in metres")
    if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
        raise wrong(
            f"triangles have the shape {corners.shape} of {corners.dtype}; give (m, 3) integers"
        )
    corners = corners.astype(np.int64)
    if corners.size and not (0 <= corners.min() and corners.max() < len(points)):
        raise wrong(
            f"triangles name vertices {corners.min()} to {corners.max()}; there are 0 to {len(points) - 1}"
        )
    return points, corners


#: The keys of a material, the argument that it comes from, and what arguments the keys were.
_Keys = tuple[Mapping[str, Any], str, Mapping[str, str]]


def _materials(materials: Material | Mapping[str, Material]) -> dict[str, _Keys]:
    if not isinstance(materials, Mapping):
        return {"surface": _material(materials, "materials")}
    for name in materials:
        if not isinstance(name, str):
            raise misfit("a name in materials", name, "text")
    return {name: _material(of, f"materials[{name!r}]") for name, of in materials.items()}


def _material(of: Material, place: str) -> _Keys:
    if isinstance(of, Mapping):
        return of, place, {}
    return {"diffuse": of}, place, {"diffuse": ""}


def _chosen(
    of_triangles: npt.ArrayLike | None, names: list[str], count: int
) -> npt.NDArray[np.int64]:
    if not names:
        raise wrong("materials are empty; give one, as {'paint': 0.7}")
    if of_triangles is None:
        if len(names) > 1:
            raise wrong("triangle_materials are missing; there are several materials")
        return np.zeros(count, dtype=np.int64)
    try:
        chosen = np.asarray(of_triangles)
    except ValueError:
        raise misfit("triangle_materials", of_triangles, f"({count},) names or integers") from None
    if chosen.shape != (count,):
        raise wrong(f"triangle_materials have the shape {chosen.shape}; give ({count},)")
    if chosen.dtype.kind in "iu":
        if count and not (0 <= chosen.min() and chosen.max() < len(names)):
            raise wrong(
                f"triangle_materials go from {chosen.min()} to {chosen.max()}; there are 0 to {len(names) - 1}"
            )
        return chosen.astype(np.int64)
    number = {name: at for at, name in enumerate(names)}
    unknown = sorted({str(name) for name in chosen} - set(names))
    if unknown:
        raise wrong(f"triangle_materials name {unknown[0]!r}; choose one of {names}")
    return np.array([number[str(name)] for name in chosen], dtype=np.int64)


def _write_ply(path: Path, points: npt.NDArray[np.float64], corners: npt.NDArray[np.int64]) -> None:
    used, own = np.unique(corners, return_inverse=True)
    head = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(used)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(corners)}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    faces = np.empty(len(corners), dtype=[("count", "u1"), ("corners", "<u4", (3,))])
    faces["count"] = 3
    faces["corners"] = own.reshape(-1, 3)
    path.write_bytes(head.encode() + points[used].astype("<f8").tobytes() + faces.tobytes())
