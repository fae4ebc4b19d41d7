"""A scene as the exporter wrote it: what every renderer is given, and what it must find."""

import json
import math
from dataclasses import dataclass, field
from pathlib import Path


# The share of places that a result must tell of.
LEAST_KNOWN = 0.98


@dataclass(frozen=True)
class Shape:
    """Triangles of one material; `sphere` is what they stand for, if anything: (centre, radius_m)."""

    name: str
    positions: list
    triangles: list
    material: int
    sphere: tuple | None

    def outline(self):
        """The corners of a polygon that is written as a fan of triangles, else None."""
        last = len(self.positions)
        fan = [[0, k - 1, k] for k in range(2, last)]
        return list(range(last)) if self.triangles == fan else None

    def quads(self):
        """The triangles, those that are halves of a rectangle joined."""
        found, rest = [], [list(t) for t in self.triangles]
        while rest:
            a, b, c = rest.pop(0)
            joins = rest and rest[0][:2] == [a, c] and self.are_rectangle(a, b, c, rest[0][2])
            found.append([a, b, c, rest.pop(0)[2]] if joins else [a, b, c])
        return found

    def are_rectangle(self, *corners):
        a, b, c, d = (self.positions[k] for k in corners)
        return all(abs(a[k] + c[k] - b[k] - d[k]) < 1e-6 for k in range(3))

    def area_m2(self):
        return sum(_area(*(self.positions[v] for v in corners)) for corners in self.triangles)


@dataclass(frozen=True)
class Material:
    """A front that is diffuse or a mirror, reflectances of red, green and blue, and shines; or `pane`, thin glass:
    (refractive index, transmittance of its inside)."""

    name: str
    diffuse: tuple
    mirror: tuple
    pane: tuple | None
    luminance_cd_m2: tuple = (0.0, 0.0, 0.0)

    def shines(self):
        return max(self.luminance_cd_m2) > 0


@dataclass(frozen=True)
class Web:
    """Intensities, cd, by C plane and gamma, degrees; one plane stands for all."""

    planes_deg: list
    gammas_deg: list
    candela: list


@dataclass(frozen=True)
class PointLuminaire:
    """A point. `axes` are where x, y and z of its own frame point; nadir is -z and C0 along x."""

    name: str
    position: tuple
    axes: tuple
    colour: tuple
    intensity_cd: float | None
    """The same in every direction; None where `web` tells."""
    web: Web | None


@dataclass(frozen=True)
class Sun:
    """Parallel light: where it goes, and the illuminance of what faces it."""

    name: str
    direction: tuple
    illuminance_lx: float


@dataclass(frozen=True)
class PointSet:
    """Places, inward normals, exact illuminances, and how much each place counts."""

    name: str
    positions: list
    normals: list
    expected_lx: list
    weights: list
    own_error: float
    """Of the expected values themselves, in the same measure; its square is taken off."""
    has_caustics: bool
    """Whether expected values hold what glass and gloss throw on surfaces."""

    def error(self, values_lx):
        """Weighted root mean square of relative differences; None where a value is missing. (A map may not know some
        places between solids; those that it knows count then, if they are nearly all.)"""
        if len(values_lx) != len(self.expected_lx):
            raise SystemExit(f"{len(values_lx)} values for {len(self.expected_lx)} points")
        rows = list(zip(values_lx, self.expected_lx, self.weights))
        known = [row for row in rows if row[0] is not None and math.isfinite(row[0])]
        if len(known) < LEAST_KNOWN * len(rows):
            return None
        total = sum(weight * (value / expected - 1.0) ** 2 for value, expected, weight in known)
        squared = total / sum(weight for _, _, weight in known) - self.own_error**2
        return math.sqrt(max(squared, 0.0))


