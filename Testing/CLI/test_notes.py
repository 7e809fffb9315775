# SPDX-License-Identifier: BSD-3-Clause
"""What deserves a word: layers without files, textures that are missing, cameras that see nothing."""
import json
import os

from harness import SCENES, Case, load_json, main

QUAD = "vt 0 0\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1/1 2/1 3/1 4/1\n"


def camera(name="c", **changes):
    return {"name": name, "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 16, "height": 12, **changes}


class Notes(Case):
    def setUp(self):
        super().setUp()
        self.write("quad.obj", QUAD)

    def scene(self, **changes):
        scene = {"objects": [{"name": "quad", "model": "quad.obj"}], "cameras": [camera()], **changes}
        return self.write("s.json", json.dumps(scene))

    def render(self, layers, *more, out="out", **options):
        return self.dgtk("render", self.path("s.json"), "-o", self.path(out), "--layers", layers, *more, **options)

    def manifest(self, out="out"):
        return load_json(self.path(out, "manifest.json"))

    def empty(self, layers, says, *more):
        self.refused("render", self.path("s.json"), "-o", self.path("out"), "--layers", layers, "--quiet", *more,
                     status=2, says=says)
        self.assertFalse(os.path.exists(self.path("out")), "nothing may be left behind")

    def test_layers_that_would_be_empty_are_refused(self):
        self.scene()
        for layer in ("flow_forward", "flow_backward", "sceneflow"):
            self.empty("depth," + layer, [f"layer {layer} would have no file", "a frame of the scene"])
        self.empty("correspondence", ["layer correspondence would have no file", "another camera"])
        self.empty("disparity", ["layer disparity would have no file", "two cameras side by side"])
        self.empty("disparity_forward", ["layer disparity_forward would have no file", "two cameras side by side at both"])
        self.empty("color_sharp", ["layer color_sharp would have no file", "a shutter or a lens"])
        self.empty("matting", ["layer matting would have no file", "names of the objects"])

    def test_a_frame_or_a_camera_too_few(self):
        self.scene(keyFrames=[0, 3], cameras=[camera(), camera("d", eye=[1, 0, 5], lookAt=[1, 0, 0])])
        self.empty("flow_forward", "layer flow_forward", "--frames", "3")
        self.empty("flow_backward", "layer flow_backward", "--frames", "0")
        self.empty("correspondence", "layer correspondence", "--cameras", "c")
        self.render("flow_forward,correspondence,disparity", "--quiet", "--frames", "2")
        self.assertEqual(self.manifest()["empty"], [])

    def test_a_pair_outside_the_run_is_refused(self):
        self.scene(keyFrames=[0, 3], cameras=[camera(), camera("d", eye=[1, 0, 5], lookAt=[1, 0, 0])])
        self.empty("correspondence", ["'c:c+1'", "does not have"], "--pairs", "d:c,c:c+1", "--frames", "3")
        self.empty("correspondence", ["'d:c-4'", "does not have"], "--pairs", "d:c-4,c:d")
        self.render("correspondence", "--pairs", "c:c+1", "--quiet")

    def test_what_some_pictures_lack_is_said_in_a_line_and_in_the_manifest(self):
        self.scene(keyFrames=[0, 3])
        said = self.render("depth,flow_forward").stderr
        self.assertIn("layers without a file for some pictures: flow_forward (1 of 4)\n", said)
        self.assertEqual([(e["layer"], e["pictures"], e["of"]) for e in self.manifest()["empty"]], [("flow_forward", 1, 4)])
        self.assertIn("frame", self.manifest()["empty"][0]["needs"])
        self.assertEqual(self.render("depth", out="none").stderr.count("without a file"), 0)

    def test_all_takes_what_there_is(self):
        self.scene()
        said = self.render("all", "--frames", "0").stderr
        line = [line for line in said.splitlines() if "without a file" in line]
        self.assertEqual(len(line), 1, said)
        files = self.manifest()["files"]
        empty = {e["layer"] for e in self.manifest()["empty"]}
        self.assertEqual(empty, {"color_sharp", "correspondence", "disparity", "disparity_forward",
                                 "disparity_backward", "flow_forward", "flow_backward", "sceneflow",
                                 "matting"})
        for layer in empty:
            self.assertIn(layer, line[0])
            self.assertFalse([f for f in files if f.get("layer") == layer])

    def test_a_missing_texture_stands_in_the_manifest(self):
        os.mkdir(self.path("deep"))
        self.scene(objects=[{"model": "quad.obj", "materials": {"*": {"texture": "no.png"}}}])
        self.write("m.obj", "mtllib m.mtl\nusemtl m\n" + QUAD)
        self.write("m.mtl", "newmtl m\nmap_Kd gone.png\n")
        self.scene(objects=[{"model": "quad.obj", "materials": {"*": {"texture": "no.png"}}}, {"model": "m.obj"}])
        done = self.render("depth", "--quiet")
        self.assertEqual(done.stderr, "")
        warnings = self.manifest()["warnings"]
        self.assertEqual([w.split(":")[0] for w in warnings], ["m.obj", "s.json"])
        self.assertIn("gone.png", warnings[0])
        self.assertIn("'no.png': not found", warnings[1])
        # the same from wherever the scene is named
        import subprocess
        from harness import DGTK
        for cwd, scene, out in ((self.folder, "s.json", "o1"), (self.path("deep"), "../s.json", "../o2"),
                                (self.folder, "./s.json", "o3")):
            subprocess.run([DGTK, "render", scene, "-o", out, "--layers", "depth", "--quiet"], cwd=cwd, check=True)
        for out in ("o1", "o2", "o3"):
            self.assert_same_files(self.path("out"), self.path(out))

    def test_blind_cameras_and_empty_scenes_deserve_a_word(self):
        away = camera("away", eye=[0, 0, 5], lookAt=[0, 0, 9])
        near = camera("near", far=2)
        past = camera("past", near=6)
        beside = [camera(name, eye=[x, y, 5], lookAt=[x, y, 0]) for name, x, y in (("right", 9, 0), ("left", -9, 0), ("above", 0, 9), ("below", 0, -9))]
        plan = camera("plan", model="orthographic", eye=[5, 0, 5], lookAt=[5, 0, 0])
        late = camera("late", eye={"keys": [[0, [90, 0, 5]], [3, [0, 0, 5]]]}, lookAt=[0, 0, 0],
                      fovY={"keys": [[0, 1e-6], [3, 60]]})
        self.scene(cameras=[camera(), away, near, past, *beside, plan, late])
        said = self.render("objects", "--objects-format", "npy").stderr
        blind = ["away", "near", "past", "right", "left", "above", "below", "plan"]
        self.assertEqual(self.manifest()["warnings"],
                         [f"camera '{name}' sees no object at any frame of this run" for name in blind])
        for name in blind:
            self.assertIn(f"warning: camera '{name}' sees no object", said)
        import numpy

        for name in blind + ["c"]:
            seen = any(numpy.load(self.path("out", name, "objects", f"{f:06}.npy")).any() for f in range(4))
            self.assertEqual(seen, name == "c")
        self.scene(objects=[])
        self.render("depth", out="bare")
        self.assertEqual(self.manifest("bare")["warnings"], ["the scene has no object with a surface: its pictures are empty"])

    def test_coarse_shadows_deserve_a_word(self):
        lamps = [{"name": "sun", "kind": "directional", "position": [1, 2, 3], "target": [0, 0, 0], "shadows": True},
                 {"name": "lamp", "position": [0, 0, 4], "shadows": True, "shadowSize": 64},
                 {"name": "off", "position": [0, 0, 4], "shadows": True, "shadowSize": 16, "enabled": False},
                 {"name": "plain", "position": [0, 0, 4]}]
        close = camera("close", eye={"keys": [[0, [0, 0, 5]], [2, [0, 0, 0.2]]]}, width=200, height=150)
        self.scene(lights=lamps, cameras=[camera(), close])
        maps = ("--renderer", "vtk")
        said = self.render("color", "--frames", "0", *maps).stderr
        self.assertNotIn("shadow", said)
        self.assertEqual(self.manifest()["warnings"], [])
        said = self.render("color,objects", *maps, out="closer").stderr
        self.assertEqual(said.count("shadows are coarse"), 1)
        self.assertIn("warning: light 'lamp': its shadows are coarse", said)
        [line] = self.manifest("closer")["warnings"]
        self.assertRegex(line, r"shadowSize 64\) is up to \d+ pixels large \(camera 'close', frame 2\)")
        self.assertNotIn("shadow", self.render("color", out="rays").stderr)
        self.render("objects", "--quiet", *maps, out="none")
        self.assertEqual(self.manifest("none")["warnings"], [])

    def test_the_demo_has_nothing_to_say(self):
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("out"), "--layers", "depth", "--size", "16x12",
                  "--frames", "0", "--quiet")
        self.assertEqual((self.manifest()["warnings"], self.manifest()["empty"]), ([], []))


if __name__ == "__main__":
    main()
