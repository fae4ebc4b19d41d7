"""Illuminances by isolux: from its maps, and by its long paths, which know no map."""

import json
import subprocess
import time


def command(program, words):
    """What a subcommand prints as JSON, and the seconds it took. Exit code 3 is an error that was not reached: the value holds."""
    started = time.perf_counter()
    ran = subprocess.run([program, *map(str, words), "--json"], capture_output=True, text=True)
    seconds = time.perf_counter() - started
    if ran.returncode not in (0, 3) or not ran.stdout:
        raise SystemExit(f"isolux {' '.join(map(str, words[:3]))}: {ran.stdout}{ran.stderr}")
    return json.loads(ran.stdout), seconds, ran.stderr


def solved(program, scene, accuracy):
    """A map of the scene, and the seconds it took."""
    target = scene.with_suffix(".glb")
    _, seconds, _ = command(program, ["solve", scene, "-o", target, "--accuracy", accuracy])
    return target, seconds


def by_grid(program, source, plane):
    """The grid of a map, and the seconds it took."""
    columns, rows = plane.counts
    corner = ",".join(map(str, plane.corner))
    words = ["grid", source, "--corner", corner, "--u", f"{columns * plane.spacing},0,0"]
    words += ["--v", f"0,{rows * plane.spacing},0", "--spacing", plane.spacing]
    found, seconds, _ = command(program, words)
    [grid] = found["grids"]
    for place, value in zip(plane.points(), grid["values"], strict=True):
        if max(abs(a - b) for a, b in zip(place, value["position"])) > 1e-4:
            raise SystemExit(f"isolux reads {value['position']} where Radiance reads {place}")
    return grid, seconds


def exactly(program, source, places, points_file):
    """Illuminances and standard errors of a map with the light of every place estimated afresh, and the seconds they took."""
    return probed(program, source, places, points_file, ["--exact"])


def by_paths(program, scene, places, paths, points_file, seed=1):
    """Illuminances and standard errors by complete paths at every place, and the seconds they took."""
    return probed(program, scene, places, points_file, ["--paths", paths, "--seed", seed])


def probed(program, source, places, points_file, how):
    points_file.write_text("".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in places))
    found, seconds, _ = command(program, ["probe", source, "--points", points_file, *how])
    points = found["points"]
    return [p["illuminance_lx"] for p in points], [p["standard_error_lx"] for p in points], seconds
