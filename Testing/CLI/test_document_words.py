# SPDX-License-Identifier: BSD-3-Clause
"""Every number and word of a dataset's documents is judged: each is changed, left out or doubled, one at a time, in a dataset whose hashes
agree, and `dgtk verify` must see it, but for what is free. It must never end in another way. No command that reads them may fail, either."""
import collections
import concurrent.futures
import hashlib
import json
import os
import queue
import re
import shutil
import signal
import subprocess
import unittest

from dataset_edits import plainer
from harness import DGTK, SOURCE, WHOLE, load_json, main
from many_runs import ManyCase, ManyRuns
from referee import SCENE
from word_changes import changes_of, json_changes

OPTIONS = ["--layers", "objects,classes,boxes,amodal,points,tracks,calibration,depth", "--models", "--frames", "0:1", "--points-step", "2",
           "--tracks-step", "4"]
CHECKS = "hashes,metadata,cameras,poses,boxes,keypoints,models,points,tracks,partition,calibration"
# "FILE PLACE" of what need not be seen.
FREE = [r"cameras.json -cameras/\*/distortion",  # nothing is distorted
        r"objects.json -objects/\*/deforming",
        r"000000.json objects/\*/pixels_whole",  # what is outside of the picture lies between bounds
        # of a first dataset, or of another version, or what was asked for
        r"manifest.json -(fps|empty|warnings)", r"manifest.json (version|request_hash)", r"manifest.json -?request/.*",
        r"manifest.json shorter inputs",  # the scene that was read
        "manifest.json longer layers",  # earlier versions have some twice
        r"manifest.json layers/\*/(unit|frame|invalid|description|channels)"]
# By commands that need not see what is wrong; what they write is compared with nothing.
READERS = [("info", "{}"), ("report", "{}", "-o", "{}.html"), ("export", "{}", "--format", "coco", "-o", "{}.coco", "--replace", "--quiet"),
           ("export", "{}", "--format", "tapvid", "-o", "{}.tapvid", "--replace", "--quiet")]


