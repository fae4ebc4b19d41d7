"""Studies: one function of many variants, and what it returns in one table."""

from __future__ import annotations

import json
import os
import string
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from isolux._arguments import at_least, checked
from isolux._call import Path
from isolux._errors import InputError, wrong
from isolux._scene import load
from isolux.cluster import _ray

if TYPE_CHECKING:
    import pandas

Variant = Mapping[str, Any]

#: How often a variant may be lost with its worker.
_MOST_LOSSES = 3
_LOOK_S = 1.0


class Table(list[dict[str, Any]]):
    """Rows of a study, in the order of its variants: the variant, and what the function returned for it, or ``error``."""

    @property
    def frame(self) -> pandas.DataFrame:
        """The same as a table of pandas, if that is installed."""
        import pandas

        return pandas.DataFrame(list(self))

    @property
    def failures(self) -> Table:
        """The rows that have an ``error``."""
        return Table(row for row in self if row.get("error") is not None)


@checked
def study(
    function: Callable[..., Mapping[str, Any]],
    variants: Iterable[Variant],
    *,
    template: Path | None = None,
    output: Path | None = None,
    address: str | None = None,
    workers: int | None = None,
    threads: int = 1,
    progress: bool = True,
) -> Table:
    """Call a function for every variant on a cluster of Ray, and collect what it returns.

    ``function`` gets the keys of a variant as keyword arguments, makes a scene, solves it and returns a row: a dict of plain values. It
    runs on a worker with ``threads`` processors; give them to :func:`isolux.solve`, too. ``variants``: dicts of plain values.

    ``template``: a ``scene.toml`` with ``${key}`` in it, for which the values of the variant are put. It is read here, with the files
    that it names; the function gets the scene as its first argument.

    A variant that fails is a row with its ``error`` and the keys of the variant; so is one whose worker is lost three times. ``output``:
    a file of JSON lines that gets every row as it is made. Variants that it has a row of without an ``error`` are not made again: a
    study that was stopped goes on. Rows do not depend on workers, and are in the order of variants, in the file, too, at the end.
    ``address`` and ``workers`` are those of :func:`isolux.cluster.solve`.

    Ctrl-C raises ``KeyboardInterrupt``; rows that were made are in ``output``.
    """
    at_least(1, workers=workers, threads=threads)
    asked = [dict(variant) for variant in variants]
    keys = [_key(number, variant) for number, variant in enumerate(asked)]
    file = FilePath(output) if output is not None else None
    known = _known(file) if file else {}
    rows: dict[int, dict[str, Any]] = {
        number: known[key] for number, key in enumerate(keys) if key in known
    }
    left = [number for number in range(len(asked)) if number not in rows]
    shown = _Shown(len(asked), progress)
    if left:
        with _ray.connected(address, workers * threads if workers else None) as ray:
            make = ray.remote(_row).options(
                num_cpus=threads, max_retries=_MOST_LOSSES - 1, retry_exceptions=False
            )
            held = ray.put(function)

            def begin(number: int) -> Any:
                return make.remote(held, asked[number], *_scenes(template, asked[number]))

            for number, row in _rows(ray, begin, left, workers, threads):
                rows[number] = {**asked[number], **row}
                if file:
                    _append(file, keys[number], rows[number])
                shown.show(len(rows), sum("error" in row for row in rows.values()))
    shown.close()
    if file:
        _write(file, [(keys[number], rows[number]) for number in range(len(asked))])
    return Table(rows[number] for number in range(len(asked)))


def _row(function: Callable[..., Mapping[str, Any]], variant: Variant, *scenes: Any) -> Any:
    """What the function returns, or why it fails. On a worker."""
    try:
        # As the file has it, so that a study that goes on has the same rows.
        return json.loads(json.dumps(dict(function(*scenes, **variant)), default=_plain))
    except Exception as failure:
        return {"error": f"{type(failure).__name__}: {failure}"}


