# SPDX-License-Identifier: BSD-3-Clause
"""Bad scenes and a machine that cannot: one line, the right status, and nothing harmed."""
import contextlib
import json
import os
import subprocess

from harness import DGTK, SCENES, Case, digests, load_json, main
from many_runs import ManyCase

QUAD = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"
CAMERA = {"name": "c", "fovY": 60, "near": 0.1, "far": 100, "eye": [0, 0, 5], "lookAt": [0, 0, 0], "up": [0, 1, 0]}


def scene(**changes):
    return {"objects": [{"name": "quad", "model": "quad.obj"}], "cameras": [CAMERA], **changes}


class BadScenes(ManyCase):
    def setUp(self):
        super().setUp()
        self.write("quad.obj", QUAD)

    def bad(self, text, says, name="bad.json"):
        path = self.write(name, text if isinstance(text, (str, bytes)) else json.dumps(text, indent=1))
        self.refused("render", path, "-o", self.path("out"), "--quiet", status=3, says=says)
        self.assertFalse(os.path.exists(self.path("out")), "nothing may be left behind")

    def test_unknown_key_has_line_and_path_and_suggestion(self):
        self.bad(scene(camera=[]), ["bad.json:", "camera", "cameras"])

    def test_missing_model(self):
        self.bad(scene(objects=[{"name": "o", "model": "no.obj"}]), ["bad.json", "no.obj"])

    def test_all_missing_models_in_one_line(self):
        objects = [{"name": n, "model": f"no/{n}.obj"} for n in "abc"] + [{"name": "quad", "model": "quad.obj"}]
        self.bad(scene(objects=objects), ["bad.json", "3 model files are missing", "no/a.obj", "no/b.obj", "no/c.obj"])

    def test_not_a_number(self):
        self.bad('{"objects":[],"cameras":[{"name":"c","fovY":NaN}]}', "bad.json:1")
        self.bad('{"objects":[],"cameras":[{"name":"c","fovY":1e999,"near":1,"far":2,"eye":[0,0,1],"lookAt":[0,0,0]}]}', "bad.json:1")

    def test_zero_quaternion(self):
        self.bad(scene(objects=[{"name": "o", "model": "quad.obj", "orientation": [0, 0, 0, 0]}]), "orientation")

    def test_recursive_parents(self):
        self.bad(scene(objects=[{"name": "a", "model": "quad.obj", "parent": "b"},
                                {"name": "b", "model": "quad.obj", "parent": "a"}]), "parent")

    def test_many_objects_claimed(self):
        self.bad("1000000000\nglObject_AC: a.ac\n", "bad.scene", name="bad.scene")

    def test_key_frames_out_of_order(self):
        text = "1\nglObject_Camera: ( 60, 0.1, 100, 1.33 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n2\n5\n< 0 0 5 > { 1, <0,0,0> }\n" \
               "< 0 0 0 > { 1, <0,0,0> }\n2\n< 0 0 5 > { 1, <0,0,0> }\n< 0 0 0 > { 1, <0,0,0> }\n"
        self.bad(text, "bad.scene:8", name="bad.scene")

    def test_rubbish(self):
        self.bad(b"\x00\xff\x80" * 99, "bad.json", name="bad.json")
        self.bad("", "bad.json")
        self.bad("[" * 100000, "bad.json")

    def test_a_directory(self):
        os.mkdir(self.path("folder.json"))
        self.refused("render", self.path("folder.json"), "-o", self.path("out"), status=3, says="a directory")
        self.refused("info", self.path("nothing.json"), status=3, says="nothing.json")

    def test_scene_without_cameras(self):
        self.bad(scene(cameras=[]), "no camera")


