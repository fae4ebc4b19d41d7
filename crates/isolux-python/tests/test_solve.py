"""Runs: progress, their end, failures."""

from __future__ import annotations

import os
import signal
import threading
import time
import warnings
from pathlib import Path

import isolux
import pytest
from isolux import _native
from isolux._call import Call


def test_a_callback_follows_a_run(cube: isolux.Scene) -> None:
    seen: list[isolux.Progress] = []
    isolux.solve(cube, accuracy=0.02, progress=False, callback=seen.append)
    assert seen[0].stage == "pilot"
    assert seen[-1].stage == "increments"
    assert seen[-1].error is not None and seen[-1].error <= 0.02
    assert all(state.rays_per_s >= 0 and 0 <= state.share <= 1 for state in seen)
    assert any(state.finish_s is not None for state in seen)


def test_a_callback_ends_a_run_where_it_says(cube: isolux.Scene) -> None:
    def until_five(state: isolux.Progress) -> bool:
        return state.increments < 5

    # The run waits for the answer: the same map every time.
    maps = [
        isolux.solve(cube, accuracy=0.002, progress=False, callback=until_five) for _ in range(2)
    ]
    assert [m.complete for m in maps] == [False, False]
    assert maps[0].increments >= 5
    assert maps[0].to_bytes() == maps[1].to_bytes()


def test_an_exception_of_a_callback_ends_a_run(cube: isolux.Scene) -> None:
    def fail(state: isolux.Progress) -> None:
        raise LookupError("seen enough")

    with pytest.raises(LookupError, match="seen enough"):
        isolux.solve(cube, accuracy=1e-4, progress=False, callback=fail)


def test_ctrl_c_ends_a_run_with_its_map(cube: isolux.Scene) -> None:
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    found = isolux.solve(cube, accuracy=1e-4, progress=False)
    assert time.monotonic() - began < 60
    assert not found.complete
    # Whether its error is known depends on how far it came.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", isolux.IsoluxWarning)
        assert found.probe([(0.5, -5.0, 0.5)], (0, 1, 0))["illuminance_lx"][0] > 0


def test_a_second_ctrl_c_is_an_exception() -> None:
    hall = isolux.load("builtin:hall")
    for seconds in (0.5, 0.8):
        threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()
    # The hall is not subdivided in that time, where a run looks up less often.
    with pytest.raises(KeyboardInterrupt):
        isolux.solve(hall, accuracy=1e-4, progress=False)
        time.sleep(1)


def test_time_limits_and_progress(cube: isolux.Scene, capfd: pytest.CaptureFixture[str]) -> None:
    # Of hours, on any machine.
    found = isolux.solve(cube, accuracy=1e-6, time_limit=5)
    assert not found.complete
    # Not on a terminal: a line now and then.
    assert "target 0.00010 %" in capfd.readouterr().err


def test_other_threads_go_on(cube: isolux.Scene) -> None:
    counted = [0]
    done = threading.Event()

    def count() -> None:
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    isolux.solve(cube, accuracy=1e-4, time_limit="1s", progress=False)
    done.set()
    thread.join()
    # Of a thousand, on a machine with other work.
    assert counted[0] > 50


def test_a_run_goes_on_to_the_same_map(cube: isolux.Scene, tmp_path: Path) -> None:
    def until_five(state: isolux.Progress) -> bool:
        return state.increments < 5

    path = tmp_path / "map.glb"
    isolux.solve(cube, accuracy=0.002, progress=False, output=path, callback=until_five)
    assert (tmp_path / "map.checkpoint").exists()
    resumed = isolux.solve(cube, accuracy=0.002, progress=False, output=path, resume=True)
    assert resumed.complete
    assert path.read_bytes() == isolux.solve(cube, accuracy=0.002, progress=False).to_bytes()


def test_threads_do_not_matter(cube: isolux.Scene, coarse: isolux.Map) -> None:
    alone = isolux.solve(cube, accuracy=0.05, threads=1, progress=False)
    assert alone.to_bytes() == coarse.to_bytes()


@pytest.mark.parametrize(
    "options, words",
    [
        ({"accuracy": 7}, "--accuracy"),
        ({"method": "magic"}, "magic"),
        ({"unshot": 0.1}, "--method radiosity"),
        ({"output": "map.png"}, "end its name in .glb"),
        ({"resume": True}, "no output"),
    ],
)
def test_wrong_arguments(cube: isolux.Scene, options: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError) as found:
        isolux.solve(cube, progress=False, **options)  # type: ignore[arg-type]
    assert words in str(found.value)


def test_too_little_memory_is_refused() -> None:
    with pytest.raises(isolux.RefusedError, match="--max-memory") as found:
        isolux.solve("builtin:hall", progress=False, max_memory="1MB")
    assert isinstance(found.value, OSError)


def test_methods_by_name(cube: isolux.Scene) -> None:
    for method in ("forward", "radiosity", "cache"):
        found = isolux.solve(cube, method=method, accuracy=0.1, progress=False, time_limit=20)
        assert found.report["method"] == method


def test_a_panic_is_a_defect() -> None:
    with pytest.raises(isolux.Defect, match="asked for by a test; please report it"):
        _native.defect(Call())
