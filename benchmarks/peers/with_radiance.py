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
# Half of the angle that stands for parallel light.
SUN_DEG = 0.01
# Surfaces of this name shine from all around: hemisphere samples find them, as Radiance's manual advises for skies. All others
# that shine are sources, cut as fine as Radiance does it.
SKY = "sky"
FINEST = 0.01
# From then on not every lamp is looked at from every place.
MANY = 100


def main():
    flags = arguments.parser(__doc__, EFFORT).parse_args()
    scene = scenes.read(flags.scene)
    points = scene.points(flags.points)
    description, octree, cache = (
        flags.folder / f"{scene.name}.{ending}" for ending in ("rad", "oct", "amb")
    )
    description.write_text(rad(scene, flags.folder))
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
    is_open = scene.has_specular() or scene.shines() or scene.suns
    beyond = 0.0 if is_open else scene.mean_luminance_cd_m2()
    if len(scene.luminaires) > MANY:
        # Of lamps that together could add less than this share no shadows are traced, and what they give is guessed;
        # one mirror at most between lamp and place.
        many = "-dt 0.02 -dc 0.5 -dr 1"
    else:
        many = "-dt 0 -dc 1 -dr 3"
    words = f"-I -h -fdd -w- -n {flags.threads} -ab {bounces:.0f} -aa {accuracy} -ar {resolution:.0f}"
    words += f" -ad {divisions:.0f} -as {supersamples:.0f} -av {beyond} {beyond} {beyond} -aw 0"
    finest = FINEST if scene.shines() else 0
    words += f" -ds {finest} -dj 0 {many} -dp 0 -lr 60 -lw 1e-7 -st 0"
    return [*words.split(), "-af", cache]


def rad(scene, folder):
    """The scene in Radiance's language, in photometric units on all three channels."""
    skies = {shape.material for shape in scene.shapes if shape.name == SKY}
    lines = [surface(material, k in skies) for k, material in enumerate(scene.materials)]
    for shape in scene.shapes:
        lines.extend(surfaces(shape, word(scene.materials[shape.material].name)))
    radius_m = LAMP_RADIUS_SHARE * scene.size_m()
    lights = Lights(folder, math.pi * radius_m * radius_m)
    for lamp in scene.luminaires:
        light = lights.of(lamp)
        place = " ".join(str(x) for x in (*lamp.position, radius_m))
        name = word(lamp.name)
        lines.extend([*lights.new, f"{light} sphere {name}\n0\n0\n4 {place}\n"])
        lights.new.clear()
    lines.extend(parallel(sun) for sun in scene.suns)
    return "\n".join(lines)


def word(name):
    """A name as Radiance reads it."""
    return name.replace(" ", "_")


def parallel(sun):
    """A disc of the sky as small as a sun's, and smaller."""
    steradians = math.pi * math.sin(math.radians(SUN_DEG)) ** 2
    shone = 3 * f" {sun.illuminance_lx / steradians}"
    towards = " ".join(str(-x) for x in sun.direction)
    name = word(sun.name)
    return f"void light {name}\n0\n0\n3{shone}\n\n{name} source {name}.disc\n0\n0\n4 {towards} {2 * SUN_DEG}\n"


def surface(material, is_sky):
    name = word(material.name)
    if material.shines():
        shone = " ".join(str(x) for x in material.luminance_cd_m2)
        # `glow` of no reach is never a source of shadow rays.
        return f"void glow {name}\n0\n0\n4 {shone} 0\n" if is_sky else f"void light {name}\n0\n0\n3 {shone}\n"
    if material.pane:
        ior, transmittance = material.pane
        return f"void glass {name}\n0\n0\n4" + 3 * f" {transmittance}" + f" {ior}\n"
    kind, rgb = ("mirror", material.mirror) if max(material.mirror) else ("plastic", material.diffuse)
    tail = "3 {} {} {}" if kind == "mirror" else "5 {} {} {} 0 0"
    return f"void {kind} {name}\n0\n0\n{tail.format(*rgb)}\n"


class Lights:
    """Materials of lamps: one for every distribution, colour and way of standing."""

    def __init__(self, folder, disc_m2):
        self.folder, self.disc_m2 = folder, disc_m2
        self.names, self.files, self.new = {}, {}, []

    def of(self, lamp):
        """The name of its material; what is not yet written is in `new`."""
        key = (id(lamp.web), lamp.intensity_cd, lamp.colour, lamp.axes)
        if key not in self.names:
            self.names[key] = f"light{len(self.names)}"
            self.new.append(self.material(self.names[key], lamp))
        return self.names[key]

    def material(self, name, lamp):
        if lamp.web is None:
            rgb = [c * lamp.intensity_cd / self.disc_m2 for c in lamp.colour]
            return f"void light {name}\n0\n0\n3 {rgb[0]} {rgb[1]} {rgb[2]}\n"
        (x, y, _), _, (_, _, up) = lamp.axes
        if abs(up - 1.0) > 1e-9:
            raise SystemExit(f"{lamp.name} does not hang upright; teach this script to tilt")
        turn_deg = math.degrees(math.atan2(y, x))
        angles = "src_theta" if len(lamp.web.planes_deg) == 1 else "src_phi src_theta"
        words = ["corr", self.table(lamp.web), "source.cal", *angles.split(), "-rz", str(turn_deg)]
        rgb = " ".join(map(str, lamp.colour))
        return (
            f"void brightdata {name}.web\n{len(words)} {' '.join(words)}\n0\n1 {1.0 / self.disc_m2}\n"
            f"\n{name}.web light {name}\n0\n0\n3 {rgb}\n"
        )

    def table(self, web):
        """A file of intensities, cd, as Radiance's data files are."""
        if id(web) not in self.files:
            path = self.folder / f"web{len(self.files)}.dat"
            planes = [*web.planes_deg]
            rows = [web.candela[k * len(web.gammas_deg):][: len(web.gammas_deg)] for k in range(len(planes))]
            if 1 < len(planes) and planes[-1] < planes[0] + 360.0:
                planes.append(planes[0] + 360.0)
                rows.append(rows[0])
            # Below the horizon only, if the table ends there: nothing above.
            gammas = [*web.gammas_deg]
            if gammas[-1] < 180.0:
                gammas += [gammas[-1] + 1e-3, 180.0]
                rows = [[*row, 0.0, 0.0] for row in rows]
            axes = [planes, gammas] if len(planes) > 1 else [gammas]
            text = [str(len(axes)), *(axis(values) for values in axes)]
            text.extend(" ".join(map(str, row)) for row in rows)
            path.write_text("\n".join(text) + "\n")
            self.files[id(web)] = path
        return str(self.files[id(web)])


def axis(values):
    """Of a data file, with values at any distance."""
    return f"0 0 {len(values)} " + " ".join(map(str, values))


def surfaces(shape, material):
    if shape.sphere:
        centre, radius_m = shape.sphere
        numbers = " ".join(str(x) for x in (*centre, radius_m))
        return [f"{material} bubble {shape.name}\n0\n0\n4 {numbers}\n"]
    texts = []
    # Every plane of a mirror doubles the lamps: a flat one is one polygon, not its triangles.
    faces = [shape.outline()] if shape.outline() else shape.quads()
    for k, corners in enumerate(faces):
        numbers = " ".join(str(x) for v in corners for x in shape.positions[v])
        texts.append(f"{material} polygon {shape.name}.{k}\n0\n0\n{3 * len(corners)} {numbers}\n")
    return texts


if __name__ == "__main__":
    sys.exit(main())
