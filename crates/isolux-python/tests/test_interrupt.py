"""Ctrl-C in what takes long."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import isolux
import numpy as np
import pytest

TASKS = Path("/proc/self/task")
#: When Ctrl-C comes, s: while the work goes on, and when it has come to something.
SOON_S = 0.7
LATER_S = 4.0


def interrupted(work: Callable[[], object], after_s: float = SOON_S) -> Any:
    """What work returns or raises that Ctrl-C meets."""
    timer = threading.Timer(after_s, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        found = work()
    except BaseException:
        timer.cancel()
        raise
    try:
        timer.join()
    except KeyboardInterrupt:
        pytest.fail("the work was done before")
    return found


def wait_for_end_of(count: int) -> None:
    """Wait until there are no more threads than there were."""
    patience = time.monotonic() + 20
    while len(list(TASKS.iterdir())) > count:
        assert time.monotonic() < patience, "a thread goes on"
        time.sleep(0.05)


def points(count: int, at: Any) -> Any:
    """Many points about one."""
    return np.asarray(at) + 1e-3 * np.arange(count)[:, None] / count


def middle(m: isolux.Map) -> Any:
    """The middle of its scene."""
    return m.scene.bounds_m.mean(axis=0)


#: Each takes minutes, and has nothing to keep.
LONG: dict[str, Callable[[isolux.Map], object]] = {
    "picture": lambda m: m.render(width=2500, height=1600),
    "interpolated": lambda m: m.render(width=4000, height=3000, interpolated=True),
    "grid": lambda m: m.grid(height=middle(m)[1], spacing=0.004),
    "probe": lambda m: m.probe(points(200_000, middle(m)), exact=True),
    "paths": lambda m: m.scene.probe(points(100_000, middle(m))),
    "audit": lambda m: m.audit(places=1_000_000),
}


@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_is_heard_at_once_where_nothing_can_be_kept(name: str, coarse: isolux.Map) -> None:
    threads = len(list(TASKS.iterdir())) if TASKS.exists() else None
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        interrupted(lambda: LONG[name](coarse))
    assert time.monotonic() - began < SOON_S + 2
    if threads is not None:
        wait_for_end_of(threads)


def test_ctrl_c_keeps_the_rounds_of_a_picture(coarse: isolux.Map) -> None:
    began = time.monotonic()
    # Its noise would take an hour.
    view = {"width": 64, "height": 36, "picture_accuracy": 0.001}
    picture = interrupted(lambda: coarse.render(**view), LATER_S)  # type: ignore[arg-type]
    assert picture.shape == (36, 64, 3) and picture.std() > 0
    assert LATER_S - 0.1 < time.monotonic() - began < LATER_S + 20


def test_ctrl_c_before_there_is_a_pilot_is_no_wrong_input(cube: isolux.Scene) -> None:
    with pytest.raises(KeyboardInterrupt):
        interrupted(lambda: isolux.parts.make_pilot(cube, accuracy=1e-3, mesh_accuracy=2e-4))
