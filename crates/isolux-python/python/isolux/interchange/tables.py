"""Grids and maps as tables of pandas and data sets of xarray."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from isolux._arguments import checked
from isolux._grid import Grid
from isolux._map import Map
from isolux._optional import needed
from isolux._readings import Array

_WORDS = {
    "illuminance_lx": "illuminance",
    "standard_error_lx": "standard error of the illuminance",
    "direct_lx": "direct part of the illuminance",
    "indirect_lx": "indirect part of the illuminance",
}


@checked
def grid_frame(grid: Grid) -> Any:
    """A grid as a table of pandas: a row a point, ``x_m``, ``y_m``, ``z_m`` and what is known there, in lx."""
    return _frame(grid.positions.reshape(-1, 3), grid.values.reshape(-1), list(_WORDS))


@checked
def map_frame(m: Map) -> Any:
    """A map as a table of pandas: a row a vertex, with its area in m2, its normal, and the light there."""
    names = [name for name in m.values.dtype.names or () if name != "rgb_lx"]
    frame = _frame(m.vertices, m.values, names)
    for axis, name in enumerate(("red_lx", "green_lx", "blue_lx")):
        frame[name] = m.values["rgb_lx"][:, axis]
    for axis, name in enumerate(("normal_x", "normal_y", "normal_z")):
        frame.insert(3 + axis, name, m.normals[:, axis])
    frame.insert(6, "area_m2", m.areas_m2)
    return frame


def _frame(positions: Array, values: npt.NDArray[Any], names: list[str]) -> Any:
    columns = {f"{axis}_m": positions[:, k] for k, axis in enumerate("xyz")}
    columns |= {name: np.asarray(values[name]) for name in names}
    return needed("pandas").DataFrame(columns)


@checked
def grid_dataset(grid: Grid) -> Any:
    """A grid as an ``xarray.Dataset`` with the dimensions ``v`` and ``u``.

    Coordinates are metres: ``u`` and ``v`` from the corner of the grid along its sides, ``x``, ``y``, ``z`` in the axes of the scene. Variables
    have the attribute ``units``; ``illuminance_lx`` names its standard error as ``ancillary_variables``, as the CF conventions have it.
    """
    xarray = needed("xarray")
    ny, nx = grid.values.shape
    sides = [
        grid.border_m + (np.arange(count) + 0.5) * step
        for count, step in zip((nx, ny), grid.spacing_m)
    ]
    coords: dict[str, Any] = {
        name: (name, along, {"units": "m", "long_name": f"distance along {name}"})
        for name, along in zip("uv", sides)
    }
    for axis, name in enumerate("xyz"):
        coords[name] = (("v", "u"), grid.positions[..., axis], {"units": "m"})
    variables = {
        name: (("v", "u"), np.asarray(grid.values[name]), {"units": "lx", "long_name": words})
        for name, words in _WORDS.items()
    }
    variables["illuminance_lx"][2]["ancillary_variables"] = "standard_error_lx"
    about: dict[str, Any] = {
        "title": grid.name,
        "maintenance_factor": grid.maintenance_factor,
        "maintenance": grid.maintenance,
        "spacing_m": grid.spacing_m,
        "border_m": grid.border_m,
    }
    for name in ("Em", "Emin", "Emax", "U0", "Ud"):
        figure = getattr(grid, name)
        if figure is not None:
            about[name], about[f"{name}_interval_95"] = figure.value, (figure.low, figure.high)
    return xarray.Dataset(variables, coords, about)
