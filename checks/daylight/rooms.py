"""Illuminances of ten daylit rooms by Radiance, by maps of isolux, and by isolux's long paths as the arbiter.

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
# Root mean square of what points of a map are off, in combined standard errors: right ones have one or less.
MOST_RMS_ERRORS = 2.0
# 95 % of a normal distribution.
NORMAL = 1.96
# What is divided by what.
PAIRS = [("grid", "radiance"), ("exact", "radiance"), ("paths", "radiance"), ("grid", "paths"), ("exact", "paths")]
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
    wrong = [result for result in results if result["right"] in ("Radiance", "neither") or result["understated"]]
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
    points_file = folder / "points.pts"
    long_lx, long_error, long_s = by_isolux.by_paths(flags.isolux, scene, [*places, OPEN_GROUND], flags.paths, points_file)
    made, map_s = by_isolux.solved(flags.isolux, scene, flags.accuracy)
    grid, grid_s = by_isolux.by_grid(flags.isolux, made, room.plane)
    exact_lx, exact_error, exact_s = by_isolux.exactly(flags.isolux, made, places, points_file)
    read = [(v["illuminance_lx"], v["standard_error_lx"]) for v in grid["values"]]
    mean = grid["mean_lx"]
    found = {
        "radiance": (point_lx, point_error),
        "grid": tuple(np.array(read, dtype=float).T),
        "exact": (np.array(exact_lx), np.array(exact_error)),
        "paths": (np.array(long_lx[:-1]), np.array(long_error[:-1])),
    }
    means = {
        "radiance": {"mean_lx": theirs_mean, "error_lx": theirs_error, "seconds": theirs["seconds"]},
        "grid": {"mean_lx": mean["value"], "error_lx": (mean["high"] - mean["low"]) / (2 * NORMAL), "seconds": map_s + grid_s},
        # Errors of what a map says may be alike at all points.
        "exact": {**of_points(found["exact"], np.mean), "seconds": map_s + exact_s},
        # Points are traced with numbers of their own.
        "paths": {**of_points(found["paths"], of_independent), "seconds": long_s},
    }
    result = {
        "number": number,
        "room": room.name,
        "use": "tuning" if ten_rooms.is_for_tuning(number) else "judging",
        "open_ground": {"radiance_lx": open_lx, "paths_lx": long_lx[-1]},
        **means,
        "points": [
            {"place": place, **{name: [lx[k], error[k]] for name, (lx, error) in found.items()}}
            for k, place in enumerate(places)
        ],
    }
    for one, other in PAIRS:
        result[f"{one}_over_{other}"] = compared(found[one], found[other], means[one], means[other])
    result["right"] = verdict(result)
    result["understated"] = [name for name in ("grid", "exact") if result[f"{name}_over_paths"]["rms_errors"] > MOST_RMS_ERRORS]
    return result


def of_points(found, of_errors):
    lx, errors = found
    return {"mean_lx": float(lx.mean()), "error_lx": float(of_errors(errors))}


def of_independent(errors):
    """The standard error of a mean of independent values."""
    return math.sqrt((errors**2).sum()) / len(errors)


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
    """With whom the long paths are, where isolux and Radiance are apart; else nobody."""
    isolux_is_far = is_apart(result["grid_over_paths"]) or is_apart(result["exact_over_paths"])
    radiance_is_far = is_apart(result["paths_over_radiance"])
    return {(False, True): "isolux", (True, False): "Radiance", (True, True): "neither", (False, False): None}[
        isolux_is_far, radiance_is_far
    ]


def sentence(result):
    shares = [f"{one} {percent(result[f'{one}_over_radiance'])}" for one in ("grid", "exact", "paths")]
    end = f"; long paths are with {result['right']}" if result["right"] else ""
    return f"{result['room']}, over Radiance: {', '.join(shares)}{end}"


def percent(of):
    return f"{100 * of['difference']:+.2f} ± {100 * of['error']:.2f} %"


def table(results):
    """Means, differences of means, and differences of points: the largest and the root mean square, in combined standard errors."""
    means = ["radiance", "grid", "exact", "paths"]
    ratios = [f"{one} over {other}" for one, other in PAIRS]
    cells = ["room", "for", *(f"{name}, lx" for name in means), *ratios, *(f"points, {name}" for name in ratios), "seconds", "paths are with", "understates its errors"]
    lines = [cells, len(cells) * ["---"]]
    for result in results:
        pairs = [result[f"{one}_over_{other}"] for one, other in PAIRS]
        lines.append([
            result["room"], result["use"],
            *(f"{result[name]['mean_lx']:.1f} ± {result[name]['error_lx']:.1f}" for name in means),
            *map(percent, pairs),
            *(f"{of['largest_errors']:.1f}, {of['rms_errors']:.2f}" for of in pairs),
            ", ".join(f"{result[name]['seconds']:.0f}" for name in means),
            result["right"] or "",
            ", ".join(result["understated"]),
        ])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


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
    (flags.save / "rooms.json").write_text(json.dumps(rounded(facts), indent=1) + "\n")
    (flags.save / "rooms.md").write_text(table(results))


def rounded(value):
    """With six significant digits, as standard errors need no more."""
    if isinstance(value, dict):
        return {key: rounded(of) for key, of in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(of) for of in value]
    return float(f"{value:.6g}") if isinstance(value, (float, np.floating)) else value


if __name__ == "__main__":
    main()
