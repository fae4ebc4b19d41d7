"""Plots, the exact values of the study, and maps that show themselves."""

from __future__ import annotations

import gzip
import io
import re
import sys
from typing import Any

import isolux
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import REPOSITORY
from isolux import plots, study

matplotlib.use("agg")


@pytest.fixture(autouse=True)
def closed() -> Any:
    """No figure outlives its test."""
    yield
    plt.close("all")


def test_curves_of_a_run() -> None:
    history = plots.History("hybrid")
    m = isolux.solve("builtin:cube", accuracy=0.003, progress=False, callback=history)
    # What the run ends with, and times that rise.
    assert history.array("error")[-1] == pytest.approx(m.accuracy)
    assert (np.diff(history.array("elapsed_s")) >= 0).all()
    for against, key in (("time", "elapsed_s"), ("rays", "rays")):
        ax = plots.errors(history, against=against)
        curve, target = ax.get_lines()
        known = np.isfinite(history.array("error"))
        assert curve.get_xdata() == pytest.approx(history.array(key)[known])
        assert target.get_ydata()[0] == 0.003
    assert len(history.frame) == len(history.states)
    with pytest.raises(ValueError, match="'time' or 'rays'"):
        plots.errors(history, against="money")
    with pytest.raises(ValueError, match="as callback"):
        plots.errors(plots.History())


def test_graph_1_has_a_curve_for_each_method() -> None:
    series = {"hybrid": [(2.0, 0.01), (1.0, 0.02)], "radiosity": [(1.0, 0.1), (4.0, None)]}
    ax = plots.graph_1(series)
    hybrid, radiosity, slope = ax.get_lines()
    assert list(hybrid.get_xdata()) == [1.0, 2.0] and list(radiosity.get_ydata()) == [0.1]
    (x0, x1), (y0, y1) = slope.get_xdata(), slope.get_ydata()
    assert y1 / y0 == pytest.approx((x0 / x1) ** 0.5)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["hybrid", "radiosity"]


def test_a_plan_of_a_grid(lit: isolux.Map) -> None:
    grid = lit.grid("floor", spacing=0.5)
    ax = plots.grid(grid, lines=[20, 25])
    shown = sorted(text.get_text() for text in ax.texts)
    values = [f"{value:.0f}" for value in grid.values["illuminance_lx"].reshape(-1)]
    lines = {text for text in shown if text.endswith("lx")}
    inside = grid.values["illuminance_lx"]
    assert lines <= {"20 lx", "25 lx"} and (inside.min() > 20 or inside.max() < 20 or lines)
    assert sorted(set(shown) - lines) == sorted(set(values))
    assert "$E_m$" in ax.get_title()
    figure = io.BytesIO()
    ax.figure.savefig(figure)
    assert len(figure.getvalue()) > 10_000


def test_colours_are_those_of_the_command(lit: isolux.Map) -> None:
    for name, ends in (("viridis", ("#440154", "#fde725")), ("inferno", ("#000004", "#fcffa4"))):
        colours = plots.colour_map(name)
        assert (matplotlib.colors.to_hex(colours(0.0)), matplotlib.colors.to_hex(colours(1.0))) == ends
    view = {"eye": (2, 1, 1.5), "target": (2, 2, 0), "width": 64, "height": 64}
    chart = lit.render(**view, false_colour=True, limits=(0, 40))
    # What looks down sees the floor alone in the middle of the picture.
    known = {tuple(row) for row in (255 * plots.colour_map().colors).round().astype(int)[:, :3]}
    middle = {tuple(pixel) for pixel in chart[24:40, 24:40].reshape(-1, 3).astype(int)}
    assert len(middle) > 1 and middle <= known
    with pytest.raises(ValueError, match="choose viridis, inferno or turbo"):
        plots.colour_map("jet")


def test_numbers_in_false_colours() -> None:
    ax = plots.false_colour([[1.0, 10.0], [np.nan, 100.0]], logarithmic=True)
    (image,) = ax.get_images()
    assert (image.norm.vmin, image.norm.vmax) == (1.0, 100.0)
    with pytest.raises(ValueError, match="no value is known"):
        plots.false_colour([[np.nan]])


def test_exact_values_of_the_study() -> None:
    # Table 1 of the study: luminances of six points, to four digits; reflectance 2/3.
    cube = study.points("cube")
    luminances = cube.illuminance_lx * (2 / 3) / np.pi
    assert cube.letters == tuple("ABCDEF")
    assert luminances == pytest.approx([892.8, 768.7, 686.6, 565.1, 522.4, 388.4], abs=0.1)
    assert cube.weights.sum() == pytest.approx(1)
    # Appendix A.
    assert study.points("sphere").illuminance_lx == pytest.approx([1353.247], abs=1e-3)
    assert study.grid("cube").points.shape == (1024, 3)
    with pytest.raises(ValueError, match="choose cube or sphere"):
        study.points("teapot")


def test_errors_of_a_map() -> None:
    m = isolux.solve("builtin:cube", accuracy=0.01, progress=False)
    found = study.errors(m, "cube")
    exact = study.points("cube")
    off = m.probe(exact.points, exact.normals)["illuminance_lx"] / exact.illuminance_lx - 1
    assert found.points == pytest.approx(np.sqrt((exact.weights * off**2).sum()), rel=1e-6)
    assert 0 < found.grid < 0.03
    other = isolux.solve("builtin:sphere", accuracy=0.1, progress=False)
    with pytest.raises(ValueError, match="is it a map of this scene"):
        study.errors(other, "cube")


def test_a_map_shows_itself(lit: isolux.Map) -> None:
    data, about = lit._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data and "text/html" not in data
    assert data["image/png"].startswith(b"\x89PNG")
    size = about["image/png"]
    image = plt.imread(io.BytesIO(data["image/png"]))
    assert image.shape[:2] == (size["height"], size["width"]) and image.std() > 0
    view = lit.view(height=300)
    page = gzip.decompress(view._widget.page).decode()
    assert page.startswith("<!") and view._widget.height == 300


def test_a_page_that_notebooks_keep(lit: isolux.Map) -> None:
    data, _ = lit.view(live=False, height=300)._repr_mimebundle_()
    assert set(data) == {"text/plain", "text/html", "image/png"}
    assert data["text/html"].startswith("<iframe sandbox=") and "height:300px" in data["text/html"]


def test_without_anywidget_the_page_is_there(
    lit: isolux.Map, monkeypatch: pytest.MonkeyPatch
) -> None:
    from isolux import _view

    monkeypatch.setitem(sys.modules, "anywidget", None)
    _view._widget_class.cache_clear()
    assert "text/html" in lit.view()._repr_mimebundle_()[0]
    _view._widget_class.cache_clear()


def test_the_examples_of_the_book_run() -> None:
    text = (REPOSITORY / "docs" / "book" / "python-notebooks.md").read_text(encoding="utf-8")
    examples = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(examples) == 3
    names: dict[str, Any] = {}
    for example in examples:
        exec(compile(example, "python-notebooks.md", "exec"), names)
    assert len(names["table"]) == 81
