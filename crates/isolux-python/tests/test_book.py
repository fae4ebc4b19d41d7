"""The examples of the book."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from conftest import REPOSITORY


def test_the_examples_of_the_book_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (REPOSITORY / "docs" / "book" / "python.md").read_text(encoding="utf-8")
    examples = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(examples) > 5
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for example in examples:
        exec(compile(example, "python.md", "exec"), names)
    assert (tmp_path / "map.glb").exists() and (tmp_path / "plan.png").exists()
    # Below the lamp nothing else sends light: 1000 / (4 pi) / 4.
    lamp = names["lit"].probe([(2, 2, 0)])["illuminance_lx"][0]
    assert lamp == pytest.approx(19.894, rel=0.01)
    half = names["m"].mix({"lamp": 0.5}).probe([(2, 2, 0)])["illuminance_lx"][0]
    assert half == pytest.approx(0.5 * lamp, rel=0.01)