class Words(ManyCase):
    def setUp(self):
        super().setUp()
        scene = json.loads(json.dumps(SCENE))
        scene["objects"] = scene["objects"][:3]  # a floor, what moves, and what deforms
        for place in scene["objects"]:  # without textures, unless WHOLE of skins, and with few triangles: each run reads them
            with open(place["model"], "rb") as file:
                plain = re.sub(rb"(?m)^texture .*\n", b"", file.read())
            if plain.startswith(b"IDP2"):
                if WHOLE:
                    continue  # its skin lies beside it
                plain = plainer(plain, 100)
            place["model"] = self.write(os.path.basename(place["model"]), plain)
        scene["cameras"] = [dict(camera, width=20, height=15) for camera in (scene["cameras"][0], scene["cameras"][1], scene["cameras"][3])]
        self.dgtk("render", self.write("scene.json", json.dumps(scene)), "-o", self.path("dataset"), "--quiet", *OPTIONS)
        self.manifest = load_json(self.path("dataset", "manifest.json"))
        self.copies = queue.Queue()
        for number in range(2):
            shutil.copytree(self.path("dataset"), self.path(f"copy{number}"))
            self.copies.put(self.path(f"copy{number}"))

    def changes(self):
        """(file, what, bytes) of the documents: one of each kind.

        Of a second camera model all is read by the same code: unless WHOLE, values alone are others there.
        """
        kinds = collections.OrderedDict((re.sub(r"[0-9a-f]{16}|\d+", "#", row["path"]).replace("right", "left"), row["path"])
                                        for row in reversed(self.manifest["files"]))
        for name in kinds.values():
            if name.endswith((".json", ".txt", ".ply")) and name != "scene.json":
                with open(self.path("dataset", name), "rb") as file:
                    data = file.read()
                yield from ((name, what, changed) for what, changed in changes_of(name, data)
                            if changed != data and (WHOLE or not name.startswith("parallel/") or not re.match("-|.* ", what)))
        yield from (("manifest.json", what, json.dumps(changed).encode()) for what, changed in json_changes(self.manifest))

    def with_change(self, change, body):
        """body(folder) of a dataset that differs in one document, which its manifest knows."""
        name, _, data = change
        folder = self.copies.get()
        try:
            files = [dict(row, sha256=hashlib.sha256(data).hexdigest(), bytes=len(data)) if row["path"] == name else row for row in self.manifest["files"]]
            saved = {}
            for path, text in ((name, data), ("manifest.json", json.dumps({**self.manifest, "files": files}).encode())):
                if path not in saved:
                    with open(os.path.join(folder, path), "rb") as file:
                        saved[path] = file.read()
                    with open(os.path.join(folder, path), "wb") as file:
                        file.write(text)
            found = body(folder)
            for path, text in saved.items():
                with open(os.path.join(folder, path), "wb") as file:
                    file.write(text)
            return found
        finally:
            self.copies.put(folder)

    def sweep(self, changes, *command):
        """(change, exit status, standard error) of a command."""
        def run(folder):
            done = self.runs.run(*(word.replace("{}", folder) for word in command))
            return done.returncode, done.stderr.decode()

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            return [(change, *found) for change, found in zip(changes, pool.map(lambda change: self.with_change(change, run), changes))]

    @staticmethod
    def place(change):
        return f"{os.path.basename(change[0])} {change[1]}"

    def test_every_word_is_judged(self):
        verify = ("verify", "{}", "--threads", "1", "--check", CHECKS)
        self.dgtk("verify", self.path("dataset"), "--check", CHECKS)
        results = self.sweep(list(self.changes()), *verify)
        self.assertGreater(len(results), 400)
        wrong = [f"{self.place(change)}: exit {status} {text}" for change, status, text in results if status not in (0, 1, 3)]
        self.assertEqual(wrong, [])
        unseen = [self.place(change) for change, status, _ in results if status == 0]
        self.assertEqual([place for place in unseen if not any(re.fullmatch(free, place) for free in FREE)], [])
        self.assertEqual([free for free in FREE if not any(re.fullmatch(free, place) for place in unseen)], [], "is seen")

    def test_runs_are_those_of_a_program(self):
        """Here the program is started once for all runs: what those before it left changes none of them, and all ends as it does by itself."""
        dataset, coco = self.path("dataset"), self.path("coco")
        words = ["verify", dataset, "--check", CHECKS]
        for arguments in (words, ["verify", self.path("missing")], ["--version"], ["no such command"], words,
                          ["export", dataset, "--format", "coco", "-o", coco, "--replace"], ["verify", dataset, "--export", coco],
                          # replaces itself by another start
                          ["render", self.path("scene.json"), "-o", self.path("raster"), "--replace", "--gl", "osmesa", "--visibility", "raster"], words):
            done, alone = self.runs.run(*arguments), subprocess.run([DGTK, *arguments], capture_output=True)
            said, expected = ((one.returncode, one.stdout, re.sub(rb", [0-9.]+ s$", b"", one.stderr, flags=re.M)) for one in (done, alone))
            self.assertEqual(said, expected)

    @unittest.skipIf(os.environ.get("DGTK_TEST_SANITIZED"), "there each run is a process")
    def test_a_run_that_ends_the_program_is_seen(self):
        own = ManyRuns()
        self.assertEqual(own.run("--version").returncode, 0)
        with open(f"/proc/{own.all[0].pid}/task/{own.all[0].pid}/children", encoding="ascii") as file:
            os.kill(int(file.read()), signal.SIGKILL)
        with self.assertRaisesRegex(AssertionError, "otherwise than by itself"), own:
            pass

    def test_no_reader_fails_otherwise(self):
        changes = [change for change in self.changes() if not change[0].endswith(".ply")][::3]
        for command in READERS:
            with self.subTest(command[0]):
                found = self.sweep(changes, *command)
                self.assertEqual([f"{self.place(change)}: exit {status} {text}" for change, status, text in found if status not in (0, 1, 2, 3)], [])

    def test_a_folder_of_datasets(self):
        """Its manifest names all datasets and their bytes; nobody who reads it fails otherwise."""
        self.dgtk("sample", os.path.join(SOURCE, "Data", "Recipes", "street.json"), "-o", self.path("scenes"), "--samples", "0:1", "--quiet")
        folder = self.path("many")
        self.dgtk("render", self.path("scenes"), "-o", folder, "--size", "24x18", "--frames", "0", "--layers", "objects,boxes,amodal,color", "--quiet")
        self.dgtk("verify", folder)
        manifest = os.path.join(folder, "manifest.json")
        sound = load_json(manifest)
        unseen, wrong = [], []
        for what, changed in json_changes(sound):
            self.write(manifest, json.dumps(changed))
            for command in (("verify", "{}", "--check", "hashes"), *READERS[:3]):
                done = self.runs.run(*(word.replace("{}", folder) for word in command))
                if done.returncode == 0 and command[0] == "verify":
                    unseen.append(what)
                elif done.returncode not in (0, 1, 2, 3):
                    wrong.append(f"{command[0]} {what}: exit {done.returncode} {done.stderr.decode()}")
        self.assertEqual(wrong, [])
        self.assertEqual([what for what in unseen if not re.fullmatch("version|-?request/.*|(shorter |longer )?left_out(/0)?", what)], [])
        self.write(manifest, json.dumps(sound))
        shutil.copytree(os.path.join(folder, "000001"), os.path.join(folder, "000002"))
        self.assertIn("000002/manifest.json: found a dataset that manifest.json does not list", self.dgtk("verify", folder, status=1).stderr)

    def test_reports_of_what_was_verified(self):
        dataset, verified = self.path("dataset"), self.path("verification.json")
        for what, changed in json_changes(json.loads(self.dgtk("verify", dataset, "--json", "--check", "cameras,metadata").stdout)):
            self.write(verified, json.dumps(changed))
            done = self.runs.run("report", dataset, "-o", self.path("report.html"), "--pictures", "1", "--read", "1", "--verification", verified)
            self.assertIn(done.returncode, (0, 3), f"{what}: {done.stderr}")


if __name__ == "__main__":
    main()
