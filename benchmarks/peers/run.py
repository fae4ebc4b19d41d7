"""Runs isolux and its peers in turn over the scenes, and says who reaches which error in what time."""

import argparse
import datetime
import json
import os
import sys
import tempfile
from pathlib import Path

import ladders
import machine
import once
import report
import scene as scenes

# Runs shorter than this are repeated with other seeds: their times scatter most.
SHORT_S = 3.0
REPETITIONS = 3


def main():
    flags = arguments()
    # Only Mitsuba needs it.
    needs_llvm = not flags.only or "mitsuba" in flags.only
    environment = once.environment("mitsuba" if needs_llvm else None, flags.threads)
    environment["ISOLUX"] = str(flags.isolux.resolve())
    libllvm = environment["DRJIT_LIBLLVM_PATH"] if needs_llvm else None
    result = {
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"),
        "revision": flags.revision,
        "machine": machine.machine(),
        "versions": machine.versions(flags.isolux, libllvm),
        "threads": flags.threads,
        "quick": flags.quick,
        "error": "weighted root mean square of relative differences from the exact values",
        "cannot": [
            {"scene": scene, "renderer": renderer, "reason": reason}
            for (scene, renderer), reason in ladders.CANNOT.items()
        ],
        "runs": [],
        "values": [],
    }
    with tempfile.TemporaryDirectory(prefix="isolux-peers-") as folder:
        bench = Bench(flags, environment, Path(folder))
        for run in bench.in_turn():
            result["runs"].append(run)
        result["values"].extend(bench.values())
    result["machine"]["load_after"] = os.getloadavg()[0]
    result["levels"] = report.levels(result)
    save(result, flags.results)
    print(json.dumps(result, indent=1) if flags.json else report.text(result))


def arguments():
    flags = argparse.ArgumentParser(description=__doc__)
    flags.add_argument("--isolux", type=Path, required=True, help="the program")
    flags.add_argument("--scenes", type=Path, required=True, help="folder of NAME.json, from the example `peers`")
    flags.add_argument("--results", type=Path, required=True, help="folder for the result and its picture")
    flags.add_argument("--revision", default="unknown", help="of isolux, for the record")
    flags.add_argument("--threads", type=int, default=2)
    flags.add_argument("--quick", action="store_true", help="only the efforts that end soon")
    flags.add_argument("--json", action="store_true", help="print the result instead of a table")
    flags.add_argument("--only", nargs="+", action="extend", metavar="RENDERER", default=[], help="leave the others out")
    flags.add_argument("--scene", nargs="+", action="extend", metavar="SCENE", default=[], help="leave the others out")
    given = flags.parse_args()
    chosen(flags, "renderer", given.only, sorted({ladder.renderer for ladder in ladders.LADDERS}))
    chosen(flags, "scene", given.scene, list(dict.fromkeys(ladder.scene for ladder in ladders.LADDERS)))
    for path in (given.isolux, given.scenes):
        if not path.exists():
            flags.error(f"{path} is not there; `cargo xtask bench peers` makes it")
    if not 1 <= given.threads <= 1024:
        flags.error("--threads: from 1 to 1024")
    given.results.mkdir(parents=True, exist_ok=True)
    return given


def chosen(flags, what, names, known):
    """Refuses a name that nothing has."""
    strangers = [name for name in names if name not in known]
    if strangers:
        flags.error(f"there is no {what} `{strangers[0]}`; choose from {', '.join(known)}")