@dataclass(frozen=True)
class Scene:
    """Everything a renderer needs."""

    name: str
    shapes: list
    materials: list
    luminaires: list
    point_sets: list
    suns: list = field(default_factory=list)

    def points(self, name):
        for point_set in self.point_sets:
            if point_set.name == name:
                return point_set
        names = ", ".join(p.name for p in self.point_sets)
        raise SystemExit(f"{self.name} has no points `{name}`; choose one of {names}")

    def size_m(self):
        """The longest edge of its box."""
        low, high = self.box()
        return max(b - a for a, b in zip(low, high))

    def box(self):
        positions = [p for shape in self.shapes for p in shape.positions]
        return [[pick(p[k] for p in positions) for k in range(3)] for pick in (min, max)]

    def has_specular(self):
        return any(max(m.mirror) > 0 or m.pane for m in self.materials)

    def shines(self):
        return any(m.shines() for m in self.materials)

    def mean_luminance_cd_m2(self):
        """Of a closed scene without mirrors, by the balance of energy: what is absorbed is emitted."""
        areas = [(s.area_m2(), luminance(self.materials[s.material].diffuse)) for s in self.shapes]
        whole_m2 = sum(area for area, _ in areas)
        reflectance = sum(area * r for area, r in areas) / whole_m2
        if reflectance == 0:
            return 0.0
        flux_lm = sum(4.0 * math.pi * lamp.intensity_cd for lamp in self.luminaires)
        return reflectance * flux_lm / (whole_m2 * (1.0 - reflectance)) / math.pi

    def just_inside(self, point_set):
        """The points moved off their surface by a share of the scene, and off its edges by as much of the way to
        its middle, where a ray can start. (Nearer, the renderers' own tolerances show at edges.)"""
        share = 1e-5
        low, high = self.box()
        centre = [0.5 * (a + b) for a, b in zip(low, high)]
        lift_m = share * self.size_m()
        return [
            [x + share * (c - x) + lift_m * n for x, c, n in zip(position, centre, normal)]
            for position, normal in zip(point_set.positions, point_set.normals)
        ]


def read(path):
    """The scene of a file."""
    try:
        record = json.loads(Path(path).read_text())
    except OSError as e:
        raise SystemExit(f"{path}: cannot be read ({e.strerror}); check the path") from None
    except ValueError as e:
        raise SystemExit(f"{path}: is not JSON ({e}); write it with the example `peers`") from None
    try:
        return Scene(
            name=record["name"],
            shapes=[_shape(s) for s in record["shapes"]],
            materials=[_material(m) for m in record["materials"]],
            luminaires=_luminaires(record["luminaires"], record["distributions"]),
            point_sets=[PointSet(**p) for p in record["point_sets"]],
            suns=[Sun(s["name"], tuple(s["direction"]), s["illuminance_lx"]) for s in record.get("suns", [])],
        )
    except (KeyError, TypeError) as e:
        raise SystemExit(f"{path}: is no scene of ours ({e!r}); write it with the example `peers`") from None


def luminance(rgb):
    """Of linear Rec. 709."""
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]


def _shape(record):
    sphere = record["sphere"] and (tuple(record["sphere"]["centre"]), record["sphere"]["radius_m"])
    return Shape(record["name"], record["positions"], record["triangles"], record["material"], sphere)


def _material(record):
    if "dielectric" in record["body"]:
        glass = record["body"]["dielectric"]
        if not glass["thin"]:
            raise KeyError("thin")
        pane = (glass["ior"], luminance(glass["transmittance"]))
        return Material(record["name"], (0.0,) * 3, (0.0,) * 3, pane)
    front = record["body"]["opaque"]["front"]
    shone = tuple(front.get("luminance_cd_m2", (0.0,) * 3))
    return Material(record["name"], tuple(front["diffuse"]["colour"]), tuple(front["mirror"]), None, shone)


def _luminaires(records, distributions):
    webs = [_intensity(d) for d in distributions]
    return [
        PointLuminaire(
            r["name"], tuple(r["position"]), tuple(map(tuple, r["axes"])), tuple(r["colour"]),
            *webs[r["distribution"]],
        )
        for r in records
    ]


def _intensity(record):
    """Intensity and web, one of them None."""
    if "isotropic" in record:
        return record["isotropic"]["intensity_cd"], None
    web = record["web"]
    if web.get("system", "c") != "c":
        raise KeyError("system")
    return None, Web(web["planes_deg"], web["gammas_deg"], web["candela"])


def _area(a, b, c):
    u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
    cross = [u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3] for k in range(3)]
    return 0.5 * math.sqrt(sum(x * x for x in cross))
