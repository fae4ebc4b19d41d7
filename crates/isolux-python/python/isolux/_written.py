"""A ``scene.toml`` that is written for its reader. What that says of places in it is told of the arguments that they come from."""

from __future__ import annotations

import datetime
import json
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from isolux._arguments import misfit
from isolux._errors import Error, InputError, Problem

#: Keys that need no quotes.
_BARE = re.compile(r"[A-Za-z0-9_-]+")


class Written:
    """The file, line by line."""

    def __init__(self, folder: Path, function: str) -> None:
        self.folder = folder
        self.file = folder / "scene.toml"
        self._function = function
        self._lines: list[str] = []
        #: The argument of every line.
        self._places: list[str] = []
        #: Those of the other files in the folder.
        self._files: dict[str, str] = {}

    def line(self, text: str, place: str) -> None:
        """One line, and the argument that it comes from."""
        self._lines.append(text)
        self._places.append(place)

    def table(
        self,
        header: str,
        keys: Mapping[str, Any],
        place: str,
        names: Mapping[str, str] | None = None,
    ) -> None:
        """A table; the place of its keys is told by other ``names``, if they have them."""
        self.line(header, place)
        for key, value in keys.items():
            where = (names or {}).get(key, f".{key}")
            self.line(f"{_key(key)} = {toml(value, place + where)}", place + where)

    def beside(self, file: str, place: str) -> Path:
        """A further file, and the argument that it comes from."""
        self._files[file] = place
        return self.folder / file

    def save(self) -> None:
        """Write the file."""
        self.file.write_text("\n".join(self._lines) + "\n", encoding="utf-8")

    def told(self, text: str) -> str:
        """What is told of the file, told of the arguments."""
        own = rf"{re.escape(str(self.file))}(?:: (line \d+(?:, column \d+)?))?"
        text = re.sub(own, lambda at: self._where(at[1]), text)
        for file, place in self._files.items():
            text = text.replace(str(self.folder / file), f"{self._function}: {place}")
        return text.replace(str(self.folder), self._function)

    def _where(self, line: str | None) -> str:
        place = self._place(line)
        return f"{self._function}: {place}" if place else self._function

    def _place(self, line: str | None) -> str | None:
        number = re.match(r"line (\d+)", line or "")
        lines = len(self._places)
        return self._places[min(int(number[1]), lines) - 1] if number else line

    def error(self, error: Error) -> Error:
        """The same error, told of the arguments."""
        return InputError._of([self._problem(problem) for problem in error.problems])

    def _problem(self, problem: Problem) -> Problem:
        own = {str(self.folder / file): place for file, place in self._files.items()}
        file, place = problem.file, problem.place
        if file == str(self.file):
            file, place = None, self._place(place)
        elif file is not None and file in own:
            place, file = own[file], None
        remedy = problem.remedy and self.told(problem.remedy)
        return Problem(self.told(problem.message), file, place, remedy)


def written(keys: Mapping[str, Any], place: str) -> str:
    """A table as the words of an argument of the command."""
    return ", ".join(f"{_key(key)} = {toml(value, f'{place}.{key}')}" for key, value in keys.items())


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise misfit("a key", key, "text")
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    """A string of JSON is one of TOML."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml(value: Any, place: str) -> str:
    """A value in TOML, and the argument that it comes from."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, datetime.datetime):
        return value.isoformat()
    if isinstance(value, Mapping):
        parts = (f"{_key(k)} = {toml(v, f'{place}.{k}')}" for k, v in value.items())
        return "{ " + ", ".join(parts) + " }"
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(toml(v, f"{place}[{k}]") for k, v in enumerate(value)) + "]"
    raise misfit(place, value, "a number, text, True or False, a datetime, a list or a dict")
