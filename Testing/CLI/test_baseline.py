# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of datasets with their baselines finds what differs and leaves it to be looked at."""
import os
import shutil
import subprocess
import sys

from harness import SCENES, SOURCE, Case, main

SCRIPT = os.path.join(SOURCE, "Testing", "Datasets", "check_baseline.py")


class Baseline(Case):
    def check(self, status, *options):
        done = subprocess.run([sys.executable, "-B", SCRIPT, self.path("set"), self.path("baseline"), self.path("failures"), *options],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stderr

    def setUp(self):
        super().setUp()
        self.dgtk("render", os.path.join(SCENES, "dataset_stereo.json"), "-o", self.path("set"), "--quiet", "--size", "64x48",
                  "--layers", "color,depth", "--renderer", "vtk")
        self.check(0, "--update")
        self.check(0)
        self.assertFalse(os.path.exists(self.path("failures")))

    def test_other_bytes_of_an_exact_layer(self):
        listed = self.path("baseline", "exact.sha256")
        with open(listed, encoding="utf-8") as file:
            text = file.read()
        self.write(listed, ("0" if text[0] != "0" else "1") + text[1:])
        self.assertIn("left/depth/000000.npy: other bytes", self.check(1))
        self.assertEqual(os.listdir(self.path("failures")), ["result_left_depth_000000.npy"])

    def test_colour_by_rays_is_exact(self):
        self.dgtk("render", os.path.join(SCENES, "dataset_stereo.json"), "-o", self.path("set"), "--replace", "--quiet", "--size", "64x48",
                  "--layers", "color")
        self.check(0, "--update")
        with open(self.path("baseline", "exact.sha256"), encoding="utf-8") as file:
            self.assertIn("left/color/000000.png", file.read())

    def test_missing_and_additional_files(self):
        self.write(self.path("baseline", "exact.sha256"), "0" * 64 + "  left/depth/000009.npy\n")
        said = self.check(1)
        self.assertIn("left/depth/000009.npy: is missing", said)
        self.assertIn("right/depth/000000.npy: is not in the baseline", said)

    def test_another_picture(self):
        shutil.copyfile(self.path("baseline", "right_color_000000.png"), self.path("baseline", "left_color_000000.png"))
        self.assertIn("left/color/000000.png: mean difference", self.check(1))
        self.assertEqual(sorted(os.listdir(self.path("failures"))),
                         [f"{kind}_left_color_000000.png" for kind in ("baseline", "difference", "result")])


if __name__ == "__main__":
    main()
