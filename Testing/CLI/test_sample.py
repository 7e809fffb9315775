# SPDX-License-Identifier: BSD-3-Clause
"""`dgtk sample`: a sample depends on its number alone, folders of others are left alone, scenes can be rendered."""
import fcntl
import json
import os
import subprocess

from harness import Case, digests, load_json, main

SOURCE = os.environ["DGTK_SOURCE"]
SCENE = {
    "seed": 7,
    "parameters": {"n": {"integer": [2, 5]}},
    "objects": [
        {"name": "wall", "model": "models/quad.obj", "scale": 4, "position": [0, 0, -2]},
        {"name": "tile", "count": "$n", "model": {"choice": {"files": "models/*.obj"}}, "orientation": {"rotation": "any"},
         "position": {"inBox": [[-1, -1, 0], [1, 1, 1]]}, "scale": {"uniform": [0.2, 0.4]}}],
    "lights": [{"name": "sun", "position": {"shell": {"center": "wall", "radius": 9}}, "intensity": {"uniform": [0.5, 1]}}],
    "cameras": [
        {"name": "seen", "eye": {"inBox": [[-4, -4, 3], [4, 4, 8]]}, "lookAt": "tile",
         "require": {"visible": {"tile*": 0.6}, "clearance": 0.5, "otherwise": "omit"}},
        {"name": "walk", "path": {"walk": {"box": [[-3, -1, -4], [3, 1, 4]], "speed": 0.2, "clearance": 0.3, "frames": [0, 9]}}},
        {"name": "orbit", "path": {"orbit": {"center": "wall", "radius": 9, "azimuth": [-40, 40], "frames": [0, 4]}}}]}


