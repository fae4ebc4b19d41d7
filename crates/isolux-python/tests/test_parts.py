"""Parts of runs."""

from __future__ import annotations

import pickle
import threading
from pathlib import Path

import isolux
import pytest
from conftest import room


@pytest.fixture(scope="module")
def pilot(cube: isolux.Scene) -> bytes:
    return isolux.parts.make_pilot(cube, accuracy=0.05)


def test_parts_are_the_files_of_the_command(
    cube: isolux.Scene, pilot: bytes, tmp_path: Path
) -> None:
    asked = ["builtin:cube", "--accuracy", "5%"]
    file, part = tmp_path / "a.pilot", tmp_path / "a.part"
    isolux.command("solve", "-o", file, *asked)
    assert file.read_bytes() == pilot
    isolux.command("solve", "-o", part, *asked, "--pilot", file, "--increments", "1..3")
    maker = isolux.parts.PartMaker(cube, pilot, threads=1)
    assert maker.make(1, 3) == part.read_bytes()
    # Of one maker in any order.
    second, first = maker.make(2, 3), maker.make(1, 2)
    assert isolux.parts.merge([second, first]) == part.read_bytes()


def test_parts_come_to_the_map_of_one_run(
    cube: isolux.Scene, coarse: isolux.Map, pilot: bytes
) -> None:
    maker = isolux.parts.PartMaker(cube, pilot)
    count = coarse.increments
    parts = [maker.make(count - 2, count), maker.make(0, count - 2)]
    for known in (None, pilot):
        found = isolux.parts.to_map(parts, cube, pilot=known)
        assert found.to_bytes() == coarse.to_bytes()


def test_increments_from_elsewhere_come_to_the_map_of_one_run() -> None:
    scene = room()
    whole = isolux.solve(scene, accuracy=0.02, progress=False)
    # As another process has it.
    copy = pickle.loads(pickle.dumps(scene))
    assert copy.hash == scene.hash
    makers: list[isolux.parts.PartMaker] = []
    asked: list[int] = []

    def made(pilot: bytes | None, stage: int, index: int) -> bytes:
        if pilot is not None:
            makers.append(isolux.parts.PartMaker(copy, pilot, threads=1))
        asked.append(index)
        return makers[-1].make(index, index + 1)

    found = isolux.parts.solve_elsewhere(scene, made, accuracy=0.02, progress=False)
    assert found.to_bytes() == whole.to_bytes()
    assert asked[-found.increments :] == list(range(found.increments))


def test_none_ends_a_run_with_its_map_from_which_it_goes_on(
    cube: isolux.Scene, tmp_path: Path
) -> None:
    makers: list[isolux.parts.PartMaker] = []

    def made(until: int) -> isolux.parts.Next:
        def make(pilot: bytes | None, stage: int, index: int) -> bytes | None:
            if pilot is not None:
                makers.append(isolux.parts.PartMaker(cube, pilot))
            return makers[-1].make(index, index + 1) if index < until else None

        return make

    path = tmp_path / "map.glb"
    asked = {"accuracy": 0.005, "progress": False, "output": path}
    first = isolux.parts.solve_elsewhere(cube, made(4), **asked)
    assert not first.complete and first.increments == 4
    second = isolux.parts.solve_elsewhere(cube, made(10_000), resume=True, **asked)
    assert second.complete
    assert second.to_bytes() == isolux.solve(cube, accuracy=0.005, progress=False).to_bytes()


def test_failures_elsewhere_are_raised(cube: isolux.Scene) -> None:
    def fail(pilot: bytes | None, stage: int, index: int) -> bytes:
        raise LookupError("no machine")

    with pytest.raises(LookupError, match="no machine"):
        isolux.parts.solve_elsewhere(cube, fail, accuracy=0.05, progress=False)
    with pytest.raises(isolux.InputError, match="increment 0, made elsewhere: it is not a checkp"):
        isolux.parts.solve_elsewhere(cube, lambda *_: b"?", accuracy=0.05, progress=False)
    with pytest.raises(isolux.InputError, match="radiosity"):
        isolux.parts.solve_elsewhere(cube, fail, method="radiosity", progress=False)


def test_pilots_and_parts_of_others_are_refused(cube: isolux.Scene, pilot: bytes) -> None:
    with pytest.raises(isolux.InputError, match="the pilot: is of another scene than room"):
        isolux.parts.PartMaker(room(), pilot)
    with pytest.raises(isolux.InputError, match="checksum"):
        isolux.parts.PartMaker(cube, pilot[:-1])
    with pytest.raises(isolux.InputError, match="not a checkpoint"):
        isolux.parts.merge([b"nothing"])
    part = isolux.parts.PartMaker(cube, pilot).make(0, 1)
    for known in (None, pilot):
        with pytest.raises(isolux.InputError, match="room: is not the scene that the parts"):
            isolux.parts.to_map([part], room(), pilot=known)
    damaged = bytearray(pickle.dumps(cube))
    at = len(damaged) // 2
    damaged[at] ^= 1
    with pytest.raises(isolux.InputError, match="a scene in bytes"):
        pickle.loads(bytes(damaged))


def test_other_threads_go_on_while_increments_are_made(cube: isolux.Scene, pilot: bytes) -> None:
    maker = isolux.parts.PartMaker(cube, pilot, threads=1)
    made: list[bytes] = []
    thread = threading.Thread(target=lambda: made.append(maker.make(0, 3)))
    thread.start()
    counted = 0
    while thread.is_alive():
        counted += 1
        thread.join(0.001)
    assert counted > 1
    assert made == [isolux.parts.PartMaker(cube, pilot).make(0, 3)]


def test_increments_are_counted_from_nought(cube: isolux.Scene, pilot: bytes) -> None:
    maker = isolux.parts.PartMaker(cube, pilot)
    for first, end in ((3, 1), (2, 2), (-1, 2), (0, isolux.parts.MOST_INCREMENTS + 1)):
        with pytest.raises(isolux.InputError, match="give 0 <= first < end <= 32768"):
            maker.make(first, end)


def test_options_that_a_pilot_has_no_use_for(cube: isolux.Scene) -> None:
    for options, flag in (
        ({"layout": "texels"}, "--layout texels"),
        ({"group": True}, "--group"),
        ({"resume": True}, "--resume"),
    ):
        with pytest.raises(isolux.InputError, match=f"{flag}: .* is no map"):
            isolux.parts.make_pilot(cube, **options)


def test_what_files_of_runs_hold(cube: isolux.Scene, pilot: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.pilot").write_bytes(pilot)
    (tmp_path / "a.part").write_bytes(isolux.parts.PartMaker(cube, pilot).make(1, 3))
    of_pilot, of_part = isolux.info(tmp_path / "a.pilot"), isolux.info(tmp_path / "a.part")
    assert (of_pilot["kind"], of_part["kind"]) == ("pilot", "part of a run")
    assert of_part["scene"] == "builtin:cube" and of_part["increments"] == [[1, 3]]
    for told in (of_pilot, of_part):
        assert told["scene_hash"] == cube.hash and told["mesh"] == 1
        assert told["version"] == isolux.__version__ and told["accuracy_target"] == 0.05
    assert of_pilot["receivers"] == of_part["receivers"] > 100
