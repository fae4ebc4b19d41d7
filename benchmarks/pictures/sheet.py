"""One sheet of pictures: isolux beside Mitsuba 3, and what they differ by.

    python3 -m pip install -r benchmarks/pictures/requirements.txt
    python3 benchmarks/pictures/sheet.py --isolux target/release/isolux -o sheet.png

Every scene is solved to 1 %, rendered once as luminance (EXR), and traced by Mitsuba with many paths a pixel. Both go through the
same exposure and the same tone curve. The third column is their CIE94 difference: 2 is just seen side by side."""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import tomllib

import mitsuba as mi
import numpy as np
from PIL import Image, ImageDraw

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZE = (400, 225)
MARGIN = 28
# The darkest and brightest of the colours of differences: none, and one of 10.
MOST_SHOWN = 10.0


def main():
    flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    flags.add_argument("--isolux", default="isolux")
    flags.add_argument("--samples", type=int, default=144, help="paths a pixel of Mitsuba")
    flags.add_argument("-o", "--output", required=True)
    flags = flags.parse_args()
    mi.set_variant("scalar_rgb")
    rows, report = [], []
    with tempfile.TemporaryDirectory() as folder:
        for name, scene in scenes(flags.isolux, pathlib.Path(folder)):
            ours, times = by_isolux(flags.isolux, scene)
            started = time.perf_counter()
            theirs = by_mitsuba(scene, flags.samples)
            times["mitsuba_s"] = round(time.perf_counter() - started, 1)
            exposure = 0.35 / log_average(luminance(theirs))
            pictures = [developed(exposure * image) for image in (ours, theirs)]
            off = cie94(*(lab(picture) for picture in pictures))
            figures = {"scene": name, "cie94_mean": round(float(off.mean()), 2),
                       "cie94_99_percent": round(float(np.quantile(off, 0.99)), 2), **times}
            report.append(figures)
            print(json.dumps(figures), file=sys.stderr)
            rows.append((name, pictures, off, figures))
    sheet(rows).save(flags.output)
    print(json.dumps(report, indent=1))


def scenes(isolux, folder):
    """Scenes as files that both can read: a `scene.toml` with a glTF file beside it."""
    office = folder / "office.toml"
    run(isolux, "new", "office", "--size", "6x5x2.8", "-o", office)
    for name, source in [
        ("office", office),
        ("cornell_mcguire", ROOT / "scenes/cornell_mcguire/scene.toml"),
        ("cornell_mitsuba", ROOT / "scenes/cornell_mitsuba/scene.xml"),
    ]:
        run(isolux, "scene", source, "-o", folder / name)
        yield name, folder / name / "scene.toml"


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def by_isolux(isolux, scene):
    """Luminance in cd/m2, and how long that took."""
    luminous, picture = scene.with_name("map.glb"), scene.with_name("view.exr")
    started = time.perf_counter()
    run(isolux, "solve", scene, "-o", luminous, "--accuracy", "1%")
    solved = time.perf_counter()
    camera = tomllib.loads(scene.read_text())["camera"][0]["name"]
    run(isolux, "render", luminous, "-o", picture, "--camera", camera, "--size", f"{SIZE[0]}x{SIZE[1]}")
    ended = time.perf_counter()
    image = np.array(mi.Bitmap(str(picture)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32))
    return image, {"solve_s": round(solved - started, 1), "render_s": round(ended - solved, 1)}


def by_mitsuba(path, samples):
    """Luminance in cd/m2 by path tracing."""
    written = tomllib.loads(path.read_text())
    world = {"type": "scene", "integrator": {"type": "path", "max_depth": -1}}
    is_z_up = written.get("up", "z") == "z"
    for number, mesh in enumerate(meshes(path.with_name("scene.gltf"), written["materials"], is_z_up)):
        world[f"mesh{number}"] = mesh
    camera = written["camera"][0]
    at, way = np.array(camera["position"]), np.array(camera["direction"])
    up = [0.0, 0.0, 1.0] if is_z_up else [0.0, 1.0, 0.0]
    world["sensor"] = {
        "type": "perspective",
        "fov_axis": "y",
        "fov": camera["vertical_fov_deg"],
        "to_world": mi.ScalarTransform4f().look_at(
            origin=at.tolist(), target=(at + way).tolist(), up=camera.get("up", up)),
        "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"},
                 "pixel_format": "rgb", "component_format": "float32"},
        "sampler": {"type": "independent", "sample_count": samples},
    }
    return np.array(mi.render(mi.load_dict(world)))


