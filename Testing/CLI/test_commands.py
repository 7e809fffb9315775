# SPDX-License-Identifier: BSD-3-Clause
"""All that the commands say, compared whole: pages of help, tables, documents of a small scene that is worked out by hand."""
import json
import os
import subprocess

from harness import DGTK, SCENES, SOURCE, main
from many_runs import ManyCase

HELP = {
    "merge": ("DIR", "Makes one dataset, or export, of a run in shards; names what is missing and exits with 1 then.", [
        ("--json", "print one JSON object")]),
    "sample": ("SCENE", "Draws plain scenes from one with random values.", [
        ("--output DIR", "folder of the scenes"),
        ("--samples A:B", "numbers of the samples, both included"),
        ("--seed N", "instead of the scene's seed"),
        ("--threads N", "threads to work with (0: all processors) [0]"),
        ("--replace", "remove the samples of an earlier run that the folder holds"),
        ("--quiet", "no progress and no messages"),
        ("--no-cache", "read models anew, and keep none of them for other runs")]),
    "info": ("FILE", "Tells what a scene, a model or a dataset holds.", [
        ("--json", "print one JSON object"),
        ("--size WxH", "of a scene: size of the images (default: the camera's own, else 640x480)"),
        ("--surfaces", "of a scene: world units per pixel over what each camera sees at its first frame"),
        ("--no-cache", "read models anew, and keep none of them for other runs")]),
    "convert": ("IN OUT", "Converts a scene between .scene and .json, and a scene or model to a POV-Ray scene .pov.", [
        ("--camera NAME", "for .pov: the camera (default: the scene's first)"),
        ("--frame N", "for .pov: the frame (default: the scene's first)"),
        ("--flat-ids", "for .pov: every object in the colour of its id, without light"),
        ("--shadows", "for .pov: objects cast shadows"),
        ("--no-cache", "read models anew, and keep none of them for other runs")]),
    "verify": ("DIR", "Derives anew what a dataset or a folder of samples claims, prints residuals; exits with 1 on a breach.", [
        ("--export DIR", "read an export of the dataset back and compare it, instead of the dataset itself"),
        ("--check NAME,...", "only these checks, by the names of the table [all]"),
        ("--json", "print one JSON object"),
        ("--write", "also write DIR/verification.json"),
        ("--threads N", "threads to work with (0: all processors) [0]")]),
    "correspond": ("SCENE", "Finds where image points of one view are in another, and whether they are seen there.", [
        ("--from CAM[@FRAME]", "first view (default frame: the scene's first)"),
        ("--to CAM[@FRAME]", "second view"),
        ("--points FILE|-", "image points x y, one a line, in pixels; - reads standard input"),
        ("--size WxH", "size of the images in pixels (default: the camera's own, else 640x480)"),
        ("--json", "print JSON"),
        ("--no-cache", "read models anew, and keep none of them for other runs")]),
    "compare": ("A B", "Compares two images or two datasets; exits with 1 if they differ.", [
        ("--tolerance LAYER:value=V,pixels=N,share=S",
         "pixels of the layer may differ by V, and N of them, or a share S of all, by more; may be repeated"),
        ("--json", "print one JSON object")]),
    "warp": ("LDI", "Renders a novel view from a layered depth image of a dataset.", [
        ("--output FILE.png", "the picture"),
        ("--to CAMERA", "a camera of the dataset, NAME[@FRAME], or a .json file with K, R, t, width, height"),
        ("--layers N", "use the first N surfaces of each pixel (1: a depth map); 0: all [0]"),
        ("--mask FILE.png", "also write where no sample fell (255)")]),
    "report": ("DATASET", "One page, for any browser and without a network, that shows what is in a dataset or in a folder of datasets.", [
        ("--output FILE.html", "the page"),
        ("--pictures N|all", "pictures that are shown, with all of their layers [48]"),
        ("--read N|all", "pictures that distributions are made from; those that are shown are among them [240]"),
        ("--seed N", "of which pictures these are [0]"),
        ("--verification FILE", "what dgtk verify DATASET --json printed (default: DATASET/verification.json)"),
        ("--export DIR", "an export of the dataset, whose rounding is shown; may be repeated"),
        ("--samples FILE", "samples.json of the scenes: what was refused (default: DATASET/samples.json)"),
        ("--threads N", "threads to work with (0: all processors) [0]"),
        ("--quiet", "no progress and no messages")]),
    "list": ("[readers|layers|options|writers|cameras|exporters|gl|commands]", "Lists what this program can read, derive and write.", [
        ("--json", "as JSON, with all that is known of commands, layers and options")]),
}


