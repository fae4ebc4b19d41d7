"""LuxCore: its lightmap baker (`BAKECPU`), one texture for each rectangle of the scene, read at the
points as its own textures are: bilinear between the middles of texels."""

import math
import sys
import time
from dataclasses import dataclass

import arguments
import scene as scenes

EFFORT = "texels:samples"


def main():
    flags = arguments.parser(__doc__, EFFORT).parse_args()
    scene = scenes.read(flags.scene)
    points = scene.points(flags.points)
    texels, samples = (max(1, int(value)) for value in flags.effort)
    patches = rectangles(scene)
    # It brings an allocator of its own: numpy in the same process ends in a crash.
    import pyluxcore

    pyluxcore.Init()
    started = time.perf_counter()
    world = described(pyluxcore, scene, patches)
    maps = [flags.folder / f"{patch.name}.pfm" for patch in patches]
    settings = engine(flags, texels, samples)
    for k, (patch, path) in enumerate(zip(patches, maps)):
        path.unlink(missing_ok=True)
        settings.update({f"bake.maps.{k}.{key}": v for key, v in bake(patch, path, texels).items()})
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties(pyluxcore, settings), world))
    session.Start()
    while not session.HasDone():
        time.sleep(0.005)
        session.UpdateStats()
    session.Stop()
    pictures = [read_pfm(path) for path in maps]
    values = [read_at(patches, pictures, position) for position in points.positions]
    arguments.write(flags.output, values_lx=values, trace_s=time.perf_counter() - started)


@dataclass(frozen=True)
class Patch:
    """A rectangle `corner + s u + t v`."""

    name: str
    corners: list
    triangles: list
    material: str

    def coordinates(self, place):
        """(s, t) of a place on it, else None."""
        corner, first, _, last = self.corners
        u, v = ([b - a for a, b in zip(corner, end)] for end in (first, last))
        away = [b - a for a, b in zip(corner, place)]
        s, t = (dot(away, edge) / dot(edge, edge) for edge in (u, v))
        rest = [a - s * x - t * y for a, x, y in zip(away, u, v)]
        near = dot(rest, rest) < 1e-12 * (dot(u, u) + dot(v, v))
        return (s, t) if near and -1e-9 < s < 1 + 1e-9 and -1e-9 < t < 1 + 1e-9 else None


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def rectangles(scene):
    """The scene as pairs of triangles, each pair a rectangle with four corners in order."""
    found = []
    for shape in scene.shapes:
        pairs = list(zip(shape.triangles[::2], shape.triangles[1::2]))
        for first, second in pairs:
            corners = sorted({*first, *second})
            if shape.sphere or len(shape.triangles) % 2 or len(corners) != 4:
                raise SystemExit(f"{scene.name}: `{shape.name}` is not of rectangles, which this script bakes")
            local = [[corners.index(v) for v in triangle] for triangle in (first, second)]
            positions = [shape.positions[v] for v in corners]
            material = scene.materials[shape.material].name
            found.append(Patch(f"{shape.name}{len(found)}", positions, local, material))
    return found


def described(pyluxcore, scene, patches):
    world = pyluxcore.Scene()
    settings = {"scene.camera.type": "perspective", "scene.camera.lookat.orig": [0.0, 0.0, 0.0],
                "scene.camera.lookat.target": [1.0, 0.0, 0.0]}
    for material in scene.materials:
        settings[f"scene.materials.{material.name}.type"] = "matte"
        settings[f"scene.materials.{material.name}.kd"] = list(material.diffuse)
    for lamp in scene.luminaires:
        light = f"scene.lights.{lamp.name}"
        settings[f"{light}.type"] = "point"
        settings[f"{light}.position"] = list(lamp.position)
        # It takes what is sent in all directions together.
        settings[f"{light}.color"] = [4.0 * math.pi * lamp.intensity_cd] * 3
    world.Parse(properties(pyluxcore, settings))
    for patch in patches:
        corners = [tuple(map(float, p)) for p in patch.corners]
        uvs = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        world.DefineMesh(patch.name, corners, [tuple(t) for t in patch.triangles], None, uvs, None, None)
        place = f"scene.objects.{patch.name}"
        world.Parse(properties(pyluxcore, {f"{place}.shape": patch.name, f"{place}.material": patch.material}))
    return world


def engine(flags, texels, samples):
    return {
        "renderengine.type": "BAKECPU", "renderengine.seed": flags.seed, "sampler.type": "SOBOL",
        "native.threads.count": flags.threads, "film.width": texels, "film.height": texels,
        "film.filter.type": "NONE", "film.imagepipelines.0.0.type": "NOP", "batch.haltspp": samples,
        "path.pathdepth.total": 24, "path.pathdepth.diffuse": 24, "path.russianroulette.depth": 8,
        "path.clamping.variance.maxvalue": 0.0, "bake.margin": 0, "bake.skipexistingmapfiles": 0,
    }


def bake(patch, path, texels):
    return {
        "type": "LIGHTMAP", "filename": str(path), "imagepipelineindex": 0, "width": texels,
        "height": texels, "autosize.enabled": 0, "uvindex": 0, "objectnames": patch.name,
    }


def properties(pyluxcore, settings):
    made = pyluxcore.Properties()
    for name, value in settings.items():
        made.Set(pyluxcore.Property(name, value))
    return made


def read_pfm(path):
    """Rows of luminances."""
    import array

    data = path.read_bytes()
    _, size, scale, body = data.split(b"\n", 3)
    width, height = map(int, size.split())
    values = array.array("f")
    values.frombytes(body[: 12 * width * height])
    if (float(scale) < 0) != (sys.byteorder == "little"):
        values.byteswap()
    texel = [scenes.luminance(values[k : k + 3]) for k in range(0, len(values), 3)]
    return [texel[row * width : (row + 1) * width] for row in range(height)]


def read_at(patches, pictures, place):
    """The illuminance at a place: pi times what a lightmap holds."""
    for patch, picture in zip(patches, pictures):
        at = patch.coordinates(place)
        if at:
            return math.pi * bilinear(picture, *at)
    return None


def bilinear(picture, s, t):
    size = len(picture)
    (column, right), (row, up) = (clamped(x * size - 0.5, size) for x in (s, t))
    next_column, next_row = min(column + 1, size - 1), min(row + 1, size - 1)
    low, high = (
        (1.0 - right) * picture[r][column] + right * picture[r][next_column] for r in (row, next_row)
    )
    return (1.0 - up) * low + up * high


def clamped(x, size):
    """The texel below and the way to the next."""
    x = min(max(x, 0.0), size - 1.0)
    return int(x), x - int(x)


if __name__ == "__main__":
    sys.exit(main())
