"""The state of a run, and how it is shown."""

from __future__ import annotations

import json
import shutil
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from isolux._errors import public

_EVERY_S = 0.1
_LINE_EVERY_S = 2.0
_BAR = 24


@public
@dataclass(frozen=True)
class Progress:
    """The state of a run at one of its increments. What is not known yet is ``None``."""

    #: ``"pilot"`` while the elements are subdivided, then ``"increments"``.
    stage: str
    #: Independent replicates of the computation so far (shots, with ``method="radiosity"``).
    increments: int
    #: The whole error of the scene, a share: 0.01 is 1 %.
    accuracy: float | None
    #: The part of it that is noise.
    accuracy_statistical: float | None
    #: The error that was asked for.
    target: float | None
    #: Vertices that receive light.
    receivers: int
    rays: int
    rays_per_s: float
    #: Time since the beginning, in seconds.
    elapsed_s: float
    #: When the run will end, likely, at the earliest and at the latest: seconds from the beginning.
    finish_s: float | None
    finish_earliest_s: float | None
    finish_latest_s: float | None
    #: The time passed over the time predicted, 0 to 1.
    share: float
    #: All of it in words.
    text: str
    #: With ``method="radiosity"``: the share of all light that is unshot.
    unshot: float | None = None

    @property
    def error(self) -> float | None:
        """The whole error of the scene, a share: the same as ``accuracy``."""
        return self.accuracy


class Shown:
    """Shows a run on standard error, and hands its states to a callback."""

    def __init__(self, bar: bool, callback: Callable[[Progress], object] | None) -> None:
        self._bar = _bar() if bar else None
        self._callback = callback

    def __call__(self, told: str) -> object:
        if self._bar and self._bar.is_due():
            state = json.loads(told)
            self._bar.show(state["share"], state["text"])
        if self._callback is not None:
            return self._callback(Progress(**json.loads(told)))
        return None

    def close(self) -> None:
        """Leave the terminal as it was."""
        if self._bar:
            self._bar.close()


class _Line:
    """A line that changes, on a terminal or in a notebook; elsewhere a line now and then."""

    def __init__(self, changes: bool) -> None:
        self._changes = changes
        self._next = time.monotonic() + (0.0 if changes else _LINE_EVERY_S)
        self._is_shown = False

    def is_due(self) -> bool:
        now = time.monotonic()
        if now < self._next:
            return False
        self._next = now + (_EVERY_S if self._changes else _LINE_EVERY_S)
        return True

    def show(self, share: float, text: str) -> None:
        if not self._changes:
            print(text, file=sys.stderr, flush=True)
            return
        done = round(share * _BAR)
        line = f"{'█' * done}{'░' * (_BAR - done)} {text}"
        width = shutil.get_terminal_size().columns - 1
        print(f"\r{line[:width]:<{width}}", end="", file=sys.stderr, flush=True)
        self._is_shown = True

    def close(self) -> None:
        if self._is_shown:
            width = shutil.get_terminal_size().columns - 1
            print(f"\r{'':{width}}\r", end="", file=sys.stderr, flush=True)


class _Widget:
    """The bar of tqdm in a notebook."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar
        self._next = 0.0

    def is_due(self) -> bool:
        now = time.monotonic()
        is_due = now >= self._next
        if is_due:
            self._next = now + _EVERY_S
        return is_due

    def show(self, share: float, text: str) -> None:
        self._bar.n = round(share, 3)
        self._bar.set_postfix_str(text)

    def close(self) -> None:
        self._bar.close()


def _bar() -> _Line | _Widget:
    if _is_notebook():
        try:
            from tqdm.auto import tqdm
        except ImportError:
            pass
        else:
            return _Widget(tqdm(total=1.0, bar_format="{bar}{postfix}", leave=False))
    return _Line(changes=_is_notebook() or sys.stderr.isatty())


def _is_notebook() -> bool:
    shell = sys.modules.get("IPython")
    found = shell.get_ipython() if shell else None
    return type(found).__name__ == "ZMQInteractiveShell"
