"""Irradiance at points of a Mitsuba scene, by Mitsuba 3 and by isolux, side by side.

Run by hand:  python judge.py --isolux PATH SCENE.xml POINTS.pts [--samples N] [--efficacy 179] [--tolerance 0.01]

At every point (x y z nx ny nz) Mitsuba's emitters are sampled for direct light, and its path integrator looks
along cosine-distributed rays, without what emitters send along them, for the rest. isolux traces paths of its own at the same points
(`isolux probe SCENE`). The script fails where luminances differ by more than the tolerance and three standard errors."""

import argparse
import json
import os
import subprocess
import sys

WEIGHTS = (0.2126, 0.7152, 0.0722)
BATCHES = 16


def main():
    flags = arguments()
    points = [[float(x) for x in line.split()] for line in open(flags.points) if line.strip()]
    theirs, errors = by_mitsuba(flags.scene, points, flags.samples, flags.seed)
    theirs = [[flags.efficacy * c for c in rgb] for rgb in theirs]
    errors = [flags.efficacy * error for error in errors]
    ours = by_isolux(flags)
    outside = 0
    print("   isolux lx      +-   Mitsuba lx      +-    ratio   ratio of r, g, b")
    squares, weight = 0.0, 0.0
    for mine, rgb, error in zip(ours, theirs, errors):
        other = luminance(rgb)
        spread = 3.0 * (mine["standard_error_lx"] ** 2 + error**2) ** 0.5
        outside += abs(mine["illuminance_lx"] - other) > flags.tolerance * other + spread
        channels = " ".join(f"{a / b:.4f}" if b > 0 else "-" for a, b in zip(mine["rgb_lx"], rgb))
        print(f"{mine['illuminance_lx']:12.3f} {mine['standard_error_lx']:7.3f} {other:12.3f} {error:7.3f} "
              f"{mine['illuminance_lx'] / other:8.4f}   {channels}")
        squares += (mine["illuminance_lx"] - other) ** 2
        weight += other**2
    print(f"root mean square difference {100 * (squares / weight) ** 0.5:.3f} % over {len(points)} points")
    if outside:
        sys.exit(f"{outside} points differ by more than {100 * flags.tolerance} % and three standard errors")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("points")
    parser.add_argument("--isolux", required=True)
    parser.add_argument("--samples", type=int, default=1 << 18)
    parser.add_argument("--paths", type=int, default=1 << 16, help="of isolux, at every point")
    parser.add_argument("--efficacy", type=float, default=179.0, help="lm/W of the reading")
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


def luminance(rgb):
    return sum(weight * c for weight, c in zip(WEIGHTS, rgb))


def by_isolux(flags):
    command = [flags.isolux, "probe", flags.scene, "--points", flags.points, "--json", "--paths", str(flags.paths)]
    said = subprocess.run(command, capture_output=True, text=True)
    if said.returncode != 0:
        sys.exit(said.stderr)
    return json.loads(said.stdout)["points"]


def by_mitsuba(scene, points, samples, seed):
    """Irradiance of three channels at every point, and the standard error of its luminance."""
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "benchmarks", "peers"))
        import library
        os.environ["DRJIT_LIBLLVM_PATH"] = library.llvm()
    import drjit as dr
    import mitsuba as mi
    import numpy as np

    mi.set_variant("llvm_ad_rgb")
    world = mi.load_file(scene)
    path = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 8})
    count, each = len(points), max(1, samples // BATCHES)
    places = np.repeat(np.array(points, dtype=np.float32), each, axis=0).T
    normal = mi.Normal3f(places[3:])
    origin = mi.Point3f(places[:3]) + normal * 1e-4
    found = np.zeros((BATCHES, count, 3))
    for batch in range(BATCHES):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed * 1000 + batch, count * each)
        at = dr.zeros(mi.SurfaceInteraction3f, count * each)
        at.p, at.n, at.sh_frame = origin, normal, mi.Frame3f(normal)
        light, weight = world.sample_emitter_direction(at, sampler.next_2d(), True)
        direct = weight * dr.maximum(0.0, dr.dot(light.d, normal))
        local = mi.warp.square_to_cosine_hemisphere(sampler.next_2d())
        ray = mi.RayDifferential3f(mi.Ray3f(origin, mi.Frame3f(normal).to_world(local)))
        seen, _, _ = path.sample(world, sampler, ray)
        # What emitters send along these rays was sampled already; what they reflect was not.
        first = world.ray_intersect(ray)
        emitted = first.emitter(world).eval(first)
        total = direct + dr.pi * (seen - emitted)
        found[batch] = np.array([np.array(dr.block_sum(c, each)) for c in (total.x, total.y, total.z)]).T / each
    spread = np.std(found @ np.array(WEIGHTS), axis=0, ddof=1) / BATCHES**0.5
    return found.mean(axis=0).tolist(), spread.tolist()


if __name__ == "__main__":
    main()
