# SPDX-License-Identifier: BSD-3-Clause
"""Names of files that are not UTF-8, and the words of failures that come from below."""
import json
import os
import subprocess

from harness import DGTK, Case, load_json, main

MESH = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n"
LATIN = b"caf\xe9"
CAMERA = {"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 16, "height": 12}


def name_of(text):
    """The bytes of a name in a document, as the page on datasets says."""
    return os.fsencode(text.translate({0xEF00 + b: 0xDC00 + b for b in range(128, 256)}))


class Names(Case):
    def setUp(self):
        super().setUp()
        self.home = os.path.join(os.fsencode(self.folder), LATIN)
        os.mkdir(self.home)

    def put(self, name, text):
        path = os.path.join(self.home, name)
        with open(path, "wb") as file:
            file.write(text.encode())
        return path

    def run_dgtk(self, *words, status=0):
        done = subprocess.run([DGTK, *words], capture_output=True)
        self.assertEqual(done.returncode, status, done.stderr)
        done.stderr.decode()  # UTF-8 at all times
        return done

    def test_a_model(self):
        model = self.put(b"mod\xe8le.obj", MESH)
        info = json.loads(self.run_dgtk("info", model, "--json").stdout)
        self.assertEqual(name_of(info["file"]), model)
        self.assertIn("caf\\xE9/mod\\xE8le.obj", self.run_dgtk("info", model).stdout.decode())
        told = self.run_dgtk("info", os.path.join(self.home, b"\xff\n.obj"), status=3).stderr.decode()
        self.assertIn("caf\\xE9/\\xFF\\x0A.obj: ", told)
        self.assertEqual(told.count("\n"), 1)

    def test_a_scene_and_its_dataset(self):
        self.put(b"mod\xe8le.obj", MESH)
        document = json.dumps({"objects": [{"model": "modle.obj", "class": "caf\uefe9"}],
                               "cameras": [{**CAMERA, "name": "c\uefe9"}]}).replace("modle", "mod\uefe8le")
        scene = self.put(b"sc\xe8ne.json", document)
        out = os.path.join(self.home, b"donn\xe9es")
        self.run_dgtk("render", scene, "-o", out, "--layers", "color,depth,objects,boxes", "--quiet")
        self.run_dgtk("verify", out)
        for words in (("verify", out), ("info", out), ("info", scene), ("compare", out, out)):
            json.loads(self.run_dgtk(*words, "--json").stdout)
        manifest = load_json(os.path.join(out, b"manifest.json"))
        self.assertEqual({name_of(entry["path"]) for entry in manifest["inputs"]}, {b"../sc\xe8ne.json", b"../mod\xe8le.obj"})
        self.assertEqual(name_of(load_json(os.path.join(out, b"objects.json"))["objects"][0]["model"]), b"../mod\xe8le.obj")
        again = os.path.join(self.home, b"again.json")
        self.run_dgtk("convert", scene, again)
        self.assertEqual(name_of(load_json(again)["objects"][0]["model"]), b"mod\xe8le.obj")
        os.remove(os.path.join(self.home, b"mod\xe8le.obj"))
        told = self.run_dgtk("render", scene, "-o", out, status=3).stderr
        self.assertIn(b"mod\\xE8le.obj: cannot be read", told)
        self.assertNotIn(b"\xe8", told)

    def test_mattes_of_names_like_numbers(self):
        """A folder is named by an id where the name cannot be one, and no name is as those are."""
        self.put(b"m.obj", MESH)
        names = ("#2", "a/b", "#c")
        scene = self.put(b"s.json", json.dumps({"objects": [{"name": name, "model": "m.obj"} for name in names], "cameras": [CAMERA]}))
        out = os.path.join(self.home, b"mattes")
        self.run_dgtk("render", scene, "-o", out, "--quiet", "--layers", "matting,objects", "--matte", ",".join(names))
        self.assertEqual(sorted(os.listdir(os.path.join(out, b"c"))), [b"matting_#1", b"matting_#2", b"matting_#3", b"objects"])
        self.run_dgtk("verify", out)

    def test_an_old_scene_file(self):
        self.put(b"mod\xe8le.ac", "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n"
                 "OBJECT poly\nnumvert 3\n-1 -1 0\n1 -1 0\n1 1 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n")
        scene = os.path.join(self.home, b"old.scene")
        with open(scene, "wb") as file:
            file.write(b"2\nglObject_AC: mod\xe8le.ac\nglObject_Camera: ( 60, 0.1, 100, 1.33 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n0\n")
        out = os.path.join(self.home, b"out")
        self.run_dgtk("render", scene, "-o", out, "--pack", "--layers", "depth,objects", "--size", "16x12", "--quiet")
        os.rename(scene, scene + b".gone")
        self.run_dgtk("verify", out)
        self.assertTrue(os.path.exists(os.path.join(out, b"inputs/scene/mod\xe8le.ac")))

    def test_no_words_of_libraries(self):
        scene = self.put(b"s.json", json.dumps({"objects": [], "cameras": [CAMERA]}))
        os.symlink(b"loop", os.path.join(self.home, b"loop"))
        loop, long = os.path.join(self.home, b"loop"), os.path.join(self.home, b"n" * 300)
        for words, status in ((("render", scene, "-o", long), 4), (("render", scene, "-o", loop), 4),
                              (("render", scene, "-o", os.path.join(loop, b"x")), 4), (("verify", loop), 3),
                              (("verify", long), 3), (("info", loop), 3), (("info", long), 3), (("compare", loop, loop), None),
                              (("info", os.path.join(loop, b"a.obj")), 3), (("info", os.path.join(long, b"s.json")), 3)):
            done = subprocess.run([DGTK, *words], capture_output=True)
            told = done.stderr.decode()
            self.assertIn(done.returncode, (2, 3, 4) if status is None else (status,), told)
            self.assertEqual(told.count("\n"), 1, told)
            for text in ("filesystem error", "std::", "exception", "basic_string"):
                self.assertNotIn(text, told)


if __name__ == "__main__":
    main()
