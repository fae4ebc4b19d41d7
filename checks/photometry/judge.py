"""What Radiance's ies2rad and photompy read out of photometric files, against isolux.

Both judges only read: their tables are integrated here, by Gauss-Legendre quadrature of the bilinear
interpolation, so that any difference of flux is one of reading (values, factors, symmetry), not of summing.
Differences that are accepted stand in accepted.json with their reasons; one that has vanished is a failure,
too, so that the list stays true.
"""

import argparse
import fnmatch
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

# photompy keeps all digits: a few roundings of sums of thousands of numbers.
PHOTOMPY_TOLERANCE = 1e-9
# ies2rad writes six digits.
RADIANCE_TOLERANCE = 1e-5
# Lumens in a watt, as ies2rad reckons.
EFFICACY = 179.0


class Refused(Exception):
    """A judge does not read a file."""


def flux(planes_deg, gammas_deg, candela):
    """The integral of bilinear interpolation over planes (which cover a circle) and gamma, lm."""
    if len(planes_deg) == 1:
        planes_deg = [0.0, 360.0]
        candela = np.repeat(candela, 2, axis=0)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    gammas = np.radians(gammas_deg)
    total = 0.0
    for k in range(len(gammas) - 1):
        low, high = gammas[k], gammas[k + 1]
        for node, weight in zip(nodes, weights):
            share = 0.5 * (1.0 + node)
            ring = candela[:, k] * (1.0 - share) + candela[:, k + 1] * share
            around = np.trapezoid(ring, np.radians(planes_deg))
            total += 0.5 * weight * (high - low) * math.sin(low + share * (high - low)) * around
    return total


def mirrored(planes, candela, about):
    """A table and its image: about 0 degrees, or about 90."""
    image = [2.0 * about - plane for plane in planes]
    rows = {}
    for plane, row in [*zip(image, candela), *zip(planes, candela)]:
        rows[round(plane % 360.0, 9)] = row
    planes = sorted(rows)
    return planes, np.array([rows[plane] for plane in planes])


def closed(planes, candela):
    """The circle closed by its first plane."""
    if planes[-1] < planes[0] + 360.0:
        planes = [*planes, planes[0] + 360.0]
        candela = np.vstack([candela, candela[:1]])
    return planes, candela


def by_photompy(path):
    """Flux and greatest intensity as photompy reads them."""
    from photompy import IESFile
    from photompy.ldt import LDTFile

    reader = IESFile if path.suffix.lower() == ".ies" else LDTFile
    try:
        given = reader.read(str(path)).photometry
        photometry = given.expanded()
    except Exception as error:
        raise Refused(f"{type(error).__name__}: {error}") from error
    values = np.asarray(photometry.values, dtype=float)
    if photometry.photometric_type.name == "A":
        return flux(photometry.phis, photometry.thetas + 90.0, values), float(values.max())
    if photometry.photometric_type.name == "B":
        return flux(photometry.thetas, photometry.phis + 90.0, values.T), float(values.max())
    # A table that ends at 90 degrees goes on with zeros there: what is between is not in the file.
    kept = photometry.thetas <= given.thetas[-1]
    candela = values[:, kept]
    planes, candela = closed(list(photometry.phis), candela)
    return flux(planes, photometry.thetas[kept], candela), float(candela.max())


def multiplier_of(path):
    """The multiplier of an LM-63 file; ies2rad leaves it to the scene it writes."""
    text = path.read_bytes().decode("latin-1").upper()
    words = re.split(r"(?m)^\s*TILT=", text, maxsplit=1)[1].replace(",", " ").split()
    # Lamp-to-luminaire geometry, count, angles, factors.
    table = 2 + 2 * int(words[2]) if words[0] == "INCLUDE" else 0
    return float(words[1 + table + 2])


def both_sides(angles, values):
    """A table from 0 on and its image."""
    image = [-angle for angle in angles[:0:-1]]
    return np.array([*image, *angles]), np.vstack([values[:0:-1], values])


