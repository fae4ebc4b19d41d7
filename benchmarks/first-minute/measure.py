"""Times what a user does in the first minute, and prints a table: python3 measure.py --isolux PATH --data FOLDER."""

import argparse
import os
import pathlib
import platform
import resource
import subprocess
import tempfile
import time

# What is done, the goal in seconds of wall time on two cores, and the arguments; {data} is the folder of scenes from outside.
ROWS = [
    ("`scenes/cornell_mcguire`, map at 1 %", None, "solve {root}/scenes/cornell_mcguire/scene.toml --accuracy 1% -o c.glb"),
    ("its picture, 1280 x 720", 1.5, "render c.glb -o c.png"),
    ("its interpolated picture", 0.5, "render c.glb --interpolated -o ci.png"),
    ("a new office", None, "new office -o office.toml"),
    ("its map at 1 %", 3, "solve office.toml --accuracy 1% -o o.glb"),
    ("its picture", 3, "render o.glb -o o.png"),
    ("picture and false colours of one tracing", 3.5, "render o.glb -o o.png --false-colour-output of.png"),
    ("Bevy's `CornellBox.glb`, map at 2 %", 1, "solve {data}/bevy/CornellBox.glb --accuracy 2% -o b.glb"),
    ("its picture", 2, "render b.glb -o b.png"),
    ("`CornellBox-Sphere.obj`, map at 2 %", 5, "solve {data}/cornell_mcguire/CornellBox-Sphere.obj --accuracy 2% -o s.glb"),
    ("the same, `check`", 1, "check {data}/cornell_mcguire/CornellBox-Sphere.obj"),
    ("hall, draft", 3, "solve builtin:hall --accuracy 20% -o h.glb"),
    ("its picture, 2626 luminaires", 8, "render h.glb -o h.png"),
    ("its interpolated picture", 1, "render h.glb --interpolated -o hi.png"),
    ("the demonstration, map at 1 %", 15, "solve {root}/scenes/demo/scene.toml --accuracy 1% -o d.glb"),
    ("CUBE at 10 %", None, "solve builtin:cube --accuracy 10% -o x.glb"),
    ("CUBE at 3 %", None, "solve builtin:cube --accuracy 3% -o x.glb"),
    ("CUBE at 1 %", None, "solve builtin:cube --accuracy 1% -o x.glb"),
    ("SPHERE at 0.3 %", None, "solve builtin:sphere --accuracy 0.3% -o x.glb"),
    ("CUBE at 0.1 %, one thread", None, "solve builtin:cube --accuracy 0.1% --threads 1 -o x.glb"),
    ("CUBE at 0.1 %, two threads", None, "solve builtin:cube --accuracy 0.1% --threads 2 -o x.glb"),
    ("picture by a new cache", None, "render {root}/scenes/cornell_mcguire/scene.toml --cache k.cache -o k.png"),
    ("the same, all samples found", None, "render {root}/scenes/cornell_mcguire/scene.toml --cache k.cache -o k.png"),
    ("a million triangles at 5 %", 20, "solve builtin:hall,triangles=1e6,luminaires=100 --accuracy 5% -o m.glb"),
    ("the same, `--time-limit 30s`", 33, "solve builtin:hall,triangles=1e6,luminaires=100 --accuracy 5% --time-limit 30s -o m.glb"),
]


def timed(command, folder):
    """Wall and processor time of a command, s, and its exit code."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    started = time.perf_counter()
    code = subprocess.run(command, cwd=folder, capture_output=True, check=False).returncode
    wall = time.perf_counter() - started
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return wall, processor, code


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--isolux", required=True, type=pathlib.Path)
    parser.add_argument("--data", required=True, type=pathlib.Path, help="folder with bevy/ and cornell_mcguire/")
    given = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    print(f"{platform.machine()}, {os.cpu_count()} cores; {given.isolux.stat().st_size / 1e6:.1f} MB\n")
    print("| what | goal, s | time, s | processor, s | exit code |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for what, goal, arguments in ROWS:
            words = arguments.format(data=given.data.resolve(), root=root).split()
            wall, processor, code = timed([given.isolux.resolve(), *words], folder)
            shown = "" if goal is None else f"{goal:g}"
            print(f"| {what} | {shown} | {wall:.2f} | {processor:.2f} | {code} |", flush=True)


if __name__ == "__main__":
    main()
