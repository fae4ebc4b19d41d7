"""Illuminances of ten daylit rooms by Radiance, by isolux, and by isolux's long paths as the arbiter.

Run by hand:  python rooms.py --isolux PATH [--only 1 4] [--save results]

The same .rad file, with its sky, goes to all three, at the same points. README.md tells what is compared and how."""

import argparse
import json
import math
import pathlib
import sys
import tempfile

import numpy as np

import by_isolux
import radiance
import ten_rooms

# Differences beyond both are marked.
LIMIT = 0.02
MOST_ERRORS = 3.0
# 95 % of a normal distribution.
NORMAL = 1.96
# High above everything: the light of the sky alone.
OPEN_GROUND = (0.0, 0.0, 500.0)


def main():
    flags = arguments()
    results = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = flags.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for number, make in enumerate(ten_rooms.ROOMS, 1):
            if flags.only and number not in flags.only:
                continue
            room = make()
            if flags.clear:
                room.clear_panes()
            result = judged(number, room, flags, folder)
            results.append(result)
            print(sentence(result), flush=True)
    print("\n" + table(results))
    if flags.save:
        save(results, flags)
    # Nothing judged is no acceptance.
    wrong = [result["room"] for result in results if result["right"] == "Radiance"]
    sys.exit(1 if wrong or not results else 0)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--isolux", required=True, help="the program")
    parser.add_argument("--only", type=int, nargs="+", help="numbers of rooms")
    parser.add_argument("--clear", action="store_true", help="panes absorb nothing, to tell their absorption from other causes")
    parser.add_argument("--divisions", type=int, default=8192, help="of Radiance: paths from a point in one repetition")
    parser.add_argument("--repetitions", type=int, default=16, help="of Radiance, whose spread is its standard error")
    parser.add_argument("--accuracy", default="1%", help="of the maps of isolux")
    parser.add_argument("--paths", type=int, default=1 << 18, help="long paths of isolux at every point")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for scenes and for what Radiance found, which a later run takes from there")
    parser.add_argument("--save", type=pathlib.Path, help="a folder for rooms.json and rooms.md")
    return parser.parse_args()


def judged(number, room, flags, folder):
    """One room by all three."""
    scene = folder / f"room{number}.rad"
    scene.write_text(room.text())
    places = room.plane.points()
    theirs, open_lx = of_radiance(scene, room, flags)
    theirs_mean, theirs_error = over_repetitions(theirs["lux"].mean(axis=1))
    point_lx, point_error = over_repetitions(theirs["lux"])
    long_lx, long_error, long_s = map(
        np.array, by_isolux.by_paths(flags.isolux, scene, [*places, OPEN_GROUND], flags.paths, folder / "points.pts")
    )
    open_by_isolux, long_lx, long_error = long_lx[-1], long_lx[:-1], long_error[:-1]
    grid, grid_s, _ = by_isolux.by_grid(flags.isolux, scene, room.plane, flags.accuracy)
    mean = grid["mean_lx"]
    map_lx = np.array([v["illuminance_lx"] for v in grid["values"]], dtype=float)
    map_error = np.array([v["standard_error_lx"] for v in grid["values"]], dtype=float)
    result = {
        "number": number,
        "room": room.name,
        "use": "tuning" if ten_rooms.is_for_tuning(number) else "judging",
        "open_ground": {"radiance_lx": open_lx, "isolux_lx": open_by_isolux},
        "radiance": {"mean_lx": theirs_mean, "error_lx": theirs_error, "seconds": theirs["seconds"]},
        "map": {"mean_lx": mean["value"], "error_lx": (mean["high"] - mean["low"]) / (2 * NORMAL), "seconds": grid_s},
        # Points are traced with numbers of their own.
        "paths": {
            "mean_lx": long_lx.mean(),
            "error_lx": math.sqrt((long_error**2).sum()) / len(long_error),
            "seconds": float(long_s),
        },
        "points": [
            {"place": place, "radiance": [r, re], "map": [m, me], "paths": [p, pe]}
            for place, r, re, m, me, p, pe in zip(
                places, point_lx, point_error, map_lx, map_error, long_lx, long_error
            )
        ],
    }
    result["map_over_radiance"] = compared((map_lx, map_error), (point_lx, point_error), result["map"], result["radiance"])
    result["paths_over_radiance"] = compared((long_lx, long_error), (point_lx, point_error), result["paths"], result["radiance"])
    result["map_over_paths"] = compared((map_lx, map_error), (long_lx, long_error), result["map"], result["paths"])
    result["right"] = verdict(result)
    return result