class Machine(Case):
    def test_output_that_cannot_be_made(self):
        blocked = self.write("file", "kept")
        self.refused("render", os.path.join(SCENES, "demo.json"), "-o", os.path.join(blocked, "x"), "--quiet", status=4, says="file")
        with open(blocked, encoding="utf-8") as file:
            self.assertEqual(file.read(), "kept")

    @contextlib.contextmanager
    def small_disk(self, size):
        os.mkdir(self.path("small"))
        if os.geteuid() != 0 or subprocess.run(
                ["mount", "-t", "tmpfs", "-o", f"size={size}", "none", self.path("small")], capture_output=True).returncode:
            self.skipTest("only root may mount a small disk")
        try:
            yield
        finally:
            subprocess.run(["umount", self.path("small")], check=True)

    def test_full_disk(self):
        with self.small_disk("256k"):
            words = ("render", os.path.join(SCENES, "demo.json"), "-o", self.path("small", "out"), "--quiet", "--frames", "0", "--size", "640x480")
            self.refused(*words, "--layers", "depth", status=4, says=("needs at least 4.92 MB", "there are 262 KB"))
            self.assertFalse(os.path.exists(self.path("small", "out")))
            line = self.refused(*words, "--layers", "normal", "--normal-format", "exr", status=4, says="No space left")
            self.assertIn(".exr", line)
            left = [n for n in digests(self.path("small")) if n.endswith((".exr", "manifest.json"))]
            self.assertEqual(left, [], "half-written files")

    def test_a_disk_that_may_be_too_small_is_not_in_the_manifest(self):
        """It is the same on every disk."""
        self.write("quad.obj", QUAD)
        words = ("render", self.write("scene.json", json.dumps(scene())), "--layers", "color", "--size", "640x480", "--frames", "0")
        with self.small_disk("128k"):
            self.assertIn("warning: " + self.path("small", "out") + ": the dataset needs some", self.dgtk(*words, "-o", self.path("small", "out")).stderr)
            self.assertEqual(load_json(self.path("small", "out", "manifest.json"))["warnings"], [])

    def limited(self, limit, *words, status):
        """dgtk with less of something than usual; what it says."""
        done = subprocess.run(["bash", "-c", f'ulimit {limit} && exec "$@"', "bash", DGTK, *map(str, words)], capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertLessEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def test_limited_file_size(self):
        """Files larger than 64 KiB fail, and leave nothing half-written."""
        words = ("--quiet", "--layers", "depth", "--frames", "0", "--size", "640x480")
        self.assertIn("ulimit -f", self.limited("-f 64", "render", os.path.join(SCENES, "demo.json"), "-o", self.path("out"), *words, status=4))
        self.assertEqual([n for n in digests(self.path("out")) if n != ".dgtk-journal"], [])

    def many_cameras(self, count):
        self.write("a.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n")
        return self.write("many.json", json.dumps({
            "objects": [{"name": "a", "model": "a.obj"}],
            "cameras": [{"name": f"c{i}", "eye": [0.001 * i, 0, 5], "lookAt": [0, 0, 0], "width": 8, "height": 8} for i in range(count)]}))

    def test_more_files_together_than_may_be_open(self):
        """All pairs of a camera are written together: more of them than descriptors."""
        words = ("--quiet", "--layers", "correspondence", "--visibility", "ray")
        pairs = ",".join(f"c0:c{i}" for i in range(1, 130))
        scene = self.many_cameras(130)
        self.dgtk("render", scene, "-o", self.path("free"), *words, "--pairs", pairs)
        self.assertGreater(sum("/correspondence" in name for name in digests(self.path("free"))), 256)
        self.limited("-n 256", "render", scene, "-o", self.path("some"), *words, "--pairs", pairs, status=0)
        self.limited("-n 64", "render", scene, "-o", self.path("few"), *words, "--pairs", pairs, status=0)
        self.assert_same_files(self.path("free"), self.path("some"))
        self.assert_same_files(self.path("free"), self.path("few"))

    def test_a_machine_without_dev_null(self):
        """Its programs are there: they are not to blame."""
        inside = ["unshare", "--map-root-user", "--mount", "sh", "-c", 'mount -t tmpfs none /dev && exec "$@"', "sh"]
        if subprocess.run([*inside, "true"], capture_output=True).returncode != 0:
            self.skipTest("no folder of devices of its own")
        model = os.path.join(os.path.dirname(SCENES), "Models", "windmill.gltf")
        done = subprocess.run([*inside, DGTK, "info", model], capture_output=True, text=True, env={**os.environ, "DGTK_CACHE": "0"})
        self.assertEqual((done.returncode, done.stderr), (4, "dgtk: /dev/null: cannot be opened: No such file or directory\n"))

    def test_no_opengl(self):
        broken = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent", "LIBGL_DRIVERS_PATH": "/nonexistent", "DISPLAY": ""}
        done = self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("x"), "--quiet", "--gl", "egl",
                         "--renderer", "vtk", status=4, environment=broken)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        fallback = self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("y"), "--frames", "0", "--size", "64x48",
                             "--layers", "color", "--renderer", "vtk", environment={**broken, "LIBGL_DRIVERS_PATH": ""})
        self.assertIn("OSMesa", fallback.stderr)
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("z"), "--frames", "0", "--size", "64x48", "--quiet", environment=broken)

    def test_no_opengl_is_needed_without_colour(self):
        broken = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent", "LIBGL_DRIVERS_PATH": "/nonexistent", "DISPLAY": ""}
        self.dgtk("render", os.path.join(SCENES, "demo.json"), "-o", self.path("x"), "--quiet", "--layers", "depth,objects",
                  "--size", "64x48", environment=broken)


if __name__ == "__main__":
    main()
