# SPDX-License-Identifier: BSD-3-Clause
"""Runs in shares: however they are made, `dgtk merge` leaves the bytes of one process. Folders of scenes."""
import json
import os
import random
import shutil
import signal
import subprocess
import time

from harness import DGTK, digests, load_json, main
from many_runs import ManyCase

SOURCE = os.environ["DGTK_SOURCE"]
DEMO = os.path.join(SOURCE, "Data", "Scenes", "demo.json")
OPTIONS = ("--layers", "color,depth,objects,boxes,points,tracks,flow_forward,pov", "--size", "64x48", "--contact-sheet", "--models",
           "--quiet")
SEED = 20061125
KILLS = 30


def flip(path, bits):
    """Changes bits of the last byte of a file."""
    with open(path, "r+b") as file:
        file.seek(-1, os.SEEK_END)
        last = file.read(1)[0]
        file.seek(-1, os.SEEK_END)
        file.write(bytes([last ^ bits]))


class Shards(ManyCase):
    def scenes(self, count=8):
        """Plain scenes of a random one, in a folder with a file that is no scene."""
        os.mkdir(self.path("models"))
        self.write("models/quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        scene = {"seed": 3, "classes": {"tile": 1},
                 "objects": [{"name": "tile", "class": "tile", "count": {"integer": [1, 4]}, "model": "models/quad.obj",
                              "orientation": {"rotation": "any"}, "position": {"inBox": [[-1, -1, -1], [1, 1, 1]]}}],
                 "cameras": [{"name": "left", "eye": [0, 0, 6], "lookAt": [0, 0, 0]}, {"name": "right", "eye": [1, 0, 6], "lookAt": [1, 0, 0]}]}
        self.write("random.json", json.dumps(scene))
        self.dgtk("sample", self.path("random.json"), "-o", self.path("scenes"), "--samples", f"0:{count - 1}", "--quiet")
        return self.path("scenes")

    def shard(self, scene, folder, index, count, options=OPTIONS, status=0):
        return self.dgtk("render", scene, "-o", folder, *options, "--shard", f"{index}/{count}", status=status)

    def test_pictures_of_one_scene(self):
        """In any order, by any number of processes, some twice; a lost part is named, and made again."""
        whole = self.path("whole")
        self.alone("render", DEMO, "-o", whole, *OPTIONS)
        order = list(range(8))
        random.Random(SEED).shuffle(order)
        for index in order[:-1] + order[:2]:
            self.shard(DEMO, self.path("parts"), index, 8)
        self.shard(DEMO, self.path("parts"), order[-1], 8)
        lost = os.path.join(self.path("parts"), ".dgtk-parts", "000002")
        shutil.rmtree(lost)
        for command in (["verify"], ["info"], ["compare", self.path("parts")], ["report", "-o", self.path("report")]):
            self.refused(*command, self.path("parts"), status=3, says="parts: holds a run in parts: dgtk merge makes the dataset")
        report = json.loads(self.dgtk("merge", self.path("parts"), "--json", status=1).stdout)
        self.assertEqual((report["merged"], report["missing"], report["array"], report["shares"]), (False, [2], "0", {"8": "2"}))
        self.assertFalse(os.path.exists(self.path("parts", "manifest.json")))
        self.shard(DEMO, self.path("parts"), 2, 3)
        with self.goes_at_once(self.path("parts", ".dgtk-parts")):
            self.dgtk("merge", self.path("parts"))
        self.assert_same_files(whole, self.path("parts"))
        # Killed while the parts were removed, or called once more.
        for further in ("--shard 2/8", "--resume", None):
            os.makedirs(self.path("parts", ".dgtk-parts-merged", "000001"))
            self.write("parts/.dgtk-parts-merged/000001/cameras.json", "{}")
            if further:
                self.dgtk("verify", self.path("parts"))
                self.dgtk("render", DEMO, "-o", self.path("parts"), *OPTIONS, *further.split())
                self.assert_same_files(whole, self.path("parts"))
        self.assertEqual(self.dgtk("merge", self.path("parts")).stdout, self.path("parts") + ": is whole already\n")
        self.assertFalse(os.path.exists(self.path("parts", ".dgtk-parts-merged")))
        report = json.loads(self.dgtk("merge", self.path("parts"), "--json").stdout)
        files = len(load_json(self.path("parts", "manifest.json"))["files"])
        self.assertEqual(report, {"merged": True, "blocks": 0, "files": files, "missing": [], "problems": []})
        export = ("export", whole, "--format", "yolo", "-o", self.path("yolo"), "--quiet")
        self.dgtk(*export)
        os.makedirs(self.path("yolo", ".dgtk-parts-merged"))
        self.write("yolo/.dgtk-parts-merged/left.txt", "")
        self.dgtk("verify", whole, "--export", self.path("yolo"))
        self.dgtk(*export)
        self.assertFalse(os.path.exists(self.path("yolo", ".dgtk-parts-merged")))

    def test_what_is_of_another_run(self):
        """A share replaces nothing: it says what may be done."""
        options = ("render", DEMO, "-o", self.path("run"), "--size", "32x24", "--quiet", "--layers")
        self.dgtk(*options, "depth", "--shard", "0/8")
        told = self.refused(*options, "objects", "--shard", "0/8", status=2,
                            says=": holds an unfinished run of another request, in parts; remove its .dgtk-parts, or name another folder")
        self.assertNotIn("--replace", told)
        shutil.rmtree(self.path("run", ".dgtk-parts"))
        self.dgtk(*options, "objects", "--shard", "0/1")
        self.dgtk("merge", self.path("run"))
        self.refused(*options, "depth", "--shard", "0/8", status=2, says="of another request; without --shard, --replace removes it")
        self.refused(*options, "depth", status=2, says="of another request; --replace removes it, or name another folder")
        self.dgtk(*options, "depth", "--replace")

    def test_a_folder_that_another_process_has_just_made(self):
        """As it is between two steps of another share, or after that one was killed there."""
        for scene, name, counted in ((DEMO, "one", "6 pictures"), (self.scenes(2), "many", "2 scenes")):
            os.makedirs(self.path(name, ".dgtk-parts"))
            said = self.dgtk("render", scene, "-o", self.path(name), "--layers", "depth", "--size", "32x24", "--shard", "0/1",
                             environment={"DGTK_PROGRESS": "3600"}).stderr
            self.assertIn(f"0/{counted}, 0.000/s, ? left\n", said)
            self.dgtk("merge", self.path(name))

    def test_packed_inputs(self):
        """What all parts would have alike is in the first one."""
        options = ("--layers", "depth", "--size", "32x24", "--quiet", "--pack", "--models")
        self.alone("render", DEMO, "-o", self.path("whole"), *options)
        for index in range(2):
            self.shard(DEMO, self.path("parts"), index, 2, options)
        common = {"cameras.json", "objects.json", "poses.json", "scene.json", "inputs", "models"}
        self.assertLess(common, {name.split("/")[0] for name in digests(self.path("whole"))})
        made = [name.split("/") for name in digests(self.path("parts", ".dgtk-parts"))]
        self.assertEqual({block for block, *names in made if common & set(names)}, {"000000"})
        self.dgtk("merge", self.path("parts"))
        self.assert_same_files(self.path("whole"), self.path("parts"))

    def test_warnings_and_inputs(self):
        """Each part has the warnings of the whole; a picture that a model and the scene name is one input."""
        self.write("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        os.mkdir(self.path("models"))
        self.write("models/seen.obj", "mtllib seen.mtl\nusemtl m\nv 0 0 1\nv 1 0 1\nv 0 1 1\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        self.write("models/seen.mtl", "newmtl m\nmap_Kd ../grey.pgm\n")
        self.write("grey.pgm", "P2\n1 1\n255\n99\n")
        self.write("scene.json", json.dumps(
            {"objects": [{"model": "models/seen.obj"}, {"model": "quad.obj", "materials": {"*": {"texture": "models/../grey.pgm"}}}],
             "keyFrames": [0, 3], "cameras": [{"name": "c", "eye": [0, 0, 6], "lookAt": [0, 0, 0]}]}))
        options = ("--layers", "color", "--size", "16x12", "--quiet")
        self.alone("render", self.path("scene.json"), "-o", self.path("whole"), *options)
        self.shard(self.path("scene.json"), self.path("parts"), 0, 1, options)
        self.dgtk("merge", self.path("parts"))
        self.assert_same_files(self.path("whole"), self.path("parts"))
        manifest = load_json(self.path("parts", "manifest.json"))
        self.assertIn("no texture coordinates", *manifest["warnings"])
        self.assertEqual([entry["path"] for entry in manifest["inputs"]].count("../grey.pgm"), 1)
        self.dgtk("verify", self.path("parts"))

    def test_a_damaged_part_is_missing(self):
        options = ("--layers", "depth", "--size", "32x24", "--quiet")
        self.dgtk("render", DEMO, "-o", self.path("whole"), *options)
        for index in range(2):
            self.shard(DEMO, self.path("parts"), index, 2, options)
        parts = os.path.join(self.path("parts"), ".dgtk-parts")
        victim = next(os.path.join(folder, name) for folder, _, names in sorted(os.walk(parts)) for name in sorted(names) if name.endswith(".npy"))
        flip(victim, 1)
        with self.goes_at_once(victim[:len(parts) + len("/000000")]):
            self.refused("merge", self.path("parts"), status=1, says=("1 of 6 blocks are missing",))
        for index in range(2):
            self.shard(DEMO, self.path("parts"), index, 2, options)
        self.dgtk("merge", self.path("parts"))
        self.assert_same_files(self.path("whole"), self.path("parts"))

    def test_three_workers_and_thirty_kills(self):
        """Workers that begin the same blocks at once, killed and started again until all is there."""
        scenes = self.scenes()
        options = ("--layers", "color,depth,objects,boxes", "--size", "96x72", "--quiet", "--threads", "1")
        self.dgtk("render", scenes, "-o", self.path("whole"), *options)
        chance = random.Random(SEED)
        parts = self.path("parts")
        kills = 0
        while kills < KILLS:
            running = [subprocess.Popen([DGTK, "render", scenes, "-o", parts, *options, "--shard", f"{index}/{count}"],
                                        stderr=subprocess.DEVNULL) for index, count in ((0, 2), (1, 2), (0, 2))]
            for process in running:
                time.sleep(chance.uniform(0, 0.06))
                process.send_signal(chance.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGUSR1)))
                kills += 1
            for process in running:
                self.assertIn(process.wait(timeout=300), (0, 75, -9, -15, -10))
            done = subprocess.run([DGTK, "merge", parts], capture_output=True, text=True)
            if done.returncode == 0:
                shutil.rmtree(parts)  # all was there already: begin anew
        for index in range(3):
            self.shard(scenes, parts, index, 3, options)
        self.dgtk("merge", parts)
        self.assert_same_files(self.path("whole"), parts)

    def test_a_folder_of_scenes(self):
        scenes = self.scenes(3)
        options = ("--layers", "depth,objects", "--size", "32x24", "--quiet")
        os.makedirs(self.path("all", ".dgtk-parts"))
        with self.goes_at_once(self.path("all", ".dgtk-parts")):
            self.dgtk("render", scenes, "-o", self.path("all"), *options)
        manifest = load_json(self.path("all", "manifest.json"))
        self.assertEqual([one["path"] for one in manifest["datasets"]], [f"{k:06}/manifest.json" for k in range(3)])
        self.assertEqual(manifest["left_out"], ["samples.json"])
        for name in ("000000", "000001", "000002"):
            self.dgtk("render", os.path.join(scenes, name + ".json"), "-o", self.path("alone", name), *options)
        self.assert_same_files(self.path("all"), self.path("alone"), ignore=("manifest.json",))
        self.assertIn("3 datasets, 0 with a breach", self.dgtk("verify", self.path("all")).stdout)
        self.assertEqual(json.loads(self.dgtk("info", self.path("all"), "--json").stdout)["scenes"], ["000000", "000001", "000002"])
        shutil.copytree(self.path("all"), self.path("copy"))
        self.assertNotIn(" 1 differ", self.dgtk("compare", self.path("all"), self.path("copy")).stdout)
        flip(self.path("copy", "000001", "left", "depth", "000000.npy"), 1)
        self.assertIn(" 1 differ", self.dgtk("compare", self.path("all"), self.path("copy"), status=1).stdout)
        # The same again, another request, and an unfinished one.
        self.dgtk("render", scenes, "-o", self.path("all"), *options)
        self.refused("render", scenes, "-o", self.path("all"), "--layers", "depth", "--quiet", status=2, says=("another request",))
        self.write("numbers.json", '{"tile": 5}')
        for more in (("--cameras", "left"), ("--frames", "0"), ("--contact-sheet",), ("--classes", self.path("numbers.json")), ("--samples", "2")):
            with self.subTest(more=more):
                self.refused("render", scenes, "-o", self.path("all"), *options, *more, status=2, says=("another request",))
        for sizes in ((), ("--size", "24x32")):
            self.refused("render", scenes, "-o", self.path("all"), "--layers", "depth,objects", "--quiet", *sizes, status=2, says=("another request",))
        self.dgtk("render", scenes, "-o", self.path("all"), *options, "--threads", "1")
        self.dgtk("render", scenes, "-o", self.path("all"), "--layers", "depth", "--quiet", "--size", "32x24", "--replace")
        self.assertFalse(os.path.exists(self.path("all", "000000", "left", "objects")))
        depth = self.path("all", "000001", "left", "depth", "000000.npy")
        flip(depth, 64)
        self.assertIn("1 with a breach", self.dgtk("verify", self.path("all"), status=1).stdout)

    def test_a_model_that_changes(self):
        """Is another request: nothing is changed, and no datasets are merged that do not belong together."""
        scenes = self.scenes(2)
        options = ("--layers", "depth", "--size", "32x24", "--quiet")
        self.dgtk("render", scenes, "-o", self.path("all"), *options)
        self.shard(scenes, self.path("parts"), 0, 2, options)
        before = digests(self.path("all"))
        self.write("models/quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 2 0\nf 1 2 3 4\n")
        for more in ((), ("--resume",), ("--shard", "0/1"), ("--shard", "1/2")):
            with self.subTest(more=more):
                name = "000001" if "1/2" in more else "000000"
                self.refused("render", scenes, "-o", self.path("all"), *options, *more, status=2,
                             says=self.path("all", name) + ": holds the finished dataset of another request")
                self.assertEqual(digests(self.path("all")), before)
        self.shard(scenes, self.path("parts"), 1, 2, options)
        self.refused("merge", self.path("parts"), status=1, says=self.path("parts", "000001") + ": is of another version of " +
                     self.path("models", "quad.obj") + " than " + self.path("parts", "000000") + "; ")
        self.assertFalse(os.path.exists(self.path("parts", "manifest.json")))
        shutil.rmtree(self.path("parts", "000000"))
        self.shard(scenes, self.path("parts"), 0, 2, options)
        self.dgtk("merge", self.path("parts"))
        self.dgtk("render", scenes, "-o", self.path("all"), *options, "--replace")
        self.assert_same_files(self.path("all"), self.path("parts"))

    def test_datasets_of_another_request(self):
        """As a replacing that was killed has left them, are not merged with those of the run."""
        scenes = self.scenes(2)
        options = ("--size", "32x24", "--quiet", "--layers")
        self.dgtk("render", scenes, "-o", self.path("all"), *options, "depth")
        self.shard(scenes, self.path("other"), 0, 2, (*options, "distance"))
        shutil.rmtree(self.path("all", "000000"))
        for name in (".dgtk-parts", "000000"):
            shutil.copytree(self.path("other", name), self.path("all", name))
        before = digests(self.path("all"))
        self.refused("merge", self.path("all"), status=1,
                     says=self.path("all", "000001") + ": is of another request: layers (expected distance, found depth)")
        self.assertEqual(digests(self.path("all")), before)
        self.dgtk("render", scenes, "-o", self.path("all"), *options, "distance", "--replace")
        self.dgtk("render", scenes, "-o", self.path("one"), *options, "distance")
        self.assert_same_files(self.path("all"), self.path("one"))

    def test_a_request_in_many_words(self):
        """The datasets of a run say it otherwise than the run."""
        scenes = self.scenes(2)
        other = load_json(os.path.join(scenes, "000001.json"))
        other["cameras"][0].update(model="fisheye", fovY=150)
        self.write("scenes/000001.json", json.dumps(other))
        self.write("numbers.json", '{"tile": 5}')
        for words in ("--size 16x12", "--size 16x12 --layers all --frames 0",
                      "--layers depth,color --cameras right --color-format exr,png --samples 02 --exposure 1.50 --pack --models --visibility auto "
                      "--size 16x12 --classes " + self.path("numbers.json"),
                      "--layers color_noisy --color-format exr --size 16x12 --seed 3"):
            with self.subTest(words):
                shutil.rmtree(self.path("parts"), ignore_errors=True)
                for index in range(2):
                    self.shard(scenes, self.path("parts"), index, 2, ("--quiet", *words.split()))
                self.dgtk("merge", self.path("parts"))

    def test_the_record_of_an_unfinished_run_is_replaced(self):
        """At once: a folder that lost it could neither go on nor be replaced."""
        scenes = self.scenes(2)
        options = ("--size", "32x24", "--quiet", "--layers")
        self.shard(scenes, self.path("run"), 0, 2, (*options, "objects"))
        with self.goes_at_once(self.path("run", ".dgtk-parts")):
            self.dgtk("render", scenes, "-o", self.path("run"), *options, "depth", "--replace")
        self.dgtk("render", scenes, "-o", self.path("whole"), *options, "depth")
        self.assert_same_files(self.path("whole"), self.path("run"))

    def test_one_numbering_of_classes(self):
        """Of all scenes of the folder, whichever share; as a run of its own with the same numbers; contradictions are named."""
        scenes = self.scenes(3)
        for k, names in enumerate((["pear"], ["apple", "pear"], ["fig", "apple"])):
            scene = load_json(os.path.join(scenes, f"{k:06}.json"))
            del scene["classes"]
            first = scene["objects"][0]
            scene["objects"] = [{**first, "name": name, "class": name, "position": [1.3 * i, 0, 0]} for i, name in enumerate(names)]
            self.write(f"scenes/{k:06}.json", json.dumps(scene))
        options = ("--layers", "classes,objects", "--for", "yolo", "--size", "32x24", "--quiet")
        self.dgtk("render", scenes, "-o", self.path("all"), *options)
        numbers = {"apple": 1, "fig": 2, "pear": 3}
        self.write("numbers.json", json.dumps(numbers))
        for k, names in enumerate((["pear"], ["apple", "pear"], ["fig", "apple"])):
            document = load_json(self.path("all", f"{k:06}", "objects.json"))
            self.assertEqual({one["name"]: one["id"] for one in document["classes"]}, numbers)
            self.assertEqual([one["class_id"] for one in document["objects"]], [numbers[name] for name in names])
            self.assertEqual(json.loads(load_json(self.path("all", f"{k:06}", "manifest.json"))["request"]["classes"]), numbers)
            self.dgtk("render", os.path.join(scenes, f"{k:06}.json"), "-o", self.path("alone", f"{k:06}"), *options, "--classes",
                      self.path("numbers.json"))
        self.assert_same_files(self.path("all"), self.path("alone"), ignore=("manifest.json",))
        for k in range(3):
            self.assertEqual(load_json(self.path("all", f"{k:06}", "manifest.json")), load_json(self.path("alone", f"{k:06}", "manifest.json")))
        self.assertIn("3 datasets, 0 with a breach", self.dgtk("verify", self.path("all")).stdout)
        self.dgtk("export", self.path("all"), "--format", "yolo", "-o", self.path("yolo"), "--quiet")
        for index in (1, 0):
            self.shard(scenes, self.path("parts"), index, 2, options)
        self.dgtk("merge", self.path("parts"))
        self.assert_same_files(self.path("all"), self.path("parts"))
        # One scene fixes the numbers: of the others, too, or they are named. Two that differ.
        fixed = load_json(os.path.join(scenes, "000001.json"))
        self.write("scenes/000001.json", json.dumps({**fixed, "classes": {"pear": 9, "fig": 4, "apple": 7}}))
        self.dgtk("render", scenes, "-o", self.path("fixed"), *options)
        self.assertEqual([one["class_id"] for one in load_json(self.path("fixed", "000002", "objects.json"))["objects"]], [4, 7])
        self.write("scenes/000001.json", json.dumps({**fixed, "classes": {"pear": 9, "apple": 7}}))
        self.refused("render", scenes, "-o", self.path("less"), *options, status=3, says=("1 of 3 scenes", "000002.json", "'fig'"))
        other = load_json(os.path.join(scenes, "000000.json"))
        self.write("scenes/000000.json", json.dumps({**other, "classes": {"pear": 1}}))
        self.refused("render", scenes, "-o", self.path("no"), *options, status=3, says=("000001.json", "fixes other numbers", "000000.json"))
        self.assertFalse(os.path.exists(self.path("no")))

    def test_a_damaged_scene_is_missing(self):
        scenes = self.scenes(3)
        options = ("--layers", "depth", "--size", "32x24", "--quiet")
        self.dgtk("render", scenes, "-o", self.path("whole"), *options)
        for index in range(2):
            self.shard(scenes, self.path("parts"), index, 2, options)
        flip(self.path("parts", "000001", "left", "depth", "000000.npy"), 1)
        self.refused("merge", self.path("parts"), status=1, says=("1 of 3 blocks are missing", "shares 1 of 2; --array=0)"))
        self.shard(scenes, self.path("parts"), 1, 2, options)
        with self.goes_at_once(self.path("parts", ".dgtk-parts")):
            self.dgtk("merge", self.path("parts"))
        self.assert_same_files(self.path("whole"), self.path("parts"))

    def test_a_scene_that_cannot_be_rendered_is_named(self):
        scenes = self.scenes(3)
        broken = load_json(os.path.join(scenes, "000001.json"))
        broken["objects"][0]["model"] = "nothing.obj"
        self.write("scenes/000001.json", json.dumps(broken))
        options = ("--layers", "depth", "--size", "32x24", "--quiet")
        self.refused("render", scenes, "-o", self.path("all"), *options, status=3, says=("1 of 3 scenes", "nothing.obj"))
        self.assertFalse(os.path.exists(self.path("all", "manifest.json")))
        self.assertTrue(os.path.exists(self.path("all", "000002", "manifest.json")))
        shutil.copy(self.path("models", "quad.obj"), self.path("scenes", "nothing.obj"))
        other = load_json(os.path.join(scenes, "000002.json"))
        other["cameras"] = other["cameras"][:1]
        self.write("scenes/000002.json", json.dumps(other))
        self.refused("render", scenes, "-o", self.path("some"), *options, "--cameras", "right", status=3, says=("1 of 3 scenes", "000002: "))
        self.refused("render", scenes, "-o", self.path("none"), *options, "--cameras", "nobody", status=2, says=("000000: ",))
        self.write("scenes/000002.json", json.dumps({**other, "cameras": load_json(os.path.join(scenes, "000001.json"))["cameras"]}))
        self.dgtk("render", scenes, "-o", self.path("all"), *options, "--replace")
        self.assertTrue(os.path.exists(self.path("all", "manifest.json")))

    def test_missing_shares_are_an_array(self):
        """Whichever are missing: an array's tasks share what is left among them."""
        self.dgtk("render", DEMO, "-o", self.path("whole"), *OPTIONS)
        for index in (0, 2):
            self.shard(DEMO, self.path("parts"), index, 4)
        report = json.loads(self.dgtk("merge", self.path("parts"), "--json", status=1).stdout)
        self.assertEqual((report["missing"], report["shares"], report["array"]), ([1, 3, 5], {"4": "1,3"}, "0-2"))
        for task in range(3):
            self.dgtk("render", DEMO, "-o", self.path("parts"), *OPTIONS, "--shard", "auto", environment={
                "SLURM_ARRAY_TASK_ID": str(task), "SLURM_ARRAY_TASK_MIN": "0", "SLURM_ARRAY_TASK_MAX": "2", "SLURM_ARRAY_TASK_COUNT": "3"})
        self.dgtk("merge", self.path("parts"))
        self.assert_same_files(self.path("whole"), self.path("parts"))
        self.shard(DEMO, self.path("two"), 0, 2)
        self.assertIn("--array=0-1", self.dgtk("merge", self.path("two"), status=1).stderr, "no more tasks than there were")

    def test_launchers(self):
        options = ("--layers", "depth", "--size", "16x12", "--quiet", "--shard", "auto")
        clean = {"SLURM_ARRAY_TASK_ID": "", "SLURM_PROCID": "", "OMPI_COMM_WORLD_RANK": "", "PMI_RANK": ""}
        rows = [({"SLURM_ARRAY_TASK_ID": "7", "SLURM_ARRAY_TASK_MIN": "5", "SLURM_ARRAY_TASK_MAX": "9", "SLURM_ARRAY_TASK_STEP": "2",
                  "SLURM_ARRAY_TASK_COUNT": "3", "SLURM_PROCID": "0", "SLURM_NTASKS": "1"}, (1, 4)),
                ({"SLURM_PROCID": "2", "SLURM_NTASKS": "3"}, (2, 5)), ({"OMPI_COMM_WORLD_RANK": "0", "OMPI_COMM_WORLD_SIZE": "3"}, (0, 3)),
                ({"PMI_RANK": "5", "PMI_SIZE": "6"}, (5,)),
                # mpirun within a job of Slurm, whose words all processes inherit
                ({"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "3", "SLURM_PROCID": "0", "SLURM_NTASKS": "3"}, (1, 4)),
                ({"PMI_RANK": "2", "PMI_SIZE": "3", "SLURM_PROCID": "0", "SLURM_NTASKS": "1"}, (2, 5))]
        for number, (words, blocks) in enumerate(rows):
            with self.subTest(words):
                folder = self.path(f"d{number}")
                self.dgtk("render", DEMO, "-o", folder, *options, environment={**clean, **words})
                there = sorted(name for name in os.listdir(os.path.join(folder, ".dgtk-parts")) if name.isdigit())
                self.assertEqual(there, [f"{block:06}" for block in blocks])
        for words in ({}, {"SLURM_ARRAY_TASK_ID": "7", "SLURM_ARRAY_TASK_MIN": "5", "SLURM_ARRAY_TASK_MAX": "9", "SLURM_ARRAY_TASK_COUNT": "2"},
                      {"PMI_RANK": "6", "PMI_SIZE": "6"}, {"SLURM_PROCID": "x", "SLURM_NTASKS": "2"}):
            done = subprocess.run([DGTK, "render", DEMO, "-o", self.path("no"), *options], capture_output=True, text=True,
                                  env={**os.environ, **clean, **words})
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        for bad in ("3/3", "1", "a/b", "-1/2", "0/0"):
            self.refused("render", DEMO, "-o", self.path("no"), "--layers", "depth", "--shard", bad, status=2, says=("--shard",))
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
