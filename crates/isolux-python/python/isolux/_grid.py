"""Calculation grids."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from isolux._errors import public
from isolux._readings import READING, Array, Readings


@public
class Figure(NamedTuple):
    """A figure with its interval of 95 %."""

    value: float
    low: float
    high: float


@public
@dataclass(frozen=True)
class Grid:
    """The illuminance on a calculation grid, as ``isolux grid`` tells it: maintained, if there is a maintenance factor.

    Figures are of the points with a value, and ``None`` where there is none. Each has its interval: ``grid.Em.low``.
    """

    name: str
    #: The mean, the least and the greatest illuminance, in lx.
    Em: Figure | None
    Emin: Figure | None
    Emax: Figure | None
    #: Uniformity, the least over the mean; diversity, the least over the greatest.
    U0: Figure | None
    Ud: Figure | None
    #: The means of direct and of indirect light, in lx.
    direct_lx: float | None
    indirect_lx: float | None
    #: (ny, nx) :data:`isolux.READING`, along ``v`` and ``u`` of the grid; ``nan`` where nothing is known. Colours are not told.
    values: Readings
    #: (ny, nx, 3), in metres.
    positions: Array
    #: Distances of points along ``u`` and ``v``, and the width of the band along the sides that is left out, in metres.
    spacing_m: tuple[float, float]
    border_m: float
    #: The factor of the grid, and whether values are ``"initial"``, ``"maintained"`` or ``"both"``.
    maintenance_factor: float
    maintenance: str
    #: What is required of it, by ``require`` and by the scene: each a dict with its ``condition``, the ``value`` found with its interval
    #: (``low``, ``high``), the ``verdict`` (``"met"``, ``"not_met"`` or ``"undecided"``) and the ``probability`` that it holds.
    requirements: list[dict[str, Any]]
    #: All that ``isolux grid --json`` prints of it.
    report: dict[str, Any]


def grids(report: dict[str, Any]) -> list[Grid]:
    """All grids that the command tells of."""
    required = report.get("requirements", [])
    return [
        _grid(of, [judged for judged in required if judged["grid"] == of["name"]])
        for of in report["grids"]
    ]


def _grid(report: dict[str, Any], requirements: list[dict[str, Any]]) -> Grid:
    across, down = report["counts"]

    def figure(name: str) -> Figure | None:
        return None if report[name] is None else Figure(**report[name])

    def column(name: str) -> Any:
        return np.array([value.get(name) for value in report["values"]], dtype=np.float64)

    rows = np.full((len(report["values"]), 8), np.nan)
    values = rows.view(READING)[:, 0]
    for name in ("illuminance_lx", "standard_error_lx", "direct_lx", "indirect_lx"):
        values[name] = column(name)
    positions = np.array([value["position"] for value in report["values"]])
    return Grid(
        name=report["name"],
        Em=figure("mean_lx"),
        Emin=figure("least_lx"),
        Emax=figure("greatest_lx"),
        U0=figure("uniformity"),
        Ud=figure("diversity"),
        direct_lx=report["direct_lx"],
        indirect_lx=report["indirect_lx"],
        values=values.reshape(down, across).view(Readings),
        positions=positions.reshape(down, across, 3),
        spacing_m=(report["spacing_m"][0], report["spacing_m"][1]),
        border_m=report["border_m"],
        maintenance_factor=report["maintenance_factor"],
        maintenance=report["maintenance"],
        requirements=requirements,
        report=report,
    )
