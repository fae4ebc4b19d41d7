"""What is run: for every scene and set of points, each renderer's efforts from the cheapest upwards.

The numbers of an effort are named in the renderer's script. Each ladder holds, of the settings tried, those
that nothing of the same renderer beats in both time and error; `quick` is how many of them end soon.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Ladder:
    """The efforts of one renderer at the points of one scene."""

    scene: str
    points: str
    renderer: str
    efforts: list
    quick: int

    def is_valued(self):
        """Whether values count and not time."""
        return self.scene.startswith(VALUED)


# Of these scenes the values themselves are compared with the exact ones, after one good effort of each renderer; no time is
# measured. They are cases of `isolux validate`, which tells what isolux finds.
VALUED = "cie171_"
CASES = [
    "cie171_5_2_isotropic",
    "cie171_5_2_web",
    "cie171_5_3",
    "cie171_5_4",
    "cie171_5_5",
    "cie171_5_6",
    "cie171_5_7",
    "cie171_5_8_sphere",
    "cie171_5_8_cube",
    "cie171_5_9_uniform",
    "cie171_5_9_overcast",
    "cie171_5_9_clear",
    "cie171_5_10_uniform",
    "cie171_5_10_overcast",
    "cie171_5_11_uniform",
    "cie171_5_11_overcast",
    "cie171_5_11_clear",
    "cie171_5_12_uniform",
    "cie171_5_13_uniform",
    "cie171_5_14_uniform",
]

# Renderers that are left out, and why: it is said in the results.
CANNOT = {
    ("sphere", "luxcore"): "its baker traces paths from the surface, and none finds a point lamp in a mirror",
    ("hall", "mitsuba"): "it has no luminaire with a measured distribution",
    ("hall", "luxcore"): "its baker takes rectangles, each a light map of its own, from this script",
    ("cie171_5_2_web", "mitsuba"): "it has no luminaire with a measured distribution",
    ("cie171_5_5", "mitsuba"): "its shadow rays do not pass glass, and no path meets a point lamp",
    **{(case, "luxcore"): "its baker takes diffuse rectangles; receivers here are black" for case in CASES},
}

LADDERS = [
    Ladder(
        "cube", "map", "isolux",
        ["0.2", "0.05", "0.02", "0.01", "0.006", "0.003", "0.002", "0.001"], 6,
    ),
    Ladder(
        "cube", "map", "radiance",
        ["0.5:64:0:4:4", "0.4:64:0:16:5", "0.3:128:32:32:5", "0.2:256:0:64:5", "0.15:512:0:32:5",
         "0.1:1024:0:64:6"], 4,
    ),
    Ladder("cube", "map", "mitsuba", ["0:64", "0:256", "0:1024", "0:4096", "0:16384", "0:65536"], 3),
    Ladder("cube", "map", "luxcore", ["32:16", "64:16", "64:64", "64:256"], 2),
    Ladder("cube", "paper", "isolux", ["0.2", "0.05", "0.01", "0.003"], 3),
    Ladder(
        "cube", "paper", "radiance",
        ["0.4:64:0:16:5", "0.3:128:32:32:5", "0.2:256:0:64:5", "0.2:1024:0:64:5", "0.1:1024:0:64:6"], 3,
    ),
    Ladder("cube", "paper", "mitsuba", ["0:1024", "0:16384", "0:65536", "0:262144", "0:1048576"], 4),
    Ladder("sphere", "map", "isolux", ["0.2", "0.05", "0.02", "0.01", "0.006", "0.003", "0.001"], 5),
    Ladder(
        "sphere", "map", "radiance",
        ["0.5:64:0:8:3", "0.5:256:0:8:6", "0.4:512:0:8:8", "0.2:256:0:8:12", "0.15:512:0:8:12",
         "0.1:1024:0:8:12"], 4,
    ),
    Ladder("sphere", "map", "mitsuba", ["1:16", "1:64", "1:256", "1:1024", "1:4096"], 3),
    Ladder("hall", "map", "isolux", ["0.2", "0.05", "0.02", "0.01"], 3),
    Ladder("hall", "map", "radiance", ["0.5:64:0:4:2", "0.4:64:0:8:4"], 1),
]


def _valued(case):
    """One effort of each renderer that can."""
    # Nothing is reflected; a sky or a patch is met at the first bounce; ground or wall is, and then the sky; everything.
    if case in ("cie171_5_2_isotropic", "cie171_5_2_web", "cie171_5_3", "cie171_5_5"):
        radiance = "0:1:0:0:0"
    elif case.startswith("cie171_5_8"):
        radiance = "0.2:1024:0:64:8"
    elif case in ("cie171_5_11_uniform", "cie171_5_12_uniform", "cie171_5_13_uniform", "cie171_5_14_uniform"):
        radiance = "0.1:16384:0:64:2"
    else:
        radiance = "0:524288:0:0:1"
    efforts = {"radiance": radiance, "mitsuba": "2:4194304"}
    return [
        Ladder(case, "map", renderer, [effort], 1)
        for renderer, effort in efforts.items() if (case, renderer) not in CANNOT
    ]


LADDERS += [ladder for case in CASES for ladder in _valued(case)]
