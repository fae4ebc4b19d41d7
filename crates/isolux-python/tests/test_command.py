"""The command of the wheel."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import isolux
import pytest


def command(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "isolux", *words], capture_output=True, text=True)


def test_the_wheel_holds_the_command(tmp_path: Path) -> None:
    told = command("info", "builtin:cube", "--json")
    assert told.returncode == 0, told.stderr
    assert json.loads(told.stdout) == isolux.info("builtin:cube")
    wrong = command("solve", "missing.toml", "-o", str(tmp_path / "map.glb"))
    assert wrong.returncode == 2
    assert "missing.toml" in wrong.stderr
    script = Path(sys.executable).with_name("isolux")
    assert subprocess.run([script, "--version"], capture_output=True, text=True).stdout.startswith(
        "isolux "
    )


def test_maps_are_the_bytes_of_the_command(tmp_path: Path, coarse: isolux.Map) -> None:
    path = tmp_path / "command.glb"
    told = command("solve", "builtin:cube", "--accuracy", "5%", "-o", str(path), "--json")
    assert told.returncode == 0, told.stderr
    coarse.save(tmp_path / "python.glb")
    assert (tmp_path / "python.glb").read_bytes() == path.read_bytes()
    written = isolux.solve("builtin:cube", accuracy="5%", progress=False, output=tmp_path / "o.glb")
    assert (tmp_path / "o.glb").read_bytes() == path.read_bytes() == written.to_bytes()
    # All that is told, but for what a run took and where it wrote.
    own = {"map", "memory_peak_bytes", "time_s"}
    expected = {key: value for key, value in json.loads(told.stdout).items() if key not in own}
    assert {key: value for key, value in written.report.items() if key not in own} == expected


def test_readings_are_those_of_the_command(tmp_path: Path, coarse: isolux.Map) -> None:
    coarse.save(tmp_path / "map.glb")
    (tmp_path / "points").write_text("0.5 -5 0.5  0 1 0\n5 0.5 0.5  -1 0 0\n-9 0 0  0 0 1\n")
    points = [(0.5, -5, 0.5), (5, 0.5, 0.5), (-9, 0, 0)]
    normals = [(0, 1, 0), (-1, 0, 0), (0, 0, 1)]
    for flags, options in (([], {}), (["--exact"], {"exact": True})):
        words = ["probe", str(tmp_path / "map.glb"), "--points", str(tmp_path / "points"), *flags]
        expected = json.loads(command(*words, "--json").stdout)["points"]
        with pytest.warns(isolux.IsoluxWarning):
            found = coarse.probe(points, normals, **options)
        for reading, told in zip(found, expected):
            for name in ("illuminance_lx", "standard_error_lx", "direct_lx", "indirect_lx"):
                if told[name] is None:
                    assert reading[name] != reading[name]
                else:
                    assert reading[name] == told[name]


def test_ctrl_c_ends_the_command_with_a_map(tmp_path: Path) -> None:
    words = ["solve", "builtin:cube", "--accuracy", "0.01%", "-o", str(tmp_path / "map.glb")]
    with subprocess.Popen(
        [sys.executable, "-m", "isolux", *words], stderr=subprocess.PIPE, text=True
    ) as run:
        assert run.stderr
        # The first line of progress: it listens.
        first = run.stderr.readline()
        os.kill(run.pid, signal.SIGINT)
        _, told = run.communicate()
    assert run.returncode == 130, first + told
    assert not isolux.open_map(tmp_path / "map.glb").complete


def test_help_and_version_are_text() -> None:
    for words in (("--version",), ("solve", "--help"), ("help", "grid"), ("--help",)):
        assert isolux.command(*words) == command(*words).stdout
    assert isolux.command("--version").startswith("isolux ")
    with pytest.raises(isolux.InputError, match="a subcommand is missing"):
        isolux.command()


def test_what_serves_until_it_is_stopped_is_refused(tmp_path: Path) -> None:
    with pytest.raises(isolux.InputError, match=r"use m\.view\(\)"):
        isolux.command("view", tmp_path / "map.glb")
    with pytest.raises(isolux.InputError, match="--live.*callback"):
        isolux.command("solve", "builtin:cube", "--live", "-o", tmp_path / "map.glb")
    assert not list(tmp_path.iterdir())