class Sample(Case):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("models"))
        for name in ("quad", "two"):
            self.write(f"models/{name}.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")

    def scene(self, **changes):
        return self.write("scene.json", json.dumps({**SCENE, **changes}, indent=1))

    def test_a_sample_is_the_same_alone_and_on_any_threads(self):
        scene = self.scene()
        self.dgtk("sample", scene, "-o", self.path("many"), "--samples", "690:709", "--threads", "0", "--quiet")
        self.dgtk("sample", scene, "-o", self.path("one"), "--samples", "690:709", "--threads", "1", "--quiet")
        self.dgtk("sample", scene, "-o", self.path("alone"), "--samples", "700", "--quiet")
        self.assertEqual(digests(self.path("many")), digests(self.path("one")))
        with open(self.path("many/000700.json"), "rb") as a, open(self.path("alone/000700.json"), "rb") as b:
            self.assertEqual(a.read(), b.read())
        with open(self.path("many/samples.json")) as file:
            record = json.load(file)
        self.assertTrue(record["complete"])
        self.assertEqual([s["sample"] for s in record["samples"]], list(range(690, 710)))
        self.assertEqual(record["inputs"][0]["count"], 2)
        self.dgtk("sample", scene, "-o", self.path("other"), "--samples", "700", "--seed", "8", "--quiet")
        self.assertNotEqual(digests(self.path("other")), digests(self.path("alone")))

    def test_a_run_that_was_killed_at_its_beginning(self):
        """There is a part of its record alone."""
        os.mkdir(self.path("out"))
        self.write("out/samples.json.partial", "{")
        self.dgtk("sample", self.scene(), "-o", self.path("out"), "--samples", "0", "--quiet")
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["000000.json", "samples.json"])

    def test_what_is_required_is_what_the_layers_say(self):
        self.dgtk("sample", self.scene(), "-o", self.path("out"), "--samples", "0:4", "--quiet")
        with open(self.path("out/samples.json")) as file:
            record = json.load(file)
        for sample in record["samples"]:
            notes = {note["path"]: note for note in sample["notes"]}
            note = notes["cameras/seen/require"]
            self.assertTrue(note["kept"])
            self.assertGreaterEqual(note["measured"]["clearance"], 0.5)
            folder = self.path(f"rendered{sample['sample']}")
            self.dgtk("render", self.path("out", sample["file"]), "-o", folder, "--layers", "boxes", "--cameras", "seen,walk",
                      "--size", "160x120", "--quiet")
            fractions = []
            for frame in range(10):
                with open(os.path.join(folder, "seen", "boxes", f"{frame:06d}.json")) as file:
                    boxes = json.load(file)
                fractions += [o["visible_fraction"] for o in boxes["objects"] if o["name"].startswith("tile")]
            self.assertAlmostEqual(min(fractions), note["measured"]["visible tile*"], places=12)
            self.assertGreaterEqual(min(fractions), 0.6)

    def test_a_walk_keeps_its_distance(self):
        self.dgtk("sample", self.scene(), "-o", self.path("out"), "--samples", "0:9", "--quiet")
        for number in range(10):
            with open(self.path(f"out/{number:06d}.json")) as file:
                plain = json.load(file)
            eyes = [key[1] for key in next(c for c in plain["cameras"] if c["name"] == "walk")["eye"]["keys"]]
            self.assertEqual(len(eyes), 10)
            for x, y, z in eyes:  # of the wall, whose plane is z = -2 over -4..4
                self.assertGreaterEqual(abs(z + 2), 0.3)
                self.assertTrue(-3 <= x <= 3 and -1 <= y <= 1 and -4 <= z <= 4)

    def test_what_cannot_be_kept_is_omitted_or_refuses_the_sample(self):
        camera = {"name": "c", "eye": [0, 0, 9], "lookAt": [0, 0, 20],
                  "require": {"visible": {"wall": 0.5}, "attempts": 3, "otherwise": "omit"}}
        self.dgtk("sample", self.scene(cameras=[camera]), "-o", self.path("omit"), "--samples", "0", "--quiet")
        with open(self.path("omit/samples.json")) as file:
            note = json.load(file)["samples"][0]["notes"][0]
        self.assertEqual((note["kept"], note["attempts"]), (False, 3))
        with open(self.path("omit/000000.json")) as file:
            self.assertNotIn("cameras", json.load(file))
        camera["require"]["otherwise"] = "refuse"
        self.dgtk("sample", self.scene(cameras=[camera]), "-o", self.path("refuse"), "--samples", "0", "--quiet")
        with open(self.path("refuse/samples.json")) as file:
            refused = json.load(file)["samples"][0]["refused"]
        self.assertEqual((refused["path"], refused["attempts"]), ("cameras/c/require", 3))
        self.assertEqual(os.listdir(self.path("refuse")), ["samples.json"])

    def test_a_proxy_that_is_none_is_refused(self):
        for proxy, says in (("models/none.obj", "cannot be read"), ("models/far.obj", "is not where the object's is")):
            self.write("models/far.obj", "v 5 5 0\nv 6 5 0\nv 6 6 0\nf 1 2 3\n")
            thing = {"name": "thing", "model": "models/two.obj", "place": {"on": "wall", "drop": {}, "proxy": proxy}}
            scene = self.scene(objects=[SCENE["objects"][0], thing], cameras=[])
            self.refused("sample", scene, "-o", self.path(os.path.basename(proxy) + ".out"), "--samples", "0", status=3,
                         says=["scene.json:", "proxy", says])

    def test_folders_of_others_are_left_alone(self):
        scene = self.scene()
        os.mkdir(self.path("foreign"))
        os.mkdir(self.path("numbers"))
        self.write("foreign/a.txt", "mine")
        self.refused("sample", scene, "-o", self.path("foreign"), "--samples", "0:1", "--replace", status=2, says="a.txt")
        self.write("numbers/000000.json", "{}")
        self.refused("sample", scene, "-o", self.path("numbers"), "--samples", "0:1", "--replace", status=2, says="000000.json")
        self.dgtk("sample", scene, "-o", self.path("own"), "--samples", "0:3", "--quiet")
        self.refused("sample", scene, "-o", self.path("own"), "--samples", "0:1", status=2, says="--replace")
        self.dgtk("sample", scene, "-o", self.path("own"), "--samples", "0:1", "--replace", "--quiet")
        self.assertEqual(sorted(os.listdir(self.path("own"))), ["000000.json", "000001.json", "samples.json"])

    def test_one_run_at_a_time_writes_into_a_folder(self):
        command = ("sample", self.scene(), "-o", self.path("own"), "--samples", "0", "--quiet")
        self.dgtk(*command)
        folder = os.open(self.path("own"), os.O_RDONLY)
        fcntl.flock(folder, fcntl.LOCK_EX)
        before = os.stat(self.path("own/samples.json")).st_mtime_ns
        for more in ((), ("--replace",)):
            self.refused(*command, *more, status=75, says="own: another process is writing it")
        self.assertEqual(os.stat(self.path("own/samples.json")).st_mtime_ns, before)
        os.close(folder)
        self.dgtk(*command, "--replace")

    def test_an_interrupted_run_is_begun_anew(self):
        command = ("sample", self.scene(), "-o", self.path("own"), "--quiet", "--samples")
        self.dgtk(*command, "0:3")
        whole = digests(self.path("own"))
        record = load_json(self.path("own/samples.json"))
        self.write("own/samples.json", json.dumps({**record, "complete": False, "inputs": [], "samples": []}))
        os.remove(self.path("own/000002.json"))
        self.write("own/000001.json", "{")
        self.assertIn("unfinished run", self.refused("verify", self.path("own"), status=3))
        self.refused(*command, "0:4", status=2, says="holds samples already (--replace removes them)")
        self.dgtk(*command, "0:3")
        self.assertEqual(digests(self.path("own")), whole)

    def test_a_value_that_cannot_be_used_ends_the_run_and_says_where(self):
        objects = [{"name": "a", "model": "models/quad.obj", "materials": {"*": {"shininess": {"uniform": [100, 132]}}}}]
        scene = self.scene(objects=objects, lights=[], cameras=[])
        command = ("sample", scene, "-o", self.path("own"), "--quiet", "--threads", "1", "--samples")
        said = self.refused(*command, "0:99", status=3)
        failed = int(said.rsplit(", in sample ", 1)[1])
        self.assertIn("scene.json:", said)
        record = load_json(self.path("own/samples.json"))
        self.assertFalse(record["complete"])
        self.assertEqual([s["sample"] for s in record["samples"]], list(range(failed)))
        self.assertEqual(self.refused(*command, "0:99", status=3), said)
        # a folder without a sample is in nobody's way
        command = ("sample", scene, "-o", self.path("none"), "--quiet", "--samples")
        self.refused(*command, str(failed), status=3)
        self.assertEqual(os.listdir(self.path("none")), ["samples.json"])
        objects[0]["materials"]["*"]["shininess"] = 100
        self.scene(objects=objects, lights=[], cameras=[])
        self.dgtk(*command, "0:1")

    def test_the_guide_s_example_is_sampled_and_rendered(self):
        with open(os.path.join(SOURCE, "Documentation/UserGuide/sampling.md"), encoding="utf-8") as file:
            example = file.read().split("```jsonc\n")[1].split("```")[0]
        scene = self.write("table.json", example.replace("../Models", os.path.join(SOURCE, "Data/Models")))
        self.dgtk("sample", scene, "-o", self.path("out"), "--samples", "0:2", "--quiet")
        self.dgtk("render", self.path("out/000001.json"), "-o", self.path("dataset"), "--layers", "depth", "--frames", "0",
                  "--size", "64x48", "--quiet")

    def test_the_schema_is_what_its_maker_makes(self):
        subprocess.run([os.path.join(SOURCE, "Utilities/Maintenance/make_random_schema"), "--check"], check=True)

    def test_usage(self):
        scene = self.scene(parameters={"n": {"integer": [2, 5]}, "m": 4})
        for words, says in ((["--samples", "3:1"], "--samples"), (["--samples", "0:1000000"], "--samples"),
                            (["--samples", "0", "--seed", "-1"], "--seed"), ([], "--samples")):
            self.refused("sample", scene, "-o", self.path("out"), *words, status=2, says=says)
        largest = (1 << 53) - 1
        self.refused("sample", scene, "-o", self.path("out"), "--samples", "0", "--seed", largest + 1, status=2, says="from 0 to 2^53 - 1")
        self.dgtk("sample", scene, "-o", self.path("out"), "--samples", "0", "--seed", largest, "--quiet")
        self.refused("render", scene, "-o", self.path("out"), status=3, says=["scene.json:3", "parameters", "dgtk sample"])
        self.refused("sample", self.write("a.scene", "0\n"), "-o", self.path("out"), "--samples", "0", status=3, says="a.scene")
        info = json.loads(self.dgtk("info", scene, "--json").stdout)
        self.assertEqual(info["parameters"], ["n", "m"])
        self.refused("info", scene, "--size", "4x3", status=2, says="--size is for a scene without random values")
        self.assertIn(("cameras[1].path", "path"), [(value["path"], value["kind"]) for value in info["values"]])


if __name__ == "__main__":
    main()
