# SPDX-License-Identifier: BSD-3-Clause
"""An interrupted run is completed by --resume, and ends in the bytes of an uninterrupted one."""
import fcntl
import json
import os
import re
import signal
import subprocess
import time
import unittest

import numpy

import pictures
from harness import DGTK, SCENES, digests, ended, load_json, main
from many_runs import ManyCase

SCENE = os.path.join(SCENES, "fig_4_14_bouncing_ball.scene")
OPTIONS = ("--quiet", "--layers", "color,depth,objects,calibration", "--size", "160x120")


class Resume(ManyCase):
    def interrupt(self, folder, how, options=OPTIONS, files=12):
        """Starts a run and sends `how` as soon as more than so many files are there; returns its exit status and what it said."""
        return self.interrupted(["render", SCENE, "-o", folder, *options], folder, how,
                                lambda: sum(len(names) for _, _, names in os.walk(folder)) > files)

    def unfinish(self, folder, lost=1):
        """Makes of a dataset what a run that was killed leaves, without the last files."""
        manifest = load_json(os.path.join(folder, "manifest.json"))
        files = [f for f in manifest["files"] if "frame" in f]
        for _ in range(lost):
            os.remove(os.path.join(folder, files.pop()["path"]))
        for name in ("manifest.json", "cameras.json", "objects.json", "poses.json", "scene.json"):
            os.remove(os.path.join(folder, name))
        with open(os.path.join(folder, ".dgtk-journal"), "w", encoding="utf-8") as journal:
            journal.write(f"DGTk journal 1 {manifest['request_hash']}\n")
            for f in files:
                journal.write("\t".join([f["sha256"], str(f["bytes"]), str(f["frame"]), f["layer"], f["camera"], f["path"]]) + "\n")

    def test_interrupt_and_kill(self):
        self.dgtk("render", SCENE, "-o", self.path("whole"), *OPTIONS)
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1, signal.SIGKILL):
            with self.subTest(how):
                folder = self.path(how.name)
                status, errors = self.interrupt(folder, how)
                if how != signal.SIGKILL:
                    self.assertEqual(status, 75, errors)
                    self.assertIn("--resume", errors)
                self.assertFalse(os.path.exists(os.path.join(folder, "manifest.json")))
                before = {n: os.stat(os.path.join(folder, n)).st_mtime_ns for n in digests(folder) if n.count("/") == 2
                          and not n.endswith(".partial")}
                self.assertGreater(len(before), 0)
                self.dgtk("render", SCENE, "-o", folder, *OPTIONS, "--resume")
                self.assert_same_files(self.path("whole"), folder)
                kept = [n for n, t in before.items() if os.stat(os.path.join(folder, n)).st_mtime_ns == t]
                self.assertGreater(len(kept), 0, "nothing was kept")

    def test_below_nohup_a_run_goes_on(self):
        command = ["nohup", DGTK, "render", SCENE, "-o", self.path("out"), *OPTIONS]
        with ended(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)) as process:
            while process.poll() is None and not os.path.isdir(self.path("out", "Camera0", "color")):
                time.sleep(0.002)
            self.assertIsNone(process.poll(), "it ended first")
            process.send_signal(signal.SIGHUP)
            self.assertEqual(process.wait(timeout=300), 0)

    def test_two_writers_of_a_file(self):
        with open(self.write("x.pov.partial", "half"), encoding="ascii") as other:
            fcntl.flock(other, fcntl.LOCK_EX)
            self.refused("convert", SCENE, self.path("x.pov"), status=75, says=self.path("x.pov") + ": another process is writing it")
        self.dgtk("convert", SCENE, self.path("x.pov"))
        self.assertFalse(os.path.exists(self.path("x.pov.partial")))

    def test_two_runs_in_a_folder(self):
        """The later one may be tried again, when the first has ended."""
        folder = self.path("busy")
        os.mkdir(folder)
        with open(self.write("busy/.dgtk-journal", f"DGTk journal 1 {64 * '0'}\n"), encoding="ascii") as journal:
            fcntl.flock(journal, fcntl.LOCK_EX)
            self.refused("render", SCENE, "-o", folder, *OPTIONS, status=75, says="another run is writing into this folder")

    def test_interrupt_within_a_picture(self):
        """A large picture is not waited for."""
        options = ("--quiet", "--layers", "color,depth", "--size", "256x16000", "--tile", "256x16", "--frames", "0:0")
        folder = self.path("part")
        status, errors = self.interrupt(folder, signal.SIGINT, options, 1)
        self.assertEqual(status, 75, errors)
        self.assertEqual([n for n in digests(folder) if n.endswith((".png", ".npy", ".exr"))], [])
        self.dgtk("render", SCENE, "-o", folder, *options, "--resume")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *options)
        self.assert_same_files(self.path("whole"), folder)

    @unittest.skipIf(os.environ.get("DGTK_TEST_SANITIZED"), "sanitizers start before what is preloaded")
    def test_a_block_lost_on_the_way_to_the_disk(self):
        """Who waits for the disk beside the work is told of it, and the system tells only once."""
        options = ("--quiet", "--layers", "depth", "--size", "1024x768", "--frames", "0:2")  # 18 MiB
        folder = self.path("lost")
        lost = os.path.join(os.environ["DGTK_BUILD"], "lib", "libdgtk_lost_block.so")
        done = self.dgtk("render", SCENE, "-o", folder, *options, status=4, environment={"LD_PRELOAD": lost})
        self.assertEqual(done.stderr, f"dgtk: {folder}: cannot be written: Input/output error\n")
        self.assertFalse(os.path.exists(os.path.join(folder, "manifest.json")))
        self.dgtk("render", SCENE, "-o", folder, *options, "--resume")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *options)
        self.assert_same_files(self.path("whole"), folder)

    def test_pictures_that_are_kept_do_not_count_in_the_rate(self):
        self.write("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        scene = self.write("s.json", json.dumps({"keyFrames": [0, 199], "objects": [{"model": "quad.obj"}],
                                                 "cameras": [{"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}))
        render = ("render", scene, "-o", self.path("d"), "--layers", "depth", "--size", "16x12")
        self.dgtk(*render, "--quiet")
        self.unfinish(self.path("d"), 100)
        said = self.dgtk(*render, "--resume", environment={"DGTK_PROGRESS": "0.01"}).stderr
        told = [(int(done), float(rate)) for done, rate in re.findall(r"(?m)^(\d+)/200 pictures, ([\d.]+)/s, \S+ left$", said)]
        self.assertEqual(told[0], (0, 0))
        self.assertGreater(len(told), 1, said)
        for done, rate in told[1:]:  # 0.01 s or more after the first line
            self.assertLessEqual(rate, (done - 100) / 0.01)

    def test_a_second_interrupt_ends_the_program_at_once(self):
        """While the only row of tiles of a picture is drawn, between whose ends nothing looks for the first one."""
        words = [DGTK, "render", SCENE, "-o", self.path("x"), "--quiet", "--layers", "color", "--size", "4096x4096", "--tile", "4096x4096",
                 "--samples", "16", "--visibility", "ray", "--frames", "0", "--threads", "1"]
        with ended(subprocess.Popen(words)) as process:
            def told(name):
                with open(f"/proc/{process.pid}/{name}", encoding="utf-8") as file:
                    return file.read()

            def until(holds):
                while process.poll() is None and not holds():
                    time.sleep(0.002)

            catches = lambda: int(re.search(r"SigCgt:\s*(\w+)", told("status")).group(1), 16) >> (signal.SIGINT - 1) & 1
            spent = lambda: int(told("stat").rsplit(")", 1)[1].split()[11]) / os.sysconf("SC_CLK_TCK")  # s
            until(lambda: os.path.isdir(self.path("x", "Camera0", "color")))
            before = spent()
            until(lambda: spent() > before + 0.3)  # it draws
            process.send_signal(signal.SIGINT)
            until(lambda: not catches())
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=300), -signal.SIGINT)

    def test_another_request_is_not_mixed_in(self):
        folder = self.path("mixed")
        self.interrupt(folder, signal.SIGKILL)
        other = ("--quiet", "--layers", "depth", "--size", "64x48", "--frames", "0:3")
        before = digests(folder)
        self.refused("render", SCENE, "-o", folder, *other, "--resume", status=2, says="another request")
        for command in (["verify", folder], ["info", folder], ["compare", folder, folder], ["report", folder, "-o", self.path("report")]):
            self.refused(*command, status=3, says="holds an unfinished run: the same run with resume completes it")
        self.refused("render", SCENE, "-o", folder, *other, status=2, says=("unfinished run of another request", "--replace"))
        self.assertEqual(digests(folder), before)
        self.write("mixed/notes.txt", "mine")
        self.dgtk("render", SCENE, "-o", folder, *other, "--replace")
        with open(os.path.join(folder, "notes.txt"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "mine")
        os.remove(os.path.join(folder, "notes.txt"))
        self.dgtk("render", SCENE, "-o", self.path("clean"), *other)
        self.assert_same_files(self.path("clean"), folder)

    def test_changed_file_of_an_interrupted_run_is_rendered_again(self):
        folder = self.path("changed")
        self.interrupt(folder, signal.SIGKILL)
        victim = sorted(n for n in digests(folder) if n.endswith(".npy"))[0]
        with open(os.path.join(folder, victim), "ab") as file:
            file.write(b"x")
        self.dgtk("render", SCENE, "-o", folder, *OPTIONS, "--resume")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *OPTIONS)
        self.assert_same_files(self.path("whole"), folder)


    def test_an_unfinished_run_is_not_replaced_unasked(self):
        folder = self.path("run")
        self.interrupt(folder, signal.SIGKILL)
        before = digests(folder)
        self.refused("render", SCENE, "-o", folder, *OPTIONS, status=2, says=("unfinished run of the same request", "--resume", "--replace"))
        self.refused("render", SCENE, "-o", folder, *OPTIONS, "--resume", "--replace", status=2, says="exclude one another")
        self.assertEqual(digests(folder), before)
        self.dgtk("render", SCENE, "-o", folder, *OPTIONS, "--replace")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *OPTIONS)
        self.assert_same_files(self.path("whole"), folder)

    def test_a_finished_dataset_is_replaced_when_asked(self):
        one, other = (("--quiet", "--layers", layers, "--size", "64x48", "--frames", "0:3") for layers in ("depth,objects", "depth"))
        folder = self.path("d")
        self.dgtk("render", SCENE, "-o", folder, *one)
        whole = digests(folder)
        self.dgtk("render", SCENE, "-o", folder, *one)  # the same request is rendered anew
        self.assertEqual(digests(folder), whole)
        self.refused("render", SCENE, "-o", folder, *other, status=2, says=("finished dataset of another request", "--replace"))
        self.assertEqual(digests(folder), whole)
        self.dgtk("render", SCENE, "-o", folder, *other, "--replace")
        self.dgtk("render", SCENE, "-o", self.path("clean"), *other)
        self.assert_same_files(self.path("clean"), folder)

    def test_a_changed_model_or_texture_is_another_request(self):
        """The contents of the files that a scene names are part of what is resumed."""
        pictures.write_png(self.path("a.png"), numpy.zeros((1, 2, 3), numpy.uint8))
        with open(self.path("a.png"), "rb") as file:
            picture = file.read()
        files = {"a.obj": b"mtllib a.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n# 1",
                 "a.mtl": b"newmtl m\nKd 1 1 1\nmap_Kd a.png\n# 1", "a.png": picture + b"1"}
        for name, data in files.items():
            self.write(name, data)
        scene = self.write("s.json", json.dumps({
            "objects": [{"name": "a", "model": "a.obj"}], "keyFrames": [0, 3],
            "cameras": [{"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0], "width": 32, "height": 24}]}))
        render = ("render", scene, "-o", self.path("d"), "--quiet", "--layers", "depth")
        self.dgtk(*render)
        self.unfinish(self.path("d"))
        for name, data in files.items():
            with self.subTest(name):
                self.write(name, data[:-1] + b"2")  # the size tells nothing
                self.refused(*render, "--resume", status=2, says="unfinished run of another request")
                self.write(name, data)
        self.dgtk(*render, "--resume")

    def test_what_a_power_cut_leaves_is_not_kept(self):
        """Files with their names and sizes, and full of zeros."""
        render = ("render", SCENE, "--quiet", "--layers", "depth,objects", "--size", "64x48", "--frames", "0:3")
        self.dgtk(*render, "-o", self.path("whole"))
        self.dgtk(*render, "-o", self.path("d"))
        self.unfinish(self.path("d"))
        names = [n for n in digests(self.path("d")) if n.endswith((".npy", ".ppm"))]
        kept = {n: os.stat(self.path("d", n)).st_mtime_ns for n in names}
        with open(self.path("d", names[1]), "r+b") as file:
            size = os.path.getsize(file.name)
            file.truncate(0)
            file.truncate(size)
        self.dgtk(*render, "-o", self.path("d"), "--resume")
        self.assert_same_files(self.path("whole"), self.path("d"))
        self.assertTrue([n for n, t in kept.items() if os.stat(self.path("d", n)).st_mtime_ns == t], "nothing was kept")

    def test_every_seed_is_a_request_of_its_own(self):
        render = ("render", SCENE, "-o", self.path("d"), "--quiet", "--layers", "depth", "--size", "32x24", "--frames", "0:1")
        self.dgtk(*render, "--seed", "7")
        self.assertEqual(load_json(self.path("d", "manifest.json"))["request"]["seed"], "7")
        self.refused(*render, "--seed", "8", "--resume", status=2, says="another request")

    def test_the_name_of_a_scene_is_part_of_its_request(self):
        text = json.dumps({"cameras": [{"name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]})
        for name in ("a", "b"):
            self.dgtk("render", self.write(f"{name}.json", text), "-o", self.path(name), "--quiet", "--layers", "depth", "--size", "8x6")
        a, b = (load_json(self.path(name, "manifest.json")) for name in ("a", "b"))
        self.assertEqual(a["inputs"][0]["sha256"], b["inputs"][0]["sha256"])
        self.assertNotEqual(a["request_hash"], b["request_hash"])


if __name__ == "__main__":
    main()