def page(command, arguments, help_, options):
    rows = [("-o, " if name.startswith("--output") else "    ") + name for name, _ in options] + ["-h, --help"]
    width = max(map(len, rows)) + 2
    texts = [text for _, text in options] + ["show this page"]
    return (f"usage: dgtk {command} {arguments} [options]\n\n{help_}\n\n"
            + "".join(f"  {row:{width}}{text}\n" for row, text in zip(rows, texts)))


class Number(str):
    """As the document has it: others write the same number with other digits."""


def compact(item):
    if isinstance(item, list):
        return "[" + ",".join(map(compact, item)) + "]"
    return item if isinstance(item, Number) else json.dumps(item)


def document(text):
    return json.loads(text, parse_float=Number)


def told(value, indent=""):
    """The lines that `dgtk info` prints of a JSON document."""
    text = ""
    for key, item in value.items():
        if isinstance(item, dict):
            text += f"{indent}{key}:\n" + told(item, indent + "  ")
        elif isinstance(item, list) and item and isinstance(item[0], dict):
            text += f"{indent}{key}:\n"
            for entry in item:
                block = told(entry, indent + "    ")
                text += indent + "  -" + block[len(indent) + 3:]
        else:
            shown = item if isinstance(item, str) else compact(item)
            text += f"{indent}{key}: {shown}\n"
    return text


LONG = {"render": "Renders images and ground truth of a scene, or of all scenes of a folder, into a folder.",
        "export": "Writes a dataset in the format of other people's tools."}


