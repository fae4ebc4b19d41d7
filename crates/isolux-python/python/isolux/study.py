"""The scenes of the study of 1998 with their exact values, and the errors of maps by them.

The study is Kopylov, Khodulev, Volevich: The Comparison of Illumination Maps Technique in Computer Graphics Software, GraphiCon'98. Its scenes are
``isolux.load("builtin:cube")`` and ``isolux.load("builtin:sphere")``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from isolux import _native
from isolux._arguments import checked
from isolux._map import Map
from isolux._readings import Array, fixed


@dataclass(frozen=True)
class Exact:
    """Places of a scene, and the illuminance there, exactly."""

    #: (n, 3), in metres, and (n, 3), the way that the surface faces.
    points: Array
    normals: Array
    #: (n,), in lx.
    illuminance_lx: Array
    #: What each counts in a mean; all add up to 1.
    weights: Array
    #: Letters of the points of the study; none on the grid.
    letters: tuple[str, ...] = ()


class Errors(NamedTuple):
    """Errors of a map, shares: 0.01 is 1 %. ``None`` is not known."""

    #: At the points of the study: the root of the weighted mean of the squares of relative differences (2.1 of the study).
    points: float | None
    #: Over the grid: the root of the sum of the squares of differences over that of the values (3.3 of the study).
    grid: float | None
    #: The share of the grid that lies within its intervals of 95 %.
    covered: float | None
    #: Root mean square of the standard errors of the grid over that of its errors.
    told_over_true: float | None


@checked
def points(case: str) -> Exact:
    """The points of the study: A to F of ``"cube"``, the middle of ``"sphere"``. Values are computed to more digits than the study has."""
    rows, named = _native.exact(case)
    letters = tuple(letter for letter, _ in named)
    weights = np.array([weight for _, weight in named])
    return _places(rows[len(rows) - len(named) :], weights / weights.sum(), letters)


@checked
def grid(case: str) -> Exact:
    """Places of equal area: 32 x 32 on a face of ``"cube"``, 16 x 16 on ``"sphere"``."""
    rows, named = _native.exact(case)
    count = len(rows) - len(named)
    return _places(rows[:count], np.full(count, 1.0 / count), ())


@checked
def errors(m: Map, case: str) -> Errors:
    """The errors of a map of ``"cube"`` or ``"sphere"``, as ``isolux compare`` has them."""
    return Errors(*_native.errors(m._native, case))


def _places(
    rows: npt.NDArray[np.float64], weights: npt.NDArray[np.float64], letters: tuple[str, ...]
) -> Exact:
    points, normals, lux = rows[:, :3], rows[:, 3:6], rows[:, 6]
    return Exact(fixed(points), fixed(normals), fixed(lux), fixed(weights), letters)
