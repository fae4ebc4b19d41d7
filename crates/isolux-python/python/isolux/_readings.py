"""Values at places."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from isolux._arguments import misfit
from isolux._errors import public, wrong

if TYPE_CHECKING:
    import pandas as _pandas

Array = npt.NDArray[np.float64]

#: What is known at a place, all in lx: a dtype of numpy. ``nan`` is not known, 0 is known and dark.
#:
#: ``illuminance_lx`` is ``direct_lx`` plus ``indirect_lx``; ``caustic_lx`` is the part of the direct light that only particles find,
#: through glass, gloss and curved mirrors; ``rgb_lx`` are the three channels (linear Rec. 709) of the illuminance.
READING = np.dtype(
    [
        ("illuminance_lx", "f8"),
        ("standard_error_lx", "f8"),
        ("direct_lx", "f8"),
        ("caustic_lx", "f8"),
        ("indirect_lx", "f8"),
        ("rgb_lx", "f8", (3,)),
    ]
)


@public
class Readings(np.ndarray[Any, Any]):
    """A structured array of :data:`READING`. Its fields are arrays: ``readings["illuminance_lx"]``."""

    @property
    def frame(self) -> _pandas.DataFrame:
        """The same as a table of pandas, which has to be installed: a row a place, ``red_lx``, ``green_lx``, ``blue_lx`` apart."""
        import pandas

        flat = np.asarray(self).reshape(-1)
        names = [name for name in READING.names or () if name != "rgb_lx"]
        columns: dict[str, Any] = {name: flat[name] for name in names}
        for channel, name in enumerate(("red_lx", "green_lx", "blue_lx")):
            columns[name] = flat["rgb_lx"][:, channel]
        return pandas.DataFrame(columns)


def readings(rows: Array) -> Readings:
    """Rows of eight numbers as readings, without a copy."""
    return rows.view(READING)[:, 0].view(Readings)


def places(points: npt.ArrayLike, normals: npt.ArrayLike) -> Array:
    """Points with their normals as rows of six."""
    at = np.atleast_2d(numbers("points", points, "(n, 3) or (3,)"))
    facing = numbers("normals", normals, f"one for all, (3,), or {at.shape}")
    if at.ndim != 2 or at.shape[1] != 3:
        raise wrong(f"points have the shape {at.shape}; give (n, 3) or (3,)")
    try:
        facing = np.broadcast_to(facing, at.shape)
    except ValueError:
        raise wrong(
            f"normals have the shape {facing.shape}; give one for all, (3,), or {at.shape}"
        ) from None
    return np.ascontiguousarray(np.concatenate([at, facing], axis=1))


def numbers(name: str, values: npt.ArrayLike, give: str) -> Array:
    """An argument as an array of numbers."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise misfit(name, values, f"{give} numbers") from None


def fixed(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The array, not to be written to: it is kept and given to everybody who asks."""
    array.setflags(write=False)
    return array