class Pages(ManyCase):
    def test_every_page_of_help(self):
        for command, (arguments, help_, options) in HELP.items():
            with self.subTest(command):
                self.assertEqual(self.dgtk(command, "--help").stdout, page(command, arguments, help_, options))
                self.assertEqual(self.dgtk(command, "-h").stdout, page(command, arguments, help_, options))
        rows = json.loads(self.dgtk("list", "options", "--json").stdout)["options"]
        layers = ",".join(row.split()[0] for row in self.dgtk("list", "layers").stdout.splitlines()
                          if row.split()[0] in ("color", "depth", "objects", "calibration"))
        options = [("--output DIR", "folder of the dataset"), ("--layers NAMES|all", f"what to write; see dgtk list layers [{layers}]"),
                   ("--for EXPORTER,...", "what these exports need, beside the layers that are given"),
                   ("--cameras NAMES", "some of the cameras (default: all)"), ("--frames A[:B[:STEP]]", "some of the frames (default: all)"),
                   ("--classes FILE", "numbers of the classes of scenes that fix none (default: of all scenes of a folder together)"),
                   ("--size WxH", "size of the images in pixels (default: the camera's own, else 640x480)")]
        for row in rows:
            value, default = row["value"], row["default"]
            options.append(("--" + row["name"].replace("_", "-") + (" " + value if value else ""),
                            row["help"] + (f" [{default}]" if value and default else "")))
        options += [("--shard I/N|auto", "a share of the run, from 0; dgtk merge ends it when all are there"),
                    ("--resume", "continue an interrupted run of the same request"),
                    ("--replace", "remove the dataset of another request, or an interrupted run, that the folder holds"),
                    ("--no-cache", "read models anew, and keep none of them for other runs"),
                    ("--timings", "print where processor time and memory went, at the end"),
                    ("--quiet", "no progress and no messages (environment DGTK_PROGRESS: seconds between its lines, else 5)")]
        self.assertEqual(self.dgtk("render", "--help").stdout,
                         page("render", "SCENE|FOLDER", "Renders images and ground truth of a scene, or of all scenes of a folder, into a folder.", options))

    def test_the_overview(self):
        expected = "usage: dgtk COMMAND [arguments] [options]\n\nImages and exact ground truth from described 3D scenes.\n\n"
        for command in ("render", "sample", "merge", "export", "info", "convert", "verify", "correspond", "compare", "warp", "report", "list"):
            help_ = HELP[command][1] if command in HELP else LONG[command]
            expected += f"  {command:12}{help_}\n"
        expected += "\ndgtk COMMAND --help tells more; dgtk --version prints the version.\n"
        for word in ("--help", "-h", "help"):
            self.assertEqual(self.dgtk(word).stdout, expected)

    def test_a_start_loads_no_library_of_what_few_commands_do(self):
        loaded = subprocess.run([DGTK], env={**os.environ, "LD_TRACE_LOADED_OBJECTS": "1"}, capture_output=True, text=True, timeout=60).stdout
        self.assertIn("libdgtkPipeline", loaded)
        for name in ("embree", "crypto", "vtkRendering", "libGL", "libX11", "opencv", "fcl", "Bullet", "OpenImageIO", "assimp"):
            self.assertNotIn(name, loaded)

    def test_every_table_has_the_rows_of_its_document(self):
        keys = {"readers": ["format", "extensions", "description"], "layers": ["layer", "formats", "description"],
                "options": ["name", "value", "default", "help"], "writers": ["format", "extension", "description"],
                "cameras": ["model", "description"], "exporters": ["format", "layers", "description"], "gl": ["backend", "state", "description"],
                "commands": ["command", "arguments", "help"]}
        everything = json.loads(self.dgtk("list", "--json").stdout)
        self.assertEqual(list(everything), list(keys))
        tables = []
        for section, columns in keys.items():
            with self.subTest(section):
                self.assertEqual(json.loads(self.dgtk("list", section, "--json").stdout), {section: everything[section]})
                rows = [[row[column] for column in columns] for row in everything[section]]
                widths = [max(len(row[i]) for row in rows) + 2 for i in range(len(columns) - 1)]
                text = "".join("  " + "".join(f"{cell:{width}}" for cell, width in zip(row, widths)) + row[-1] + "\n" for row in rows)
                self.assertEqual(self.dgtk("list", section).stdout, text)
                tables.append(f"{section}:\n{text}")
        self.assertEqual(self.dgtk("list").stdout, "\n".join(tables))

    def test_cameras_and_their_parameters(self):
        cameras = {row["model"]: row["parameters"] for row in json.loads(self.dgtk("list", "cameras", "--json").stdout)["cameras"]}
        told_of = lambda model: [(p["name"], p["unit"], p["counts"], p["default"], p["moves"]) for p in cameras[model]]
        self.assertEqual(told_of("pinhole"), [("fovY", "degrees", [1], [60], True), ("aspect", "", [1], [0], False), ("K", "pixels", [1], [], False),
                                              ("distortion", "", [4, 5, 8, 12, 14], [0, 0, 0, 0], False)])
        self.assertEqual(told_of("orthographic"), [("viewHeight", "scene units", [1], [2], True), ("aspect", "", [1], [0], False)])
        for model, parameters in cameras.items():
            for parameter in parameters:
                self.assertEqual(sorted(parameter), ["counts", "default", "description", "moves", "name", "unit"], model)
                self.assertTrue(parameter["description"], model)
                self.assertIsInstance(parameter["moves"], bool)

    def test_options_may_be_written_in_many_ways(self):
        scene = self.write("s.json", '{"cameras": [{"name": "c", "width": 8, "height": 4, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]}')
        size = lambda *words: [json.loads(self.dgtk("info", *words).stdout)["cameras"][0][key] for key in ("width", "height")]
        for words, expected in (((scene, "--json"), [8, 4]), (("--json", scene, "--size", "16x12"), [16, 12]),
                                ((scene, "--json", "--size=16X12"), [16, 12]), ((scene, "--json", "--size=16x12", "--size=32x24"), [32, 24]),
                                (("--json", "--size", "1048576x1", scene), [1048576, 1]), (("--json", "--", scene), [8, 4])):
            self.assertEqual(size(*words), expected, words)
        for words, says in ((("--json=1",), "--json takes no value"), (("--size",), "--size needs a value: --size WxH"),
                            (("--size", "16"), "--size: expected WxH, for example 640x480, found '16'"),
                            (("--size", "x12"), "--size width: expected an integer from 1 to 1048576, found ''"),
                            (("--size", "0x12"), "--size width: expected an integer from 1 to 1048576, found '0'"),
                            (("--size", "16x0"), "--size height: expected an integer from 1 to 1048576, found '0'"),
                            (("--size", "16x12x"), "--size height: expected an integer from 1 to 1048576, found '12x'"),
                            (("--size", "1048577x4"), "--size width: expected an integer from 1 to 1048576, found '1048577'"),
                            (("--size", "4x1048577"), "--size height: expected an integer from 1 to 1048576, found '1048577'"),
                            (("--", "--json"), "too many arguments; usage: dgtk info FILE [options] (see dgtk info --help)"),
                            (("--jason",), "unknown option '--jason', did you mean --json? (see dgtk info --help)")):
            self.assertEqual(self.refused("info", scene, *words, status=2), "dgtk: " + says)
        self.refused("info", "-", status=3, says="-: ")

    def test_progress_is_asked_for_in_seconds(self):
        words = ("render", os.path.join(SCENES, "demo.json"), "-o", self.path("x"), "--size", "640x480", "--layers", "depth,normal", "--frames", "0:2")
        for wrong in ("0.009", "3600.1", "1x", "1 ", "x", "1e400", "-5"):
            done = self.dgtk(*words, status=2, environment={"DGTK_PROGRESS": wrong})
            self.assertEqual(done.stderr, f"dgtk: DGTK_PROGRESS: expected seconds from 0.01 to 3600, found '{wrong}'\n")
        for right in ("0.01", "3600"):
            done = self.dgtk(*words, "--replace", environment={"DGTK_PROGRESS": right})
            lines = done.stderr.splitlines()
            self.assertRegex(lines[0], r"^0/\d+ pictures, 0\.000/s, \? left$")
            self.assertRegex(lines[-1], rf"^\d+ pictures, \d+ files in {self.path('x')}, \d+\.\d s$")
            self.assertEqual(sum("left" in line for line in lines) > 1, right == "0.01")


