"""Arguments are looked at before any work: what they are has to fit the types that functions tell.

:func:`checked` reads the types from the signature of a function, so that none is told twice. What the tables below do not know is left to
the function itself, as what only some values of a type can be.
"""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, ParamSpec, TypeVar

import numpy as np

from isolux._errors import wrong

P = ParamSpec("P")
R = TypeVar("R")

#: Three numbers: x, y and z.
Point = Sequence[float]

#: Of an argument that is shown, in letters.
_MOST_SHOWN = 60


class Kind(NamedTuple):
    """What arguments of a type are."""

    #: What to give, in words.
    give: str
    fits: Callable[[Any], bool]


def _are_numbers(value: Any, kinds: str = "iuf", shape: tuple[int, ...] | None = ()) -> bool:
    """Whether these are numbers, of a shape if there is one; truths and text are none."""
    try:
        array = np.asarray(value)
    except ValueError:
        return False
    return array.dtype.kind in kinds and (array.ndim == 1 if shape is None else array.shape == shape)


def _is_instance(name: str) -> Callable[[Any], bool]:
    """Whether it is one of this class of isolux, which may not be there yet."""
    return lambda value: any(
        kind.__name__ == name and kind.__module__ == "isolux" for kind in type(value).__mro__
    )


def _are_text(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str)
    return is_list and all(isinstance(part, str) for part in value)


def _are_bytes(value: Any) -> bool:
    return isinstance(value, Sequence) and all(isinstance(part, bytes) for part in value)


_FUNCTION = Kind("a function", callable)
_PATH = Kind("a path", lambda value: isinstance(value, (str, os.PathLike)))
_KINDS = {
    "bool": Kind("True or False", lambda value: isinstance(value, (bool, np.bool_))),
    "int": Kind("a whole number", lambda value: _are_numbers(value, "iu")),
    "float": Kind("a number", _are_numbers),
    "str": Kind("text", lambda value: isinstance(value, str)),
    "bytes": Kind("bytes", lambda value: isinstance(value, bytes)),
    "Path": _PATH,
    "os.PathLike[str]": _PATH,
    "Point": Kind("three numbers, (x, y, z)", lambda value: _are_numbers(value, shape=(3,))),
    "Sequence[float]": Kind("a list of numbers", lambda value: _are_numbers(value, shape=None)),
    "tuple[int, int]": Kind("two whole numbers", lambda value: _are_numbers(value, "iu", (2,))),
    "tuple[float, float]": Kind("two numbers", lambda value: _are_numbers(value, shape=(2,))),
    "Sequence[str]": Kind("a list of text", _are_text),
    "Mapping[str, Any]": Kind("a dict", lambda value: isinstance(value, Mapping)),
    "Sky": Kind("text or a dict", lambda value: isinstance(value, (str, Mapping))),
    "Sequence[bytes]": Kind("a list of bytes", _are_bytes),
    "Map": Kind("an isolux.Map", _is_instance("Map")),
    "Grid": Kind("an isolux.Grid", _is_instance("Grid")),
    "Next": _FUNCTION,
    "None": Kind("None", lambda value: value is None),
}


def _kind(type_: str) -> Kind | None:
    """What arguments of a type are; none where that is not told here."""
    parts = type_.split(" | ")
    kinds = [_FUNCTION if part.startswith("Callable[") else _KINDS.get(part) for part in parts]
    known = [kind for kind in kinds if kind is not None]
    if len(known) < len(parts):
        return None
    give = " or ".join(kind.give for kind in known if kind.give != "None")
    return Kind(give, lambda value: any(kind.fits(value) for kind in known))


def kinds_of(function: Callable[..., object]) -> dict[str, Kind]:
    """What the arguments of a function are, as far as it is known, by their names."""
    found = {}
    for parameter in inspect.signature(function).parameters.values():
        kind = isinstance(parameter.annotation, str) and _kind(parameter.annotation)
        if kind and parameter.kind is not inspect.Parameter.VAR_KEYWORD:
            found[parameter.name] = kind
    return found


def checked(function: Callable[P, R]) -> Callable[P, R]:
    """The function, which refuses arguments that do not fit its types."""
    signature, kinds = inspect.signature(function), kinds_of(function)

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            given = signature.bind(*args, **kwargs).arguments
        except TypeError:
            # Python says it better.
            return function(*args, **kwargs)
        for name, value in given.items():
            is_many = signature.parameters[name].kind is inspect.Parameter.VAR_POSITIONAL
            if not is_many:
                look(kinds, {name: value})
            elif name in kinds:
                several = {f"{name}[{k}]": part for k, part in enumerate(value)}
                look(dict.fromkeys(several, kinds[name]), several)
        return function(*args, **kwargs)

    return call


def look(kinds: Mapping[str, Kind], given: Mapping[str, Any]) -> None:
    """Refuse the first argument that is not of its kind."""
    for name, value in given.items():
        if name in kinds and not kinds[name].fits(value):
            raise misfit(name, value, kinds[name].give)


def misfit(name: str, value: Any, give: str) -> Exception:
    """An argument that is wrong."""
    text = " ".join(repr(value).split())
    if len(text) > _MOST_SHOWN:
        text = text[:_MOST_SHOWN] + "..."
    return wrong(f"{name} is {text}; give {give}")


def at_least(least: int, **arguments: int | None) -> None:
    """Refuse whole numbers that are too small."""
    for name, value in arguments.items():
        if value is not None and value < least:
            raise wrong(f"{name} is {value}; give at least {least}")