def _rows(
    ray: Any,
    begin: Callable[[int], Any],
    numbers: Sequence[int],
    workers: int | None,
    threads: int,
) -> Iterable[tuple[int, dict[str, Any]]]:
    """Rows as they are made, with twice as many tasks as the cluster can do at a time."""
    left = iter(numbers)
    pending: dict[Any, int] = {}
    try:
        while True:
            slots = _ray.slots(ray, threads)
            most = workers if workers and workers < slots else 2 * slots
            for number in left:
                try:
                    pending[begin(number)] = number
                except (InputError, KeyError, ValueError) as failure:
                    yield number, {"error": f"{type(failure).__name__}: {failure}"}
                if len(pending) >= most:
                    break
            if not pending:
                return
            ready, _ = ray.wait(list(pending), num_returns=1, timeout=_LOOK_S)
            for ref in ready:
                number = pending.pop(ref)
                try:
                    yield number, ray.get(ref)
                except ray.exceptions.RayError as failure:
                    first = str(failure).strip().splitlines()[0]
                    yield number, {"error": f"{type(failure).__name__}: {first}"}
    finally:
        for ref in pending:
            ray.cancel(ref)


def _scenes(template: Path | None, variant: Variant) -> list[Any]:
    """The scene of a template, if there is one. The file of a variant lies beside the template, since that names others."""
    if template is None:
        return []
    path = FilePath(template)
    try:
        text = string.Template(path.read_text(encoding="utf-8")).substitute(variant)
    except KeyError as missing:
        raise KeyError(f"{path}: the variant has no {missing} for ${{{missing.args[0]}}}") from None
    own = path.with_name(f".{path.stem}-{os.getpid()}.toml")
    try:
        own.write_text(text, encoding="utf-8")
        return [load(own)._named(str(path))]
    finally:
        own.unlink(missing_ok=True)


def _plain(value: Any) -> Any:
    """Numbers and arrays of numpy as JSON has them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a row holds {type(value).__name__}; return numbers, text, lists and dicts")


def _key(number: int, variant: Variant) -> str:
    try:
        return json.dumps(variant, sort_keys=True, default=_plain)
    except TypeError as failure:
        raise wrong(f"variant {number}: {failure}") from None


def _line(key: str, row: Mapping[str, Any]) -> str:
    return json.dumps({"variant": json.loads(key), "row": row}, default=_plain) + "\n"


def _append(file: FilePath, key: str, row: Mapping[str, Any]) -> None:
    with open(file, "a", encoding="utf-8") as out:
        out.write(_line(key, row))


def _write(file: FilePath, rows: Iterable[tuple[str, Mapping[str, Any]]]) -> None:
    """All rows in order, in place of those in the order in which they were made."""
    beside = file.with_name(file.name + ".new")
    beside.write_text("".join(_line(key, row) for key, row in rows), encoding="utf-8")
    os.replace(beside, file)


def _known(file: FilePath) -> dict[str, dict[str, Any]]:
    """The rows of a file that have no error, by the key of their variant."""
    found: dict[str, dict[str, Any]] = {}
    if not file.exists():
        return found
    lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
    for number, line in enumerate(lines, 1):
        try:
            held = json.loads(line)
            key, row = json.dumps(held["variant"], sort_keys=True), held["row"]
        except (ValueError, KeyError, TypeError):
            # The last line of a study that was killed.
            if number == len(lines) and not line.endswith("\n"):
                file.write_text("".join(lines[:-1]), encoding="utf-8")
                break
            text = f"{file}: line {number} is no row of a study; name another file, or remove it"
            raise wrong(text) from None
        if "error" not in row:
            found[key] = row
    return found


class _Shown:
    """A line now and then."""

    def __init__(self, count: int, progress: bool) -> None:
        self._count = count
        self._began = time.monotonic()
        self._first: tuple[int, float] | None = None
        self._next = 0.0
        self._line = sys.stderr.isatty()
        self._on = progress

    def show(self, done: int, failed: int) -> None:
        now = time.monotonic()
        if self._first is None:
            self._first = (done, now)
        if not self._on or (now < self._next and done < self._count):
            return
        self._next = now + (0.2 if self._line else 2.0)
        text = f"{done} of {self._count} variants"
        if failed:
            text += f", {failed} failed"
        since, then = self._first
        if done > since:
            text += f", {(self._count - done) * (now - then) / (done - since):.0f} s left"
        if self._line:
            print(f"\r{text:<79}", end="", file=sys.stderr, flush=True)
        else:
            print(text, file=sys.stderr, flush=True)

    def close(self) -> None:
        if self._on and self._line:
            print(f"\r{'':79}\r", end="", file=sys.stderr, flush=True)
