"""What these tests share: a map of an open floor, by a closed form."""

from __future__ import annotations

from pathlib import Path

import isolux
import pytest

REPOSITORY = Path(__file__).parents[4]
FLUX_LM = 1000.0


@pytest.fixture(scope="session")
def lit() -> isolux.Map:
    """A lamp of 1000 lm, 2 m above the middle of an open floor of 4 x 4 m."""
    scene = isolux.Scene.from_arrays(
        [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)],
        [(0, 1, 2), (0, 2, 3)],
        materials={"oak": 0.3},
        luminaires=[isolux.Luminaire(isotropic={"flux_lm": FLUX_LM}, position=(2, 2, 2))],
        grids=[{"name": "floor", "corner": (0.5, 1, 0), "u": (3, 0, 0), "v": (0, 2, 0)}],
    )
    return isolux.solve(scene, accuracy=0.02, progress=False)
