"""One call of the command in this process."""

from __future__ import annotations

import json
import logging
import os
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from isolux import _native
from isolux._arguments import checked
from isolux._errors import IsoluxWarning

Path = str | os.PathLike[str]

#: Has an increment of a run made: gets the scene and the pilot, in bytes, unless they are those of before, the number of the mesh and
#: that of the increment, and returns a part, or ``None`` to end the run.
Increment = Callable[[bytes | None, bytes | None, int, int], bytes | None]

_LOG = logging.getLogger("isolux")

#: The exit code of a subcommand that was ended by Ctrl-C.
_INTERRUPTED = 130


class Call:
    """Hears what a call tells, and keeps what it makes."""

    def __init__(
        self,
        progress: Callable[[str], object] | None = None,
        increment: Increment | None = None,
        told: Callable[[str], str] | None = None,
    ) -> None:
        self.report: Any = None
        self.warnings: list[str] = []
        self.notes: list[str] = []
        self.maps: list[tuple[str, _native.Map]] = []
        self.image: Any = None
        self.exit_code = 0
        self._progress = progress
        self._increment = increment
        self._told = told or str

    def __call__(self, kind: str, told: Any) -> object:
        if kind == "progress":
            return self._progress(told) if self._progress else None
        if kind == "increment":
            return self._increment(*told) if self._increment else None
        if kind == "json":
            self.report = json.loads(told)
        elif kind == "map":
            self.maps.append((os.fspath(told[0]), told[1]))
        elif kind in ("picture", "luminances"):
            self.image = told
        elif kind == "text":
            self.report = told
        elif kind == "note":
            self.notes.append(self._told(told))
        else:
            self.warnings.append(self._told(told))
        return None

    def run(
        self,
        words: Sequence[str],
        given: Sequence[tuple[str, _native.Scene | _native.Map]] = (),
        waits: bool = False,
    ) -> Call:
        """Run a subcommand."""
        try:
            makes = self._increment is not None
            self.exit_code = _native.run(list(words), list(given), self, waits, makes)
        finally:
            self.pass_on()
        if self.exit_code == _INTERRUPTED and not self._has_result():
            raise KeyboardInterrupt
        return self

    def _has_result(self) -> bool:
        return bool(self.maps) or self.report is not None or self.image is not None

    def pass_on(self) -> None:
        """Give warnings to ``warnings``, and notes to ``logging``."""
        for text in self.notes:
            _LOG.info(text)
        for text in self.warnings:
            warnings.warn(text, IsoluxWarning, stacklevel=_outside())


def _outside() -> int:
    """How many frames the caller of this package is above ``pass_on``."""
    import sys

    frame, level = sys._getframe(1), 1
    while frame.f_back and frame.f_globals.get("__package__") == "isolux":
        frame, level = frame.f_back, level + 1
    return level


def words(**flags: Any) -> list[str]:
    """Flags as the command has them: none of those that are ``None`` or ``False``."""
    found: list[str] = []
    for name, value in flags.items():
        flag = "--" + name.strip("_").replace("_", "-")
        if isinstance(value, np.bool_):
            value = bool(value)
        if value is None or value is False:
            continue
        if value is True:
            found.append(flag)
        elif isinstance(value, (list, tuple)) or (hasattr(value, "ndim") and value.ndim > 0):
            found += [flag, ",".join(word(part) for part in value)]
        else:
            found += [flag, word(value)]
    return found


def repeated(name: str, values: str | Sequence[Any]) -> list[str]:
    """A flag that may be given several times."""
    several = [values] if isinstance(values, str) else values
    return [part for value in several for part in words(**{name: value})]


def word(value: Any) -> str:
    """A value as the command has it."""
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    return repr(float(value)) if isinstance(value, float) else str(value)


def with_unit(value: float | str | None, unit: str) -> str | None:
    """A number with the unit that it is in; text as it is."""
    return value if value is None or isinstance(value, str) else f"{float(value)!r}{unit}"


@checked
def command(*arguments: Path) -> Any:
    """Run a subcommand in this process and return what it prints with ``--json``.

    ``isolux.command("info", "lamp.ies")`` is ``isolux info lamp.ies --json`` as Python objects; ``--help`` and ``--version`` are text. Every
    subcommand works but ``view``, and ``solve --live``, which serve until they are stopped. The keys are in the book of isolux, under JSON.
    Results that are negative are results: ``lint`` of a bad file returns its findings. Warnings are ``IsoluxWarning``; failures are
    ``InputError`` and ``RefusedError``.
    """
    return Call().run([os.fspath(argument) for argument in arguments]).report
