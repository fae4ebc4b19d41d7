"""Radiance: `oconv`, then `rtrace -I` at the points with a cache of ambient light.

This process only writes the files that Radiance reads and starts its programs: the time of the whole is
theirs alone.
"""

import array
import importlib.util
import math
import os
import subprocess
import sys
import time
from pathlib import Path

import arguments
import scene as scenes

EFFORT = "aa:ad:as:ar:ab"
# A lamp in place of a point: so small that its size is not seen.
LAMP_RADIUS_SHARE = 1e-4


def main():
    flags = arguments.parser(__doc__, EFFORT).parse_args()
    scene = scenes.read(flags.scene)
    points = scene.points(flags.points)
    description, octree, cache = (
        flags.folder / f"{scene.name}.{ending}" for ending in ("rad", "oct", "amb")
    )
    description.write_text(rad(scene))
    rays = array.array("d")
    for position, normal in zip(scene.just_inside(points), points.normals):
        rays.extend([*position, *normal])
    cache.unlink(missing_ok=True)
    bin_folder, environment = programs()
    started = time.perf_counter()
    with octree.open("wb") as output:
        subprocess.run(
            [bin_folder / "oconv", description], stdout=output, env=environment, check=True
        )
    traced = time.perf_counter()
    command = [bin_folder / "rtrace", *options(scene, flags, cache), octree]
    found = subprocess.run(
        command, input=rays.tobytes(), stdout=subprocess.PIPE, env=environment, check=True
    )
    ended = time.perf_counter()
    values = array.array("d")
    values.frombytes(found.stdout)
    lux = [scenes.luminance(values[k : k + 3]) for k in range(0, len(values), 3)]
    arguments.write(
        flags.output, values_lx=lux, trace_s=ended - traced, whole_s=ended - started
    )


def programs():
    """The folder of Radiance's programs inside the Python package, and their environment."""
    found = importlib.util.find_spec("pyradiance")
    if not found:
        raise SystemExit("there is no Radiance; install the Python package pyradiance")
    package = Path(found.origin).parent
    return package / "bin", {**os.environ, "RAYPATH": f".:{package / 'lib'}"}


def options(scene, flags, cache):
    accuracy, divisions, supersamples, resolution, bounces = flags.effort
    # Light beyond the last bounce: the mean of the closed scene, where the balance of energy gives it.
    beyond = 0.0 if scene.has_mirrors() else scene.mean_luminance_cd_m2()
    words = f"-I -h -fdd -w- -n {flags.threads} -ab {bounces:.0f} -aa {accuracy} -ar {resolution:.0f}"
    words += f" -ad {divisions:.0f} -as {supersamples:.0f} -av {beyond} {beyond} {beyond} -aw 0"
    words += " -ds 0 -dj 0 -dt 0 -dc 1 -dr 3 -dp 0 -lr 60 -lw 1e-7 -st 0"
    return [*words.split(), "-af", cache]


def rad(scene):
    """The scene in Radiance's language, in photometric units on all three channels."""
    lines = []
    for material in scene.materials:
        kind, rgb = ("mirror", material.mirror) if max(material.mirror) else ("plastic", material.diffuse)
        tail = "3 {} {} {}" if kind == "mirror" else "5 {} {} {} 0 0"
        lines.append(f"void {kind} {material.name}\n0\n0\n{tail.format(*rgb)}\n")
    for shape in scene.shapes:
        lines.extend(surfaces(shape, scene.materials[shape.material].name))
    radius_m = LAMP_RADIUS_SHARE * scene.size_m()
    for k, lamp in enumerate(scene.luminaires):
        luminance_cd_m2 = lamp.intensity_cd / (math.pi * radius_m * radius_m)
        lines.append(f"void light lamp{k}\n0\n0\n3" + 3 * f" {luminance_cd_m2}" + "\n")
        place = " ".join(str(x) for x in (*lamp.position, radius_m))
        lines.append(f"lamp{k} sphere {lamp.name}\n0\n0\n4 {place}\n")
    return "\n".join(lines)


def surfaces(shape, material):
    if shape.sphere:
        centre, radius_m = shape.sphere
        numbers = " ".join(str(x) for x in (*centre, radius_m))
        return [f"{material} bubble {shape.name}\n0\n0\n4 {numbers}\n"]
    texts = []
    # Every plane of a mirror doubles the lamps: a flat one is one polygon, not its triangles.
    faces = [shape.outline()] if shape.outline() else shape.triangles
    for k, corners in enumerate(faces):
        numbers = " ".join(str(x) for v in corners for x in shape.positions[v])
        texts.append(f"{material} polygon {shape.name}.{k}\n0\n0\n{3 * len(corners)} {numbers}\n")
    return texts


if __name__ == "__main__":
    sys.exit(main())
