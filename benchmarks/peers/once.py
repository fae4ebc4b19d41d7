"""One effort of one renderer: the values that it finds at the points of a scene, and what that takes.

`once.py --list` says which renderers are installed, and their efforts.
"""

import argparse
import importlib.metadata
import importlib.util
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import ladders
import library
from arguments import between, existing_file

HERE = Path(__file__).parent
# The Python packages of the renderers.
PACKAGES = {"radiance": "pyradiance", "mitsuba": "mitsuba", "luxcore": "pyluxcore"}
# Then a run is given up.
TOO_LONG_S = 600.0


class Failed(Exception):
    """A run that found nothing, and why."""


def environment(renderer, threads):
    """What the process of a renderer runs in."""
    libllvm = {"DRJIT_LIBLLVM_PATH": library.llvm()} if renderer == "mitsuba" else {}
    return {**os.environ, "OMP_NUM_THREADS": str(threads), **libllvm}


def run(scene, points, renderer, effort, *, threads, seed, folder, environment, at_most_s=TOO_LONG_S):
    """The record that the renderer's script writes, with `whole_s`, the time of the whole."""
    output = Path(folder) / "values.json"
    output.unlink(missing_ok=True)
    command = [
        sys.executable, HERE / f"with_{renderer}.py", scene, "--points", points, "--effort", effort,
        "--threads", str(threads), "--seed", str(seed), "--folder", folder, "--output", output,
    ]
    started = time.perf_counter()
    try:
        ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=at_most_s)
    except subprocess.TimeoutExpired:
        raise Failed(f"given up after {at_most_s:.0f} s") from None
    whole_s = time.perf_counter() - started
    if ended.returncode != 0 or not output.is_file():
        raise Failed(" ".join(ended.stderr.split()[-60:]))
    record = json.loads(output.read_text())
    record.setdefault("whole_s", whole_s)
    return record


def missing(renderer):
    """Why a renderer cannot run here; None if it can."""
    package = PACKAGES[renderer]
    if not importlib.util.find_spec(package):
        return f"the Python package {package} is not installed"
    if renderer == "mitsuba":
        try:
            library.llvm()
        except SystemExit as why:
            return str(why)
    return None


def listed():
    """What there is."""
    renderers = [{"name": name, "missing": missing(name)} for name in PACKAGES]
    for renderer in renderers:
        if not renderer["missing"]:
            renderer["version"] = importlib.metadata.version(PACKAGES[renderer["name"]])
    rows = [
        {"scene": of.scene, "points": of.points, "renderer": of.renderer, "efforts": of.efforts}
        for of in ladders.LADDERS if of.renderer in PACKAGES
    ]
    return {"renderers": renderers, "ladders": rows}


def main():
    if sys.argv[1:] == ["--list"]:
        print(json.dumps(listed()))
        return None
    flags = argparse.ArgumentParser(description=__doc__)
    flags.add_argument("scene", type=existing_file, help="scene as JSON")
    flags.add_argument("--points", required=True, help="name of a set of points of the scene")
    flags.add_argument("--renderer", required=True, choices=sorted(PACKAGES))
    flags.add_argument("--effort", required=True)
    flags.add_argument("--threads", type=between(1, 1024), default=2)
    flags.add_argument("--seed", type=between(1, 1_000_000), default=1)
    flags.add_argument("--folder", type=Path, required=True, help="where files may be written")
    flags.add_argument("--at-most", type=between(1, 1_000_000), default=int(TOO_LONG_S), help="seconds")
    given = flags.parse_args()
    try:
        record = run(
            given.scene, given.points, given.renderer, given.effort, threads=given.threads, seed=given.seed,
            folder=given.folder, environment=environment(given.renderer, given.threads), at_most_s=given.at_most,
        )
    except Failed as why:
        return str(why)
    print(json.dumps({"values_lx": record["values_lx"], "whole_s": record["whole_s"]}))
    return None


if __name__ == "__main__":
    sys.exit(main())
