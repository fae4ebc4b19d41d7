"""Sensor points of Radiance (``.pts``) in, results (``.res``) out."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np
import numpy.typing as npt

from isolux._arguments import checked
from isolux._errors import InputError
from isolux._readings import Array, Readings

_MOST_PROBLEMS = 20


@checked
def read_pts(path: str | os.PathLike[str]) -> tuple[Array, Array]:
    """Read sensor points: ``x y z dx dy dz`` a line, in metres, as ``rtrace`` takes them. Returns positions and directions, (n, 3) each,
    which :meth:`isolux.Map.probe` takes."""
    file = os.fspath(path)
    rows: list[list[float]] = []
    problems: list[tuple[str, str | None, str | None, str | None]] = []
    try:
        text = Path(file).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as wrong:
        raise InputError._of([(f"{file}: cannot be read: {wrong}", file, None, None)]) from wrong
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split("#")[0].split()
        if not words:
            continue
        found = _six(words)
        if isinstance(found, str):
            place, remedy = f"line {number}", "write six: x y z dx dy dz"
            problems.append((f"{file}: {place}: {found}; {remedy}", file, place, remedy))
        else:
            rows.append(found)
        if len(problems) == _MOST_PROBLEMS:
            break
    if not rows and not problems:
        remedy = "write x y z dx dy dz, one a line"
        problems.append((f"{file}: holds no point; {remedy}", file, None, remedy))
    if problems:
        raise InputError._of(problems)
    points = np.array(rows)
    return points[:, :3], points[:, 3:]


def _six(words: list[str]) -> list[float] | str:
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return f"{' '.join(words)[:40]!r} are not all numbers"
    if len(numbers) != 6:
        return f"{len(numbers)} numbers"
    if not all(map(math.isfinite, numbers)):
        return "a number is not finite"
    return numbers if any(numbers[3:]) else "the direction is zero"


@checked
def write_res(path: str | os.PathLike[str], values: Readings | npt.ArrayLike) -> None:
    """Write illuminances in lx, one a line in the order of the points, as Radiance and Honeybee have results of a grid of sensors.

    ``values``: readings, or numbers. What is not known is ``nan``.
    """
    array = np.asarray(values)
    if array.dtype.names:
        array = array["illuminance_lx"]
    lines = [f"{value:.7e}\n" for value in np.asarray(array, dtype=np.float64).reshape(-1)]
    Path(path).write_text("".join(lines), encoding="ascii", newline="\n")


@checked
def read_res(path: str | os.PathLike[str]) -> Array:
    """Read what :func:`write_res`, Radiance or Honeybee have written: (n,), or (n, 3) where there are three columns."""
    return np.loadtxt(path, dtype=np.float64, ndmin=1)
