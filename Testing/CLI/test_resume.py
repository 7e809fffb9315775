# SPDX-License-Identifier: BSD-3-Clause
"""An interrupted run is completed by --resume, and ends in the bytes of an uninterrupted one."""
import os
import signal
import subprocess
import time

from harness import DGTK, SCENES, Case, digests, main

SCENE = os.path.join(SCENES, "fig_4_14_bouncing_ball.scene")
OPTIONS = ("--quiet", "--layers", "color,depth,objects,calibration", "--size", "320x240")


class Resume(Case):
    def interrupted(self, folder, how, options=OPTIONS, files=12):
        """Starts a run and sends `how` as soon as more than so many files are there."""
        process = subprocess.Popen([DGTK, "render", SCENE, "-o", folder, *options], stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline and process.poll() is None:
            if sum(len(names) for _, _, names in os.walk(folder)) > files:
                process.send_signal(how)
                break
            time.sleep(0.002)
        _, errors = process.communicate(timeout=120)
        return process.returncode, errors

    def test_interrupt_and_kill(self):
        self.dgtk("render", SCENE, "-o", self.path("whole"), *OPTIONS)
        for how in (signal.SIGINT, signal.SIGKILL):
            with self.subTest(how):
                folder = self.path(how.name)
                status, errors = self.interrupted(folder, how)
                if how == signal.SIGINT:
                    self.assertEqual(status, 4, errors)
                    self.assertIn("--resume", errors)
                self.assertFalse(os.path.exists(os.path.join(folder, "manifest.json")))
                before = {n: os.stat(os.path.join(folder, n)).st_mtime_ns for n in digests(folder) if n.count("/") == 2
                          and not n.endswith(".partial")}
                self.assertGreater(len(before), 0)
                self.dgtk("render", SCENE, "-o", folder, *OPTIONS, "--resume")
                self.assert_same_files(self.path("whole"), folder)
                kept = [n for n, t in before.items() if os.stat(os.path.join(folder, n)).st_mtime_ns == t]
                self.assertGreater(len(kept), 0, "nothing was kept")

    def test_interrupt_within_a_picture(self):
        """A large picture is not waited for."""
        options = ("--quiet", "--layers", "color,depth", "--size", "256x12000", "--tile", "256x16", "--frames", "0:0")
        folder = self.path("part")
        status, errors = self.interrupted(folder, signal.SIGINT, options, 1)
        self.assertEqual(status, 4, errors)
        self.assertEqual([n for n in digests(folder) if n.endswith((".png", ".npy", ".exr"))], [])
        self.dgtk("render", SCENE, "-o", folder, *options, "--resume")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *options)
        self.assert_same_files(self.path("whole"), folder)

    def test_another_request_is_not_mixed_in(self):
        folder = self.path("mixed")
        self.interrupted(folder, signal.SIGKILL)
        other = ("--quiet", "--layers", "depth", "--size", "64x48", "--frames", "0:3")
        self.refused("render", SCENE, "-o", folder, *other, "--resume", status=2, says="another request")
        self.dgtk("render", SCENE, "-o", folder, *other)
        self.dgtk("render", SCENE, "-o", self.path("clean"), *other)
        self.assert_same_files(self.path("clean"), folder)

    def test_changed_file_of_an_interrupted_run_is_rendered_again(self):
        folder = self.path("changed")
        self.interrupted(folder, signal.SIGKILL)
        victim = sorted(n for n in digests(folder) if n.endswith(".npy"))[0]
        with open(os.path.join(folder, victim), "ab") as file:
            file.write(b"x")
        self.dgtk("render", SCENE, "-o", folder, *OPTIONS, "--resume")
        self.dgtk("render", SCENE, "-o", self.path("whole"), *OPTIONS)
        self.assert_same_files(self.path("whole"), folder)


if __name__ == "__main__":
    main()
