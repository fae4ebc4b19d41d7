"""isolux: lux on every surface of a scene, with a standard error.

    scene = isolux.load("room.toml")
    m = isolux.solve(scene, accuracy=0.01)
    m.probe([(2, 2, 0)], (0, 0, 1))["illuminance_lx"]

Lengths are metres in the axes of the scene, illuminances lux, luminances cd/m2, shares fractions (0.01 is 1 %). What is not known is
``nan`` in arrays and ``None`` elsewhere, never 0. The book of isolux explains the numbers.
"""

from __future__ import annotations

from importlib.metadata import version as _version
from os import PathLike
from typing import Any

from isolux import parts
from isolux._arguments import checked
from isolux._builder import Luminaire
from isolux._call import Path, command
from isolux._daylight import DaylightGrid
from isolux._errors import Defect, Error, InputError, IsoluxWarning, Problem, RefusedError
from isolux._grid import Figure, Grid
from isolux._map import Map, mix, open_map
from isolux._progress import Progress
from isolux._readings import READING, Readings
from isolux._scene import Scene, as_scene, load
from isolux._solve import solve

__version__ = _version("isolux")

__all__ = [
    "READING",
    "DaylightGrid",
    "Defect",
    "Error",
    "Figure",
    "Grid",
    "InputError",
    "IsoluxWarning",
    "Luminaire",
    "Map",
    "Problem",
    "Progress",
    "Readings",
    "RefusedError",
    "Scene",
    "check",
    "command",
    "info",
    "lint",
    "load",
    "mix",
    "open_map",
    "parts",
    "solve",
    "validate",
]


@checked
def check(scene: Path | Scene) -> Any:
    """Audit a scene before a run: the object that ``isolux check --json`` prints, with its ``findings``."""
    if isinstance(scene, (str, PathLike)):
        return command("check", "--", scene)
    return as_scene(scene).check()


@checked
def info(path: Path) -> Any:
    """What a map, a scene, a photometric file or a part of a run holds: the object that ``isolux info --json`` prints."""
    return command("info", "--", path)


@checked
def lint(*files: Path) -> Any:
    """Audit photometric files (.ies, .ldt): what ``isolux lint --json`` prints. Findings are a result, not an exception."""
    return command("lint", "--", *files)


@checked
def validate(*flags: str) -> Any:
    """Run the cases with exact answers, some minutes: what ``isolux validate FLAGS --json`` prints."""
    return command("validate", *flags)


def __dir__() -> list[str]:
    """Public names alone, with the modules that are imported."""
    further = ("cluster", "interchange", "plots", "study")
    return sorted([*__all__, "__version__", *(name for name in further if name in globals())])
