# SPDX-License-Identifier: BSD-3-Clause
"""What holds for every exporter: the same bytes however it ran, refusals in one line, nothing that looks whole and is not."""
import fcntl
import json
import os
import random
import resource
import shutil
import struct
import subprocess
import tempfile
import time

import datasets
from datasets import load_json, main
from harness import DGTK, digests

KILLS = 20


def flip_bit(path, seed):
    with open(path, "rb") as file:
        data = bytearray(file.read())
    bit = random.Random(seed).randrange(8 * len(data))
    data[bit // 8] ^= 1 << bit % 8
    with open(path, "wb") as file:
        file.write(data)


class Frame(datasets.ExportCase):
    def rendered_for(self, form, scene):
        """A dataset for a format, or what it is refused with."""
        folder = self.path(f"for-{form}-{os.path.basename(scene)}")
        done = self.dgtk_any("render", scene, "-o", folder, "--for", form, "--quiet")
        return folder, done.stderr if done.returncode else ""

    def rendered_for_many(self, forms, scene):
        """One dataset, which has more than each of the formats needs."""
        folder = self.path(f"for-many-{os.path.basename(scene)}")
        if not os.path.exists(folder):
            self.dgtk("render", scene, "-o", folder, "--for", ",".join(forms), "--quiet")
        return folder, ""

    def dgtk_any(self, *arguments):
        done = self.ran(*arguments)
        self.assertIn(done.returncode, (0, 2), done.stderr)
        self.assertLessEqual(len(done.stderr.splitlines()), 1 if done.returncode else 99, done.stderr)
        return done

    def test_every_exporter_gives_the_same_bytes_and_is_read_back(self):
        """Threads, links and shares change nothing; what comes out passes the referee; or it is refused in words.

        A format is tried with the first scene rendered for it alone, and with the others rendered for all formats that they are for.
        """
        listed = json.loads(self.dgtk("list", "exporters", "--json").stdout)["exporters"]
        known = {row["format"]: row["layers"].split(",") for row in listed}  # that each needs
        scenes = [datasets.stereo(self.path("stereo")), datasets.walk(self.path("walk"), empty=False), datasets.street(self.path("street"))]
        never = []
        for form in known:
            with self.subTest(form):
                exported = 0
                for number, scene in enumerate(scenes):
                    pair = len(load_json(scene)["cameras"]) > 1
                    ready = [one for one in known if pair or "disparity" not in known[one]]
                    alone = not exported or form not in ready
                    dataset, refused = self.rendered_for(form, scene) if alone else self.rendered_for_many(ready, scene)
                    if refused:
                        continue
                    one, two = self.path(f"{form}-1-{number}"), self.path(f"{form}-2-{number}")
                    done = self.dgtk_any("export", dataset, "--format", form, "-o", one, "--threads", 1, "--quiet")
                    if not done.returncode:
                        options = ("--format", form, "-o", two, "--threads", 3, "--link", "--quiet")
                        for share in () if exported else ("2/3", "0/3", "1/3"):
                            self.dgtk("export", dataset, *options, "--shard", share)
                        self.dgtk(*(("export", dataset, *options) if exported else ("merge", two)))
                        self.assert_same_files(one, two)
                        rows = self.referee(dataset, one)
                        self.assertGreater(len(rows["residuals"]), 1)
                        if not exported:
                            self.flip_bits(dataset, one)
                        exported += 1
                    else:
                        self.assertIn(":", done.stderr)
                if not exported:
                    never.append(form)
        self.assertEqual(never, [], "formats that no scene can be exported to")

    def flip_bits(self, dataset, folder):
        """A bit of a file of each kind; the referee counts them all, and names one of them."""
        kinds = {}
        for base, _, names in os.walk(folder):
            for name in sorted(names):
                kinds.setdefault(os.path.splitext(name)[1], []).append(os.path.join(base, name))
        rest = sorted(set(kinds.pop(".json")) - {os.path.join(folder, "export.json")})
        damaged = [random.Random(seed).choice(paths) for seed, paths in enumerate([*kinds.values(), rest]) if paths]
        for seed, path in enumerate(damaged):
            flip_bit(path, seed)
        done = self.dgtk("verify", dataset, "--export", folder, "--json", status=1)
        [row] = [one for one in json.loads(done.stdout)["residuals"] if one["check"] == "hashes"]
        self.assertEqual(row["bad"], len(damaged))
        self.assertIn(os.path.join(folder, row["worst"]["file"]), damaged)
        self.assertIn(row["worst"]["file"], done.stderr)

    def test_each_bit_of_export_json_counts(self):
        """What no row compares, such as a convention's words, is in the document's hash of itself."""
        dataset = self.render(datasets.walk(self.path("scene")))
        folder, _ = self.export(dataset, "coco")
        path = os.path.join(folder, "export.json")
        with open(path, "rb") as file:
            whole = file.read()
        for seed in range(12):
            flip_bit(path, seed)
            done = self.ran("verify", dataset, "--export", folder)
            self.assertIn(done.returncode, (1, 2, 3), seed)
            self.assertEqual(done.returncode == 1 and "export.json" not in done.stderr, False, done.stderr)
            with open(path, "wb") as file:
                file.write(whole)
        for old, new in ((b"(0.5, 0.5)", b"(0.5, 0.0)"), (b'"sha256": "' + whole[-68:-4], b'"sha257": "' + whole[-68:-4])):
            self.assertEqual(whole.count(old), 1)
            with open(path, "wb") as file:
                file.write(whole.replace(old, new))
            self.assertIn("export.json", self.dgtk("verify", dataset, "--export", folder, status=1).stderr)

    def test_names_of_a_camera(self):
        """Are files, all or none."""
        dataset = self.render(datasets.walk(self.path("scene")))
        folder, record = self.export(dataset, "coco")
        record["names"][1]["name"] = "no file"
        self.written({os.path.join(folder, "export.json"): datasets.sealed(record)})
        [row] = [one for one in self.referee(dataset, folder, 1)["residuals"] if one["layer"] == "record"]
        self.assertEqual((row["bad"], row["worst"]["value"]), (1, "some names are no files (Kamera 1)"))

    def test_names_that_differ_by_case_alone(self):
        """Have a number, since some systems would write one file over the other; other names do not."""
        path = datasets.stereo(self.path("scene"), 1)
        with open(path, encoding="utf-8") as file:
            scene = json.load(file)
        scene["cameras"] = [{**scene["cameras"][0], "name": name} for name in ("cam A.1", "Cam a.1", "cam b")]
        dataset = self.render(self.write(path, json.dumps(scene)), "color", "--for", "coco,yolo,voc,transforms,imagefolder,webdataset")
        for form in ("coco", "yolo", "voc", "transforms", "imagefolder", "webdataset"):
            _, record = self.export(dataset, form)
            files = [one["path"] for one in record["files"]]
            self.assertEqual(len({name.lower() for name in files}), len(files))
            names = {one["camera"]: one["name"] for one in record["names"]}
            self.assertIn("Cam_a_1_000000", names["Cam a.1"])
            self.assertIn("cam_A_1_2_000000", names["cam A.1"])
            self.assertIn("cam_b_000000", names["cam b"])

    def damaged_notes(self, command, unfinished):
        """What says more of itself than there is ends a run that goes on."""
        damaged = shutil.copytree(unfinished, self.path("damaged"))
        path = os.path.join(damaged, ".dgtk-journal-notes")
        with open(path, "rb") as file:
            sound = file.read()
        begin = 64 + 16  # behind the request's hash and the first record's head
        end = begin + struct.unpack_from("Q", sound, begin - 8)[0]
        note = begin + 8 + struct.unpack_from("Q", sound, begin)[0]
        while note < end:  # sizes of the list's name and of a text, name, text
            last, sizes = note, struct.unpack_from("QQ", sound, note)
            note += 16 + sum(sizes)
        self.assertEqual(note, end)
        for at, data in ((begin, b"\xff" * 16), (last, struct.pack("Q", sum(sizes) + 1)), (last + 8, struct.pack("Q", sizes[1] + 1))):
            with open(path, "wb") as file:
                file.write(sound[:at] + data + sound[at + len(data):])
            self.refused(*command[1:], "-o", damaged, "--resume", status=3, says=".dgtk-journal-notes: is damaged; start over")

    def test_killed_twenty_times_and_resumed(self):
        scene = datasets.walk(self.path("scene"), frames=60, empty=False)
        dataset = self.render(scene)
        whole, part = self.path("whole"), self.path("part")
        command = [DGTK, "export", dataset, "--format", "coco", "--image-format", "jpg", "--quiet"]
        self.dgtk(*command[1:], "-o", whole)
        files, killed = len(digests(whole)), 0
        for i in range(KILLS):
            shutil.rmtree(part, ignore_errors=True)
            process = subprocess.Popen([*command, "-o", part])
            while process.poll() is None and sum(len(names) for _, _, names in os.walk(part)) < files * i // KILLS:
                time.sleep(0.001)
            process.kill()
            process.wait()
            unfinished = not os.path.exists(os.path.join(part, "export.json"))
            killed += unfinished
            if unfinished and i == KILLS // 2:
                self.damaged_notes(command, part)
            self.dgtk(*command[1:], "-o", part, "--resume")
            self.assert_same_files(whole, part)
        self.assertGreater(killed, KILLS // 2)

    def test_shares_that_are_killed_lost_or_damaged(self):
        dataset = self.render(datasets.walk(self.path("scene"), frames=30, empty=False))
        whole, part = self.path("whole"), self.path("part")
        command = [DGTK, "export", dataset, "--format", "coco", "--quiet"]
        self.dgtk(*command[1:], "-o", whole)
        for i in range(KILLS // 2):
            process = subprocess.Popen([*command, "-o", part, "--shard", f"{i % 2}/3"])
            time.sleep(0.02 + 0.02 * i)
            process.kill()
            process.wait()
        for share in ("1/3", "0/3", "1/3"):
            self.dgtk(*command[1:], "-o", part, "--shard", share)
        self.assertEqual(set(self.rates(*command[2:-1], "-o", part, "--shard", "1/3")), {0}, "it was all there")
        self.refused("merge", part, status=1, says=("10 of 30 blocks are missing", "shares 2 of 3; --array=0-2)"))
        self.assertFalse(os.path.exists(os.path.join(part, "export.json")))
        self.dgtk(*command[1:], "-o", part, "--shard", "2/3")
        blocks = os.path.join(part, ".dgtk-parts")
        shutil.rmtree(os.path.join(blocks, "000004"))
        [picture] = [os.path.join(base, name) for base, _, names in os.walk(os.path.join(blocks, "000006")) for name in names if name.endswith(".png")]
        with open(picture, "ab") as file:
            file.write(b"!")
        report = json.loads(self.dgtk("merge", part, "--json", status=1).stdout)
        self.assertEqual((report["missing"], report["shares"], report["array"]), ([4, 6], {"3": "0-1"}, "0-1"))
        done = self.refused("export", dataset, "--format", "yolo", "-o", part, "--shard", "0/3", status=2,
                            says=f"{part}: holds an unfinished run of another request, in parts; remove its .dgtk-parts, or name another folder")
        self.assertNotIn("--replace", done)
        for option in ("--resume", "--replace"):
            self.refused(*command[1:], "-o", part, option, status=2, says=".dgtk-parts: parts of a run wait to be merged")
        for share in ("0/3", "1/3"):
            self.dgtk(*command[1:], "-o", part, "--shard", share)
        self.dgtk("merge", part)
        self.assert_same_files(whole, part)
        self.dgtk("export", dataset, "--format", "coco", "-o", part, "--quiet", "--shard", "0/2")  # whole already
        self.assert_same_files(whole, part)

    def test_links_are_made_again(self):
        """Of an export that was killed, which knows what it was going to write."""
        dataset = self.render(datasets.walk(self.path("scene")))
        command = ("export", dataset, "--format", "imagefolder", "--link", "--quiet", "-o", self.path("linked"))
        self.dgtk(*command)
        whole, record = digests(self.path("linked")), load_json(self.path("linked", "export.json"))
        linked = [one["path"] for one in record["files"] if os.stat(self.path("linked", one["path"])).st_nlink > 1]
        self.assertGreater(len(linked), 0)
        os.remove(self.path("linked", "export.json"))
        self.write("linked/.dgtk-journal", f"DGTk journal 1 {record['request_hash']}\n" +
                   "".join(f"planned\t{one['path']}\n" for one in record["files"]))
        self.dgtk(*command, "--resume")
        self.assertEqual(digests(self.path("linked")), whole)
        with tempfile.TemporaryDirectory(prefix="dgtk-", dir="/dev/shm") as memory:  # where links cannot lead: copies
            self.dgtk(*command[:-1], os.path.join(memory, "linked"))
            self.assertEqual(digests(os.path.join(memory, "linked")), whole)

    def test_another_export_is_not_mixed_in(self):
        dataset = self.render(datasets.walk(self.path("scene")))
        folder, _ = self.export(dataset, "coco")
        before = digests(folder)
        self.refused("export", dataset, "--format", "coco", "-o", folder, "--masks", "polygon", status=2, says=("another request", "--replace"))
        self.dgtk("export", dataset, "--format", "coco", "-o", self.path("steps"), "--quiet", "--frames", "0:2:2")
        self.refused("export", dataset, "--format", "coco", "-o", self.path("steps"), "--frames", "0:2:1", "--resume", status=2, says="another request")
        with open(os.path.join(self.path("steps"), ".dgtk-journal"), "w", encoding="ascii") as journal:
            fcntl.flock(journal, fcntl.LOCK_EX)
            self.refused("export", dataset, "--format", "coco", "-o", self.path("steps"), status=75, says="another run is writing into this folder")
        self.refused("export", dataset, "--format", "coco", "-o", dataset, status=2, says="the dataset's own folder")
        self.refused("export", dataset, "--format", "coco", "-o", self.path("scene"), status=2, says="name a new or an empty folder")
        self.assertEqual(digests(folder), before)
        self.write(os.path.join(os.path.basename(folder), "notes.txt"), "mine")
        self.dgtk("export", dataset, "--format", "coco", "-o", folder, "--masks", "polygon", "--replace", "--quiet")
        self.assertTrue(os.path.exists(os.path.join(folder, "notes.txt")))
        planned = sorted(one["path"] for one in load_json(os.path.join(folder, "export.json"))["files"] if one["path"].endswith(".png"))
        for name in (planned[0], planned[-1]):  # each is looked for
            jpegs = self.path("jpegs of " + os.path.basename(name))
            self.dgtk("export", dataset, "--format", "coco", "--image-format", "jpg", "-o", jpegs, "--quiet")
            self.write(os.path.join(jpegs, name), "mine")
            self.refused("export", dataset, "--format", "coco", "-o", jpegs, "--replace", status=2, says=(name, "is in the way"))
        self.refused("verify", self.render(datasets.stereo(self.path("other"))), "--export", folder, status=2, says="another dataset")

    def test_refusals(self):
        dataset = self.render(datasets.walk(self.path("scene")), "color")
        target = self.path("target")
        whole = self.render(self.path("scene", "walk.json"))
        for says, *more in (("did you mean coco", "cocoo"), ("did you mean", "coco", "--cameras", "Kamera 2"),
                            ("none of the dataset's pictures", "coco", "--frames", "7:9"), ("--split: expected", "coco", "--split", "train"),
                            ("--out-of-range: expected one of void, refuse", "coco", "--out-of-range", "clamp")):
            self.refused("export", whole, "--format", *more, "-o", target, status=2, says=says)
            self.assertFalse(os.path.exists(target))
        for says, *splits in (("NAME=A:B", "=0:1", "train=0", "train:0=1", "train=0:x", "train=0:1x", "train=:1"), ("A <= B", "train=1:0", "a b=0:1"),
                              ("do not overlap", "train=0:1,val=1:2", "val=1:2,train=0:1", "train=0:2,val=1:1", "train=0:0,train=1:1"),
                              ("frames of the dataset", "train=0:0,val=9:10")):
            for split in splits:
                self.refused("export", whole, "--format", "coco", "-o", target, "--split", split, status=2, says=("--split: expected", says))
        for says, *more in (("lacks layers", "coco"),):
            self.refused("export", dataset, "--format", *more, "-o", target, status=2, says=says)
            self.assertFalse(os.path.exists(target))
        self.refused("export", self.path("scene"), "--format", "coco", "-o", target, status=3, says="scene")
        self.refused("export", dataset, "-o", target, status=2, says="--format")

    def test_pinhole_twins_take_the_place_of_lenses(self):
        """Nothing is rendered anew: the twin is in the dataset, or the line says which one is needed."""
        dataset = self.render(datasets.twins(self.path("twins")), "color,depth")
        self.refused("export", dataset, "--format", "tum", "-o", self.path("no"), status=2, says="render a pinhole twin")
        folder, record = self.export(dataset, "tum", "--undistort", "--cameras", "fish.auge")
        self.assertEqual([(one["camera"], one["frame"]) for one in record["names"]], [("fish flach", 0), ("fish flach", 1)])
        _, record = self.export(dataset, "tum", "--undistort")
        self.assertEqual(sorted({one["camera"] for one in record["names"]}), ["a wider view", "fish flach"])
        # the twin looks where the lens does, and has its size where there is one of that; names do not decide
        path = datasets.twins(self.path("more"))
        scene = load_json(path)
        for camera in scene["cameras"]:  # rolled about t, which stays
            camera["lookAt"] = [0, 0, 0]
        flat = scene["cameras"][-1]
        scene["cameras"] += [{**flat, "name": "a small one", "width": 24, "height": 18}, {**flat, "name": "another turn", "up": [1, 2, 0]}]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        _, record = self.export(self.render(path, "color,depth"), "tum", "--undistort", "--cameras", "fish.auge")
        self.assertEqual({one["camera"] for one in record["names"]}, {"fish flach"})
        lenses = self.render(datasets.lenses(self.path("lenses")), "color,depth")
        said = self.dgtk("export", lenses, "--format", "tum", "-o", self.path("no"), "--undistort", status=2).stderr
        self.assertIn("camera 'fish' (fisheye with distortion) needs a pinhole twin", said)
        self.assertIn('"K": [[40, 0, 47.5], [0, 40, 36.2], [0, 0, 1]]', said)
        self.assertEqual(len(said.splitlines()), 1)
        self.assertFalse(os.path.exists(self.path("no")))

    def test_a_skew_is_refused_where_only_focal_lengths_stand(self):
        path = datasets.stereo(self.path("scene"), 4)
        scene = datasets.load_json(path)
        for camera in scene["cameras"]:
            camera["K"] = [[80, 0.5, 48], [0, 80, 36], [0, 0, 1]]
        path = datasets._write(os.path.dirname(path), "skew", scene)
        for form, frames in (("bop", "0:1"), ("tum", "0:1"), ("gltf", "0:1"), ("spring", "1:2")):
            dataset = self.path("of_" + form)
            self.dgtk("render", path, "-o", dataset, "--for", form, "--frames", frames, "--quiet")
            self.refused("export", dataset, "--format", form, "-o", self.path("none"), status=2, says=form + ": camera 'left eye' has a skew")

    def test_a_full_disk_leaves_one_line_and_nothing_whole(self):
        dataset = self.render(datasets.stereo(self.path("scene")), datasets.LAYERS)
        folder = self.path("full")
        done = subprocess.run([DGTK, "export", dataset, "--format", "coco", "-o", folder, "--quiet"], capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000)))
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(folder, "export.json")))
        self.dgtk("export", dataset, "--format", "coco", "-o", folder, "--quiet", "--resume")
        self.referee(dataset, folder)

    def test_a_full_disk_before_the_notes_of_all_pictures(self):
        """Of small pictures the notes for the documents are the largest file."""
        dataset = self.render(datasets.walk(self.path("scene"), frames=12), datasets.LAYERS, "--size", "16x12")
        folder = self.path("full")
        for limit in (2000, 5000):
            done = subprocess.run([DGTK, "export", dataset, "--format", "coco", "-o", folder, "--quiet", "--resume"], capture_output=True, text=True,
                                  preexec_fn=lambda most=limit: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (4, 1), done.stderr)
            self.assertIn("/.dgtk-journal-notes: cannot be written: File too large", done.stderr)
            self.assertFalse(os.path.exists(os.path.join(folder, "export.json")))
        self.dgtk("export", dataset, "--format", "coco", "-o", folder, "--quiet", "--resume")
        self.referee(dataset, folder)

    def test_links_share_what_is_equal(self):
        dataset = self.render(datasets.walk(self.path("scene")))
        folder, _ = self.export(dataset, "coco", "--link")
        name = load_json(os.path.join(folder, "annotations", "instances_train.json"))["images"][0]["file_name"]
        ours = os.stat(os.path.join(dataset, "Kamera 1", "color", "000000.png"))
        self.assertEqual(os.stat(os.path.join(folder, "train", name)).st_ino, ours.st_ino)

    def test_what_an_old_export_lists_and_no_more(self):
        """Replaced are its files alone; nothing is read, changed or removed through a link that has taken a folder's place."""
        dataset = self.render(datasets.walk(self.path("scene")))
        folder, record = self.export(dataset, "coco")
        again = ("export", dataset, "--format", "coco", "-o", folder, "--quiet", "--replace")
        self.write(os.path.join(folder, "train", "mine.txt"), "mine")
        self.dgtk(*again, "--image-format", "jpg")
        names = sorted(os.listdir(os.path.join(folder, "train")))
        self.assertEqual([os.path.splitext(name)[1] for name in names], [".jpg"] * 4 + [".txt"])
        outside = self.path("outside")
        os.rename(os.path.join(folder, "train"), outside)
        os.symlink(outside, os.path.join(folder, "train"))
        for form in ((), ("--image-format", "jpg")):
            self.refused(*again, *form, status=2, says=("train/", "a link"))
        self.refused("verify", dataset, "--export", folder, status=3, says=("train/", "link"))
        self.assertEqual(sorted(os.listdir(outside)), names)
        self.assertTrue(os.path.exists(os.path.join(folder, "export.json")))

    def test_a_changed_dataset_is_not_exported(self):
        dataset = self.render(datasets.walk(self.path("scene")))
        picture = os.path.join(dataset, "Kamera 1", "color", "000001.png")
        with open(picture, "r+b") as file:
            whole = file.read()
            file.seek(200)
            file.write(b"\0\1\2")
        for link in ((), ("--link",)):
            self.refused("export", dataset, "--format", "coco", "-o", self.path("out", *link), "--quiet", *link, status=3, says=("000001.png", "manifest"))
        with open(picture, "wb") as file:
            file.write(whole)
        for layer, form in (("boxes", "coco"), ("depth", "tum")):  # of which values are taken, not bytes
            path = next(os.path.join(dataset, "Kamera 1", layer, name) for name in sorted(os.listdir(os.path.join(dataset, "Kamera 1", layer))) if name.startswith("000001"))
            with open(path, "ab") as file:
                file.write(b" ")
            self.refused("export", dataset, "--format", form, "-o", self.path("out", form), "--quiet", status=3, says=(path, "its size differs"))

    def test_the_referee_names_a_file_once(self):
        dataset, out = self.render(datasets.walk(self.path("scene"))), self.path("out")
        self.dgtk("export", dataset, "--format", "tum", "-o", out, "--quiet")
        verify = ("verify", dataset, "--export", out)

        def breach(line):
            done = self.dgtk(*verify, status=1)
            self.assertIn(line, done.stderr)

        listed = next(one for one in load_json(os.path.join(out, "export.json"))["files"] if one["path"].endswith(".png"))
        path = os.path.join(out, listed["path"])
        with open(path, "rb") as file:
            whole = file.read()
        with open(path, "ab") as file:
            file.write(b" ")
        breach(f"dgtk: {path}: found {len(whole) + 1} bytes, expected {len(whole)} bytes (")
        os.remove(path)
        breach(f"dgtk: {path}: found no file, expected {len(whole)} bytes (")
        with open(path, "wb") as file:
            file.write(whole)
        depth = os.path.join(dataset, "Kamera 1", "depth", "000001.npy")
        os.rename(depth, depth + ".gone")
        breach(f"dgtk: {out}/export.json: found {depth}: cannot be read: ")
        os.rename(depth + ".gone", depth)
        os.remove(os.path.join(dataset, "objects.json"))
        self.refused(*verify, status=3, says=f"dgtk: {dataset}/objects.json: no such file")


if __name__ == "__main__":
    main()
