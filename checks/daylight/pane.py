"""The light of an even sky through one level pane, by Radiance, by isolux and by quadrature.

Run by hand:  python pane.py --isolux PATH

The answer is known: T(angle) of a pane by Fresnel's equations, with all inner reflections, over the half sphere. Absorption
goes by the way in the pane, which slanting light makes longer by 1 / cos (angle inside), or, where that is left out, not."""

import argparse
import pathlib
import tempfile

import numpy as np

import by_isolux
import radiance
from scene import Z, Room

# Half a sky, without the blend at the horizon that gensky's skies have.
EVEN = "void glow even\n0\n0\n4 10 10 10 0\n\neven source above\n0\n0\n4 0 0 1 180\n\n"
# Of Radiance's `glass`.
INDEX = 1.52
# So large that the rest of the sky is beside it without weight: a millionth.
HALF_SIDE_M, HEIGHT_M = 1000.0, 1.0


def transmitted(cos, share, is_lengthened):
    """Of unpolarized light by a pane that leaves this share in one crossing at right angles."""
    inside = np.sqrt(1.0 - (1.0 - cos**2) / INDEX**2)
    left = share ** (1.0 / inside) if is_lengthened else share
    perpendicular = ((cos - INDEX * inside) / (cos + INDEX * inside)) ** 2
    parallel = ((INDEX * cos - inside) / (INDEX * cos + inside)) ** 2
    of = lambda r: (1.0 - r) ** 2 * left / (1.0 - (r * left) ** 2)
    return 0.5 * (of(perpendicular) + of(parallel))


def of_even_sky(share, is_lengthened):
    nodes, weights = np.polynomial.legendre.leggauss(200)
    squares = 0.5 * (1.0 + nodes)
    return 0.5 * (weights * transmitted(np.sqrt(squares), share, is_lengthened)).sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--isolux", required=True)
    parser.add_argument("--transmissivity", type=float, nargs="+", default=[1.0, 0.9, 0.87, 0.65])
    flags = parser.parse_args()
    print("| transmissivity | quadrature | quadrature, way not lengthened | Radiance | isolux |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for share in flags.transmissivity:
            scene = pathlib.Path(scratch) / "pane.rad"
            room = Room("pane", None, None)
            room.pane("glazing", share)
            corner = (HALF_SIDE_M, HALF_SIDE_M, HEIGHT_M)
            room.level("glazing", Z, HEIGHT_M, (-corner[0], -corner[1], 0), corner)
            # A black floor, so that there is something to be lit.
            room.paint(black=0.0)
            room.level("black", Z, 0.0, (-corner[0], -corner[1], 0), corner)
            scene.write_text(EVEN + room.text(with_sky=False))
            places = [(0.3, 0.2, 0.01), (0.3, 0.2, HEIGHT_M + 1.0)]
            theirs, _ = radiance.by_rtrace(radiance.octree(scene), places, 1 << 17, 1, 4)
            ours, _, _ = by_isolux.by_paths(flags.isolux, scene, places, 1 << 16, scene.with_suffix(".pts"))
            through, above = theirs.mean(axis=0)
            print(f"| {share} | {of_even_sky(share, True):.4f} | {of_even_sky(share, False):.4f} | {through / above:.4f} | {ours[0] / ours[1]:.4f} |")


if __name__ == "__main__":
    main()
