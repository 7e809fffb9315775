# SPDX-License-Identifier: BSD-3-Clause
"""Each recipe, by its one command, at a small size: sampled, rendered, verified, exported, read back, reported."""
import glob
import os
import subprocess

from harness import DGTK, Case, load_json, main

RECIPES = os.path.join(os.environ["DGTK_SOURCE"], "Data", "Recipes")
EXPORTS = {"bin_of_parts": ["bop"], "table_tops": ["coco", "coco-panoptic"], "street": ["kitti-object", "kitti-odometry", "kitti2015"],
           "flying_things": ["flyingthings"], "turntable": ["colmap", "nerf-synthetic", "transforms"],
           "fisheye_rig": ["imagefolder", "webdataset"]}
MORE = {"turntable": ["--frames", "0:35:9"]}  # of the whole turn


class Recipes(Case):
    def test_every_recipe(self):
        files = sorted(os.path.splitext(os.path.basename(path))[0] for path in glob.glob(os.path.join(RECIPES, "*.json")))
        self.assertEqual(files, sorted(EXPORTS))
        for name in files:
            with self.subTest(name):
                out = self.path(name)
                done = subprocess.run([os.path.join(RECIPES, "make"), name, "-o", out, "--samples", "0:1", "--size", "64x48", "--quiet", *MORE.get(name, [])],
                                      capture_output=True, text=True, timeout=550, env={**os.environ, "DGTK": DGTK})
                self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
                self.assertEqual(sorted(os.listdir(os.path.join(out, "export"))), EXPORTS[name])
                samples = load_json(os.path.join(out, "scenes", "samples.json"))["samples"]
                written = [one["file"] for one in samples if "file" in one]
                self.assertGreater(len(written), 0)
                datasets = load_json(os.path.join(out, "dataset", "manifest.json"))["datasets"]
                self.assertEqual([one["path"].split("/")[0] + ".json" for one in datasets], written)
                with open(os.path.join(out, "report.html"), encoding="utf-8") as page:
                    self.assertIn("<!doctype html>", page.read(100).lower())
                self.dgtk("verify", os.path.join(out, "scenes"))

    def test_usage(self):
        for words in ([], ["bin_of_parts"], ["nothing", "-o", self.path("out")]):
            done = subprocess.run([os.path.join(RECIPES, "make"), *words], capture_output=True, text=True, env={**os.environ, "DGTK": DGTK})
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)


if __name__ == "__main__":
    main()
