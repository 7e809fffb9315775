# SPDX-License-Identifier: BSD-3-Clause
"""Output folders that lead elsewhere: nothing outside them is written, removed or read, whatever links, manifests and journals say."""
import json
import os
import shutil

from harness import digests, main
from many_runs import ManyCase

ENTRY = {"bytes": 4, "sha256": "0" * 64, "layer": "depth", "camera": "left", "frame": 0}
STARTS = ((), ("--replace",), ("--resume",))


class HostileFolders(ManyCase):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("outside"))
        self.write("outside/000000.npy", "mine")
        self.write("outside/keep", "mine")
        self.data = self.path("data")
        self.write("a.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n")
        scene = self.write("s.json", json.dumps({
            "objects": [{"name": "a", "model": "a.obj"}], "keyFrames": [0, 3],
            "cameras": [{"name": "left", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 16, "height": 12}]}))
        self.render = ("render", scene, "--quiet", "--layers", "depth", "--frames", "0:1")

    def tearDown(self):
        """Nothing that stands outside has been touched, and nothing has appeared there."""
        self.assertEqual(sorted(os.listdir(self.path("outside"))), ["000000.npy", "keep"])
        for name in ("000000.npy", "keep"):
            with open(self.path("outside", name), encoding="utf-8") as file:
                self.assertEqual(file.read(), "mine")
        self.assertFalse(os.path.lexists(self.path("new")))

    def fresh(self):
        """The dataset once more, rendered once only."""
        if not os.path.exists(self.path("whole")):
            self.dgtk(*self.render, "-o", self.path("whole"))
        shutil.rmtree(self.data, ignore_errors=True)
        shutil.copytree(self.path("whole"), self.data)

    def link(self, name, target):
        path = os.path.join(self.data, name)
        if os.path.isdir(path):
            shutil.rmtree(path)
        elif os.path.lexists(path):
            os.remove(path)
        os.symlink(target, path)

    def names(self):
        """What stands in the folder, links included and not followed."""
        return sorted(os.path.join(root, name) for root, folders, files in os.walk(self.data) for name in folders + files)

    def test_linked_folders(self):
        for name, target in (("left", "../outside"), ("left/depth", "../../outside"), ("left", self.path("outside")), ("left", "left"),
                             ("left/depth", "../../nowhere")):
            with self.subTest(name=name, target=target):
                self.fresh()
                self.link(name, target)
                before = self.names()
                for start in STARTS:
                    self.refused(*self.render, "-o", self.data, *start, status=2, says="a link or a file stands where a folder of the dataset has to be")
                self.assertEqual(self.names(), before)
                self.refused("verify", self.data, status=3, says="through a link")
                self.refused("compare", self.data, self.path("whole"), status=3, says="through a link")

    def test_linked_files_are_replaced_not_followed(self):
        for name, target in (("left/depth/000000.npy", "../../../outside/000000.npy"), ("left/depth/000000.npy", "../../../new"),
                             ("left/depth/000000.npy", "000000.npy"), ("scene.json", "../outside/keep")):
            for start in STARTS:
                with self.subTest(name=name, target=target, start=start):
                    self.fresh()
                    self.link(name, target)
                    self.dgtk(*self.render, "-o", self.data, *start)
                    self.assertFalse(os.path.islink(os.path.join(self.data, name)))
                    self.assert_same_files(self.data, self.path("whole"))

    def test_half_written_names(self):
        for name in ("scene.json", "manifest.json", "left/depth/000000.npy", ".dgtk-journal"):
            for target in ("outside/keep", "new"):
                with self.subTest(name=name, target=target):
                    self.fresh()
                    self.link(name + ".partial", os.path.join("../" * (name.count("/") + 1), target))
                    self.dgtk(*self.render, "-o", self.data)
                    self.assert_same_files(self.data, self.path("whole"))

    def test_documents_of_the_run(self):
        for name in ("manifest.json", ".dgtk-journal"):
            for target in ("../outside/keep", "../new", name):
                with self.subTest(name=name, target=target):
                    self.fresh()
                    self.link(name, target)
                    for start in STARTS:
                        self.refused(*self.render, "-o", self.data, *start, status=2, says=f"{name}: is not a file")
            self.fresh()
            path = os.path.join(self.data, name)
            if os.path.exists(path):
                os.remove(path)
            os.mkfifo(path)
            self.refused(*self.render, "-o", self.data, "--replace", status=2, says=f"{name}: is not a file")

    def test_lists_that_lead_outside(self):
        for path in ("../outside/keep", self.path("outside", "keep"), "left/../../outside/keep"):
            with self.subTest(path=path):
                self.fresh()
                name = os.path.join(self.data, "manifest.json")
                with open(name, encoding="utf-8") as file:
                    manifest = json.load(file)
                manifest["files"].append({"path": path, **ENTRY})
                with open(name, "w", encoding="utf-8") as file:
                    json.dump(manifest, file)
                for start in STARTS:
                    self.refused(*self.render, "-o", self.data, *start, status=3 if start == ("--resume",) else 2, says="leads out of the dataset")
                for command in (("verify", self.data), ("compare", self.data, self.path("whole"))):
                    self.assertNotIn("mine", self.refused(*command, status=3, says="leads out of the dataset"))
                os.remove(name)
                with open(os.path.join(self.data, ".dgtk-journal"), "w", encoding="utf-8") as file:
                    file.write(f"DGTk journal 1 {manifest['request_hash']}\n" + "\t".join(["0" * 64, "4", "0", "depth", "left", path]) + "\n")
                for start in STARTS:
                    self.refused(*self.render, "-o", self.data, *start, status=3 if start == ("--resume",) else 2, says="leads out of the dataset")

    def test_names_that_no_file_of_a_run_has(self):
        for path, says in (("left/" + "x" * 256, "is too long for a file's name"), ("/".join(["d" * 200] * 21), "is too long for a file's name"),
                           (".dgtk-journal", "is a name for records of the run"), (".dgtk-parts/left/000000.npy", "is a name for records of the run")):
            with self.subTest(path=path[:20]):
                self.fresh()
                self.edit(lambda manifest, path=path: manifest["files"].append({"path": path, **ENTRY}))
                before = digests(self.data)
                for command in (("info", self.data), ("verify", self.data), ("compare", self.data, self.path("whole")), ("report", self.data, "-o", self.path("r.html")),
                                ("export", self.data, "--format", "kitti-depth", "-o", self.path("export")), (*self.render, "-o", self.data, "--resume")):
                    self.refused(*command, status=3, says=("manifest.json:", "path " + says))
                for start in ((), ("--replace",)):
                    self.refused(*self.render, "-o", self.data, *start, status=2, says=says)
                self.assertEqual(digests(self.data), before)

    def test_entries_through_links(self):
        self.fresh()
        self.link("link", "../outside")
        name = os.path.join(self.data, "manifest.json")
        with open(name, encoding="utf-8") as file:
            manifest = json.load(file)
        manifest["files"].append({"path": "link/keep", **ENTRY})
        with open(name, "w", encoding="utf-8") as file:
            json.dump(manifest, file)
        self.refused(*self.render, "-o", self.data, "--replace", status=2, says="link/keep")
        self.refused("verify", self.data, status=3, says="through a link")
        self.refused("compare", self.data, self.path("whole"), status=3, says="through a link")

    def test_documents_through_links(self):
        os.mkdir(self.path("elsewhere"))
        for document in ("manifest.json", "objects.json", "cameras.json"):
            self.fresh()
            shutil.move(os.path.join(self.data, document), self.path("elsewhere", document))
            self.link(document, self.path("elsewhere", document))
            for command in ("info", "verify", "report"):
                if (command, document) != ("info", "cameras.json"):  # which it does not look at
                    with self.subTest(command=command, document=document):
                        more = ("-o", self.path("report.html")) if command == "report" else ()
                        self.refused(command, self.data, *more, status=3, says=f"{document}: is not read through a link")
        samples = self.path("samples")
        random_scene = self.write("random.json", json.dumps({"lights": [{"name": "sun", "intensity": {"uniform": [2, 4]}}]}))
        self.dgtk("sample", random_scene, "-o", samples, "--samples", "1:1", "--quiet")
        shutil.move(os.path.join(samples, "samples.json"), self.path("elsewhere", "samples.json"))
        os.symlink(self.path("elsewhere", "samples.json"), os.path.join(samples, "samples.json"))
        self.refused("verify", samples, status=3, says="samples.json: is not read through a link")

    def edit(self, change):
        """Changes the manifest."""
        name = os.path.join(self.data, "manifest.json")
        with open(name, encoding="utf-8") as file:
            manifest = json.load(file)
        change(manifest)
        with open(name, "w", encoding="utf-8") as file:
            json.dump(manifest, file)

    def test_files_listed_twice(self):
        for place in (0, 1, 99):  # beside itself, and far from it
            self.fresh()
            self.edit(lambda manifest, at=place: manifest["files"].insert(at, dict(manifest["files"][0])))
            for command in (("info", self.data), ("verify", self.data), ("compare", self.data, self.path("whole")), ("report", self.data, "-o", self.path("r.html")),
                            ("export", self.data, "--format", "kitti-depth", "-o", self.path("export"))):
                with self.subTest(command=command, place=place):
                    self.refused(*command, status=3, says=("manifest.json", "cameras.json", "is listed twice"))

    def test_wrong_entries_are_not_resumed(self):
        name = "left/depth/000000.npy"
        for change, says in (({"frame": -5}, "frame -5"), ({"camera": "ghost"}, "camera 'ghost'"), ({"layer": "ghost"}, "layer 'ghost'"), ({"frame": 1}, "frame 1"),
                             ({"path": "left/depth/000007.npy"}, "is no file of the run"), ({"sha256": "0"}, "sha256"), ({"path": "cameras.json"}, "is listed twice")):
            with self.subTest(**change):
                self.fresh()
                self.edit(lambda manifest, change=change: next(one for one in manifest["files"] if one["path"] == name).update(change))
                before = digests(self.data)
                self.refused(*self.render, "-o", self.data, "--resume", status=3, says=("manifest.json", says))
                self.assertEqual(digests(self.data), before)
                if says in ("sha256", "is listed twice"):
                    continue
                with open(os.path.join(self.data, "manifest.json"), encoding="utf-8") as file:
                    manifest = json.load(file)
                for document in ("manifest.json", "cameras.json", "objects.json", "poses.json", "scene.json"):
                    os.remove(os.path.join(self.data, document))
                with open(os.path.join(self.data, ".dgtk-journal"), "w", encoding="utf-8") as file:
                    file.write(f"DGTk journal 1 {manifest['request_hash']}\n")
                    for one in manifest["files"]:
                        if "frame" in one:
                            file.write("\t".join([one["sha256"], str(one["bytes"]), str(one["frame"]), one["layer"], one["camera"], one["path"]]) + "\n")
                before = digests(self.data)
                self.refused(*self.render, "-o", self.data, "--resume", status=3, says=(".dgtk-journal", says))
                self.assertEqual(digests(self.data), before)

    def test_hard_links_are_replaced(self):
        for name in ("left/depth/000000.npy", "left/depth/000000.npy.partial", ".dgtk-journal.partial", "manifest.json.partial"):
            with self.subTest(name):
                self.fresh()
                path = os.path.join(self.data, name)
                if os.path.exists(path):
                    os.remove(path)
                os.link(self.path("outside", "keep"), path)
                self.dgtk(*self.render, "-o", self.data)
                self.assert_same_files(self.data, self.path("whole"))

    def test_strangers_in_the_way(self):
        """Files with the names of planned ones, in a folder of a dataset that does not list them."""
        other = ("--frames", "0:2", "--replace")
        for make in (lambda path: self.write(path, "theirs"), os.mkdir, os.mkfifo, lambda path: os.symlink("nowhere", path)):
            self.fresh()
            path = os.path.join(self.data, "left", "depth", "000002.npy")
            make(path)
            with open(os.path.join(self.data, "manifest.json"), "rb") as file:
                before = file.read()
            self.refused(*self.render, "-o", self.data, *other, status=2, says="000002.npy: ")
            self.assertTrue(os.path.lexists(path))
            with open(os.path.join(self.data, "manifest.json"), "rb") as file:
                self.assertEqual(file.read(), before)
            self.assertTrue(os.path.exists(os.path.join(self.data, "left", "depth", "000001.npy")))
            shutil.rmtree(self.data)

    def test_half_written_files_of_others_stay(self):
        self.fresh()
        for name in ("thesis.partial", "left/depth/mine.partial"):
            self.write(os.path.join("data", name), "mine")
        self.dgtk(*self.render, "-o", self.data)
        for name in ("thesis.partial", "left/depth/mine.partial"):
            with open(os.path.join(self.data, name), encoding="utf-8") as file:
                self.assertEqual(file.read(), "mine")

    def test_the_folder_itself_may_be_a_link(self):
        os.mkdir(self.path("elsewhere"))
        os.symlink("elsewhere", self.data)
        self.dgtk(*self.render, "-o", self.data)
        self.dgtk(*self.render, "-o", self.data, "--resume")
        self.assertTrue(os.path.islink(self.data))
        self.assertTrue(os.path.exists(self.path("elsewhere", "manifest.json")))


if __name__ == "__main__":
    main()
