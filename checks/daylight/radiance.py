"""Radiance's programs, and illuminances at points by its ambient calculation without any cache."""

import importlib.util
import os
import pathlib
import subprocess
import time

import numpy as np

# What Radiance's photometric values are made with: lm/W, and the weights of red, green and blue.
EFFICACY = 179.0
WEIGHTS = np.array([0.265, 0.670, 0.065])
# Below this share of the weight of one first ray, Russian roulette ends paths.
LEAST_SHARE = 0.1


def programs():
    """The folder of the programs inside the Python package, and their environment."""
    found = importlib.util.find_spec("pyradiance")
    if not found:
        raise SystemExit("there is no Radiance; install the Python package pyradiance")
    package = pathlib.Path(found.origin).parent
    path = f"{package / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}"
    return package / "bin", {**os.environ, "PATH": path, "RAYPATH": f".:{package / 'lib'}"}


def run(command, stdin=None, stdout=subprocess.PIPE, folder=None):
    """A program of Radiance by name; what it prints."""
    folder_of_programs, environment = programs()
    words = [str(word) for word in command]
    words[0] = str(folder_of_programs / words[0])
    ran = subprocess.run(words, input=stdin, stdout=stdout, stderr=subprocess.PIPE, env=environment, cwd=folder)
    if ran.returncode != 0:
        raise SystemExit(f"{' '.join(words[:3])}: {ran.stderr.decode(errors='replace')}")
    return ran.stdout


def version():
    """As rtrace says it."""
    return run(["rtrace", "-version"]).decode().strip()


def octree(scene, *more):
    """Compiles a scene beside it."""
    target = scene.with_suffix(".oct")
    with target.open("wb") as file:
        run(["oconv", *more, scene.name], stdout=file, folder=scene.parent)
    return target


def options(divisions, bounces):
    """Paths: many at the place itself, one onwards from where each arrives. The sun's disc is jittered."""
    least = LEAST_SHARE / divisions
    words = f"-h -I -u+ -aa 0 -ab {bounces} -ad {divisions} -as 0 -av 0 0 0 -aw 0"
    words += f" -lr -{4 * bounces} -lw {least:.3g} -dt 0 -dc 1 -dr 0 -dj 1 -ds 0 -st 0"
    return words.split()


def by_rtrace(compiled, places, divisions, bounces, repetitions):
    """Illuminances, one row a repetition, and the seconds they took. With -u+ repetitions are independent."""
    rays = np.array([(*place, 0.0, 0.0, 1.0) for place in places] * repetitions, dtype=float)
    started = time.perf_counter()
    found = run(["rtrace", *options(divisions, bounces), "-fdd", compiled.name], rays.tobytes(), folder=compiled.parent)
    seconds = time.perf_counter() - started
    rgb = np.frombuffer(found).reshape(repetitions, len(places), 3)
    return EFFICACY * rgb @ WEIGHTS, seconds
