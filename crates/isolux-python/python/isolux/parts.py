"""Parts of runs: a pilot, increments made anywhere, and the map of all. As ``solve --increments`` and ``merge`` of the command.

    pilot = isolux.parts.make_pilot(scene, accuracy=0.01)
    a = isolux.parts.PartMaker(scene, pilot).make(0, 8)     # on one machine
    b = isolux.parts.PartMaker(scene, pilot).make(8, 16)    # on another
    m = isolux.parts.to_map([a, b], scene, pilot=pilot)

Bytes are those of the files ``.pilot`` and ``.part``. :mod:`isolux.cluster` distributes increments by itself.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from typing import Any

from isolux import _native
from isolux._arguments import at_least, checked
from isolux._call import Call, Path
from isolux._errors import wrong
from isolux._map import Map
from isolux._progress import Shown
from isolux._scene import Scene, as_scene
from isolux._solve import flags_of, solve

__all__ = ["PartMaker", "make_pilot", "merge", "solve_elsewhere", "to_map"]

#: Increments of a run at most.
MOST_INCREMENTS = 1 << 15

#: Gets the bytes of the pilot (``None`` if it is the one of before), the number of the mesh and that of an increment, and returns the
#: part of that increment, or ``None`` to end the run.
Next = Callable[[bytes | None, int, int], bytes | None]


@checked
def make_pilot(scene: Scene | Path, *, progress: bool = False, **options: Any) -> bytes:
    """Make the pilot of a run, which fixes its elements. ``options`` are those of :func:`isolux.solve`; all parts have them in common."""
    scene = as_scene(scene)
    shown = Shown(progress, None)
    try:
        return _written(
            "run.pilot", ["solve", *flags_of(**options)], [scene._source], scene, Call(shown)
        )
    finally:
        shown.close()


class PartMaker:
    """Makes increments of a run. What all of them share is computed once, and held by a thread with ``threads`` more.

    The pilot holds the options of the run. A scene that differs from its own, and another build of isolux, are an
    :class:`isolux.InputError`.
    """

    @checked
    def __init__(self, scene: Scene | Path, pilot: bytes, *, threads: int | None = None) -> None:
        at_least(1, threads=threads)
        scene = as_scene(scene)
        self._native = _native.PartMaker(scene._native, scene._source, pilot, threads)

    @checked
    def make(self, first: int, end: int) -> bytes:
        """Make the increments with the numbers ``first`` to ``end`` - 1. Other threads of Python go on meanwhile."""
        if not 0 <= first < end <= MOST_INCREMENTS:
            raise wrong(
                f"first and end are {first} and {end}; give 0 <= first < end <= {MOST_INCREMENTS}"
            )
        return self._native.make(first, end)


@checked
def merge(parts: Sequence[bytes]) -> bytes:
    """Add parts of one run, in any order and grouping."""
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        return _written("all.part", ["merge"], _files(parts, folder))


@checked
def to_map(
    parts: Sequence[bytes],
    scene: Scene | Path,
    *,
    pilot: bytes | None = None,
    filter: bool = True,
    threads: int | None = None,
) -> Map:
    """The map of the first increments of a run, without a gap, as ``isolux merge`` has it. Without a pilot, it is made again."""
    scene = as_scene(scene)
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        words = ["merge", *flags_of(filter=filter, threads=threads, scene=scene._source)]
        if pilot is not None:
            words += ["--pilot", _file(folder, "run.pilot", pilot)]
        words += ["-o", os.path.join(folder, "map.glb"), "--", *_files(parts, folder)]
        call = Call().run(words, [(scene._source, scene._native)])
    return Map(call.maps[-1][1], scene.name, call)


@checked
def solve_elsewhere(scene: Scene | Path, next: Next, **options: Any) -> Map:
    """Compute a map as :func:`isolux.solve` does, with its ``options`` and its bytes, from increments that ``next`` has made elsewhere.

    The pilot and the audit are made here. ``next`` is asked for one increment after the other, and again from 0 on a finer mesh.
    """
    if options.get("group"):
        raise wrong("group: every group has a scene of its own; use isolux.cluster.solve")
    return solve(scene, _increment=lambda _scene, *of: next(*of), **options)


def _written(
    name: str,
    words: Sequence[str],
    read: Sequence[str],
    scene: Scene | None = None,
    call: Call | None = None,
) -> bytes:
    """The bytes of the file that a subcommand writes."""
    given = [] if scene is None else [(scene._source, scene._native)]
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        path = os.path.join(folder, name)
        (call or Call()).run([*words, "-o", path, "--", *read], given)
        with open(path, "rb") as file:
            return file.read()


def _files(parts: Sequence[bytes], folder: str) -> list[str]:
    return [_file(folder, f"{number}.part", part) for number, part in enumerate(parts)]


def _file(folder: str, name: str, data: bytes) -> str:
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(data)
    return path
