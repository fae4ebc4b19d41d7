"""Exceptions, with the words of the command."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

T = TypeVar("T")


def public(kind: type[T]) -> type[T]:
    """The class, by the name that programs know it by."""
    kind.__module__ = "isolux"
    return kind


@public
class Problem(NamedTuple):
    """One problem: all of it in one line, and its parts where they are known."""

    message: str
    file: str | None
    place: str | None
    #: What you can do.
    remedy: str | None


@public
class Error(Exception):
    """What keeps isolux from a result. ``problems`` has all that was found, the first included."""

    problems: list[Problem]

    @classmethod
    def _of(cls, problems: list[tuple[str, str | None, str | None, str | None]]) -> Error:
        found = [Problem(*problem) for problem in problems]
        error = cls("\n".join(problem.message for problem in found))
        error.problems = found
        return error


@public
class InputError(Error, ValueError):
    """An input that you can mend: a file, a scene, an argument."""


def wrong(text: str) -> Error:
    """An argument that is wrong, and behind a semicolon how it is right."""
    _, _, remedy = text.rpartition("; ")
    return InputError._of([(text, None, None, remedy if remedy != text else None)])


@public
class RefusedError(Error, OSError):
    """What the machine cannot do: memory, space on a disk."""


@public
class Defect(Error, RuntimeError):
    """A defect of isolux itself."""

    @classmethod
    def _of(cls, problems: object) -> Defect:
        text = f"a defect of isolux: {problems}; please report it, with the scene if you can"
        error = cls(text)
        error.problems = [Problem(text, None, None, None)]
        return error


@public
class IsoluxWarning(UserWarning):
    """What was left out or guessed: in a file that was read, or by a run."""