def by_ies2rad(path, program):
    """Flux and greatest intensity of the data file that ies2rad makes."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "-p", folder, "-o", "lamp", str(path)]
        ran = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=60)
        scene, data = (pathlib.Path(folder) / f"lamp.{end}" for end in ("rad", "dat"))
        if ran.returncode != 0 or not data.exists():
            raise Refused(ran.stderr.strip().splitlines()[-1] if ran.stderr else "no data file")
        words = scene.read_text().split()
        numbers = iter([float(word) for word in data.read_text().split()])
    axes = []
    for _ in range(int(next(numbers))):
        low, high, count = next(numbers), next(numbers), int(next(numbers))
        axes.append([next(numbers) for _ in range(count)] if low == high else np.linspace(low, high, count))
    values = np.array(list(numbers)) * EFFICACY * multiplier_of(path)
    if any(word.startswith("srcB_") for word in words):
        horizontal, vertical = np.array(axes[0]), np.array(axes[1])
        values = values.reshape(len(horizontal), len(vertical))
        if "srcB_horiz2" in words:
            horizontal, values = both_sides(list(horizontal), values)
        if "srcB_vert2" in words:
            vertical, turned = both_sides(list(vertical), values.T)
            values = turned.T
        return flux(vertical, horizontal + 90.0, values.T), float(values.max())
    if len(axes) == 1:
        planes, gammas, candela = [0.0], axes[0], values[np.newaxis, :]
    else:
        planes, gammas = list(axes[0]), axes[1]
        candela = values.reshape(len(planes), len(gammas))
        if "src_phi4" in words:
            planes, candela = mirrored(planes, candela, 90.0)
            planes, candela = mirrored(planes, candela, 0.0)
        elif "src_phi2" in words:
            planes, candela = mirrored(planes, candela, 0.0)
        planes, candela = closed(planes, candela)
    return flux(planes, gammas, candela), float(candela.max())


def isolux(program, arguments):
    ran = subprocess.run([program, *arguments, "--json"], capture_output=True, text=True, timeout=300)
    if not ran.stdout:
        sys.exit(f"isolux {' '.join(arguments[:3])}: {ran.stderr}")
    return json.loads(ran.stdout)


def converted(program, path, folder):
    """The file in the other format, for judges that read that one better."""
    target = pathlib.Path(folder) / f"{path.stem}{'.ies' if path.suffix == '.ldt' else '.ldt'}"
    isolux(program, ["lint", str(path), "--convert", str(target)])
    return target


def relative(one, other):
    scale = max(abs(one), abs(other))
    return abs(one - other) / scale if scale > 0.0 else 0.0


def compare(judge, path, contents, tolerance):
    """Why a judge disagrees; None if it agrees."""
    try:
        flux_lm, most_cd = judge(path)
    except Refused as refusal:
        return f"refused: {refusal}"
    for what, theirs, ours in [
        ("flux", flux_lm, contents["luminous_flux_lm"]),
        ("greatest intensity", most_cd, contents["max_intensity_cd"]),
    ]:
        if not relative(theirs, ours) <= tolerance:
            return f"{what}: {theirs:.9g}, isolux {ours:.9g}"
    return None


def accepted_reason(accepted, judge, name):
    for entry in accepted:
        if entry["judge"] == judge and fnmatch.fnmatch(name, entry["file"]):
            return entry
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--isolux", required=True)
    parser.add_argument("--accepted", required=True, type=pathlib.Path)
    parser.add_argument("folders", nargs="+", metavar="NAME=FOLDER")
    arguments = parser.parse_args()
    import pyradiance

    ies2rad = str(pathlib.Path(pyradiance.__file__).parent / "bin" / "ies2rad")
    accepted = json.loads(arguments.accepted.read_text())
    used, failures, agreed, known = set(), [], 0, 0

    def judged(judge_name, judge, path, name, contents, tolerance):
        nonlocal agreed, known
        why = compare(judge, path, contents, tolerance)
        entry = accepted_reason(accepted, judge_name, name)
        if why is None:
            agreed += 1
            if entry is not None:
                failures.append(f"{judge_name}, {name}: agrees, remove it from the accepted differences")
        elif entry is not None and entry["says"] in why:
            known += 1
            used.add(accepted.index(entry))
        else:
            failures.append(f"{judge_name}, {name}: {why}")

    with tempfile.TemporaryDirectory() as scratch:
        for named in arguments.folders:
            set_name, _, folder = named.partition("=")
            folder = pathlib.Path(folder)
            files = sorted(p for p in folder.rglob("*") if p.suffix.lower() in (".ies", ".ldt"))
            if not files:
                failures.append(f"{folder}: no files")
                continue
            reports = isolux(arguments.isolux, ["lint", *map(str, files)])["files"]
            for path, report in zip(files, reports, strict=True):
                name = f"{set_name}/{path.relative_to(folder).as_posix()}"
                if not report["usable"]:
                    why = report["findings"][0]["what"]
                    entry = accepted_reason(accepted, "isolux", name)
                    if entry is None or entry["says"] not in why:
                        failures.append(f"isolux, {name}: {why}")
                    else:
                        known += 1
                        used.add(accepted.index(entry))
                    continue
                contents = report["contents"]
                radiance = lambda file: by_ies2rad(file, ies2rad)
                judged("photompy", by_photompy, path, name, contents, PHOTOMPY_TOLERANCE)
                if path.suffix.lower() == ".ies":
                    judged("ies2rad", radiance, path, name, contents, RADIANCE_TOLERANCE)
                    continue
                other = converted(arguments.isolux, path, scratch)
                for judge_name, judge in [("photompy", by_photompy), ("ies2rad", radiance)]:
                    judged(judge_name, judge, other, f"{name} as IES", contents, RADIANCE_TOLERANCE)

    for index, entry in enumerate(accepted):
        if index not in used:
            failures.append(f"accepted difference of {entry['judge']}, {entry['file']}: no longer met")
    for failure in failures:
        print(failure)
    print(f"{agreed} readings agree, {known} differ as accepted, {len(failures)} otherwise")
    # Nothing judged is no acceptance.
    sys.exit(1 if failures or agreed == 0 else 0)


if __name__ == "__main__":
    main()
