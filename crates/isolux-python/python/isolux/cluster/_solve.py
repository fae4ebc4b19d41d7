"""Runs on a cluster."""

from __future__ import annotations

from typing import Any

from isolux import _solve
from isolux._arguments import at_least, checked
from isolux._call import Path
from isolux._map import Map
from isolux._scene import Scene, as_scene
from isolux.cluster._feed import Feed
from isolux.cluster._ray import connected


@checked
def solve(
    scene: Scene | Path,
    *,
    address: str | None = None,
    workers: int | None = None,
    worker_threads: int = 1,
    **options: Any,
) -> Map:
    """Compute a map as :func:`isolux.solve` does, with its ``options`` and, byte by byte, its result, on a cluster of Ray.

    ``address``: of the cluster, ``"auto"`` for the one that this machine is part of. Without it, and without a connection that the
    program has made by ``ray.init``, the processors of this machine are the cluster. ``workers``: at most so many at a time; all that the
    cluster has room for unless given. ``worker_threads``: of each, and the processors that it asks Ray for.

    The pilot and the audit are made here, on ``threads``. Workers, and nodes, may be lost and added on the way: what was lost is made
    again. Ctrl-C, ``time_limit`` and ``callback`` end the run with the map so far; with ``output``, ``resume=True`` goes on from it.
    """
    at_least(1, workers=workers, worker_threads=worker_threads)
    scene = as_scene(scene)
    cpus = workers * worker_threads if workers else None
    with connected(address, cpus) as ray:
        feed = Feed(ray, workers, worker_threads)
        try:
            return _solve.solve(scene, _increment=feed, **options)
        finally:
            feed.close()