def meshes(path, materials, is_z_up):
    """The primitives of a glTF file with the materials of the scene. In glTF y is up."""
    written = json.loads(path.read_text())
    data = path.with_name(written["buffers"][0]["uri"]).read_bytes()

    def read(number):
        accessor = written["accessors"][number]
        view = written["bufferViews"][accessor["bufferView"]]
        kind = {5126: np.float32, 5125: np.uint32, 5123: np.uint16, 5121: np.uint8}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        values = np.frombuffer(data, kind, accessor["count"] * width, start)
        return values.reshape(-1, width)

    for node in written["nodes"]:
        for primitive in written["meshes"][node["mesh"]]["primitives"]:
            corners = read(primitive["attributes"]["POSITION"])
            faces = read(primitive["indices"]).reshape(-1, 3)
            material = materials[written["materials"][primitive["material"]]["name"]]
            mesh = mi.Mesh("mesh", len(corners), len(faces), props=properties(material))
            parameters = mi.traverse(mesh)
            placed = corners[:, [0, 2, 1]] * [1, -1, 1] if is_z_up else corners
            parameters["vertex_positions"] = placed.astype(np.float32).ravel()
            parameters["faces"] = faces.astype(np.uint32).ravel()
            parameters.update()
            yield mesh


def properties(material):
    properties = mi.Properties()
    colour = [float(c) for c in np.broadcast_to(material.get("diffuse", 0.0), 3)]
    bsdf = mi.load_dict({"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": colour}}})
    properties["bsdf"] = bsdf
    if "luminance_cd_m2" in material:
        light = [float(c) for c in np.broadcast_to(material["luminance_cd_m2"], 3)]
        properties["emitter"] = mi.load_dict({"type": "area", "radiance": {"type": "rgb", "value": light}})
    return properties


def log_average(values):
    """The mean of logarithms over what is not black."""
    return float(np.exp(np.mean(np.log(values[values > 1e-3 * values.mean()]))))


def luminance(image):
    return image @ np.array([0.2126, 0.7152, 0.0722])


def developed(image):
    """sRGB codes from 0 to 1, with a shoulder for what is bright."""
    shown = image / (1.0 + np.maximum(luminance(image), 0.0)[..., None] / 1.5)
    shown = np.clip(shown, 0.0, 1.0)
    return np.where(shown <= 0.0031308, 12.92 * shown, 1.055 * shown ** (1 / 2.4) - 0.055)


def lab(picture):
    linear = np.where(picture <= 0.04045, picture / 12.92, ((picture + 0.055) / 1.055) ** 2.4)
    xyz = linear @ np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]).T
    ratio = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(ratio > 216 / 24389, np.cbrt(ratio), (24389 / 27 * ratio + 16) / 116)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def cie94(one, other):
    """CIE94 differences for graphic arts (CIE 116-1995)."""
    chroma = [np.hypot(lab[..., 1], lab[..., 2]) for lab in (one, other)]
    lightness, chromatic = one[..., 0] - other[..., 0], chroma[0] - chroma[1]
    hue2 = (one[..., 1] - other[..., 1]) ** 2 + (one[..., 2] - other[..., 2]) ** 2 - chromatic**2
    return np.sqrt(lightness**2 + (chromatic / (1 + 0.045 * chroma[0])) ** 2
                   + np.maximum(hue2, 0) / (1 + 0.015 * chroma[0]) ** 2)


def sheet(rows):
    width, height = SIZE
    image = Image.new("RGB", (3 * width, len(rows) * (height + MARGIN)), "white")
    draw = ImageDraw.Draw(image)
    for row, (name, pictures, off, figures) in enumerate(rows):
        top = row * (height + MARGIN)
        grey = np.repeat(np.clip(off / MOST_SHOWN, 0, 1)[..., None], 3, -1)
        for column, picture in enumerate([*pictures, grey]):
            shown = Image.fromarray((255 * picture + 0.5).astype(np.uint8))
            image.paste(shown, (column * width, top + MARGIN))
        titles = [f"{name}: isolux, solved in {figures['solve_s']} s, drawn in {figures['render_s']} s",
                  f"Mitsuba 3, {figures['mitsuba_s']} s",
                  f"CIE94 difference, white is {MOST_SHOWN:.0f}: mean {figures['cie94_mean']}, 99 % below {figures['cie94_99_percent']}"]
        for column, title in enumerate(titles):
            draw.text((column * width + 8, top + 8), title, fill="black")
    return image


if __name__ == "__main__":
    main()
