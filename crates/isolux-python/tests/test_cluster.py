"""Runs and studies on clusters. All but the last start Ray, and are left out unless asked for: `pytest -m cluster`."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import isolux
import pytest
from conftest import room

slow = pytest.mark.cluster

NOISY: dict[str, Any] = {"method": "forward", "accuracy": 0.015, "progress": False}


@pytest.fixture(scope="module")
def scene() -> isolux.Scene:
    return room()


@pytest.fixture(scope="module")
def whole(scene: isolux.Scene) -> isolux.Map:
    """A map of some fifty increments, since particles are noisy."""
    return isolux.solve(scene, **NOISY)


@pytest.fixture
def ray(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    module = pytest.importorskip("ray")
    # Workers import what functions use, as `room`.
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent))
    yield module
    module.shutdown()


def solved(scene: isolux.Scene, **options: Any) -> isolux.Map:
    from isolux import cluster

    return cluster.solve(scene, **{**NOISY, **options})


def once_after(increments: int, act: Callable[[], object]) -> Callable[[isolux.Progress], None]:
    """Acts once, when a run has come so far."""
    acted: list[object] = []

    def see(state: isolux.Progress) -> None:
        if state.stage == "increments" and state.increments >= increments and not acted:
            acted.append(act())

    return see


@slow
@pytest.mark.parametrize("workers", [1, 2])
def test_the_bytes_are_those_of_one_machine(
    ray: Any, scene: isolux.Scene, whole: isolux.Map, workers: int
) -> None:
    assert whole.increments > 30
    assert solved(scene, workers=workers).to_bytes() == whole.to_bytes()
    assert not ray.is_initialized()


@slow
def test_groups_are_solved_with_the_scene_of_each(ray: Any) -> None:
    from isolux import cluster

    lamps = [
        isolux.Luminaire(isotropic={"flux_lm": 2000}, position=(x, 2, 1.5), group=name)
        for x, name in ((1, "left"), (3, "right"))
    ]
    scene = room(luminaires=lamps)
    asked: dict[str, Any] = {"accuracy": 0.03, "group": True, "progress": False}
    alone, spread = isolux.solve(scene, **asked), cluster.solve(scene, workers=2, **asked)
    assert spread.to_bytes() == alone.to_bytes()
    assert {name: m.to_bytes() for name, m in spread.groups.items()} == {
        name: m.to_bytes() for name, m in alone.groups.items()
    }


def workers_of_ray() -> list[int]:
    """Processes that make increments for this one: children of its children."""
    found = subprocess.run(["ps", "-eo", "pid,ppid,args"], capture_output=True, text=True).stdout
    rows = [line.split(maxsplit=2) for line in found.splitlines()[1:]]
    own = {pid for pid, parent, _ in rows if int(parent) == os.getpid()}
    return [
        int(pid) for pid, parent, name in rows if parent in own and name.startswith("ray::make")
    ]


@slow
def test_a_worker_that_is_killed_is_made_up_for(
    ray: Any, scene: isolux.Scene, whole: isolux.Map
) -> None:
    killed: list[int] = []

    def kill() -> None:
        killed.extend(workers_of_ray())
        for pid in killed:
            os.kill(pid, signal.SIGKILL)

    found = solved(scene, workers=2, callback=once_after(8, kill))
    assert killed
    assert found.to_bytes() == whole.to_bytes()


@slow
def test_a_node_that_is_killed_is_made_up_for_and_another_gets_work(
    ray: Any, scene: isolux.Scene, whole: isolux.Map
) -> None:
    from ray.cluster_utils import Cluster

    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    store = 200 << 20
    nodes: Any = Cluster(
        initialize_head=True, head_node_args={"num_cpus": 0, "object_store_memory": store}
    )
    try:
        first = nodes.add_node(num_cpus=1, object_store_memory=store)
        ray.init(address=nodes.address, log_to_driver=False, logging_level="error")

        def replace() -> None:
            nodes.remove_node(first, allow_graceful=False)
            nodes.add_node(num_cpus=1, object_store_memory=store)

        # All but the first increments can only come from the node that was added.
        found = solved(scene, callback=once_after(8, replace))
        assert found.to_bytes() == whole.to_bytes()
    finally:
        ray.shutdown()
        nodes.shutdown()


@slow
def test_ctrl_c_ends_a_run_with_its_map(ray: Any, scene: isolux.Scene) -> None:
    def stop() -> None:
        os.kill(os.getpid(), signal.SIGINT)

    found = solved(scene, accuracy=0.001, workers=1, callback=once_after(10, stop))
    assert not found.complete
    assert found.increments >= 10


@slow
def test_what_workers_refuse_is_raised(ray: Any, scene: isolux.Scene) -> None:
    from isolux import cluster

    with pytest.raises(isolux.InputError, match="radiosity"):
        cluster.solve(scene, method="radiosity", workers=1, progress=False)
    with pytest.raises(ValueError, match="workers is 0"):
        cluster.solve(scene, workers=0)


@slow
def test_a_study_is_a_table_in_order_and_goes_on(ray: Any, tmp_path: Path) -> None:
    from isolux import cluster

    calls = tmp_path / "calls"

    def lit(x: float, flux_lm: float) -> dict[str, Any]:
        with open(calls, "a") as file:
            file.write("x")
        if x < 0:
            os.kill(os.getpid(), signal.SIGKILL)
        lamp = isolux.Luminaire(isotropic={"flux_lm": flux_lm}, position=(x, 2, 1.5))
        found = isolux.solve(room(luminaires=[lamp]), accuracy=0.05, threads=1, progress=False)
        return {"lx": found.probe([(2, 2, 0)])["illuminance_lx"][0], "complete": found.complete}

    variants = [{"x": x, "flux_lm": flux} for x in (1.0, -1.0, 3.0) for flux in (1000, -5)]
    output = tmp_path / "study.jsonl"
    found = cluster.study(lit, variants, output=output, workers=2, progress=False)
    assert [{key: row[key] for key in ("x", "flux_lm")} for row in found] == variants
    assert [row.get("complete") for row in found] == [True, None, None, None, True, None]
    assert "InputError" in found[1]["error"] and "-5 is out of range" in found[1]["error"]
    assert "WorkerCrashedError" in found[2]["error"]
    assert found.failures == [found[1], found[2], found[3], found[5]]
    assert found.frame["lx"].notna().tolist() == [True, False, False, False, True, False]
    rows = [json.loads(line) for line in output.read_text().splitlines()]
    assert [row["row"] for row in rows] == found

    # A line that was cut off is made again, those that are whole are not.
    lines = output.read_text().splitlines(keepends=True)
    output.write_text("".join(lines[:1]) + lines[4][:30])
    calls.unlink()
    kept = [variants[0], variants[4]]
    again = cluster.study(lit, kept, output=output, workers=1, progress=False)
    assert again == [found[0], found[4]]
    assert calls.read_text() == "x"
    output.write_text("no row\n" + lines[0])
    with pytest.raises(ValueError, match="line 1 is no row"):
        cluster.study(lit, kept, output=output, progress=False)


TEMPLATE = """
name = "room"
[materials.paint]
diffuse = ${paint}
[[geometry]]
name = "walls"
box = { min = [0, 0, 0], max = [4, 4, 3], inward = true }
material = "paint"
[[luminaire]]
name = "lamp"
position = [${x}, 2, 2]
isotropic = { flux_lm = 1000 }
"""


@slow
def test_templates_of_studies_are_filled_in(ray: Any, tmp_path: Path) -> None:
    from isolux import cluster

    path = tmp_path / "room.toml"
    path.write_text(TEMPLATE)

    def measured(scene: isolux.Scene, paint: float, x: float) -> dict[str, float]:
        found = isolux.solve(scene, accuracy=0.05, threads=1, progress=False)
        return {"lx": float(found.probe([(2, 2, 0.0)])["illuminance_lx"][0])}

    variants: list[dict[str, Any]] = [{"paint": paint, "x": 2} for paint in (0.2, 0.8, 1.5)]
    variants.append({"x": 1})
    found = cluster.study(measured, variants, template=path, workers=1, progress=False)
    assert not found.failures[:-2], found
    assert found[1]["lx"] > found[0]["lx"]
    assert "InputError" in found[2]["error"] and "paint" in found[3]["error"]
    assert [file.name for file in tmp_path.iterdir()] == ["room.toml"]


@slow
def test_the_command_solves_on_a_cluster(ray: Any, coarse: isolux.Map, tmp_path: Path) -> None:
    path = tmp_path / "map.glb"
    words = ["cluster", "solve", "builtin:cube", "--accuracy", "5%", "-o", str(path)]
    told = subprocess.run(
        [sys.executable, "-m", "isolux", *words, "--workers", "1"], capture_output=True, text=True
    )
    assert told.returncode == 0, told.stderr
    assert "written" in told.stdout and str(path) in told.stdout
    coarse.save(tmp_path / "python.glb")
    assert path.read_bytes() == (tmp_path / "python.glb").read_bytes()
    wrong = subprocess.run(
        [sys.executable, "-m", "isolux", *words, "--acuracy", "1%"], capture_output=True, text=True
    )
    assert wrong.returncode == 2 and "--acuracy" in wrong.stderr


def test_the_command_alone_says_what_it_needs() -> None:
    with pytest.raises(isolux.InputError, match="package for Python"):
        isolux.command("cluster", "solve", "builtin:cube", "-o", "map.glb")
