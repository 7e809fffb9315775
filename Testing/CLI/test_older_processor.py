# SPDX-License-Identifier: BSD-3-Clause
"""A processor without AVX and fused operations, emulated, makes the same bytes: of exact layers and of colours."""
import json
import os
import shutil
import subprocess

from harness import DGTK, SCENES, Case, main

os.environ["DGTK_CACHE"] = "0"  # both processors read the models
EMULATED = ("qemu-x86_64", "-cpu", "Nehalem")
WORK = {
    "demo.json": "color,depth,objects,triangles,normal,shadingnormal,position,uv,flow_forward,edges,alpha,ldi,boxes",
    "rolling_shutter.json": "color,depth,flow_forward,sceneflow,alpha",
    "fisheye_rig.json": "color,distance,position,flow_forward,coverage",
    "lights_many.json": "color,depth",
    "fig_4_5_bump_mapping.json": "color,shadingnormal",
}


class OlderProcessor(Case):
    def test_same_bytes(self):
        self.assertTrue(shutil.which(EMULATED[0]), "qemu-user is not installed (Utilities/Setup/packages.txt)")
        loader = subprocess.run([*EMULATED, "/lib64/ld-linux-x86-64.so.2", "--help"], capture_output=True, text=True, check=True)
        self.assertIn("x86-64-v2 (supported", loader.stdout)
        self.assertNotIn("x86-64-v3 (supported", loader.stdout)
        for scene, layers in WORK.items():
            with self.subTest(scene):
                options = ("--layers", layers, "--size", "64x48", "--frames", "0:1" if scene == "demo.json" else "0", "--samples",
                           "1" if scene == "demo.json" else "2", "--threads", "1", "--quiet", "--replace")
                run = ("render", os.path.join(SCENES, scene), *options)
                self.dgtk(*run, "-o", self.path("here"))
                done = subprocess.run([*EMULATED, DGTK, *run, "-o", self.path("there")], capture_output=True, text=True, timeout=300)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assert_same_files(self.path("here"), self.path("there"))

    def test_same_turns(self):
        """The C library chooses among its sines by the processor; some of a thousand differ in the last bit."""
        scene = {"version": 1, "objects": [{"name": "a", "model": os.path.join(os.path.dirname(SCENES), "Models", "torus.ac"),
                                            "orientation": {"keys": [[0, [1, 0, 0, 0]], [2999, [0.3, 0.5, -0.2, 0.79]]]}}],
                 "cameras": [{"name": "c", "eye": [0, 0, 6], "lookAt": [0, 0, 0], "fovY": 40}]}
        run = ("render", self.write("turns.json", json.dumps(scene)), "--layers", "depth", "--size", "4x3", "--frames", "0:2999", "--quiet")
        self.dgtk(*run, "-o", self.path("turns"))
        without = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable"}
        subprocess.run([DGTK, *run, "-o", self.path("plain")], env=without, check=True)
        self.assert_same_files(self.path("turns"), self.path("plain"))

    def same_samples(self, scene, samples):
        run = ("sample", scene, "--samples", samples, "--threads", "1", "--quiet")
        self.dgtk(*run, "-o", self.path("scenes"))
        done = subprocess.run([*EMULATED, DGTK, *run, "-o", self.path("emulated")], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_files(self.path("scenes"), self.path("emulated"))

    def test_same_samples(self):
        self.same_samples(os.path.join(os.path.dirname(os.path.abspath(__file__)), "sampled_scene.json"), "0:9")

    def test_same_falls(self):
        def model(name):
            return os.path.join(os.path.dirname(SCENES), "Models", name)

        place = {"on": "table", "drop": {"height": 0.02}, "region": [[-0.1, -0.1], [0.1, 0.1]], "otherwise": "refuse"}
        things = [{"name": name, "model": model(f"{name}.ac"), "count": count, "orientation": {"rotation": "any"}, "place": place}
                  for name, count in (("brick", 3), ("torus", 1))]
        scene = {"seed": 3, "objects": [{"name": "table", "model": model("table.ac")}, *things]}
        self.same_samples(self.write("falls.json", json.dumps(scene)), "0:1")


if __name__ == "__main__":
    main()