def of_radiance(scene, room, flags):
    """What Radiance finds, or has found: illuminances of all repetitions, and of open ground."""
    kept = scene.with_suffix(".npz")
    asked = f"{scene.read_text()}{flags.divisions} {flags.repetitions} {room.bounces}"
    if kept.exists():
        old = np.load(kept)
        if str(old["asked"]) == asked:
            return {"lux": old["lux"], "seconds": float(old["seconds"])}, float(old["open_lx"])
    compiled = radiance.octree(scene)
    lux, seconds = radiance.by_rtrace(compiled, room.plane.points(), flags.divisions, room.bounces, flags.repetitions)
    opened, _ = radiance.by_rtrace(compiled, [OPEN_GROUND], 1 << 18, 1, 1)
    np.savez(kept, asked=asked, lux=lux, seconds=seconds, open_lx=opened[0, 0])
    return {"lux": lux, "seconds": seconds}, float(opened[0, 0])


def over_repetitions(rows):
    """Mean and standard error along the first axis."""
    return rows.mean(axis=0), rows.std(axis=0, ddof=1) / math.sqrt(len(rows))


def compared(one, other, of_one, of_other):
    """The difference of means as a share with its standard error, and those of points in combined standard errors."""
    errors = (one[0] - other[0]) / np.hypot(np.maximum(one[1], 1e-9), np.maximum(other[1], 1e-9))
    share = of_one["mean_lx"] / of_other["mean_lx"] - 1.0
    share_error = math.hypot(of_one["error_lx"], of_other["error_lx"]) / of_other["mean_lx"]
    return {
        "difference": share,
        "error": share_error,
        "rms_difference": float(np.sqrt(((one[0] / other[0] - 1.0) ** 2).mean())),
        "largest_errors": float(np.abs(errors).max()),
        "rms_errors": float(np.sqrt((errors**2).mean())),
    }


def is_apart(comparison):
    """Beyond the limit, and by more than noise."""
    difference = abs(comparison["difference"])
    return difference > LIMIT and difference > MOST_ERRORS * comparison["error"]


def verdict(result):
    """Whom the long paths say to be right, where the map and Radiance are apart; else none."""
    if not (is_apart(result["map_over_radiance"]) or is_apart(result["paths_over_radiance"])):
        return None
    map_is_far, radiance_is_far = is_apart(result["map_over_paths"]), is_apart(result["paths_over_radiance"])
    return {(False, True): "isolux", (True, False): "Radiance", (True, True): "neither", (False, False): "open"}[
        map_is_far, radiance_is_far
    ]


def sentence(result):
    of = result["map_over_radiance"]
    end = f"; the long paths are with {result['right']}" if result["right"] else ""
    return f"{result['room']}: {100 * of['difference']:+.2f} % ± {100 * of['error']:.2f} %{end}"


def table(results):
    head = (
        "| room | for | Radiance, lx | map, lx | long paths, lx | map over Radiance | paths over Radiance | points, map over Radiance: "
        "largest, RMS in errors | points, paths over Radiance: largest, RMS in errors | seconds: Radiance, map, paths | apart |\n|"
        + 11 * "---|"
    )
    return "\n".join([head, *map(row, results)]) + "\n"


def row(result):
    lux = lambda of: f"{of['mean_lx']:.1f} ± {of['error_lx']:.1f}"
    share = lambda of: f"{100 * of['difference']:+.2f} ± {100 * of['error']:.2f} %"
    spread = lambda of: f"{of['largest_errors']:.1f}, {of['rms_errors']:.2f}"
    three = [result[of] for of in ("radiance", "map", "paths")]
    on_map, on_paths = result["map_over_radiance"], result["paths_over_radiance"]
    seconds = ", ".join(f"{of['seconds']:.0f}" for of in three)
    apart = f"paths: {result['right']}" if result["right"] else ""
    cells = [result["room"], result["use"], *map(lux, three), share(on_map), share(on_paths), spread(on_map), spread(on_paths), seconds, apart]
    return f"| {' | '.join(cells)} |"


def save(results, flags):
    flags.save.mkdir(parents=True, exist_ok=True)
    facts = {
        "radiance": radiance.version(),
        "divisions": flags.divisions,
        "repetitions": flags.repetitions,
        "accuracy": flags.accuracy,
        "paths": flags.paths,
        "clear_panes": flags.clear,
        "rooms": results,
    }
    (flags.save / "rooms.json").write_text(json.dumps(facts, indent=1, default=float) + "\n")
    (flags.save / "rooms.md").write_text(table(results))


if __name__ == "__main__":
    main()
