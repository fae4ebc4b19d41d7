"""What workers do. A worker is a process of Ray; it keeps what increments share between its tasks."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux._scene import Scene
from isolux._native import Scene as NativeScene
from isolux.parts import PartMaker

Parts = list[npt.NDArray[np.uint8]]

_scenes: dict[str, Scene] = {}
_makers: dict[tuple[str, int, int], PartMaker] = {}


def make(
    mesh: tuple[str, int], refs: list[Any], first: int, end: int, threads: int
) -> tuple[float, Parts]:
    """The parts of increments, one each, and the time that one took, s. ``refs`` are the scene and the pilot in the object store:
    in a list, so that they are fetched once a worker, not for every task."""
    maker = _maker(mesh, refs, threads)
    began = time.perf_counter()
    # Arrays go to the object store and back without a copy in between.
    parts = [
        np.frombuffer(maker.make(index, index + 1), dtype=np.uint8) for index in range(first, end)
    ]
    return (time.perf_counter() - began) / (end - first), parts


def _maker(mesh: tuple[str, int], refs: list[Any], threads: int) -> PartMaker:
    key = (*mesh, threads)
    if key not in _makers:
        import ray

        # Those of an earlier mesh are of no more use.
        _makers.clear()
        scene, pilot = refs
        if scene.hex() not in _scenes:
            _scenes.clear()
            _scenes[scene.hex()] = Scene(NativeScene.unpacked(ray.get(scene)), "the scene")
        _makers[key] = PartMaker(_scenes[scene.hex()], ray.get(pilot), threads=threads)
    return _makers[key]
