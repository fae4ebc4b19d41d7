"""Arguments that fit no type are refused before any work."""

from __future__ import annotations

import inspect
import pickle
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import isolux
import numpy as np
import pytest
from conftest import room
from isolux import _arguments, plots, study

#: The same to whoever checks types.
ISOLUX: Any = isolux
PLOTS: Any = plots
STUDY: Any = study

#: What fits types that a function needs.
FITTING: dict[str, Any] = {
    "Path": "x",
    "bytes": b"",
    "float": 1.0,
    "int": 1,
    "str": "x",
    "Next": print,
    "Sequence[bytes]": [b""],
}


def functions() -> Iterator[tuple[str, Callable[..., object]]]:
    """All that programs call."""
    for module in (isolux, isolux.parts, plots, study):
        all_names = (name for name in vars(module) if not name.startswith("_"))
        own = [name for name in all_names if _is_of(getattr(module, name), module)]
        for name in getattr(module, "__all__", own):
            of = getattr(module, name)
            if inspect.isfunction(of):
                yield f"{module.__name__}.{name}", of
            elif inspect.isclass(of):
                for method, its in inspect.getmembers(of, inspect.isroutine):
                    if not method.startswith("_") and hasattr(its, "__wrapped__"):
                        yield f"{module.__name__}.{name}.{method}", its


def _is_of(of: object, module: ModuleType) -> bool:
    return getattr(of, "__module__", None) == module.__name__


class Nothing:
    """What is of no type."""

    def __repr__(self) -> str:
        return "<nothing>"


def test_functions_refuse_arguments_of_no_type_by_their_names(coarse: isolux.Map) -> None:
    fitting = {**FITTING, "Map": coarse, "Grid": coarse.grid(height=0.0, spacing=1.0)}
    seen = 0
    for name, function in functions():
        kinds = _arguments.kinds_of(function)
        parameters = inspect.signature(function).parameters.values()
        needed = [p for p in parameters if p.default is p.empty]
        named = [p for p in needed if p.kind is p.POSITIONAL_OR_KEYWORD]
        for wrong in (p for p in parameters if p.name in kinds):
            given = {p.name: fitting.get(p.annotation) for p in named if p is not wrong}
            is_many = wrong.kind is wrong.VAR_POSITIONAL
            arguments = [*given.values(), Nothing()] if is_many else []
            keywords = {} if is_many else {**given, wrong.name: Nothing()}
            with pytest.raises(isolux.InputError) as found:
                function(*arguments, **keywords)
            of = f"{wrong.name}[0]" if is_many else wrong.name
            assert str(found.value).startswith(f"{of} is <nothing>; give "), name
            seen += 1
    # Of solve alone there are two dozen.
    assert seen > 80


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda m: ISOLUX.solve("builtin:cube", accuracy=[0.05]), "accuracy is [0.05]; give a num"),
        (lambda m: ISOLUX.solve("builtin:cube", callback=3), "callback is 3; give a function"),
        (lambda m: ISOLUX.solve("builtin:cube", filter="no"), "filter is 'no'; give True or False"),
        (lambda m: ISOLUX.solve("builtin:cube", seed=1.5), "seed is 1.5; give a whole number"),
        (lambda m: ISOLUX.parts.make_pilot("builtin:cube", audit=3), "audit is 3; give True or"),
        (lambda m: m.render(false_colour=True, limits=(0, 5, 9)), "limits is (0, 5, 9); give two"),
        (lambda m: m.render(eye=(1, 2)), "eye is (1, 2); give three numbers"),
        (lambda m: m.render(width=0), "width is 0; give at least 1"),
        (lambda m: m.view(height=-3), "height is -3; give at least 1"),
        (lambda m: m.view(live="yes"), "live is 'yes'; give True or False"),
        (lambda m: m.audit(places=True), "places is True; give a whole number"),
        (lambda m: m.probe("here"), "points is 'here'; give (n, 3) or (3,) numbers"),
        (lambda m: m.probe([(0, 0, 0), (0, 0)]), "points is [(0, 0, 0), (0, 0)]; give"),
        (lambda m: m.probe([(0, 0, np.nan)]), "point 0: a coordinate is not finite"),
        (lambda m: m.scene.probe([(0, 0, 0)], seed=-1), "seed is -1; give at least 0"),
        (lambda m: m.mix({"a": None}), "dim['a'] is None; give a number or text"),
        (lambda m: ISOLUX.mix([m, 3]), "give maps or paths of maps"),
        (lambda m: ISOLUX.command("info", 3), "arguments[1] is 3; give a path"),
        (lambda m: ISOLUX.info(m), "path is <isolux.Map of"),
        (lambda m: ISOLUX.Luminaire(3), "file is 3; give text or a path"),
        (lambda m: ISOLUX.Luminaire(position=(1, 2)), "position is (1, 2); give three numbers"),
        (lambda m: STUDY.points("box"), "choose cube or sphere"),
        (lambda m: PLOTS.errors(3), "histories is 3; give a History"),
        (lambda m: ISOLUX.parts.merge(b"one"), "parts is b'one'; give a list of bytes"),
    ],
)
def test_what_is_wrong_with_an_argument(
    coarse: isolux.Map, call: Callable[[Any], object], words: str
) -> None:
    with pytest.raises(isolux.InputError) as found:
        call(coarse)
    assert words in str(found.value)
    [problem] = found.value.problems
    assert problem.remedy and str(found.value).endswith(problem.remedy)


def test_numbers_of_numpy_are_numbers(coarse: Any, tmp_path: Path) -> None:
    view: dict[str, Any] = {"width": np.int64(32), "height": np.uint8(16)}
    view |= {"interpolated": np.bool_(True), "limits": np.array([0.0, 500.0])}
    chart = coarse.render(false_colour=np.bool_(True), contours=np.bool_(False), **view)
    assert chart.shape[1] > 32
    chosen = {"accuracy": np.float32(0.25), "audit": np.bool_(False), "seed": np.int32(2)}
    m = ISOLUX.solve("builtin:cube", progress=np.bool_(False), max_memory=np.int64(1 << 30), **chosen)
    assert m.report["seed"] == 2
    m.save(tmp_path / "whole.glb")
    half = ISOLUX.mix({tmp_path / "whole.glb": np.float64(0.5)})
    twice = half.values["illuminance_lx"] * 2
    # Maps are in single precision.
    assert twice == pytest.approx(m.values["illuminance_lx"], rel=2.0**-20)


def test_names_are_those_that_programs_use(tmp_path: Path) -> None:
    names = dir(isolux)
    assert set(isolux.__all__) <= set(names)
    further = {"__version__", "cluster", "interchange", "plots", "study"}
    assert set(names) <= set(isolux.__all__) | further
    for name in isolux.__all__:
        of = getattr(isolux, name)
        if inspect.isclass(of):
            assert (of.__module__, of.__qualname__) == ("isolux", name)
    with pytest.raises(isolux.InputError) as found:
        isolux.load(tmp_path / "none.toml")
    told = "".join(traceback.format_exception(found.value))
    assert "isolux.InputError: " in told and "isolux._errors" not in told
    again = pickle.loads(pickle.dumps(found.value))
    assert again.problems == found.value.problems
    [problem] = again.problems
    assert problem.file == str(tmp_path / "none.toml")
    assert problem.remedy == "check the name and its case"
    assert isinstance(pickle.loads(pickle.dumps(room())), isolux.Scene)
