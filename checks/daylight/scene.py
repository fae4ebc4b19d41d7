"""A room as a Radiance scene: paints, panes, walls with openings, a sky, and the working plane to judge."""

import dataclasses

X, Y, Z = range(3)
SIDES = {"x_min": (X, 0), "x_max": (X, 1), "y_min": (Y, 0), "y_max": (Y, 1), "z_min": (Z, 0), "z_max": (Z, 1)}
# Both programs take the same two half spaces of `glow`, in the pattern that gensky and gendaylit write.
SKY = """
skyfunc glow sky_glow
0
0
4 1 1 1 0

sky_glow source sky
0
0
4 0 0 1 180

skyfunc glow ground_glow
0
0
4 1 1 1 0

ground_glow source ground
0
0
4 0 0 -1 180
"""


@dataclasses.dataclass
class Plane:
    """Points in the middles of square cells, which face up."""

    corner: tuple
    counts: tuple
    spacing: float

    def points(self):
        """Along x first, as `isolux grid` has them."""
        x, y, z = self.corner
        columns, rows = self.counts
        middle = lambda low, k: low + (k + 0.5) * self.spacing
        return [(middle(x, i), middle(y, j), z) for j in range(rows) for i in range(columns)]


class Room:
    def __init__(self, name, sky, plane, bounces=16):
        self.name, self.plane, self.bounces = name, plane, bounces
        self.materials, self.surfaces = {}, []
        self.sky = sky

    def paint(self, **reflectances):
        for name, share in reflectances.items():
            self.materials[name] = f"void plastic {name}\n0\n0\n5 {share} {share} {share} 0 0\n"

    def pane(self, name, transmissivity):
        numbers = 3 * f" {transmissivity}"
        self.materials[name] = f"void glass {name}\n0\n0\n3{numbers}\n"

    def clear_panes(self):
        """Panes that absorb nothing: a difference that is left is not one of absorption."""
        for name, text in list(self.materials.items()):
            if text.startswith("void glass"):
                self.pane(name, 1.0)

    def polygon(self, material, *corners):
        """Its front is where the corners run counter-clockwise."""
        numbers = " ".join(f"{x:.9g}" for corner in corners for x in corner)
        self.surfaces.append(f"{material} polygon part{len(self.surfaces)}\n0\n0\n{3 * len(corners)} {numbers}\n")

    def level(self, material, axis, at, low, high, front=1, openings=()):
        """A rectangle across an axis, without its openings; low and high are the corners of a box."""
        a, b = (axis + 1) % 3, (axis + 2) % 3
        cuts = []
        for k in (a, b):
            edges = {edge for opening in openings for edge in opening[k]}
            cuts.append(sorted({low[k], high[k]} | {e for e in edges if low[k] < e < high[k]}))
        is_open = lambda middle: any(
            all(opening[k][0] < m < opening[k][1] for k, m in zip((a, b), middle)) for opening in openings
        )
        for a0, a1 in zip(cuts[0], cuts[0][1:]):
            for b0, b1 in zip(cuts[1], cuts[1][1:]):
                if is_open((0.5 * (a0 + a1), 0.5 * (b0 + b1))):
                    continue
                corners = [(a0, b0), (a1, b0), (a1, b1), (a0, b1)][::front]
                self.polygon(material, *(placed(axis, at, corner) for corner in corners))

    def box(self, low, high, paints, openings=None, inward=True):
        """Six faces, or those that paints names by side; `walls` stands for the four upright ones."""
        for side, (axis, end) in SIDES.items():
            material = paints.get(side, paints.get("walls") if axis != Z else None)
            if material is None:
                continue
            front = (1 if end == 0 else -1) * (1 if inward else -1)
            holes = (openings or {}).get(side, ())
            self.level(material, axis, (low, high)[end][axis], low, high, front, holes)

    def sleeve(self, material, axis, start, end, opening):
        """The four reveals of an opening through something thick."""
        low, high = [0.0] * 3, [0.0] * 3
        for k, (k_low, k_high) in opening.items():
            low[k], high[k] = k_low, k_high
        low[axis], high[axis] = sorted((start, end))
        across = {side: material for side, (k, _) in SIDES.items() if k != axis}
        self.box(tuple(low), tuple(high), across)

    def glaze(self, material, axis, at, opening):
        low, high = [0.0] * 3, [0.0] * 3
        for k, (k_low, k_high) in opening.items():
            low[k], high[k] = k_low, k_high
        self.level(material, axis, at, tuple(low), tuple(high))

    def text(self, with_sky=True):
        sky = f"!{self.sky}\n{SKY}\n" if with_sky else ""
        return sky + "\n".join([*self.materials.values(), *self.surfaces])


def opening(**spans):
    """An opening by two of x, y and z."""
    return {"xyz".index(name): span for name, span in spans.items()}


def placed(axis, at, corner):
    place = [0.0] * 3
    place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = at, *corner
    return tuple(place)
