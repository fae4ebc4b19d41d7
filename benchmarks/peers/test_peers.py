"""What can be checked without any other renderer: python3 -m unittest."""

import dataclasses
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import curve
import ladders
import report
import scene as scenes
import run
import with_radiance
from arguments import effort

HERE = Path(__file__).parent
SCRIPTS = {
    "isolux": "accuracy",
    "radiance": "aa:ad:as:ar:ab",
    "mitsuba": "integrator:samples",
    "luxcore": "texels:samples",
}
RECORD = {
    "name": "wall",
    "shapes": [
        {"name": "wall", "positions": [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]],
         "triangles": [[0, 1, 2], [0, 2, 3]], "material": 0, "sphere": None}
    ],
    "materials": [
        {"name": "white",
         "body": {"opaque": {"front": {"diffuse": {"colour": [0.5] * 3}, "mirror": [0, 0, 0]}}}}
    ],
    "luminaires": [
        {"name": "lamp", "position": [0, 0, 1], "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
         "colour": [1, 1, 1], "distribution": 0}
    ],
    "distributions": [{"isotropic": {"intensity_cd": 100}}],
    "point_sets": [
        {"name": "map", "own_error": 0.0, "has_caustics": True, "positions": [[1, 0.5, 0], [2, 1, 0]], "normals": [[0, 0, 1]] * 2,
         "expected_lx": [100, 50], "weights": [1, 3]}
    ],
}


