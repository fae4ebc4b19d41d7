"""What a run of the whole found, as a table and as a picture."""

import math
import statistics

import curve

# Errors asked about; of a practical scene those of practice.
LEVELS = [0.01, 0.003, 0.001]
LEVELS_OF = {"hall": [0.1, 0.05, 0.03, 0.01]}
OWN = "isolux"
COLOURS = {"isolux": "#c1121f", "radiance": "#1d6fb8", "mitsuba": "#2a8a4a", "luxcore": "#8a5a00"}
MARKERS = {"isolux": "o", "radiance": "s", "mitsuba": "^", "luxcore": "D"}


def pairs(result, scene, points, renderer, of="whole_s"):
    """(median time of all processes, or of making the map alone, root mean square error) of every effort that gave a map."""
    found = []
    for run in result["runs"]:
        if (run["scene"], run["points"], run["renderer"]) == (scene, points, renderer) and run["errors"]:
            squares = statistics.fmean(error * error for error in run["errors"])
            if run.get(of):
                found.append((statistics.median(run[of]), math.sqrt(squares)))
    return found


def panels(result):
    """Scenes with their points, in the order they were run, and the renderers of each."""
    found = {}
    for run in result["runs"]:
        names = found.setdefault((run["scene"], run["points"]), [])
        if run["renderer"] not in names:
            names.append(run["renderer"])
    return found


def levels(result):
    """For every panel and level the time of each renderer, and the best peer's over isolux'."""
    rows = []
    for (scene, points), renderers in panels(result).items():
        for level in LEVELS_OF.get(scene, LEVELS):
            times = {r: curve.reached(pairs(result, scene, points, r), level) for r in renderers}
            peers = [t.time_s for r, t in times.items() if r != OWN and t]
            own = times.get(OWN)
            alone = curve.reached(pairs(result, scene, points, OWN, "map_s"), level)
            rows.append({
                "scene": scene,
                "points": points,
                "error": level,
                "times": {r: t and {"time_s": t.time_s, "mark": t.mark} for r, t in times.items()},
                "best_peer_over_isolux": min(peers) / own.time_s if peers and own else None,
                "map_alone": alone and {"time_s": alone.time_s, "mark": alone.mark},
                "best_peer_over_map_alone": min(peers) / alone.time_s if peers and alone else None,
            })
    return rows


def off(values_lx, expected_lx):
    """Relative differences without their signs."""
    return [abs(value / expected - 1.0) for value, expected in zip(values_lx, expected_lx)]


def text(result):
    """All tables, for the terminal."""
    tables = [table(result["levels"])] if result["runs"] else []
    return "\n\n".join(tables + ([values(result["values"])] if result["values"] else []))


def values(found):
    """Of the scenes whose values are compared: the largest relative difference of each renderer."""
    renderers = list(dict.fromkeys(one["renderer"] for one in found))
    lines = [["scene", "places", *(f"{r}, worst" for r in renderers)]]
    for scene in dict.fromkeys(one["scene"] for one in found):
        of = {one["renderer"]: one for one in found if one["scene"] == scene}
        places = len(next(iter(of.values()))["expected_lx"])
        cells = [of.get(r) and max(off(of[r]["values_lx"], of[r]["expected_lx"])) for r in renderers]
        lines.append([scene, str(places), *("-" if c is None else f"{100 * c:.3g} %" for c in cells)])
    return aligned(lines)


def aligned(lines):
    widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
    return "\n".join("  ".join(cell.ljust(w) for cell, w in zip(line, widths)).rstrip() for line in lines)


def table(rows):
    """Of `levels`, for the terminal."""
    renderers = list(dict.fromkeys(r for row in rows for r in row["times"]))
    lines = [["scene", "points", "error", *renderers, "best peer / isolux", "solve alone", "best peer / solve"]]
    for row in rows:
        lines.append([
            row["scene"], row["points"], f"{100 * row['error']:g} %",
            *(shown(row["times"].get(r), r in row["times"]) for r in renderers),
            times_faster(row["best_peer_over_isolux"], row["times"].get(OWN)),
            shown(row["map_alone"], row["map_alone"] is not None),
            times_faster(row["best_peer_over_map_alone"], row["map_alone"]),
        ])
    return "\n".join([aligned(lines), "", NOTES])


NOTES = (
    "Whole-process time at which the error (root mean square of relative differences from the exact "
    "values) is reached; of isolux with reading the points, and that of `isolux solve`, which writes the map of all surfaces, alone.\n< its cheapest run is already better, which makes the last column a bound; ~ extrapolated, at most by a factor of 2 in "
    "error; never: not with these efforts."
)


def times_faster(ratio, own):
    at_least = ">" if own and own["mark"] == "<" else ""
    return f"{at_least}{ratio:.3g}" if ratio else "-"


def shown(time, was_run):
    if not was_run:
        return "-"
    return f"{time['mark']}{time['time_s']:.3g} s" if time else "never"


def plot(result, path):
    """Error against time, one panel for a scene and its points."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "isolux"
    import matplotlib.pyplot as plt

    all_panels = panels(result)
    figure, axes = plt.subplots(1, len(all_panels), figsize=(5.2 * len(all_panels), 4.6), squeeze=False)
    for axis, ((scene, points), renderers) in zip(axes[0], all_panels.items()):
        for renderer in renderers:
            draw(axis, renderer, sorted(pairs(result, scene, points, renderer)))
        for level in LEVELS_OF.get(scene, LEVELS):
            axis.axhline(100 * level, color="0.8", linewidth=0.8, zorder=0)
        axis.set(xscale="log", yscale="log", xlabel="time of the whole process, s", ylabel="error, %")
        axis.set_title(f"{scene.upper()}, {'whole map' if points == 'map' else 'points of the paper'}")
        axis.xaxis.set_major_formatter(plain())
        axis.yaxis.set_major_formatter(plain())
        axis.grid(True, which="major", color="0.92")
        axis.legend(frameon=False)
    machine = result["machine"]
    figure.suptitle(f"{machine['processor']}, {result['threads']} threads, {result['date']}", fontsize=9)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    plt.close(figure)


def draw(axis, renderer, found):
    if found:
        times_s, errors = zip(*found)
        axis.plot(
            times_s, [100 * e for e in errors], label=renderer, color=COLOURS[renderer],
            marker=MARKERS[renderer], markersize=5, linewidth=2.2 if renderer == OWN else 1.3,
        )


def plain():
    from matplotlib.ticker import FuncFormatter

    return FuncFormatter(lambda value, _: f"{value:g}")
