"""A year of daylight."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from isolux._errors import public
from isolux._grid import Figure
from isolux._readings import Array

if TYPE_CHECKING:
    import pandas as _pandas

#: Columns of a point that are told with their intervals.
_FIGURES = ("daylight_factor", "sky_component", "daylight_autonomy", "median_lx")
#: Ranges of the useful daylight illuminance, lx.
_USEFUL = ("below_100", "100_300", "300_3000", "above_3000")


@public
@dataclass(frozen=True)
class DaylightGrid:
    """A year of daylight on a calculation grid, as ``isolux daylight`` tells it.

    Shares are fractions: 0.02 is a daylight factor of 2 %. Intervals of 95 % hold the noise of paths. A verdict is ``"met"``,
    ``"not_met"`` or ``"undecided"``.
    """

    name: str
    #: Daylight factor: the mean over points, what half of them exceed, and what 95 % exceed.
    DF: Figure
    DF_median: Figure
    DF_95: Figure
    #: Mean share of the hours of use with 300 lx.
    DA: Figure
    #: Share of points with 300 lx for half of the hours of use.
    sDA: Figure
    #: Share of points with more than 1000 lx of direct sun for more than 250 hours of use.
    ASE: float
    #: Mean shares of the hours of use below 100 lx, to 300 lx, to 3000 lx, and above.
    UDI: tuple[Figure, Figure, Figure, Figure]
    #: What is reached of EN 17037 (``"minimum"``, ``"medium"``, ``"high"``) and of LM-83 (``"sda_accepted"``, ``"sda_preferred"``,
    #: ``"ase_acceptable"``).
    verdicts: dict[str, str]
    #: (n, 3), in metres.
    positions: Array
    #: All that ``isolux daylight --json`` prints of it.
    report: dict[str, Any]

    @property
    def frame(self) -> _pandas.DataFrame:
        """The points as a table of pandas, which has to be installed: place, figures with ``_low`` and ``_high``, shares, hours of sun."""
        import pandas

        columns: dict[str, Any] = dict(zip("xyz", self.positions.T, strict=True))
        points = self.report["points"]
        for name in _FIGURES:
            columns[name] = [point[name]["value"] for point in points]
            columns[f"{name}_low"] = [point[name]["low"] for point in points]
            columns[f"{name}_high"] = [point[name]["high"] for point in points]
        for number, name in enumerate(_USEFUL):
            columns[f"udi_{name}"] = [point["useful_daylight"][number] for point in points]
        columns["sunny_h"] = [point["sunny_h"] for point in points]
        return pandas.DataFrame(columns)


def daylight_grid(report: dict[str, Any]) -> DaylightGrid:
    """A grid as the command tells of it."""

    def figure(of: dict[str, float]) -> Figure:
        return Figure(**of)

    levels = zip(("minimum", "medium", "high"), report["en_17037"], strict=True)
    further = ("sda_accepted", "sda_preferred", "ase_acceptable")
    dark, some, good, much = map(figure, report["useful_daylight"])
    return DaylightGrid(
        name=report["name"],
        DF=figure(report["daylight_factor_mean"]),
        DF_median=figure(report["daylight_factor_median"]),
        DF_95=figure(report["daylight_factor_95"]),
        DA=figure(report["daylight_autonomy"]),
        sDA=figure(report["spatial_daylight_autonomy"]),
        ASE=report["annual_sunlight_exposure"],
        UDI=(dark, some, good, much),
        verdicts={**dict(levels), **{name: report[name] for name in further}},
        positions=np.array([point["position"] for point in report["points"]]).reshape(-1, 3),
        report=report,
    )
