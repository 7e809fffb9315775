# SPDX-License-Identifier: BSD-3-Clause
"""A processor without AVX and fused operations, emulated, makes the same bytes: of exact layers and of colours."""
import json
import os
import shutil
import subprocess

from harness import DGTK, SCENES, Case, copy_scenes, load_json, main

os.environ["DGTK_CACHE"] = "0"  # both processors read the models
EMULATED = ("qemu-x86_64", "-cpu", "Nehalem")
PLAIN = ("env", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable")
# Scenes of a run, its layers, size and samples: to start is most of what the emulation does.
WORK = (
    ("demo.json lights_many.json fig_4_5_bump_mapping.json",
     "color,depth,objects,triangles,normal,shadingnormal,position,uv,flow_forward,edges,alpha,ldi,boxes", "40x30", 1),
    ("rolling_shutter.json fisheye_rig.json", "color,depth,distance,position,flow_forward,sceneflow,alpha,coverage", "20x15", 2),
)


class OlderProcessor(Case):
    def there_as_here(self, *run, there=EMULATED):
        """By the emulated processor, or where the C library takes this one for one."""
        run = [str(word) for word in run]
        self.dgtk(*run, "-o", self.path("here"))
        done = subprocess.run([*there, DGTK, *run, "-o", self.path("there")], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_files(self.path("here"), self.path("there"))
        for folder in ("here", "there"):
            shutil.rmtree(self.path(folder))

    def test_same_bytes(self):
        self.assertTrue(shutil.which(EMULATED[0]), "qemu-user is not installed (Utilities/Setup/packages.txt)")
        loader = subprocess.run([*EMULATED, "/lib64/ld-linux-x86-64.so.2", "--help"], capture_output=True, text=True, check=True)
        self.assertIn("x86-64-v2 (supported", loader.stdout)
        self.assertNotIn("x86-64-v3 (supported", loader.stdout)
        for number, (names, layers, size, samples) in enumerate(WORK):
            with self.subTest(names):
                folder = self.path(str(number))
                self.assertEqual(len(copy_scenes(folder, lambda scene: scene.setdefault("keyFrames", [0, 1]), names.split().__contains__)), len(names.split()))
                self.there_as_here("render", os.path.join(folder, "Scenes"), "--layers", layers, "--size", size, "--frames", "0", "--samples", samples,
                                   "--threads", "1", "--quiet")

    def test_same_turns(self):
        """The C library chooses among its sines by the processor; some of a thousand differ in the last bit."""
        torus = os.path.join(os.path.dirname(SCENES), "Models", "torus.ac")
        turns = ([0.3, 0.5, -0.2, 0.79], [0.1, -0.7, 0.4, 0.58], [-0.2, 0.3, 0.9, 0.24])
        scene = {"version": 1, "objects": [{"name": f"{i}", "model": torus, "position": [5.8 * (i - 1), 0, 0], "scale": [40, 40, 40],
                                            "orientation": {"keys": [[0, [1, 0, 0, 0]], [999, turn]]}} for i, turn in enumerate(turns)],
                 "cameras": [{"name": "c", "eye": [0, 0, 6], "lookAt": [0, 0, 0], "fovY": 40}]}
        run = ("render", self.write("turns.json", json.dumps(scene)), "--layers", "depth", "--size", "12x3", "--frames", "0:999", "--quiet")
        self.there_as_here(*run, there=PLAIN)

    def test_same_samples(self):
        """Of all kinds of random values, and of things that fall."""
        here = os.path.dirname(os.path.abspath(__file__))
        scene = load_json(os.path.join(here, "sampled_scene.json"))
        place = {"on": "table", "drop": {"height": 0.02}, "region": [[-0.1, -0.1], [0.1, 0.1]], "otherwise": "refuse"}
        scene["objects"] += [{"name": name, "model": f"../../Data/Models/{name}.ac", "count": count, "orientation": {"rotation": "any"}, "place": place}
                             for name, count in (("brick", 3), ("torus", 1))]
        run = ("sample", self.write("falls.json", json.dumps(scene).replace("../../Data", os.path.dirname(SCENES))), "--threads", "1", "--quiet")
        self.there_as_here(*run, "--samples", "0:0")
        self.there_as_here(*run, "--samples", "1:5", there=PLAIN)


if __name__ == "__main__":
    main()