class Folder(unittest.TestCase):
    """With a scene in a folder of its own."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)
        self.scene = self.folder / "wall.json"
        self.scene.write_text(json.dumps(RECORD))


class Arguments(Folder):
    def refused(self, renderer, *arguments):
        """What a script says of arguments that it does not take."""
        command = [sys.executable, "-B", HERE / f"with_{renderer}.py", *arguments]
        command += ["--folder", self.folder, "--output", self.folder / "out.json"]
        environment = {**os.environ, "ISOLUX": "no-such-program", "DRJIT_LIBLLVM_PATH": "none"}
        ended = subprocess.run(command, capture_output=True, text=True, env=environment)
        self.assertNotEqual(ended.returncode, 0)
        self.assertNotIn("Traceback", ended.stderr)
        return ended.stderr

    def test_every_script_refuses_what_it_cannot_use(self):
        for renderer, form in SCRIPTS.items():
            good = ":".join("1" for _ in form.split(":"))
            for arguments, said in [
                ([], "scene"),
                (["none.json", "--effort", good], "none.json is no file"),
                ([self.scene], "--effort"),
                ([self.scene, "--effort", "much"], f"is not {form}"),
                ([self.scene, "--effort", good + ":1"], f"is not {form}"),
                ([self.scene, "--effort", good.replace("1", "nan")], f"is not {form}"),
                ([self.scene, "--effort", good, "--threads", "0"], "no whole number from 1 to 1024"),
                ([self.scene, "--effort", good, "--seed", "x"], "no whole number"),
            ]:
                with self.subTest(renderer=renderer, arguments=arguments):
                    self.assertIn(said, self.refused(renderer, *arguments))

    def test_scenes_of_others_are_refused(self):
        for text, said in [("", "is not JSON"), ("{}", "no scene of ours"), ("[1]", "no scene of ours")]:
            self.scene.write_text(text)
            with self.assertRaises(SystemExit) as refused:
                scenes.read(self.scene)
            self.assertIn(said, str(refused.exception))

    def test_a_program_that_is_not_there(self):
        self.assertIn("no program", self.refused("isolux", self.scene, "--effort", "0.1"))

    def test_ladders_fit_the_scripts(self):
        for ladder in ladders.LADDERS:
            self.assertLessEqual(ladder.quick, len(ladder.efforts))
            for text in ladder.efforts:
                effort(SCRIPTS[ladder.renderer])(text)


class Scene(Folder):
    def test_errors_are_relative_and_weighted(self):
        points = scenes.read(self.scene).points("map")
        self.assertAlmostEqual(points.error([100.0, 50.0]), 0.0)
        self.assertAlmostEqual(points.error([110.0, 50.0]), 0.1 * math.sqrt(0.25))
        self.assertIsNone(points.error([None, 50.0]))
        self.assertIsNone(points.error([math.nan, 50.0]))
        for refused in (lambda: points.error([1.0]), lambda: scenes.read(self.scene).points("desk")):
            self.assertRaises(SystemExit, refused)

    def test_what_the_expected_values_are_off_by_is_taken_off(self):
        points = dataclasses.replace(scenes.read(self.scene).points("map"), own_error=0.03)
        self.assertAlmostEqual(points.error([110.0, 50.0]), math.sqrt(0.1**2 * 0.25 - 0.03**2))
        self.assertEqual(points.error([100.0, 50.0]), 0.0)

    def test_measured_distributions(self):
        web = {"planes_deg": [0, 90, 180, 270], "gammas_deg": [0, 45, 90], "candela": [9, 5, 0] * 4}
        self.scene.write_text(json.dumps({**RECORD, "distributions": [{"web": web}]}))
        scene = scenes.read(self.scene)
        text = with_radiance.rad(scene, self.folder)
        self.assertIn("src_phi src_theta -rz 0.0", text)
        table = (self.folder / "web0.dat").read_text().splitlines()
        # The circle is closed, and nothing shines above the horizon.
        self.assertEqual(table[:3], ["2", "0 0 5 0 90 180 270 360.0", "0 0 5 0 45 90 90.001 180.0"])
        self.assertEqual(table[3:], ["9 5 0 0.0 0.0"] * 5)

    def test_surfaces_that_shine_and_parallel_light(self):
        def shining(name):
            front = {"diffuse": {"colour": [0] * 3}, "mirror": [0] * 3, "luminance_cd_m2": [7] * 3}
            return {"name": name, "body": {"opaque": {"front": front}}}

        sky = {**RECORD["shapes"][0], "name": "sky", "material": 1}
        panel = {**RECORD["shapes"][0], "name": "panel", "material": 2}
        sun = {"name": "sun", "direction": [0, 0, -1], "illuminance_lx": 100}
        self.scene.write_text(json.dumps({
            **RECORD, "luminaires": [], "suns": [sun], "shapes": [*RECORD["shapes"], sky, panel],
            "materials": [*RECORD["materials"], shining("of sky"), shining("of panel")],
        }))
        scene = scenes.read(self.scene)
        self.assertTrue(scene.shines())
        text = with_radiance.rad(scene, self.folder)
        self.assertIn("void glow of_sky\n0\n0\n4 7 7 7 0\n", text)
        self.assertIn("void light of_panel\n0\n0\n3 7 7 7\n", text)
        self.assertIn("sun source sun.disc\n0\n0\n4 0 0 1 0.02\n", text)
        # The disc of its luminance is the illuminance of what faces it.
        shone = float(text.split("void light sun\n0\n0\n3 ")[1].split()[0])
        self.assertAlmostEqual(shone * math.pi * math.radians(0.01) ** 2, 100.0, places=4)

    def test_nothing_black_is_bright_beyond_the_last_bounce(self):
        black = {"name": "black", "body": {"opaque": {"front": {"diffuse": {"colour": [0] * 3}, "mirror": [0] * 3}}}}
        self.scene.write_text(json.dumps({**RECORD, "materials": [black]}))
        self.assertEqual(scenes.read(self.scene).mean_luminance_cd_m2(), 0.0)

    def test_halves_of_rectangles_are_joined(self):
        positions = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [5, 5, 0]]
        shape = scenes.Shape("s", positions, [[0, 1, 2], [0, 2, 3], [0, 2, 4]], 0, None)
        self.assertEqual(shape.quads(), [[0, 1, 2, 3], [0, 2, 4]])

    def test_geometry(self):
        scene = scenes.read(self.scene)
        self.assertAlmostEqual(scene.shapes[0].area_m2(), 2.0)
        self.assertEqual(scene.shapes[0].outline(), [0, 1, 2, 3])
        middle, corner = scene.just_inside(scene.points("map"))
        self.assertTrue(middle[2] > 0 and corner[0] < 2 and corner[1] < 1)


class Curve(unittest.TestCase):
    RUNS = [(1.0, 0.02), (4.0, 0.01), (5.0, 0.03), (400.0, 0.001)]

    def test_runs_that_another_beats_are_left_out(self):
        self.assertEqual(curve.front(self.RUNS), [(1.0, 0.02), (4.0, 0.01), (400.0, 0.001)])

    def test_between_runs_time_is_on_a_line_of_logarithms(self):
        self.assertAlmostEqual(curve.reached(self.RUNS, math.sqrt(1e-5)).time_s, 40.0)
        self.assertEqual(curve.reached(self.RUNS, 0.01), curve.Reached(4.0, ""))

    def test_before_and_beyond(self):
        self.assertEqual(curve.reached(self.RUNS, 0.1), curve.Reached(1.0, "<"))
        self.assertIsNone(curve.reached(self.RUNS, 0.0004))
        self.assertIsNone(curve.reached([], 0.01))
        self.assertIsNone(curve.reached([(1.0, 0.02)], 0.019))
        steep = curve.reached([(1.0, 0.02), (1.1, 0.002)], 0.001)
        self.assertAlmostEqual(steep.time_s, 4.4)
        self.assertEqual(steep.mark, "~")

    def test_values_are_told_by_their_largest_difference(self):
        def one(renderer, values):
            return {"scene": "cie171_5_3", "renderer": renderer, "values_lx": values, "expected_lx": [100.0, 50.0]}

        found = [one("radiance", [101.0, 51.0]), one("mitsuba", [99.0, 50.0])]
        self.assertEqual(report.values(found).splitlines()[1].split(), ["cie171_5_3", "2", "2", "%", "1", "%"])
        self.assertEqual(run.worst([101.0, 51.0], [100.0, 50.0]), "2.000 % at worst")
        self.assertEqual(run.worst([None, 51.0], [100.0, 50.0]), "not all places are known")

    def test_every_valued_scene_has_one_effort_of_each_renderer_that_can(self):
        for case in ladders.CASES:
            ran = {ladder.renderer for ladder in ladders.LADDERS if ladder.scene == case}
            cannot = {renderer for scene, renderer in ladders.CANNOT if scene == case}
            self.assertEqual(ran | cannot, {"radiance", "mitsuba", "luxcore"})
            self.assertFalse(ran & cannot)

    def test_the_table_says_never_where_an_error_is_not_reached(self):
        def run(renderer, time_s, error):
            return {"scene": "cube", "points": "map", "renderer": renderer, "whole_s": [time_s], "map_s": [0.5 * time_s] if renderer == "isolux" else [], "errors": [error]}

        rows = report.levels({"runs": [run("isolux", 1.0, 0.002), run("mitsuba", 8.0, 0.009)]})
        self.assertEqual([row["best_peer_over_isolux"] for row in rows], [8.0, None, None])
        self.assertEqual([row["best_peer_over_map_alone"] for row in rows], [16.0, None, None])
        lines = report.table(rows).splitlines()
        self.assertIn("never", lines[2])
        self.assertIn("<1 s", lines[1])


if __name__ == "__main__":
    unittest.main()
