"""What tests share: a scene and its map, both small."""

from __future__ import annotations

import signal
from pathlib import Path

import isolux
import pytest

REPOSITORY = Path(__file__).parents[3]


@pytest.fixture(scope="session", autouse=True)
def ctrl_c() -> None:
    """Tests send SIGINT to themselves, which a shell's background jobs ignore unless told otherwise."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def cube() -> isolux.Scene:
    """A room of 4 x 3 x 5 m with an exact answer."""
    return isolux.load("builtin:cube")


@pytest.fixture(scope="session")
def coarse(cube: isolux.Scene) -> isolux.Map:
    """Its map, coarse."""
    return isolux.solve(cube, accuracy=0.05, progress=False)


def room(**more: object) -> isolux.Scene:
    """A room of 4 x 4 x 3 m of arrays, open to no side, with a lamp at its middle."""
    corners = [(x, y, z) for z in (0.0, 3.0) for y in (0.0, 4.0) for x in (0.0, 4.0)]
    # Seen from inside counter-clockwise: floor, ceiling, then the walls.
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    settings: dict[str, object] = {
        "materials": {"floor": 0.3, "paint": (0.7, 0.7, 0.7)},
        "triangle_materials": ["floor"] * 2 + ["paint"] * 10,
        "luminaires": [isolux.Luminaire(isotropic={"flux_lm": 4000}, position=(2, 2, 1.5))],
        "name": "room",
    }
    return isolux.Scene.from_arrays(corners, triangles, **{**settings, **more})  # type: ignore[arg-type]