class Bench:
    """The runs of one bench."""

    def __init__(self, flags, environment, folder):
        self.flags, self.environment, self.folder = flags, environment, folder
        asked = [
            ladder for ladder in ladders.LADDERS
            if (not flags.only or ladder.renderer in flags.only) and (not flags.scene or ladder.scene in flags.scene)
        ]
        self.ladders = [ladder for ladder in asked if not ladder.is_valued()]
        self.valued = [ladder for ladder in asked if ladder.is_valued()]
        self.points = {
            (ladder.scene, ladder.points): scenes.read(self.scene(ladder)).points(ladder.points)
            for ladder in asked
        }

    def scene(self, ladder):
        return self.flags.scenes / f"{ladder.scene}.json"

    def in_turn(self):
        """Every renderer's first effort, then every renderer's second, and so on, scene by scene."""
        for place in dict.fromkeys((ladder.scene, ladder.points) for ladder in self.ladders):
            here = [ladder for ladder in self.ladders if (ladder.scene, ladder.points) == place]
            # Compiled kernels and files are read from caches from the second run on: not what is measured.
            for ladder in here:
                self.once(ladder, ladder.efforts[0], 1)
            for step in range(max(len(ladder.efforts) for ladder in here)):
                for ladder in here:
                    if step < (ladder.quick if self.flags.quick else len(ladder.efforts)):
                        yield self.measured(ladder, ladder.efforts[step])

    def values(self):
        """Of scenes whose values are compared, one run of every renderer."""
        for ladder in self.valued:
            effort, points = ladder.efforts[0], self.points[ladder.scene, ladder.points]
            found = self.once(ladder, effort, 1)
            if found is None:
                continue
            say(f"{ladder.scene} {ladder.renderer} {effort}: " + worst(found["values_lx"], points.expected_lx))
            yield {
                "scene": ladder.scene, "points": ladder.points, "renderer": ladder.renderer, "effort": effort,
                "whole_s": round(found["whole_s"], 4), "error": found["error"],
                "positions": points.positions, "normals": points.normals,
                "expected_lx": points.expected_lx, "values_lx": found["values_lx"],
            }

    def measured(self, ladder, effort):
        """One effort, more than once if it is short."""
        found = [self.once(ladder, effort, 1)]
        if found[0] and found[0]["whole_s"] < SHORT_S:
            found += [self.once(ladder, effort, seed) for seed in range(2, REPETITIONS + 1)]
        found = [one for one in found if one]
        run = {
            "scene": ladder.scene, "points": ladder.points, "renderer": ladder.renderer, "effort": effort,
            "whole_s": [round(one["whole_s"], 4) for one in found],
            "trace_s": [round(one["trace_s"], 4) for one in found],
            "map_s": [round(one["map_s"], 4) for one in found if one["map_s"]],
            "errors": [one["error"] for one in found if one["error"] is not None],
            "reported_errors": [one["reported_error"] for one in found if one["reported_error"]],
        }
        say(f"{ladder.scene} {ladder.points} {ladder.renderer} {effort}: " + said(run))
        return run

    def once(self, ladder, effort, seed):
        """Time and error of one run; None if it failed, which is said."""
        try:
            found = once.run(
                self.scene(ladder), ladder.points, ladder.renderer, effort, threads=self.flags.threads, seed=seed,
                folder=self.folder, environment=self.environment,
            )
        except once.Failed as why:
            say(f"{ladder.renderer} {effort}: {why}")
            return None
        return {
            "whole_s": found["whole_s"],
            "trace_s": found["trace_s"],
            "map_s": found.get("map_s"),
            "error": self.points[ladder.scene, ladder.points].error(found["values_lx"]),
            "reported_error": found.get("reported_error"),
            "values_lx": found["values_lx"],
        }


def worst(values_lx, expected_lx):
    if None in values_lx:
        return "not all places are known"
    return f"{100 * max(report.off(values_lx, expected_lx)):.3f} % at worst"


def said(run):
    if not run["errors"]:
        return "no map"
    return f"{100 * run['errors'][0]:.3f} % in {run['whole_s'][0]:.2f} s"


def save(result, folder):
    path = folder / f"peers-{result['date']}.json"
    path.write_text(json.dumps(result, indent=1) + "\n")
    if not result["runs"]:
        return say(f"saved {path.name} in {folder}")
    report.plot(result, path.with_suffix(".svg"))
    return say(f"saved {path.name} and its picture in {folder}")


def say(line):
    print(line, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
