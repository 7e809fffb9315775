# SPDX-License-Identifier: BSD-3-Clause
"""Help, version, and wrong usage."""
import json
import os
import re
import subprocess
import time

from harness import DGTK, SCENES, SOURCE, digests, ended, main
from many_runs import ManyCase

SCENE = os.path.join(SCENES, "demo.json")


class Usage(ManyCase):
    def test_help_of_every_command(self):
        overview = self.dgtk("--help").stdout
        for command in ("render", "info", "convert", "compare", "list"):
            self.assertIn(f"\n  {command} ", overview)
            page = self.dgtk(command, "--help").stdout
            self.assertIn(f"usage: dgtk {command}", page)
            self.assertIn("--help", page)

    def test_version(self):
        self.assertRegex(self.dgtk("--version").stdout, r"^dgtk \d+\.\d+\.\d+\n$")

    def test_starts_without_the_libraries_of_decoders_and_windows(self):
        libraries = self.dgtk("--version", environment={"LD_TRACE_LOADED_OBJECTS": "1"}).stdout
        self.assertIn("libdgtkPipeline", libraries)
        for name in ("OpenImageIO", "avcodec", "Qt5", "assimp"):
            self.assertNotIn(name, libraries)

    def test_suggestions_are_the_nearest_words(self):
        """The first of the nearest ones, of those that at most half of the letters of the word must be changed for."""
        for word, suggestion in (("--jsn", "--json"), ("--jsson", "--json"), ("--ison", "--json"), ("--surfces", "--surfaces"),
                                 ("--sion", "--json"), ("--sizze", "--size"), ("--surf", "--size"), ("--sfcs", "--size"),
                                 ("--hlp", "--help"), ("--xyzwvu", ""), ("--qqqqqqqq", "")):
            with self.subTest(word):
                line = self.refused("info", SCENE, word, status=2, says="unknown option")
                self.assertIn(f"did you mean {suggestion}?" if suggestion else f"unknown option '{word}' (see", line)

    def test_wrong_usage_is_one_line_and_status_2(self):
        self.refused(status=2, says="a command is missing")
        self.refused("rendr", status=2, says="did you mean render?")
        self.refused("render", SCENE, "-o", self.path("x"), "--sice", "4x4", status=2, says="did you mean --size?")
        self.refused("render", SCENE, status=2, says="-o DIR")
        self.refused("render", status=2, says="too few arguments")
        self.refused("render", SCENE, "-o", self.path("x"), "--size", "640", status=2, says="expected WxH")
        self.refused("render", SCENE, "-o", self.path("x"), "--size", "0x10", status=2, says="--size width")
        self.refused("render", SCENE, "-o", self.path("x"), "--samples", "17", status=2, says="1 to 16")
        self.refused("render", SCENE, "-o", self.path("x"), "--layers", "depht", status=2, says="unknown layer 'depht'")
        for option in ("--layers", "--cameras", "--for"):
            self.refused("render", SCENE, "-o", self.path("x"), option, "", status=2, says=f"{option}: expected names, found ''")
        self.refused("render", SCENE, "-o", self.path("x"), "--cameras", "nobody", status=2, says="no camera 'nobody'")
        self.refused("render", SCENE, "-o", self.path("x"), "--frames", "3:1", status=2, says="A <= B")
        self.refused("render", SCENE, "-o", self.path("x"), "--frames", "0:100000", status=2, says="the scene has frames")
        self.refused("render", SCENE, "-o", self.path("x"), "--gl", "metal", status=2, says="expected one of")
        self.refused("render", SCENE, "-o", self.path("x"), "--depth-format", "jpg", status=2, says="--depth-format: expected some of npy,")
        self.refused("convert", SCENE, self.path("x.obj"), status=2, says="expected a name in .scene, .json or .pov")
        self.refused("info", self.path("nothing"), status=3, says="nothing: cannot be read: No such file or directory")
        self.refused("export", self.path("x"), "-o", self.path("y"), status=2, says="export needs a format")
        self.refused("list", "nothing", status=2, says="expected one of readers")
        self.refused("merge", self.path("nothing"), status=3, says="nothing: does not exist")
        self.refused("merge", SCENE, status=3, says="demo.json: is no folder")
        self.assertFalse(os.path.exists(self.path("x")))

    def test_nothing_is_written_into_a_dataset(self):
        """It would not be sound any more."""
        dataset = self.path("dataset")
        self.dgtk("render", SCENE, "-o", dataset, "--quiet", "--layers", "color,depth", "--size", "16x12", "--frames", "0")
        inside = os.path.join(dataset, "left", "more")
        self.refused("render", SCENE, "-o", inside, "--layers", "depth", status=2, says=("lies in the dataset in", "dataset;"))
        self.refused("export", dataset, "-o", inside, "--format", "tum", status=2, says="lies in the dataset in")
        self.refused("render", SCENE, "-o", inside, "--layers", "depth", "--shard", "0/2", status=2, says="lies in the dataset in")
        self.refused("export", dataset, "-o", inside, "--format", "tum", "--shard", "0/2", status=2, says="lies in the dataset in")
        os.mkdir(self.path("scenes"))
        self.write("scenes/one.json", json.dumps({"cameras": [{}]}))
        self.refused("render", self.path("scenes"), "-o", inside, "--layers", "depth", status=2, says="lies in the dataset in")
        recipe = os.path.join(SOURCE, "Data", "Recipes", "turntable.json")
        self.refused("sample", recipe, "-o", inside, "--samples", "0:0", status=2, says="lies in the dataset in")
        self.dgtk("verify", dataset)

    def test_closed_streams_are_no_files(self):
        """What is said of a run does not get into a file that took the place of standard error; what cannot be said is an error."""
        render = ("render", SCENE, "-o", self.path("d"), "--layers", "depth,objects", "--size", "8x6", "--frames", "0")
        self.dgtk(*render)
        whole = digests(self.path("d"))
        subprocess.run(["sh", "-c", 'exec "$@" <&- 2>&-', "sh", DGTK, *render], check=True, env={**os.environ, "DGTK_PROGRESS": "0.01"})
        self.assertEqual(digests(self.path("d")), whole)
        done = subprocess.run(["sh", "-c", 'exec "$@" >&-', "sh", DGTK, "info", SCENE], stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (4, "dgtk: standard output cannot be written: Bad file descriptor\n"))

    def test_each_command_takes_its_number_of_arguments(self):
        for command, least, most in (("render", 1, 1), ("info", 1, 1), ("convert", 2, 2), ("verify", 1, 1), ("correspond", 1, 1),
                                     ("compare", 2, 2), ("warp", 1, 1), ("list", 0, 1)):
            with self.subTest(command):
                if least > 0:
                    self.refused(command, *["x"] * (least - 1), status=2, says="too few arguments; usage: dgtk " + command)
                self.refused(command, *["x"] * (most + 1), status=2, says="too many arguments; usage: dgtk " + command)

    def test_names_and_frames(self):
        words = ("render", SCENE, "-o", self.path("x"), "--layers", "depth")
        for names in (",", "depth,", ",depth", "depth,,objects"):
            self.refused("render", SCENE, "-o", self.path("x"), "--layers", names, status=2, says="--layers: an empty name")
        for frames, says in (("0:4:0", "STEP >= 1, found '0:4:0'"), ("0:4:-1", "STEP >= 1"), ("4:0", "A <= B"), ("a", "--frames"),
                             ("0:1:1:1", "--frames"), ("", "--frames"), ("0:", "--frames")):
            self.refused(*words, "--frames", frames, status=2, says=says)
        self.assertFalse(os.path.exists(self.path("x")))

    def test_lines_of_progress_come_as_often_as_asked(self):
        words = ("render", SCENE, "-o", self.path("x"), "--size", "16x12", "--layers", "depth")
        often = self.dgtk(*words, environment={"DGTK_PROGRESS": "0.01"}).stderr
        self.assertRegex(often, r"(?m)^0/\d+ pictures, 0\.000/s, \? left$")
        began = time.monotonic()
        usual = self.dgtk(*words[:3], self.path("y"), *words[4:]).stderr
        self.assertLessEqual(usual.count(" left"), (time.monotonic() - began) // 5)  # seconds
        for wrong in ("often", "0", "-1", "1e9", "nan", ""):
            done = self.dgtk(*words[:3], self.path("z"), *words[4:], status=2, environment={"DGTK_PROGRESS": wrong})
            self.assertIn("DGTK_PROGRESS: expected seconds from 0.01 to 3600", done.stderr)
        self.assertFalse(os.path.exists(self.path("z")))

    def test_what_is_left_of_a_long_run_is_told_in_hours(self):
        self.write("quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n")
        scene = self.write("long.json", json.dumps({"keyFrames": [0, 299999], "objects": [{"model": "quad.obj"}],
                                                    "cameras": [{"eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}))
        words = (DGTK, "render", scene, "-o", self.path("x"), "--layers", "color", "--size", "128x96", "--samples", "16", "--threads", "1")
        with ended(subprocess.Popen(words, stderr=subprocess.PIPE, text=True, env={**os.environ, "DGTK_PROGRESS": "0.01"})) as process:
            line = next(line for line in process.stderr if re.match("[1-9][0-9]*/", line))
        told = re.match(r"(\d+)/300000 pictures, ([\d.]+)/s, (\d+):([0-5]\d):([0-5]\d) left$", line)
        self.assertTrue(told, line)
        done, rate, hours, minutes, seconds = map(float, told.groups())
        left = 3600 * hours + 60 * minutes + seconds
        self.assertAlmostEqual(left * rate, 300000 - done, delta=0.01 * left + rate)  # the rate's last digit, and rounding

    def test_lists(self):
        for what, word in (("readers", "md2"), ("layers", "depth"), ("options", "points_step"), ("writers", "npy"), ("cameras", "orthographic"), ("gl", "egl")):
            self.assertIn(word, self.dgtk("list", what).stdout)
        everything = self.dgtk("list").stdout
        known = json.loads(self.dgtk("list", "--json").stdout)
        self.assertEqual([line.split()[0] for line in self.dgtk("list", "layers").stdout.splitlines()], [row["layer"] for row in known["layers"]])
        depth = next(row for row in known["layers"] if row["layer"] == "depth")
        self.assertEqual(("float64", "depth", ["depth_format"]), (depth["outputs"][0]["type"], depth["outputs"][0]["meaning"], depth["options"]))
        samples = next(row for row in known["options"] if row["name"] == "samples")
        self.assertEqual(("integer", 1, 16), (samples["kind"], samples["least"], samples["most"]))
        told = {row["name"]: {key: row[key] for key in ("kind", "least", "most", "choices") if key in row} for row in known["options"]}
        for name, expected in (("color_bits", {"kind": "choice", "choices": ["8", "16"]}), ("pack", {"kind": "switch"}),
                               ("matte", {"kind": "names"}), ("pov_position_colors", {"kind": "numbers"}),
                               ("samples", {"kind": "integer", "least": 1, "most": 16})):
            self.assertEqual(told[name], expected)
        for word in ("readers:", "layers:", "writers:", "cameras:", "gl:"):
            self.assertIn(word, everything)

    def test_the_page_of_layers_is_made_from_the_rows(self):
        script = os.path.join(SOURCE, "Utilities", "Maintenance", "update_tables")
        done = subprocess.run(["/usr/bin/python3", script, "--check", os.environ["DGTK"]], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_every_option_of_rows_is_one_of_the_command_line(self):
        page = self.dgtk("render", "--help").stdout
        for row in json.loads(self.dgtk("list", "options", "--json").stdout)["options"]:
            self.assertIn("--" + row["name"].replace("_", "-") + " ", page)


if __name__ == "__main__":
    main()
