# SPDX-License-Identifier: BSD-3-Clause
"""dgtk verify: datasets as rendered pass, and each planted error is found and named by its file."""
import hashlib
import json
import os
import shutil
import struct
import subprocess
import tempfile

import numpy

from dataset_edits import Edits
import pictures
from harness import SCENES, load_json, main
from many_runs import ManyCase

LAYERS = "color,depth,distance,position,normal,uv,objectcoords,objects,parts,triangles,calibration,classes"
WIDTH, HEIGHT = 40, 36  # more than two chunks of 16 rows
PAIRS = ",correspondence,disparity,disparity_forward,disparity_backward,flow_forward,flow_backward,sceneflow"


def contents(path):
    with open(path, "rb") as file:
        return file.read()


class Spoiled(ManyCase):
    """One dataset, of which each case spoils a copy."""
    scene, options = "", ()

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = tempfile.mkdtemp(prefix="dgtk-verify-")
        if not cls.scene:
            return
        done = subprocess.run([os.environ["DGTK"], "render", os.path.join(SCENES, cls.scene), "-o", cls.whole, "--quiet",
                               "--size", f"{WIDTH}x{HEIGHT}", *cls.options], capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stderr)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.whole, ignore_errors=True)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.whole, self.path("set"), copy_function=shutil.copyfile)
        # Paths of models are relative to the dataset.
        for name in ("scene.json", "manifest.json", "objects.json"):
            text = contents(self.path("set", name)).decode()
            there = os.path.relpath(SCENES, self.whole).replace("Scenes", "")
            here = os.path.relpath(SCENES, self.path("set")).replace("Scenes", "")
            self.write(os.path.join("set", name), text.replace(there, here))
        self.accept("scene.json", "objects.json")

    def accept(self, *names):
        """Makes the manifest agree with files as they are, so that only what they say can betray them."""
        manifest = load_json(self.path("set", "manifest.json"))
        for entry in manifest["files"]:
            if entry["path"] in names:
                data = contents(self.path("set", entry["path"]))
                entry["bytes"], entry["sha256"] = len(data), hashlib.sha256(data).hexdigest()
        self.write(os.path.join("set", "manifest.json"), json.dumps(manifest))

    def found(self, name, check, *says):
        """verify fails, and names the file in one line on standard error by the check that sees it."""
        done = self.dgtk("verify", self.path("set"), status=1)
        line, = [line for line in done.stderr.splitlines() if line]
        self.assertTrue(line.startswith("dgtk: "), line)
        for text in (name, f"check {check}", *says):
            self.assertIn(text, line)
        return done

    def change(self, name, edit):
        """Replaces the values of a .npy file of the dataset."""
        values = numpy.load(self.path("set", name))
        numpy.save(self.path("set", name), edit(values))
        self.accept(name)

    def fill(self, name, value):
        """Replaces a picture of the dataset by one of one grey."""
        pictures.write_png(self.path("set", name), numpy.full((HEIGHT, WIDTH), value, numpy.uint8))
        self.accept(name)

    def edit(self, name, change):
        """Replaces a document of the dataset by what `change` makes of its JSON."""
        document = load_json(self.path("set", name))
        change(document)
        self.write(os.path.join("set", name), json.dumps(document))
        self.accept(name)


