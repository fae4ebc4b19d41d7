"""Scenes from arrays: written as a ``scene.toml`` with meshes, which the reader of scenes reads."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux._errors import wrong


class Luminaire:
    """A luminaire of a scene that is made of arrays.

    ``Luminaire("lamp.ies", position=(2, 2, 2.7))`` has the light of an IES or EULUMDAT file and hangs straight down;
    ``Luminaire(isotropic={"flux_lm": 800}, position=(2, 2, 2))`` has one of the simple distributions ``isotropic``, ``cosine``,
    ``spot`` and ``directional``.

    ``position`` is in metres, ``aim`` a point that its axis aims at. All other keys are those of ``[[luminaire]]`` in a
    ``scene.toml``: ``name``, ``group``, ``direction``, ``rotate_deg``, ``dimming``, ``flux_lm``, ``maintenance_factor``,
    ``colour``, ``cct_k``, ``luminous_area``, ``array``, ...
    """

    def __init__(
        self,
        file: str | os.PathLike[str] | None = None,
        *,
        position: Sequence[float] | None = None,
        aim: Sequence[float] | None = None,
        **keys: Any,
    ) -> None:
        self.keys: dict[str, Any] = dict(keys)
        if file is not None:
            path = Path(file).absolute()
            kind = "ldt" if path.suffix.lower() == ".ldt" else "ies"
            self.keys[kind] = path.as_posix()
        if position is not None:
            self.keys["position"] = position
        if aim is not None:
            self.keys["target"] = aim

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
    cameras: Sequence[Mapping[str, Any]],
    grids: Sequence[Mapping[str, Any]],
    name: str,
    up: str,
) -> Path:
    """Write the files of a scene; where its ``scene.toml`` is."""
    points, corners = _mesh(vertices, triangles)
    known = _materials(materials)
    chosen = _chosen(triangle_materials, list(known), len(corners))
    lines = [f"name = {_toml(name)}", f"up = {_toml(up)}"]
    for material, keys in known.items():
        lines += [f"[materials.{json.dumps(material)}]", *_keys(keys)]
    for number, material in enumerate(known):
        own = corners[chosen == number]
        if len(own):
            file = f"{number}.ply"
            _write_ply(folder / file, points, own)
            # Coordinates are the scene's own: they are not turned.
            keys = {"name": material, "file": file, "material": material, "up": up}
            lines += ["[[geometry]]", *_keys(keys)]
    if isinstance(luminaires, (Luminaire, Mapping)):
        luminaires = [luminaires]
    for luminaire in luminaires:
        keys = luminaire.keys if isinstance(luminaire, Luminaire) else luminaire
        if not isinstance(keys, Mapping):
            raise wrong(f"luminaires hold {keys!r}; give isolux.Luminaire(...) or dicts")
        lines += ["[[luminaire]]", *_keys(keys)]
    for table, rows in (("camera", cameras), ("grid", grids)):
        for row in rows:
            lines += [f"[[{table}]]", *_keys(row)]
    path = folder / "scene.toml"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def _mesh(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    points = np.asarray(vertices, dtype=np.float64)
    corners = np.asarray(triangles)
    if points.ndim != 2 or points.shape[1] != 3:
        raise wrong(f"vertices have the shape {points.shape}; give (n, 3), in metres")
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


def _materials(materials: Material | Mapping[str, Material]) -> dict[str, Mapping[str, Any]]:
    if not isinstance(materials, Mapping):
        return {"surface": {"diffuse": materials}}
    return {
        name: of if isinstance(of, Mapping) else {"diffuse": of} for name, of in materials.items()
    }


def _chosen(
    of_triangles: npt.ArrayLike | None, names: list[str], count: int
) -> npt.NDArray[np.int64]:
    if not names:
        raise wrong("materials are empty; give one, as {'paint': 0.7}")
    if of_triangles is None:
        if len(names) > 1:
            raise wrong("triangle_materials are missing; there are several materials")
        return np.zeros(count, dtype=np.int64)
    chosen = np.asarray(of_triangles)
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


def _keys(table: Mapping[str, Any]) -> list[str]:
    return [f"{key} = {_toml(value)}" for key, value in table.items()]


def _toml(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        # A string of JSON is one of TOML.
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(k)} = {_toml(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(_toml(part) for part in value) + "]"