class Documents(ManyCase):
    """A wall of 12 x 8 at z = 0 and a square of 1 x 1 at z = 2 before cameras at z = 5 that see 90 degrees with 20 rows: 10 pixels are
    the depth."""

    def setUp(self):
        super().setUp()
        self.write("wall.obj", "v -6 -4 0\nv 6 -4 0\nv 6 4 0\nv -6 4 0\nf 1 2 3 4\n")
        self.write("block.obj", "v -0.5 -0.5 2\nv 0.5 -0.5 2\nv 0.5 0.5 2\nf 1 2 3\nv -0.5 0.5 2\nf 1 3 4\n")
        lens = {"fovY": 90, "width": 40, "height": 20, "near": 0.5, "far": 50}
        self.scene = self.write("s.json", json.dumps({
            "classes": {"flat": 7, "other": 9, "": 4},
            "objects": [{"name": "wall", "model": "wall.obj", "class": "flat"}, {"name": "gone", "model": "block.obj", "visible": False},
                        {"name": "block", "model": "block.obj"}],
            "lights": [{"name": "lamp", "enabled": False}],
            "cameras": [{"name": "a", **lens, "eye": [0, 0, 5], "lookAt": [0, 0, 0]},
                        {"name": "b", **lens, "width": 20, "eye": {"keys": [[0, [1, 0, 5]], [2, [3, 0, 5]]]},
                         "lookAt": {"keys": [[0, [1, 0, 0]], [2, [3, 0, 0]]]}},
                        {"name": "back", **lens, "eye": [0, 0, -5], "lookAt": [0, 0, -10]}]}))
        self.points = self.write("p.txt", "20.5 10.5\n24.5 10.5 # a comment\n17.5, 10.5\n10.5 10.5\n39.5 10.5\n")

    def rounded(self, value):
        if isinstance(value, list):
            return [self.rounded(item) for item in value]
        if isinstance(value, dict):
            return {key: self.rounded(item) for key, item in value.items()}
        return round(value, 9) + 0 if isinstance(value, float) else value

    def test_a_scene(self):
        def camera(name, width, x, z, pixels, smallest, median):
            return {"name": name, "model": "pinhole", "width": width, "height": 20, "K": [[10, 0, width / 2], [0, 10, 10], [0, 0, 1]],
                    "resolution": {"x": 4.95, "y": 4.95, "far_plane": {"x": 5, "y": 5}}, "R": [[1, 0, 0], [0, -1, 0], [0, 0, -1]],
                    "t": [x, 0, z], "near": 0.5, "far": 50,
                    "surfaces": {"pixels": pixels, "smallest": smallest, "median": median, "largest": median}}
        expected = {
            "file": self.scene,
            "objects": [{"id": 1, "name": "wall", "class": "flat", "class_id": 7, "model": self.path("wall.obj"), "triangles": 2},
                        {"id": 2, "name": "block", "class": "", "class_id": 4, "model": self.path("block.obj"), "triangles": 2}],
            "classes": [{"id": 4, "name": ""}, {"id": 7, "name": "flat"}, {"id": 9, "name": "other"}],
            "cameras": [camera("a", 40, 0, 5, 24 * 16, 0.3, 0.5), camera("b", 20, -1, 5, 20 * 16, 0.3, 0.5), camera("back", 40, 0, -5, 0, 0, 0)],
            "lights": [{"name": "lamp", "kind": "point", "enabled": False}],
            "first_frame": 0, "last_frame": 2, "key_frames": [0, 2], "warnings": []}
        found = json.loads(self.dgtk("info", self.scene, "--json", "--surfaces").stdout)
        self.assertEqual(self.rounded(found), expected)
        for words in ([], ["--json"]):
            self.assertNotRegex(self.dgtk("info", self.scene, *words).stdout, r"(?<![a-z])-0(\.0)?[^.0-9]", "zero has no sign")
        for row in found["cameras"]:
            del row["surfaces"]
        self.assertEqual(json.loads(self.dgtk("info", self.scene, "--json").stdout), found)
        self.assertEqual(self.dgtk("info", self.scene).stdout, told(document(self.dgtk("info", self.scene, "--json").stdout)))

    def test_models(self):
        for name in ("creature.md2", "crate.ac", "windmill.gltf"):
            path = os.path.join(SOURCE, "Data", "Models", name)
            with self.subTest(name):
                self.assertEqual(self.dgtk("info", path).stdout, told(document(self.dgtk("info", path, "--json").stdout)))
        found = json.loads(self.dgtk("info", os.path.join(SOURCE, "Data", "Models", "creature.md2"), "--json").stdout)
        self.assertEqual([tuple(a.values()) for a in found["animations"]],
                         [("stand", 0, 7, 7, 10), ("walk", 8, 19, 19, 10), ("jump", 20, 33, 33, 10)])
        self.assertEqual(list(found["animations"][0]), ["name", "first", "last", "end", "fps"])
        self.assertEqual((found["frames"], found["animations_beside"], found["textures"]),
                         (34, [], [{"name": "models/creature/creature.png", "found": True}]))
        for option in (("--size", "4x3"), ("--surfaces",)):
            self.assertEqual(self.refused("info", path, *option, status=2), f"dgtk: {option[0]} is for a scene")
        empty = self.write("empty.ac", "AC3Db\nOBJECT world\nkids 0\n")
        self.assertEqual(json.loads(self.dgtk("info", empty, "--json").stdout)["bounds"], None)

    def test_datasets(self):
        out = self.path("out")
        self.dgtk("render", self.scene, "-o", out, "--quiet", "--layers", "depth", "--frames", "1:2", "--cameras", "a,b", "--visibility", "ray")
        found = json.loads(self.dgtk("info", out, "--json").stdout)
        self.assertEqual(found["cameras"], ["a", "b"])
        self.assertEqual((found["first_frame"], found["last_frame"], found["frames"]), (1, 2, 2))
        self.assertEqual(self.dgtk("info", out).stdout, told(document(self.dgtk("info", out, "--json").stdout)))
        self.assertEqual(self.dgtk("info", os.path.join(out, "manifest.json")).stdout, self.dgtk("info", out).stdout)
        here = [subprocess.run([DGTK, "info", name], cwd=out, capture_output=True, text=True, timeout=60) for name in ("manifest.json", ".")]
        self.assertEqual([(one.returncode, one.stdout) for one in here], 2 * [(0, here[1].stdout)], here[0].stderr)
        for name in (out, os.path.join(out, "manifest.json")):
            self.refused("info", name, "--surfaces", status=2, says="--surfaces is for a scene")
        self.refused("info", self.folder, status=3, says=f"{self.folder}: is not a dataset (expected a folder with manifest.json)")

    def test_points_in_another_view(self):
        """The eye of b is at x = 2 in frame 1. The third point is behind the square there, the fourth beside the picture."""
        expected = [([20.5, 10.5], [(0.15 - 2) * 10 / 3 + 10, 10.5], 1, "visible", 2, "block"), ([24.5, 10.5], [10.5, 10.5], 1, "visible", 1, "wall"),
                    ([17.5, 10.5], [3.5, 10.5], 2, "occluded", 1, "wall"), ([10.5, 10.5], [-3.5, 10.5], 4, "outside", 1, "wall"),
                    ([39.5, 10.5], None, 0, "no surface", 0, None)]
        keys = ("from", "to", "class", "visibility", "object", "name")
        words = ("correspond", self.scene, "--from", "a", "--to", "b@1")
        found = json.loads(self.dgtk(*words, "--points", self.points, "--json").stdout)
        self.assertEqual(self.rounded(found), self.rounded({"matches": [
            {key: value for key, value in zip(keys, row) if key != "name" or value} for row in expected]}))
        lines = self.dgtk(*words, "--points", self.points).stdout.splitlines()
        self.assertEqual(lines[:3], ["# from a@0 40x20", "# to b@1 20x20", "# x y x' y' class object"])
        self.assertEqual([[round(float(word), 9) for word in line.split()] for line in lines[3:-1]],
                         [self.rounded([*row[0], *row[1], float(row[2]), float(row[4])]) for row in expected[:-1]])
        self.assertEqual(lines[-1], "39.5 10.5 nan nan 0 0")
        piped = subprocess.run([DGTK, *words, "--points", "-"], input="20.5 10.5\n", capture_output=True, text=True, check=True)
        self.assertEqual(piped.stdout.splitlines(), lines[:4])
        behind = json.loads(self.dgtk("correspond", self.scene, "--from", "a", "--to", "back@2", "--points", self.points, "--json").stdout)
        self.assertEqual([(m["to"], m["class"], m["visibility"]) for m in behind["matches"]],
                         [(None, 5, "behind")] * 4 + [(None, 0, "no surface")])

    def late(self):
        """The scene, two frames of which the first is 3."""
        with open(self.scene, encoding="utf-8") as file:
            scene = json.load(file)
        for name, x in (("eye", [[3, [1, 0, 5]], [5, [3, 0, 5]]]), ("lookAt", [[3, [1, 0, 0]], [5, [3, 0, 0]]])):
            scene["cameras"][1][name] = {"keys": x}
        return self.write("late.json", json.dumps(scene))

    def test_views_are_at_the_first_frame(self):
        lines = self.dgtk("correspond", self.late(), "--from", "a", "--to", "b", "--points", self.points).stdout.splitlines()
        self.assertEqual(lines[:2], ["# from a@3 40x20", "# to b@3 20x20"])

    def test_views_and_points_that_are_refused(self):
        words = ("correspond", self.scene)
        points = ("--points", self.points)
        for arguments, says in ((("--to", "b", *points), "correspond needs --from (see dgtk correspond --help)"),
                                (("--from", "b", *points), "correspond needs --to (see dgtk correspond --help)"),
                                (("--from", "a", "--to", "b"), "correspond needs --points (see dgtk correspond --help)"),
                                (("--from", "d", "--to", "b", *points), "--from: the scene has no camera 'd'"),
                                (("--from", "a", "--to", "d@1", *points), "--to: the scene has no camera 'd'"),
                                (("--from", "a@3", "--to", "b", *points), "--from: frame: expected an integer from 0 to 2, found '3'"),
                                (("--from", "a", "--to", "b@-1", *points), "--to: frame: expected an integer from 0 to 2, found '-1'"),
                                (("--from", "a", "--to", "b", *points, "--size", "1048577x20"),
                                 "--size width: expected an integer from 1 to 1048576, found '1048577'")):
            self.assertEqual(self.refused(*words, *arguments, status=2), "dgtk: " + says)
        self.assertEqual(self.refused(*words, "--from", "a", "--to", "b", *points, "--size", "20x10", status=3),
                         f"dgtk: {self.points}:1: point (20.5, 10.5) is outside the image of camera 'a' (expected 0 to 20, 0 to 10)")
        one = self.write("one.txt", "1 1\n")
        wide = self.dgtk(*words, "--from", "a", "--to", "b", "--points", one, "--size", "1048576x2").stdout
        self.assertIn("# from a@0 1048576x2\n", wide)

    def test_what_becomes_pov(self):
        for arguments, says in ((("--camera", "bck"), "--camera: the scene has no camera 'bck', did you mean 'back'?"),
                                (("--camera", "zzzzzzzz"), "--camera: the scene has no camera 'zzzzzzzz'"),
                                (("--frame", "3"), "--frame: expected an integer from 0 to 2, found '3'"),
                                (("--frame", "-1"), "--frame: expected an integer from 0 to 2, found '-1'")):
            self.assertEqual(self.refused("convert", self.scene, self.path("x.pov"), *arguments, status=2), "dgtk: " + says)
        for option in (("--camera", "a"), ("--frame", "0"), ("--flat-ids",), ("--shadows",)):
            for names in ((self.scene, "x.json"), (self.path("wall.obj"), "x.pov")):
                self.assertEqual(self.refused("convert", names[0], self.path(names[1]), *option, status=2),
                                 f"dgtk: {option[0]} is for a scene that becomes .pov")
        self.assertFalse(os.path.exists(self.path("x.pov")))
        nobody = self.write("nobody.json", "{}")
        self.assertIn("has no camera (expected one for the POV-Ray scene)", self.refused("convert", nobody, self.path("x.pov"), status=3))
        place = lambda *words: self.dgtk("convert", self.scene, self.path("x.pov"), *words) and self.lines("x.pov")
        first, last, other = place(), place("--frame", "2"), place("--camera", "b", "--frame", "2")
        self.assertEqual(first[0], "// Camera 'a', frame 0.")
        self.assertEqual(last[0], "// Camera 'a', frame 2.")
        self.assertEqual(first[1:], last[1:])  # the first camera stands still
        self.assertEqual(other[0], "// Camera 'b', frame 2.")
        self.assertNotEqual(first[1:], other[1:])
        self.assertNotEqual(other[1:], place("--camera", "b")[1:])
        self.assertNotEqual(first[1:], place("--flat-ids")[1:])
        self.assertEqual((first.count("  no_shadow"), place("--shadows").count("  no_shadow")), (2, 0))
        self.dgtk("convert", self.late(), self.path("late.pov"))
        self.assertEqual(self.lines("late.pov")[0], "// Camera 'a', frame 3.")

    def lines(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read().splitlines()


if __name__ == "__main__":
    main()
