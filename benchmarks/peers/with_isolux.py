"""isolux: `isolux solve`, then `isolux probe` at the points. The time of both processes counts: where the
map is not to be trusted, `probe` traces rays of its own."""

import json
import os
import shutil
import subprocess
import sys
import time

import arguments
import scene as scenes

EFFORT = "accuracy"


def main():
    flags = arguments.parser(__doc__, EFFORT).parse_args()
    program = os.environ.get("ISOLUX") or "isolux"
    if not shutil.which(program):
        raise SystemExit(f"there is no program {program}; build isolux and name it in ISOLUX")
    scene = scenes.read(flags.scene)
    points = scene.points(flags.points)
    map_file, places = flags.folder / f"{scene.name}.glb", flags.folder / "points.pts"
    solve = [program, "solve", f"builtin:{scene.name}", "-o", map_file, "--json", "--progress", "none"]
    solve += ["--accuracy", str(flags.effort[0]), "--seed", str(flags.seed)]
    solve += ["--threads", str(flags.threads)]
    probe = [program, "probe", map_file, "--points", places, "--json"]
    rows = zip(points.positions, points.normals)
    places.write_text("".join(" ".join(map(repr, [*p, *n])) + "\n" for p, n in rows))
    environment = {**os.environ, "RAYON_NUM_THREADS": str(flags.threads)}
    started = time.perf_counter()
    said = subprocess.run(solve, stdout=subprocess.PIPE, check=True).stdout
    solve_s = time.perf_counter() - started
    read = subprocess.run(probe, stdout=subprocess.PIPE, check=True, env=environment).stdout
    whole_s = time.perf_counter() - started
    summary, found = json.loads(said), json.loads(read)
    arguments.write(
        flags.output,
        values_lx=[value(point, points) for point in found["points"]],
        trace_s=summary["time_s"],
        whole_s=whole_s,
        map_s=solve_s,
        reported_error=summary["accuracy_reached"],
    )


def value(point, points):
    """Without the caustics that the expected values lack."""
    if point["illuminance_lx"] is None or points.has_caustics:
        return point["illuminance_lx"]
    return point["illuminance_lx"] - point["caustic_lx"]


if __name__ == "__main__":
    sys.exit(main())
