"""Memory: a process that solves many scenes stays as large as it is."""

from __future__ import annotations

import gc
from pathlib import Path

import isolux
import pytest

STATUS = Path("/proc/self/status")


def resident_kib() -> int:
    line = next(line for line in STATUS.read_text().splitlines() if line.startswith("VmRSS:"))
    return int(line.split()[1])


@pytest.mark.skipif(not STATUS.exists(), reason="the system does not tell resident memory")
def test_a_hundred_scenes_leave_nothing() -> None:
    def once() -> None:
        m = isolux.solve("builtin:cube", accuracy=0.2, progress=False, audit=False)
        assert m.values.shape == (m.receivers,)
        assert m.scene.triangles.shape == (12, 3, 3)
        m.probe([(0.5, -5.0, 0.5)], (0, 1, 0))

    def grown_kib(runs: int) -> int:
        before = resident_kib()
        for _ in range(runs):
            once()
        gc.collect()
        return resident_kib() - before

    # The first runs fill caches. What the allocator keeps for later comes and goes; a leak grows every time.
    grown_kib(20)
    least = min(grown_kib(30) for _ in range(3))
    one = len(isolux.solve("builtin:cube", accuracy=0.2, progress=False, audit=False).to_bytes())
    # Less than a quarter of a map file, the least of what a run holds, a run.
    assert least * 1024 < 30 * one / 4
