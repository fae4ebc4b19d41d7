"""Differences of colours by colour-science, against isolux.

The pairs are those of a table that was published and random ones: far apart, close together, of the same hue, and greys. Every
formula is asked both ways, as one of them is not symmetric. The table itself is met by isolux to the digits that
it prints.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import warnings

import numpy as np

# Differences over one and the sum of all coordinates of a pair: ten roundings of these.
ROUNDING = 2e-15
# Half of the last digit of the table, and a rounding of it.
PRINTED = 5.001e-5
# Pairs of each kind.
RANDOM = 300
SEED = 1


def published(path):
    """Pairs of colours and their CIEDE2000 differences."""
    with path.open() as file:
        rows = np.array([[float(value) for value in row] for row in list(csv.reader(file))[1:]])
    return rows[:, :6].reshape(-1, 2, 3), rows[:, 6]


def random_pairs(draw):
    """Far apart, close together, of the same hue, greys beside colours, and greys."""
    low, high = [0.0, -128.0, -128.0], [100.0, 128.0, 128.0]
    one, other = draw.uniform(low, high, (2, RANDOM, 3))
    close = one + draw.normal(0.0, 1.0, one.shape)
    paler = one * np.insert(draw.uniform(0.0, 1.0, (RANDOM, 1)), 0, 1.0, axis=1)[:, [0, 1, 1]]
    grey = other * [1.0, 0.0, 0.0]
    darker = grey * draw.uniform(0.0, 1.0, (RANDOM, 1))
    pairs = [(one, other), (one, close), (one, paler), (one, grey), (grey, one), (grey, darker)]
    return np.concatenate([np.stack(pair, axis=1) for pair in pairs])


def random_tristimulus(draw):
    """Values from black to white, many near black, and chromaticities of whites."""
    xyz = draw.uniform(0.0, 1.1, (RANDOM, 3)) ** 4
    return np.vstack([xyz, np.zeros(3)]), draw.uniform(0.28, 0.36, (RANDOM + 1, 2))


def asked(command, pairs, xyz_and_white):
    question = json.dumps({"pairs": pairs.tolist(), "xyz_and_white": xyz_and_white.tolist()})
    ran = subprocess.run(command, input=question, capture_output=True, text=True, timeout=600)
    if ran.returncode != 0:
        sys.exit(f"{' '.join(command)}: {ran.stderr}")
    return json.loads(ran.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--published", required=True, type=pathlib.Path)
    parser.add_argument("command", nargs="+", help="what answers, after --")
    arguments = parser.parse_args()
    with warnings.catch_warnings():
        # It names the packages that it could do more with.
        warnings.simplefilter("ignore")
        import colour

    draw = np.random.default_rng(SEED)
    table, printed = published(arguments.published)
    pairs = np.concatenate([table, random_pairs(draw)])
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    xyz, white_xy = random_tristimulus(draw)
    white = np.stack([white_xy[:, 0], white_xy[:, 1], 1.0 - white_xy.sum(axis=1)], axis=1) / white_xy[:, 1:]
    answer = asked(arguments.command, pairs, np.stack([xyz, white], axis=1))
    if not len(table) or len(answer["differences"]) != 3:
        sys.exit("nothing was judged")
    failures = 0

    def judge(what, ours, theirs, scale, tolerance):
        nonlocal failures
        ours, theirs = np.array(ours), np.array(theirs)
        worst = np.max(np.abs(ours - theirs) / scale) if ours.shape == theirs.shape else np.inf
        verdict = "agrees" if worst <= tolerance else "DIFFERS"
        failures += verdict != "agrees"
        absolute = np.max(np.abs(ours - theirs))
        print(f"{what}: {verdict}, {len(ours)} values, by {absolute:.2g}, of its scale {worst:.2g} ({tolerance:g})")

    size = 1.0 + np.abs(pairs).sum(axis=(1, 2))
    one, other = pairs[:, 0], pairs[:, 1]
    for name, formula in [
        ("cie1976", colour.difference.delta_E_CIE1976),
        ("cie1994", colour.difference.delta_E_CIE1994),
        ("ciede2000", colour.difference.delta_E_CIE2000),
    ]:
        judge(name, answer["differences"][name], formula(one, other), size, ROUNDING)
    judge("table", answer["differences"]["ciede2000"][: len(table)], printed, 1.0, PRINTED)
    lab = [[one["l"], one["a"], one["b"]] for one in answer["lab"]]
    # Roots times 500 and their differences.
    judge("lab", lab, colour.XYZ_to_Lab(xyz, white_xy), 1000.0, ROUNDING)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
