"""The arguments that every script of a renderer takes, and the file it writes."""

import argparse
import json
from pathlib import Path


def parser(description, efforts):
    """A parser whose `--effort` is one of the names given."""
    flags = argparse.ArgumentParser(description=description)
    flags.add_argument("scene", type=existing_file, help="scene written by the example `peers`")
    flags.add_argument("--points", default="map", help="name of a set of points of the scene")
    flags.add_argument("--effort", type=effort(efforts), required=True, help=efforts)
    flags.add_argument("--threads", type=between(1, 1024), default=2)
    flags.add_argument("--seed", type=between(1, 1_000_000), default=1)
    flags.add_argument("--folder", type=Path, required=True, help="where files may be written")
    flags.add_argument("--output", type=Path, required=True, help="JSON to write")
    return flags


def existing_file(text):
    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{text} is no file")
    return path


def between(low, high):
    """A whole number within limits, with a message that names them."""

    def number(text):
        try:
            value = int(text)
        except ValueError:
            value = low - 1
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"`{text}` is no whole number from {low} to {high}")
        return value

    return number


def effort(form):
    """Numbers joined by `:`, as many as the form has names, none of them negative."""
    names = form.split(":")

    def numbers(text):
        try:
            values = [float(field) for field in text.split(":")]
        except ValueError:
            values = []
        if len(values) != len(names) or not all(0.0 <= v < 1e12 for v in values):
            raise argparse.ArgumentTypeError(f"`{text}` is not {form}, numbers from zero")
        return values

    return numbers


def write(path, **record):
    """What was found: `values_lx` at the points, `trace_s`, `whole_s` where this process is only a driver of others, and `map_s`
    where there is a map of the whole scene before points are read from it."""
    path.write_text(json.dumps(record))
