"""The increments of a run, in order, from workers that make them ahead in any order."""

from __future__ import annotations

import threading
import time
import uuid
from typing import Any

from isolux._errors import RefusedError
from isolux.cluster import _ray, _worker

#: A task is to take this long, s: long beside the thousandth that Ray takes for it, short beside a run.
_TASK_S = 0.25
_MOST_TOGETHER = 64
#: How many tasks for each that is being done may be ahead of the increment that is wanted. A node that is lost is noticed after some
#: seconds; until then the others have something to do.
_AHEAD = 64
#: The share of the object store that increments ahead may take.
_SHARE_OF_STORE = 0.25
#: How often a task may be lost with its worker.
_MOST_LOSSES = 10
#: How often the size of the cluster is looked at, s.
_LOOK_S = 1.0


class Feed:
    """Has increments made by tasks of Ray, and hands them out in order. A thread keeps workers busy while the run adds and audits."""

    def __init__(self, ray: Any, workers: int | None, threads: int) -> None:
        self._ray = ray
        self._workers = workers
        self._threads = threads
        # Lost tasks are done again; what they raise is not.
        self._make = ray.remote(_worker.make).options(
            num_cpus=threads, max_retries=_MOST_LOSSES - 1, retry_exceptions=False
        )
        self._run = uuid.uuid4().hex
        self._mesh = 0
        self._refs: list[Any] = [None, None]
        self._pending: dict[Any, tuple[int, int]] = {}
        self._made: dict[int, Any] = {}
        self._wanted = 0
        self._next = 0
        self._increment_s: float | None = None
        self._part_bytes = 0
        self._slots = 1
        self._looked = 0.0
        self._store_bytes = 0.0
        self._failure: BaseException | None = None
        self._ends = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._keep_busy, name="isolux feed", daemon=True)
        self._thread.start()

    def __call__(
        self, scene: bytes | None, pilot: bytes | None, stage: int, increment: int
    ) -> bytes | None:
        """The part of an increment; see :data:`isolux._call.Increment`."""
        if pilot is not None:
            self._begin(scene, pilot, increment)
        with self._changed:
            self._wanted = increment
            self._changed.notify_all()
            while increment not in self._made:
                if self._failure:
                    raise self._failure
                # Now and then, since a wait without end is deaf to Ctrl-C on some systems.
                self._changed.wait(1.0)
            part: bytes = self._made.pop(increment).tobytes()
            return part

    def close(self) -> None:
        """End all that is still being made."""
        with self._changed:
            self._ends = True
            self._changed.notify_all()
        self._thread.join()
        self._cancel()

    def _begin(self, scene: bytes | None, pilot: bytes, increment: int) -> None:
        new_scene = self._ray.put(scene) if scene is not None else None
        new_pilot = self._ray.put(pilot)
        with self._changed:
            self._cancel()
            self._refs = [new_scene or self._refs[0], new_pilot]
            self._mesh += 1
            self._made.clear()
            self._increment_s = None
            self._next = self._wanted = increment

    def _cancel(self) -> None:
        for ref in self._pending:
            self._ray.cancel(ref)
        self._pending.clear()

    def _keep_busy(self) -> None:
        try:
            while True:
                with self._changed:
                    if self._ends:
                        return
                    self._look()
                    self._fill()
                    pending = list(self._pending)
                    if not pending:
                        self._changed.wait(_LOOK_S)
                        continue
                ready, _ = self._ray.wait(pending, num_returns=1, timeout=_LOOK_S)
                self._take(ready)
        except BaseException as failure:
            with self._changed:
                self._failure = failure
                self._changed.notify_all()

    def _look(self) -> None:
        """How large is the cluster now?"""
        now = time.monotonic()
        if now >= self._looked + _LOOK_S:
            self._looked = now
            self._slots = _ray.slots(self._ray, self._threads)
            self._store_bytes = self._ray.cluster_resources().get("object_store_memory", 0.0)

    def _fill(self) -> None:
        """Give as many tasks as the cluster can do, and as many again, so that none waits for us and a cluster that grows by demand sees
        some."""
        limit = min(self._workers or self._slots, self._slots)
        most = 2 * limit if limit == self._slots else limit
        if self._refs[1] is None:
            return
        while len(self._pending) < most:
            first = self._next
            count = self._together(limit)
            if first + count > self._wanted + self._most_ahead(limit, count):
                return
            ref = self._make.remote(
                (self._run, self._mesh), self._refs, first, first + count, self._threads
            )
            self._pending[ref] = (first, count)
            self._next += count

    def _together(self, limit: int) -> int:
        """Increments in a task: few while the run is short, so that the first ones do not wait for many."""
        if not self._increment_s:
            return 1
        by_time = int(_TASK_S / self._increment_s)
        return max(1, min(by_time, _MOST_TOGETHER, self._wanted // (2 * limit)))

    def _most_ahead(self, limit: int, count: int) -> int:
        """Increments ahead of the one that is wanted."""
        by_number = _AHEAD * limit * count
        by_bytes = int(_SHARE_OF_STORE * self._store_bytes / max(1, self._part_bytes))
        # The one that is wanted is always made.
        return max(count, min(by_number, by_bytes))

    def _take(self, ready: list[Any]) -> None:
        for ref in ready:
            with self._changed:
                known = self._pending.get(ref)
            if known is None:
                # Of an earlier mesh.
                continue
            first, count = known
            try:
                seconds, parts = self._ray.get(ref)
            except self._ray.exceptions.RayTaskError as failure:
                raise failure.cause or failure from failure
            except self._ray.exceptions.RayError as failure:
                with self._changed:
                    if ref not in self._pending:
                        continue
                text = f"increment {first} was lost {_MOST_LOSSES} times with its worker: {failure}"
                raise RefusedError(text) from failure
            with self._changed:
                if self._pending.pop(ref, None) is None:
                    continue
                self._increment_s = seconds
                self._part_bytes = max(len(part) for part in parts)
                self._made.update(zip(range(first, first + count), parts))
                self._changed.notify_all()
