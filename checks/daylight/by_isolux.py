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


def by_grid(program, scene, plane, accuracy, threads_words=()):
    """The grid of a scene that is solved first, and the seconds of both."""
    columns, rows = plane.counts
    corner = ",".join(map(str, plane.corner))
    words = ["grid", scene, "--corner", corner, "--u", f"{columns * plane.spacing},0,0"]
    words += ["--v", f"0,{rows * plane.spacing},0", "--spacing", plane.spacing, "--accuracy", accuracy, *threads_words]
    found, seconds, said = command(program, words)
    [grid] = found["grids"]
    for place, value in zip(plane.points(), grid["values"], strict=True):
        if max(abs(a - b) for a, b in zip(place, value["position"])) > 1e-4:
            raise SystemExit(f"isolux reads {value['position']} where Radiance reads {place}")
    return grid, seconds, said


def by_paths(program, scene, places, paths, points_file, seed=1):
    """Illuminances and standard errors by complete paths at every place, and the seconds they took."""
    points_file.write_text("".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in places))
    words = ["probe", scene, "--points", points_file, "--paths", paths, "--seed", seed]
    found, seconds, _ = command(program, words)
    points = found["points"]
    return [p["illuminance_lx"] for p in points], [p["standard_error_lx"] for p in points], seconds
