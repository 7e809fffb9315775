#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The two engines of the ids: rays decide, whatever else is asked for, and the raster engine says the same."""
import json
import os
import re
import shutil
import subprocess

from harness import DGTK, SCENES, SOURCE, Case, copy_scenes, digests, load_json, main
from many_runs import ManyCase
from pictures import read_png


class Engines(ManyCase):
    def render(self, name, scene, *options, layers="depth,objects,triangles"):
        self.dgtk("render", os.path.join(SCENES, scene), "-o", self.path(name), "--quiet", "--layers", layers, *options)
        return self.path(name)

    def verified(self, folder):
        table = self.dgtk("verify", folder).stdout
        self.assertNotIn("BREACH", table)
        return table

    def test_fresh_datasets_with_colour_pass(self):
        for scene, *options in (("demo.json", "--size", "100x75", "--frames", "0:1"),
                                ("fig_b1_half_circle.scene", "--size", "167x109", "--frames", "0", "--cameras",
                                 "Camera1,Camera12,Camera37")):
            for engine in ("auto", "raster"):
                with self.subTest(scene=scene, engine=engine):
                    table = self.verified(self.render("d", scene, *options, "--visibility", engine, layers="color,depth"))
                    depth = next(line.split() for line in table.splitlines() if line.startswith("depth"))
                    self.assertEqual(depth[3], "0", table)  # nothing is left open
                    shutil.rmtree(self.path("d"))

    def test_exact_layers_do_not_depend_on_what_else_is_asked_for(self):
        size = ("--cameras", "left", "--frames", "1", "--size", "160x120")
        for engine in ("auto", "raster"):
            with self.subTest(engine=engine):
                alone = digests(self.render(f"{engine}1", "demo.json", *size, "--visibility", engine))
                beside = self.render(f"{engine}2", "demo.json", *size, "--visibility", engine,
                                     layers="color,depth,objects,triangles,ldi")
                files = [name for name in alone if name.startswith("left")]
                self.assertEqual(len(files), 3)
                self.assertEqual([name for name in files if digests(beside)[name] != alone[name]], [])
                self.assertEqual(load_json(os.path.join(beside, "manifest.json"))["request"]["visibility"],
                                 "ray" if engine == "auto" else "raster")

    def test_pictures_of_the_raster_engine_pass_for_all_scenes(self):
        def straight(scene):
            scene["cameras"] = [camera for camera in scene["cameras"] if camera.get("model", "pinhole") in ("pinhole", "orthographic")
                                and not any(camera.get("distortion", [])) and "rollingShutter" not in camera]
            self.assertTrue(scene["cameras"])

        scenes = copy_scenes(self.folder, straight)
        self.assertGreater(len(scenes), 20)
        self.render("d", self.path("Scenes"), "--frames", "0", "--size", "64x48", "--visibility", "raster")
        self.assertIn(f": {len(scenes)} datasets, 0 with a breach", self.verified(self.path("d")))

    def test_shadows_are_the_same_however_opengl_counts_depths(self):
        """From 0 to 1, or from -1 to 1 where it has no GL_ARB_clip_control."""
        models = os.path.join(SOURCE, "Data", "Models")
        scene = {"objects": [{"name": name, "model": os.path.join(models, f"{name}.ac")} for name in ("ground", "crate")],
                 "lights": [{"name": "sun", "kind": "directional", "position": [-6, 5, 2], "shadows": True}],
                 "cameras": [{"name": "c", "eye": [3, 3, 4], "lookAt": [0.5, 0, 0], "near": 0.1, "far": 50}]}
        command = ["render", self.write("s.json", json.dumps(scene)), "--quiet", "--layers", "color", "--size", "160x120",
                   "--renderer", "vtk"]
        pictures = {}
        for name, without in (("one", ""), ("both", "-GL_ARB_clip_control")):
            self.dgtk(*command, "-o", self.path(name), environment={"MESA_EXTENSION_OVERRIDE": without})
            pictures[name] = read_png(self.path(name, "c", "color", "000000.png")).astype(int)
        self.assertGreater((pictures["one"].max(axis=2) < 5).sum(), 200)
        self.assertGreater((pictures["one"].max(axis=2) > 50).sum(), 5000)
        self.assertLess((abs(pictures["one"] - pictures["both"]) > 4).any(axis=2).sum(), 20)


class Glx(Case):
    @staticmethod
    def software(text):
        return re.search("llvmpipe", text) is not None

    def test_the_first_picture_of_a_process_is_as_the_others(self):
        """Under GLX, whose state begins otherwise; also after --resume, where another picture is the first."""
        command = ["render", os.path.join(SCENES, "demo.json"), "--layers", "color", "--size", "96x72", "--frames", "0:1",
                   "--renderer", "vtk"]

        def glx(name, *options):
            done = subprocess.run(["xvfb-run", "-a", "-n", "470", DGTK, *command, "-o", self.path(name), "--gl", "glx", *options],
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout + done.stderr

        said = glx("glx")
        alone = glx("alone", "--cameras", "right")  # another picture is the first
        pictures = {name: value for name, value in digests(self.path("glx")).items() if name.startswith("right")}
        self.assertEqual(len(pictures), 2)
        for name, value in pictures.items():
            self.assertEqual(digests(self.path("alone"))[name], value, name)
        done = self.dgtk(*command, "-o", self.path("egl"), "--gl", "egl")
        if self.software(said + alone) and self.software(done.stdout + done.stderr):
            self.assert_same_files(self.path("glx"), self.path("egl"))


if __name__ == "__main__":
    main()
