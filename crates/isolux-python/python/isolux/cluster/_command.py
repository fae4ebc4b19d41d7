"""``isolux cluster``: runs on a cluster, in the words of the command."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from typing import Any

from isolux._call import Call
from isolux._errors import Error, RefusedError
from isolux._progress import Shown
from isolux.cluster._feed import Feed
from isolux.cluster._ray import connected


def main(arguments: Sequence[str]) -> int:
    """Run ``isolux cluster`` with these arguments, to its exit code."""
    own, words = _parser().parse_known_args(list(arguments))
    shown = Shown(own.progress != "none", None)
    cpus = own.workers * own.worker_threads if own.workers else None
    try:
        with connected(own.address, cpus) as ray:
            feed = Feed(ray, own.workers, own.worker_threads)
            call = _Spoken(shown, feed)
            try:
                call.run(["solve", *words])
            finally:
                feed.close()
                shown.close()
    except Error as error:
        for problem in error.problems:
            print(f"error: {problem.message}", file=sys.stderr)
        return 4 if isinstance(error, RefusedError) else 2
    except KeyboardInterrupt:
        return 130
    except (ImportError, ConnectionError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 4
    if own.json:
        print(json.dumps(call.report, indent=2, ensure_ascii=False))
    else:
        print("\n".join(_facts(call.report)))
    return call.exit_code


class _Spoken(Call):
    """Warnings and notes on standard error."""

    def pass_on(self) -> None:
        for kind, texts in (("warning", self.warnings), ("note", self.notes)):
            for text in texts:
                print(f"{kind}: {text}", file=sys.stderr)


def _facts(report: Any) -> list[str]:
    """What there is to tell, one fact a line."""
    error = report["accuracy_reached"]
    told = {
        "written": report["map"],
        "receivers": report["receivers"],
        "increments": report["increments"],
        "error": "not known" if error is None else f"{100 * error:.2g} %",
        "time": f"{report['time_s']:.1f} s",
    }
    return [f"{name:<12}{value}" for name, value in told.items()]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="isolux cluster",
        description="Runs on a cluster of Ray: the map is, byte by byte, that of `isolux solve`.",
    )
    kinds = parser.add_subparsers(dest="subcommand", required=True)
    solve = kinds.add_parser(
        "solve",
        usage="isolux cluster solve SCENE -o MAP.glb [flags of isolux solve] [--address ADDRESS] [--workers N]",
        description="Compute an illumination map. All flags of `isolux solve` but those for viewers and parts hold; --threads are those "
        "of the pilot and the audit, which are made here.",
        allow_abbrev=False,
    )
    solve.add_argument(
        "--address",
        help="of the cluster; auto for the one that this machine is part of [default: RAY_ADDRESS, else the processors of this machine]",
    )
    solve.add_argument(
        "--workers", type=_count, metavar="N", help="at most so many at a time [default: all]"
    )
    solve.add_argument(
        "--worker-threads", type=_count, metavar="N", default=1, help="of each worker [default: 1]"
    )
    solve.add_argument("--progress", choices=["bar", "none"], default="bar")
    solve.add_argument("--json", action="store_true", help="print results as JSON")
    return parser


def _count(text: str) -> int:
    count = int(text)
    if count < 1:
        raise argparse.ArgumentTypeError("give at least 1")
    return count
