"""Pictures of runs and grids with matplotlib, which has to be installed.

    history = plots.History()
    m = isolux.solve(scene, callback=history)
    plots.errors(history)
    plots.grid(m.grid(height=0.8))

Every function draws into ``ax``, or into axes of its own, and returns the axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux import _native
from isolux._arguments import checked, misfit
from isolux._errors import wrong
from isolux._grid import Grid
from isolux._optional import needed
from isolux._progress import Progress

#: Colours of several curves, which people who confuse red and green tell apart (Okabe and Ito 2008).
_CURVES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
_MARKS = "osD^vP"
#: How much of the paper shows through below black numbers, as in the plans of ``isolux grid``.
_PALENESS = 0.5
#: Lines of equal value at most.
_LINES = 8
#: The greatest error on an axis over the least, at least: three round numbers stand on it.
_LEAST_SPAN = 10.0
#: Numbers of a grid across the picture at most: more would run into each other.
_NUMBERS = 16


class History:
    """Keeps the states of a run: give it to :func:`isolux.solve` as ``callback``."""

    @checked
    def __init__(self, label: str = "") -> None:
        self.label = label
        self.states: list[Progress] = []

    def __call__(self, state: Progress) -> None:
        self.states.append(state)

    def array(self, name: str) -> npt.NDArray[np.float64]:
        """One quantity of all states, such as ``"elapsed_s"``, ``"rays"`` or ``"error"``; ``nan`` where it is not known."""
        values = [getattr(state, name) for state in self.states]
        return np.array([np.nan if v is None else v for v in values], dtype=np.float64)

    @property
    def frame(self) -> Any:
        """All states as a table of pandas, which has to be installed."""
        return needed("pandas").DataFrame([vars(state) for state in self.states])


@checked
def colour_map(name: str = "viridis") -> Any:
    """A colour map of isolux, ``"viridis"``, ``"inferno"`` or ``"turbo"``, for matplotlib: the colours of ``isolux render`` and ``grid``."""
    colours = needed("matplotlib.colors")
    return colours.ListedColormap(_native.colours(name) / 255.0, name=f"isolux {name}")


@checked
def errors(
    histories: History | Sequence[History], *, against: str = "time", ax: Any = None
) -> Any:
    """The reported error of one or several runs against ``"time"`` or ``"rays"``; the target of a run as a dashed line."""
    every = [histories] if isinstance(histories, History) else histories
    if not isinstance(every, Sequence) or not all(isinstance(one, History) for one in every):
        raise misfit("histories", histories, "a History, or several in a list")
    keys = {"time": ("elapsed_s", "time, s"), "rays": ("rays", "rays")}
    if against not in keys:
        raise wrong(f"against is {against!r}; choose 'time' or 'rays'")
    key, words = keys[against]
    if not any(np.isfinite(history.array("error")).any() for history in every):
        raise wrong("no state with an error; give the History to isolux.solve as callback")
    ax = _axes(ax)
    for history, colour in zip(every, _colours()):
        along, error = history.array(key), history.array("error")
        known = np.isfinite(error) & (along > 0)
        ax.plot(along[known], error[known], ".-", color=colour, label=history.label or None)
        targets = {state.target for state in history.states if state.target is not None}
        for target in targets:
            ax.axhline(target, color=colour, linestyle=(0, (4, 3)), linewidth=1)
    _by_error(ax, words, "reported error")
    if any(history.label for history in every):
        ax.legend(frameon=False)
    return ax


@checked
def graph_1(
    series: Mapping[str, Sequence[tuple[float, float | None]]], *, ax: Any = None, title: str = ""
) -> Any:
    """Graph 1 of the study: measured error against time, a curve for each method.

    ``series``: of each method pairs of time in s and error (a share), such as ``study.errors(m, "cube").points``. A dotted line falls like
    one over the root of time, as errors of Monte Carlo methods do.
    """
    if not isinstance(series, Mapping):
        raise misfit("series", series, "a dict of lists of pairs, time and error")
    ax = _axes(ax)
    for (label, pairs), colour, mark in zip(series.items(), _colours(), _MARKS * 9):
        rows = sorted((time, error) for time, error in pairs if error)
        if rows:
            ax.plot(*zip(*rows), color=colour, marker=mark, markersize=5, label=label)
    _by_error(ax, "time, s", "measured error")
    ends = ax.get_xlim()
    high = max((line.get_ydata().max() for line in ax.get_lines()), default=1.0)
    ax.plot(ends, [high, high * (ends[0] / ends[1]) ** 0.5], ":", color="0.55", linewidth=1)
    ax.set_xlim(ends)
    ax.set_title(title)
    ax.legend(frameon=False)
    return ax


@checked
def grid(
    of: Grid,
    *,
    limits: tuple[float, float] | None = None,
    colours: str = "viridis",
    lines: Sequence[float] | None = None,
    numbers: bool = True,
    ax: Any = None,
) -> Any:
    """The plan of a grid: false colours, isolux lines with their lux, and the values at the points.

    ``limits``: lux of the first and the last colour; ``lines``: lux of the lines, round ones unless given. Points without a value are
    left white. Axes are metres along the sides of the grid. ``numbers=False`` leaves out the values; large grids show every second or third.
    """
    colouring = needed("matplotlib.colors")
    lux = _known(of.values["illuminance_lx"])
    if not lux.count():
        raise wrong(f"no value is known at any point of the grid {of.name!r}")
    ax = _axes(ax)
    ny, nx = lux.shape
    u, v = (of.border_m + (np.arange(n) + 0.5) * d for n, d in zip((nx, ny), of.spacing_m))
    edges = [of.border_m + np.arange(n + 1) * d for n, d in zip((nx, ny), of.spacing_m)]
    levels = np.asarray(lines if lines is not None else _round((lux.min(), lux.max()) if limits is None else limits))
    usual = (0.0, max(float(lux.max()), *levels[-1:], 1e-9))
    shown = usual if limits is None else limits
    pale = colour_map(colours)(np.linspace(0, 1, 256))
    pale[:, :3] = (1 - _PALENESS) * pale[:, :3] + _PALENESS
    mesh = ax.pcolormesh(
        *edges, lux, cmap=colouring.ListedColormap(pale), vmin=shown[0], vmax=shown[1]
    )
    inside = levels[(levels > lux.min()) & (levels < lux.max())]
    if min(nx, ny) > 1 and len(inside):
        drawn = ax.contour(u, v, lux, levels=inside, colors="0.15", linewidths=1)
        for words in ax.clabel(drawn, fmt="%g lx", fontsize=8):
            words.set(bbox={"fc": "white", "ec": "none", "pad": 1, "alpha": 0.9}, zorder=5)
    if numbers:
        _numbers(ax, u, v, lux)
    ax.set_aspect("equal")
    ax.set_xlabel("u, m")
    ax.set_ylabel("v, m")
    ax.set_title(_heading(of), fontsize="medium")
    ax.figure.colorbar(mesh, ax=ax, label="illuminance, lx", shrink=0.8)
    return ax


@checked
def false_colour(
    lux: npt.ArrayLike,
    *,
    limits: tuple[float, float] | None = None,
    colours: str = "viridis",
    logarithmic: bool = False,
    label: str = "illuminance, lx",
    ax: Any = None,
) -> Any:
    """A picture of numbers, rows from the top, in the false colours of ``isolux render`` with their scale beside it. ``nan`` is grey.

    ``m.render(luminance=True) @ (0.2126, 0.7152, 0.0722)`` are luminances in cd/m2.
    """
    colouring = needed("matplotlib.colors")
    values = _known(lux)
    positive = values[values > 0] if logarithmic else values
    if not positive.count():
        raise wrong("no value is known; a logarithmic scale needs one above 0")
    low = float(positive.min()) if logarithmic else min(0.0, float(values.min()))
    low, high = (low, float(values.max())) if limits is None else limits
    norm = colouring.LogNorm if logarithmic else colouring.Normalize
    ax = _axes(ax)
    shown = colour_map(colours).with_extremes(bad="0.6")
    image = ax.imshow(values, cmap=shown, norm=norm(low, high))
    ax.set_xticks([])
    ax.set_yticks([])
    ax.figure.colorbar(image, ax=ax, label=label, shrink=0.8)
    return ax


def _known(lux: npt.ArrayLike) -> Any:
    """Numbers, with what is not known masked."""
    # Its stubs leave it without types.
    masked: Any = np.ma
    return masked.masked_invalid(np.asarray(lux, dtype=np.float64))


def _axes(ax: Any) -> Any:
    return needed("matplotlib.pyplot").subplots(layout="constrained")[1] if ax is None else ax


def _colours() -> tuple[str, ...]:
    return _CURVES * 9


def _by_error(ax: Any, along: str, error: str) -> None:
    """Both logarithmic, errors in per cent with plain numbers."""
    ticker = needed("matplotlib.ticker")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel(along)
    ax.set_ylabel(error)
    per_cent = ticker.FuncFormatter(lambda share, _: f"{100 * share:g} %")
    plain = ticker.FuncFormatter(lambda value, _: f"{value:g}")
    ax.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    ax.yaxis.set_major_formatter(per_cent)
    ax.yaxis.set_minor_formatter(ticker.NullFormatter())
    ax.xaxis.set_minor_formatter(ticker.NullFormatter())
    if along != "rays":
        ax.xaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_major_formatter(plain)
    low, high = ax.get_ylim()
    if high < _LEAST_SPAN * low:
        middle = (low * high) ** 0.5
        ax.set_ylim(middle / _LEAST_SPAN**0.5, middle * _LEAST_SPAN**0.5)
    ax.grid(color="0.9")
    ax.set_axisbelow(True)


def _round(ends: tuple[float, float]) -> Any:
    ticker = needed("matplotlib.ticker")
    return ticker.MaxNLocator(_LINES, steps=[1, 2, 2.5, 5, 10]).tick_values(*map(float, ends))


def _numbers(ax: Any, u: Any, v: Any, lux: Any) -> None:
    every = max(1, -(-max(lux.shape) // _NUMBERS))
    for row in range(every // 2, len(v), every):
        for column in range(every // 2, len(u), every):
            value = lux[row, column]
            if value is not np.ma.masked:
                text = f"{value:.0f}" if value >= 10 else f"{value:.1f}"
                ax.text(u[column], v[row], text, ha="center", va="center", fontsize=7, color="0.3")


def _heading(of: Grid) -> str:
    parts = [of.name] if of.name else []
    if of.Em:
        parts.append(f"$E_m$ = {of.Em.value:.0f} lx")
    if of.U0:
        parts.append(f"$U_0$ = {of.U0.value:.2f}")
    return ", ".join(parts)