class Planted(Spoiled):
    """A moving stereo pair: pictures, geometry, and what relates views."""
    scene = "demo.json"
    options = ("--layers", LAYERS + PAIRS, "--pairs", "left:right,right:left+1", "--frames", "0:1",
               "--objects-format", "npy,ppm")

    def test_as_rendered(self):
        done = self.dgtk("verify", self.path("set"), "--json", "--write", "--threads", 2)
        report = json.loads(done.stdout)
        self.assertTrue(report["passed"])
        checks = {residual["check"] for residual in report["residuals"]}
        self.assertLessEqual({"hashes", "cameras", "depth", "objects", "calibration", "geometry", "motion", "class",
                              "forward-backward", "epipolar", "triangulation"}, checks)
        for residual in report["residuals"]:
            self.assertGreater(residual["count"], 0, residual)
            self.assertLessEqual(residual["skipped"] if residual["check"] in ("depth", "objects", "class", "motion") else 0,
                                 residual["count"] * 2e-3, residual)
        self.assertEqual(load_json(self.path("set", "verification.json")), report)
        self.assertEqual(report["dataset_manifest"], hashlib.sha256(contents(self.path("set", "manifest.json"))).hexdigest())
        # The report does not make the dataset another one, and does not depend on the threads.
        again = self.dgtk("verify", self.path("set"), "--json", "--threads", 1)
        self.assertEqual(again.stdout, done.stdout)
        table = self.dgtk("verify", self.path("set")).stdout
        self.assertIn("correspondence_right", table)
        self.assertNotIn("BREACH", table)

    def test_principal_point(self):
        cameras = load_json(self.path("set", "cameras.json"))
        cameras["cameras"][0]["K"][0][2] += 0.5
        self.write(os.path.join("set", "cameras.json"), json.dumps(cameras))
        self.accept("cameras.json")
        found = self.found("cameras.json", "cameras", "20.5", "expected 20 ")
        table = found.stdout
        row = next(line for line in table.splitlines() if "cv::projectPoints" in line)
        self.assertIn("5.00e-01", row)

    def test_camera_that_the_scene_has_not(self):
        self.edit("cameras.json", lambda document: document["cameras"][0].update(name="middle"))
        self.refused("verify", self.path("set"), status=3, says="cameras.json: camera 'middle' is not in the scene")

    def test_distance_for_depth(self):
        shutil.copy(self.path("set", "left", "distance", "000001.npy"), self.path("set", "left", "depth", "000001.npy"))
        self.accept("left/depth/000001.npy")
        self.found("left/depth/000001.npy", "depth")

    def test_one_id(self):
        def flip(ids):
            ids[HEIGHT // 2, WIDTH // 2] ^= 3
            return ids

        self.change("right/objects/000000.npy", flip)
        self.found("right/objects/000000.npy: pixel (20, 18)", "objects")

    def test_flow_transposed(self):
        name = self.path("set", "left", "flow_forward", "000000.flo")
        data = contents(name)
        flow = numpy.frombuffer(data, "<f4", offset=12).reshape(HEIGHT, WIDTH, 2)
        with open(name, "wb") as file:
            file.write(data[:12] + flow[..., ::-1].tobytes())
        self.accept("left/flow_forward/000000.flo")
        self.found("left/flow_forward/000000.flo: pixel", "motion")

    def test_correspondence_by_half_a_pixel(self):
        self.change("left/correspondence_right/000000.npy", lambda values: values + [0.0, 0.5])
        table = self.found("left/correspondence_right/000000.npy: pixel", "motion", "5.00e-01 pixel").stdout
        row = next(line for line in table.splitlines() if line.startswith("epipolar"))
        self.assertIn("5.00e-01", row)
        self.assertIn("BREACH", row)

    def test_position_off_by_the_camera(self):
        self.change("left/position/000000.npy", lambda values: values * (1 + 1e-6))
        self.found("left/position/000000.npy", "calibration")

    def test_normals_of_the_other_side(self):
        self.change("left/normal/000000.npy", lambda values: -values)
        self.found("left/normal/000000.npy: pixel", "geometry")

    def test_truncated(self):
        name = self.path("set", "left", "depth", "000000.npy")
        data = contents(name)
        with open(name, "wb") as file:
            file.write(data[:-1000])
        self.found("left/depth/000000.npy", "hashes", f"{len(data) - 1000} bytes")
        self.accept("left/depth/000000.npy")
        self.found("left/depth/000000.npy", "depth")

    def test_one_byte(self):
        name = self.path("set", "left", "color", "000000.png")
        data = bytearray(contents(name))
        data[len(data) // 2] ^= 1
        with open(name, "wb") as file:
            file.write(data)
        self.found("left/color/000000.png", "hashes", "SHA-256")

    def test_missing_and_unlisted(self):
        os.remove(self.path("set", "right", "uv", "000001.npy"))
        self.found("right/uv/000001.npy", "hashes", "no file")
        shutil.copy(self.path("set", "right", "uv", "000000.npy"), self.path("set", "right", "uv", "000001.npy"))
        self.accept("right/uv/000001.npy")
        self.found("right/uv/000001.npy", "geometry")

    def test_unlisted(self):
        self.write(os.path.join("set", "left", "notes.txt"), "x")
        self.found("left/notes.txt", "hashes", "does not list")

    def test_another_scene(self):
        scene = load_json(self.path("set", "scene.json"))
        scene["objects"][1]["position"][0] += 0.01
        self.write(os.path.join("set", "scene.json"), json.dumps(scene))
        self.accept("scene.json")
        self.found("poses.json", "poses")

    def test_damaged_documents(self):
        for name in ("cameras.json", "objects.json", "scene.json"):
            with self.subTest(name):
                text = contents(self.path("set", name)).decode()
                self.write(os.path.join("set", name), text[:len(text) // 2])
                self.accept(name)
                self.found(name, "hashes")
                self.write(os.path.join("set", name), text)
                self.accept(name)

    def test_class_image(self):
        # Visible where the surface is hidden.
        self.fill("left/correspondence_right/000000.png", 1)
        self.found("left/correspondence_right/000000.png: pixel", "class", "found 1")


class PlantedObjects(Spoiled):
    """What belongs to rays and objects rather than to one pixel."""
    scene = "fig_4_7_stereo.json"
    options = ("--layers", "color,depth,objects,classes,ldi,boxes,amodal,points", "--points-step", "2")

    def test_as_rendered(self):
        report = json.loads(self.dgtk("verify", self.path("set"), "--json").stdout)
        counts = {(residual["check"], residual["layer"]): residual["count"] for residual in report["residuals"]}
        for row in (("ldi", "surfaces"), ("ldi", "first = depth"), ("ldi", "first = color"), ("partition", "amodal"),
                    ("boxes", "masks"),
                    ("boxes", "pose"), ("points", "tracks"), ("points", "visible"), ("points", "ply")):
            self.assertGreater(counts.get(row, 0), 0, row)
        amodal = next(row for row in report["residuals"] if row["layer"] == "amodal")
        objects = json.loads(contents(self.path("set", "objects.json")))["objects"]
        self.assertEqual(amodal["count"] + amodal["skipped"], 2 * WIDTH * HEIGHT * len(objects))

    def ldi(self, change):
        """Edits the records of the middle pixel: (count, offset of the first record) of a bytearray."""
        name = self.path("set", "left", "ldi", "000000.ldi")
        data, at = bytearray(contents(name)), 8
        for _ in range(HEIGHT // 2 * WIDTH + WIDTH // 2):
            at += 4 + 16 * struct.unpack_from("<I", data, at)[0]
        change(data, struct.unpack_from("<I", data, at)[0], at + 4)
        with open(name, "wb") as file:
            file.write(data)
        self.accept("left/ldi/000000.ldi")

    def test_ldi_without_its_first_surface(self):
        def drop(data, count, at):
            self.assertGreater(count, 1)
            struct.pack_into("<I", data, at - 4, count - 1)
            del data[at:at + 16]

        self.ldi(drop)
        self.found("left/ldi/000000.ldi: pixel (20, 18)", "ldi")

    def test_ldi_out_of_order(self):
        def swap(data, _, at):
            data[at:at + 16], data[at + 16:at + 32] = data[at + 16:at + 32], data[at:at + 16]

        self.ldi(swap)
        self.found("left/ldi/000000.ldi: pixel (20, 18)", "ldi")

    def test_ldi_of_another_color(self):
        def paint(data, _, at):
            data[at] ^= 64

        self.ldi(paint)
        self.found("left/ldi/000000.ldi: pixel (20, 18)", "ldi", "first = color")

    def test_ldi_truncated(self):
        name = self.path("set", "left", "ldi", "000000.ldi")
        data = contents(name)
        with open(name, "wb") as file:
            file.write(data[:-5])
        self.accept("left/ldi/000000.ldi")
        self.found("left/ldi/000000.ldi", "ldi", "ends at byte")

    def test_classes_of_one_value(self):
        self.fill("right/classes/000000.png", 200)
        self.found("right/classes/000000.png: pixel (0, 0)", "partition", "found 200")

    def test_amodal_mask_moved(self):
        def move(document):
            counts = document["masks"][1]["counts"]
            counts[0] += 3
            counts[-1] -= 3

        self.edit("left/amodal/000000.json", move)
        self.found("left/amodal/000000.json: pixel", "partition", "object")

    def test_boxes(self):
        def grow(document):
            document["objects"][2]["box_visible"][2] += 1

        self.edit("left/boxes/000000.json", grow)
        self.found("left/boxes/000000.json", "boxes", "object 3 box_visible")

    def test_pose_of_the_other_camera(self):
        other = load_json(self.path("set", "right", "boxes", "000000.json"))

        def take(document):
            document["objects"][2]["matrix"] = other["objects"][2]["matrix"]

        self.edit("left/boxes/000000.json", take)
        self.found("left/boxes/000000.json", "boxes", "object 3 matrix")

    def test_track_by_half_a_pixel(self):
        def shift(document):
            document["points"][100]["track"][-1][1] += 0.5

        self.edit("points/000000.json", shift)
        self.found("points/000000.json", "points", "point 100")

    def test_point_off_its_surface(self):
        # Farther away on the ray of its first pixel.
        def push(document):
            point, camera = document["points"][100], load_json(self.path("set", "cameras.json"))["cameras"][0]
            centre = -numpy.array(camera["R"]).T @ camera["t"]
            point["x"] = list(centre + 1.2 * (numpy.array(point["x"]) - centre))
            point["track"] = point["track"][:1]

        self.edit("points/000000.json", push)
        table = self.found("points/000000.ply", "points", "vertex 100").stdout
        self.assertIn("BREACH (1)", next(row for row in table.splitlines() if row.startswith("points       surface")))


class PlantedSamples(Spoiled):
    """What several samples of a pixel give."""
    scene = "fig_4_7_stereo.json"
    options = ("--layers", "objects,alpha,coverage,matting", "--matte", "vase", "--samples", "3")

    def test_as_rendered(self):
        report = json.loads(self.dgtk("verify", self.path("set"), "--json").stdout)
        counts = {(residual["check"], residual["layer"]): residual["count"] for residual in report["residuals"]}
        for row in (("alpha", "coverage"), ("alpha", "samples"), ("alpha", "alpha"), ("matting", "matting_vase")):
            self.assertGreater(counts.get(row, 0), 0, row)

    def test_alpha_and_coverage_of_other_views(self):
        name = os.path.join("coverage", "000000.exr")
        shutil.copy(self.path("set", "left", name), self.path("set", "right", name))
        self.accept("right/coverage/000000.exr")
        self.found("right/alpha/000000.png: pixel", "alpha")

    def test_composite_without_its_object(self):
        folder = self.path("set", "left", "matting_vase")
        shutil.copy(os.path.join(folder, "000000_background.png"), os.path.join(folder, "000000_composite.png"))
        self.accept("left/matting_vase/000000_composite.png")
        self.found("left/matting_vase/000000_composite.png: pixel", "matting")


    def test_without_a_picture_of_the_set(self):
        for missing in ("background", "foreground", "composite", "alpha", "trimap"):
            name = f"left/matting_vase/000000_{missing}.png"
            with self.subTest(missing):
                manifest = load_json(self.path("set", "manifest.json"))
                manifest["files"] = [entry for entry in manifest["files"] if entry["path"] != name]
                self.write(os.path.join("set", "manifest.json"), json.dumps(manifest))
                os.remove(self.path("set", name))
                self.dgtk("verify", self.path("set"))


class Placed(ManyCase):
    """Boxes before a wall, seen by cameras side by side, one raised, one turned and one far to the right."""

    def verified(self, offset, layers, *options):
        def box(name, position, scale):
            return {"name": name, "model": os.path.join(SCENES, "..", "Models", "crate.ac"),
                    "position": [a + b for a, b in zip(position, offset)], "scale": scale}

        def camera(name, x, y, target):
            return {"name": name, "width": 64, "height": 48, "fovY": 50, "near": 0.5, "far": 50,
                    "eye": [x + offset[0], y + offset[1], 5 + offset[2]],
                    "lookAt": [x + target + offset[0], y + offset[1], offset[2]]}

        scene = {"version": 1, "objects": [box("wall", [0, 0, -4], [40, 40, 1]), box("one", [-0.4, 0.1, 0], [1, 1, 1]),
                                           box("two", [0.7, -0.3, 1], [0.6, 0.5, 0.4])],
                 "cameras": [camera("middle", 0, 0, 0), camera("raised", 0.25, 0.25, 0), camera("turned", 0.3, 0, 0.1),
                             camera("right", 0.5, 0, 0)]}
        scene["objects"][1]["position"] = {"keys": [[0, scene["objects"][1]["position"]],
                                                    [1, [offset[0], 0.2 + offset[1], 0.3 + offset[2]]]]}
        self.write("scene.json", json.dumps(scene))
        self.dgtk("render", self.path("scene.json"), "-o", self.path("set"), "--quiet", "--replace", "--visibility", "ray",
                  "--layers", layers, *options)
        return json.loads(self.dgtk("verify", self.path("set"), "--json").stdout)

    def test_disparities_are_of_cameras_side_by_side(self):
        report = self.verified([0, 0, 0], "depth,objects,disparity", "--cameras", "middle,right")
        counts = {(row["check"], row["layer"]): row["count"] for row in report["residuals"]}
        self.assertEqual(counts["motion", "disparity"], 4 * 64 * 48)  # two cameras, two frames

    def test_in_one_place_but_for_a_rounding(self):
        """The middle pixel looks along what is between the cameras, and has no epipolar line."""
        eyes = [0, 2.0000000000000004, 7.000000000000001], [0, 2, 7]
        scene = {"objects": [{"model": os.path.join(SCENES, "..", "Models", "floor.ac")}],
                 "cameras": [{"name": f"c{angle}", "fovY": angle, "eye": eye, "lookAt": [0, 0, 0]} for angle, eye in zip((45, 30), eyes)]}
        path = self.write("scene.json", json.dumps(scene))
        self.dgtk("render", path, "-o", self.path("set"), "--quiet", "--layers", "depth,objects,correspondence", "--size", "23x17")
        report = json.loads(self.dgtk("verify", self.path("set"), "--json").stdout)
        self.assertEqual(sum(row["count"] > 0 for row in report["residuals"] if row["check"] == "epipolar"), 2)

    def test_far_from_the_origin(self):
        layers = "depth,objects,position,normal,edges,correspondence,flow_forward,sceneflow,disparity"
        for offset in ([0, 0, 0], [3e7, -1e7, 2e7], [0, 0, 4e8]):
            with self.subTest(offset):
                self.verified(offset, layers, "--frames", "0:1", "--pairs", "middle:raised,turned:right")


class AllAround(ManyCase):
    """A panorama in a room, in which something moves: two of its columns look along the plane of the camera, where depth is 0."""
    COLUMN = 14

    def rendered(self, unit):
        crate = os.path.join(SCENES, "..", "Models", "crate.ac")
        eye = [3 * unit, unit, 2 * unit]
        scene = {"objects": [{"name": "room", "model": crate, "scale": [40 * unit] * 3},
                             {"name": "thing", "model": crate, "scale": [unit] * 3,
                              "position": {"keys": [[0, [0, unit, 2 * unit]], [1, [0.2 * unit, 1.1 * unit, 2.3 * unit]]]}}],
                 "cameras": [{"name": "around", "model": "equirectangular", "width": 58, "height": 30, "near": 0.01 * unit, "far": 100 * unit,
                              "eye": eye, "lookAt": [eye[0], eye[1], 0]}]}
        self.dgtk("render", self.write("scene.json", json.dumps(scene)), "-o", self.path("set"), "--quiet", "--replace", "--frames", "0",
                  "--layers", "depth,distance,position,objectcoords,objects,flow_forward,sceneflow", "--objects-format", "npy", "--flow_forward-format", "npy")
        return Edits(self.path("set"))

    def test_what_is_beside_the_camera_is_judged(self):
        data = self.rendered(1)
        self.dgtk("verify", data.root)
        rows = {("geometry", layer): lambda v: 2 * v for layer in ("distance", "position", "objectcoords")}
        rows["motion", "flow_forward"] = lambda v: v + 3
        for (_, layer), change in rows.items():
            for y in range(8, 22):
                data.change(f"around/{layer}/000000.npy", (self.COLUMN, y), change)
        data.accept()
        report = json.loads(self.dgtk("verify", data.root, "--json", "--check", "geometry,motion", status=1).stdout)
        self.assertEqual({(row["check"], row["layer"]) for row in report["residuals"] if row["breach"]}, set(rows))

    def test_of_every_unit(self):
        for unit in (1e-7, 1000, 1e6):
            with self.subTest(unit):
                data = self.rendered(unit)
                self.dgtk("verify", data.root)
                objects = data.load("around/objects/000000.npy")[..., 0]
                y, x = numpy.argwhere(objects == 2)[0].tolist()
                data.change("around/sceneflow/000000.npy", (x, y), lambda v: 1.01 * v)
                data.accept()
                self.assertIn("layer sceneflow", self.dgtk("verify", data.root, "--check", "motion", status=1).stderr)


class Refusals(ManyCase):
    def test_not_a_dataset(self):
        self.refused("verify", self.folder, status=3, says="is not a dataset")
        self.refused("verify", self.path("none"), status=3, says="is not a dataset")
        self.write("manifest.json", "{")
        self.refused("verify", self.folder, status=3, says="manifest.json")

    def test_what_the_machine_lacks_is_no_breach(self):
        scene = self.write("scene.json", json.dumps({
            "objects": [{"name": "a", "model": os.path.join(os.path.dirname(SCENES), "Models", "windmill.gltf")}],
            "cameras": [{"name": "c", "eye": [0, 0, 50], "lookAt": [0, 0, 0], "width": 16, "height": 12}]}))
        self.dgtk("render", scene, "-o", self.path("set"), "--layers", "depth", "--quiet")
        self.dgtk("verify", self.path("set"), "--threads", "0")
        told = self.dgtk("verify", self.path("set"), status=4, environment={"DGTK_IMPORT": "/none", "DGTK_CACHE": "0"})
        self.assertEqual((told.stdout, told.stderr), ("", "dgtk: /none: is not a program (DGTK_IMPORT names dgtk-import)\n"))

    def test_usage(self):
        self.refused("verify", status=2)
        self.refused("verify", self.folder, "--threads", "-1", status=2, says="--threads")
        for option in (("--check", "depth"), ("--write",)):
            self.refused("verify", self.folder, "--export", self.path("export"), *option, status=2, says="--export: an export has neither")


if __name__ == "__main__":
    main()
