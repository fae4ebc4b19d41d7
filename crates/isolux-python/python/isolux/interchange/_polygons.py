"""Polygons with holes as single rings with seams, as Radiance has them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]

#: Of the size of a polygon: nearer than this counts as touching. Coordinates in files have some ten digits.
_TOUCHING = 1e-9


def ring(boundary: Points, holes: Sequence[Points]) -> Points:
    """The boundary with a seam to every hole, gone along both ways: (n, 3). The front is that of the boundary."""
    across, up = _plane(boundary)
    if not holes:
        return boundary

    def flat(points: Points) -> Points:
        return np.stack([points @ across, points @ up], axis=1)

    joined = boundary
    left = [hole if _area(flat(hole)) < 0 else hole[::-1] for hole in holes]
    while left:
        edges = [flat(part) for part in (joined, *left)]
        at, hole, first = _seam(edges)
        inside = np.roll(left.pop(hole), -first, axis=0)
        joined = np.concatenate([joined[: at + 1], inside, inside[:1], joined[at:]])
    return joined


def _plane(boundary: Points) -> tuple[Points, Points]:
    """Two unit vectors in the plane of a polygon, which runs counter-clockwise in them."""
    onward = np.roll(boundary, -1, axis=0)
    # Newell: twice the area, as a vector.
    normal = np.cross(boundary, onward).sum(axis=0)
    across = max(onward - boundary, key=lambda edge: float(edge @ edge))
    across = across / np.linalg.norm(across)
    up = np.cross(normal, across)
    length = np.linalg.norm(up)
    if not length > 0:
        raise ValueError("its corners lie on one line")
    return across, up / length


def _area(flat: Points) -> float:
    onward = np.roll(flat, -1, axis=0)
    return float(0.5 * (flat[:, 0] * onward[:, 1] - flat[:, 1] * onward[:, 0]).sum())


def _seam(rings: Sequence[Points]) -> tuple[int, int, int]:
    """The shortest way from the first ring to another that crosses none: its corner, which other, the corner of that."""
    starts = np.concatenate(rings)
    ends = np.concatenate([np.roll(part, -1, axis=0) for part in rings])
    outer = rings[0]
    ways = [
        (float(np.hypot(*(outer[at] - inner[first]))), at, hole, first)
        for hole, inner in enumerate(rings[1:])
        for at in range(len(outer))
        for first in range(len(inner))
    ]
    size = float(np.ptp(starts, axis=0).max())
    for _, at, hole, first in sorted(ways):
        if _is_free(outer[at], rings[1 + hole][first], starts, ends, _TOUCHING * size):
            return at, hole, first
    raise ValueError("its holes cross each other or its boundary")


def _is_free(a: Points, b: Points, starts: Points, ends: Points, touching: float) -> bool:
    """Whether the way between two corners crosses no edge and passes through no other corner."""

    def side(p: Points, q: Points, r: Points) -> Points:
        return np.asarray(
            (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1])
            - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
        )

    way = b - a
    length = float(np.hypot(*way))
    if length <= touching:
        return True
    off = side(a, b, starts) / length
    along = (starts - a) @ way / length
    passes = (np.abs(off) <= touching) & (along > touching) & (along < length - touching)
    if passes.any():
        return False
    ends_off = side(a, b, ends) / length
    edges = np.maximum(np.hypot(*(ends - starts).T), touching)
    one, other = side(starts, ends, a) / edges, side(starts, ends, b) / edges
    reach = np.minimum(np.abs(off), np.abs(ends_off))
    crosses = (off * ends_off < 0) & (one * other < 0) & (reach > touching)
    crosses &= np.minimum(np.abs(one), np.abs(other)) > touching
    return not crosses.any()
