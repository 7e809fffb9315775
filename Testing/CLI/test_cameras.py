# SPDX-License-Identifier: BSD-3-Clause
"""Every camera model through the program: all exact layers, verified; what a model has no meaning for is refused."""
import json
import os
import shutil

import numpy

from dataset_edits import Edits
from harness import SOURCE, Case, load_json, main

MODELS = os.path.join(SOURCE, "Data", "Models")
WIDTH, HEIGHT = 48, 36
LAYERS = ("depth,distance,inversedepth,objects,classes,parts,triangles,normal,shadingnormal,position,objectcoords,uv,"
          "barycentrics,edges,flow_forward,flow_backward,sceneflow,alpha,coverage,boxes,amodal")


def matrix(focal, skew=0):
    return [[focal, skew, 24.5], [0, 1.02 * focal, 17.25], [0, 0, 1]]


# Where a picture has an end it lies inside of these images: of the fisheye's, the mirror's and the double sphere's.
LENSES = {
    "radial": {"K": matrix(26), "distortion": [-0.2, 0.03, 0, 0]},
    "five": {"K": matrix(26, 0.4), "distortion": [-0.21, 0.05, 0.004, -0.003, -0.004]},
    "rational": {"K": matrix(26), "distortion": [0.3, 0.02, 0.001, -0.002, 0.001, 0.5, 0.06, 0.002]},
    "tilted": {"K": matrix(30), "distortion": [-0.1, 0.01, 0.001, 0.002, 0, 0, 0, 0, 0.003, -0.001, 0.002, 0.001, 0.05, -0.08]},
    "fisheye": {"model": "fisheye", "K": matrix(7.5), "distortion": [0.02, -0.004, 0.001, -0.0002]},
    "fisheye without K": {"model": "fisheye", "fovY": 150},
    "mirror": {"model": "omnidirectional", "K": matrix(26), "xi": 1.6, "distortion": [-0.05, 0.01, 0.002, -0.001]},
    "sphere": {"model": "omnidirectional", "K": matrix(20), "xi": 0.8},
    "double sphere": {"model": "double-sphere", "K": matrix(12), "xi": -0.2, "alpha": 0.65},
    "enhanced": {"model": "eucm", "K": matrix(14), "alpha": 0.6, "beta": 1.1},
    "panorama": {"model": "equirectangular"},
    "parallel": {"model": "orthographic", "viewHeight": 3},
    "table": {"model": "raytable", "rays": "rays.npy"},
    "origins": {"model": "raytable", "rays": "origins.npy"},
}


def tables(folder):
    """Rays of a lens with a picture all around up to 150 degrees; from one point, and from points of a pupil that moves."""
    y, x = numpy.mgrid[0:HEIGHT // 2, 0:WIDTH // 2] * 2 + 1.0
    x, y = (x - WIDTH / 2) / (HEIGHT / 2), (y - HEIGHT / 2) / (HEIGHT / 2)
    radius = numpy.hypot(x, y)
    angle = numpy.where(radius < 1, numpy.radians(75) * radius, numpy.nan)
    rays = numpy.stack([numpy.sin(angle) * x / radius, numpy.sin(angle) * y / radius, numpy.cos(angle)], axis=-1)
    numpy.save(os.path.join(folder, "rays.npy"), rays)
    numpy.save(os.path.join(folder, "origins.npy"), numpy.concatenate([0.01 * rays * angle[..., None] ** 2, rays], axis=-1))


def scene():
    """A closed room with a moving ball, seen by cameras that move and turn."""
    keys = [[0, [0.1, 1.4, 2.2]], [2, [0.3, 1.5, 2.0]]]
    room = {"position": [0, -1, 0], "scale": [9, 6, 11]}
    objects = [
        {"name": "room", "model": "crate.ac", **room},
        {"name": "ball", "model": "ball.ac", "position": {"keys": [[0, [-0.4, 1.2, 0.3]], [2, [0.3, 1.3, 0.6]]]},
         "orientation": {"keys": [[0, [1, 0, 0, 0]], [2, [0.96, 0, 0.28, 0]]]}, "scale": [2, 2, 2]},
        {"name": "crate", "model": "crate.ac", "position": [1.5, 0.5, 0.5]},
        {"name": "behind", "model": "crate.ac", "position": [0.3, 1.2, 4], "orientation": [0.9, 0.3, 0.3, 0]},
    ]
    cameras = [{"name": name, "width": WIDTH, "height": HEIGHT, "near": 0.05, "far": 100, "eye": {"keys": keys},
                "lookAt": {"keys": [[0, [0, 1.1, 0]], [2, [0.4, 1.0, 0.2]]]}, **lens} for name, lens in LENSES.items()]
    for item in objects:
        item["model"] = os.path.join(MODELS, item["model"])
    return {"version": 1, "objects": objects, "cameras": cameras}


class Cameras(Case):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.json", json.dumps(scene()))
        tables(self.folder)

    def render(self, layers, *options):
        self.dgtk("render", self.scene, "-o", self.path("set"), "--quiet", "--visibility", "ray", "--frames", "0:1",
                  "--layers", layers, *options)

    def layer(self, camera, layer, frame=0):
        return numpy.load(self.path("set", camera, layer, f"{frame:06}.npy"))

    def verify(self):
        report = json.loads(self.dgtk("verify", self.path("set"), "--json", "--threads", 2).stdout)
        self.assertTrue(report["passed"])
        return report["residuals"]

    def test_all_layers_are_verified(self):
        self.render(LAYERS + ",correspondence,points,tracks", "--tracks-step", "8", "--tracks-every", "1", "--pairs",
                    "fisheye:panorama,panorama:mirror+1,mirror:radial,radial:fisheye,double sphere:enhanced,parallel:five,"
                    "table:origins,origins:table+1,radial:table",
                    "--objects-format", "npy", "--flow_forward-format", "npy", "--flow_backward-format", "npy")
        residuals = self.verify()
        self.assertEqual({residual["layer"] for residual in residuals if residual["check"] == "calibration"},
                         {"cv::projectPoints", "cv::fisheye::projectPoints", "cv::projectPoints of the sphere", "projection"})
        self.assertEqual({residual["check"] for residual in residuals if residual["skipped"] > 0.01 * residual["count"]},
                         {"forward-backward"})  # of the parallel projection, where no triangle holds four pixels
        self.around_an_image_circle()
        self.negative_depth()

    def around_an_image_circle(self):
        """Nothing is seen there, in no layer; inside there is a room all around."""
        for name in ("fisheye", "mirror", "double sphere", "table", "origins"):
            objects = self.layer(name, "objects")
            self.assertEqual(objects[0, 0], 0, name)
            self.assertGreater((objects > 0).mean(), 0.3, name)
            beyond = objects == 0
            for layer in ("depth", "distance"):
                self.assertTrue(numpy.isposinf(self.layer(name, layer)[beyond]).all(), (name, layer))
            for layer in ("position", "normal", "flow_forward"):
                self.assertTrue(numpy.isnan(self.layer(name, layer)[beyond]).all(), (name, layer))
        self.assertTrue((self.layer("panorama", "objects") > 0).all())

    def negative_depth(self):
        """Behind the camera depth is negative and distance is not."""
        depth, distance = self.layer("panorama", "depth"), self.layer("panorama", "distance")
        behind = numpy.abs(numpy.arange(WIDTH) + 0.5 - WIDTH / 2) > WIDTH / 4
        self.assertTrue((depth[:, behind] < 0).all() and (depth[:, ~behind] > 0).all())
        self.assertTrue((distance > abs(depth) - 1e-12).all())

    def test_colours_and_what_lies_behind(self):
        """All surfaces of a pixel, in order along its ray, also behind the camera; with the layers' own bytes."""
        self.render("depth,position,objects")
        before = {name: self.layer(name, "depth") for name in LENSES}
        self.dgtk("render", self.scene, "-o", self.path("set"), "--quiet", "--replace", "--renderer", "ray", "--frames", "0",
                  "--layers", "color,depth,position,objects,ldi,points")
        for name, depth in before.items():
            numpy.testing.assert_array_equal(self.layer(name, "depth"), depth, err_msg=name)
        checks = {(residual["check"], residual["layer"]) for residual in self.verify()}
        for camera in ("radial", "mirror", "panorama", "table"):
            said = self.dgtk("warp", self.path("set", "fisheye", "ldi", "000000.ldi"), "--to", camera, "-o", self.path("w.png"))
            holes = int((said.stdout + said.stderr).split()[0])
            self.assertLess(holes, 0.6 * WIDTH * HEIGHT, camera)
            shutil.copy(self.path("w.png"), self.path(camera + ".png"))
        record = next(r for r in load_json(self.path("set", "cameras.json"))["cameras"] if r["name"] == "mirror")
        alike = self.write("mirror.json", json.dumps(record))
        self.dgtk("warp", self.path("set", "fisheye", "ldi", "000000.ldi"), "--to", alike, "-o", self.path("w.png"))
        with open(self.path("w.png"), "rb") as one, open(self.path("mirror.png"), "rb") as other:
            self.assertEqual(one.read(), other.read())
        self.assertLessEqual({("ldi", "surfaces"), ("ldi", "order"), ("ldi", "first = depth"), ("points", "colors")}, checks)

    def test_a_wrong_coefficient_is_found(self):
        self.render("position,depth", "--cameras", "fisheye,mirror")
        edits = Edits(self.path("set"))

        def spoil(document):
            record = next(r for r in document["cameras"] if r["name"] == "fisheye" and r["frame"] == 0)
            record["distortion"][0] += 1e-4
        edits.document("cameras.json", spoil)
        edits.accept()
        self.refused("verify", self.path("set"), status=1, says=["cameras.json", "check cameras", "distortion"])
        table = self.dgtk("verify", self.path("set"), status=1).stdout
        row = next(line for line in table.splitlines() if "cv::fisheye::projectPoints" in line)
        self.assertIn("BREACH", row)

    def test_a_wrong_position_is_found(self):
        self.render("position", "--cameras", "fisheye,mirror")
        edits = Edits(self.path("set"))
        edits.change("mirror/position/000001.npy", (24, 20), lambda v: v + [0, 1e-6, 0])
        edits.accept()
        self.refused("verify", self.path("set"), status=1,
                     says=["mirror/position/000001.npy", "cv::projectPoints of the sphere", "(24, 20)"])

    def test_other_sizes_see_the_same(self):
        self.render("position", "--cameras", "fisheye,mirror,five,panorama")
        half = {name: self.layer(name, "position") for name in ("fisheye", "mirror", "five", "panorama")}
        self.render("position", "--cameras", "fisheye,mirror,five,panorama", "--size", f"{3 * WIDTH}x{3 * HEIGHT}",
                    "--replace")
        for name, small in half.items():
            large = self.layer(name, "position")[1::3, 1::3]
            numpy.testing.assert_allclose(large, small, atol=1e-9, err_msg=name)
        self.verify()

    def test_points_correspond_as_pixels_do(self):
        """Also outside of the image circle, where there is nothing to follow."""
        self.render("correspondence", "--pairs", "fisheye:mirror+1", "--cameras", "fisheye")
        dense = self.layer("fisheye", "correspondence_mirror+1")
        places = [(0, 0), (24, 17), (20, 9), (30, 25), (12, 17)]
        points = self.write("points.txt", "".join(f"{x + 0.5} {y + 0.5}\n" for x, y in places))
        found = json.loads(self.dgtk("correspond", self.scene, "--from", "fisheye", "--to", "mirror@1", "--points", points,
                                     "--json").stdout)["matches"]
        for (x, y), match in zip(places, found):
            there = numpy.array([numpy.nan if v is None else v for v in match["to"] or [None, None]], float)
            numpy.testing.assert_allclose(there, dense[y, x], atol=1e-9)
        self.assertEqual(found[0]["class"], 0)

    def test_info_says_lenses_and_their_pixels(self):
        cameras = json.loads(self.dgtk("info", self.scene, "--surfaces", "--json").stdout)["cameras"]
        for camera in cameras:
            lens = LENSES[camera["name"]]
            self.assertEqual(camera.get("distortion", lens.get("distortion")), lens.get("distortion", camera.get("distortion")))
            self.assertEqual("K" in camera, camera["model"] not in ("equirectangular", "raytable"))
            self.assertGreater(camera["surfaces"]["pixels"], 0.2 * WIDTH * HEIGHT)
            self.assertGreater(camera["surfaces"]["smallest"], 0)

    def test_cameras_are_written_under_the_scenes_names(self):
        self.render("depth", "--cameras", "five,mirror,double sphere,enhanced,panorama,fisheye without K")
        for record in load_json(self.path("set", "cameras.json"))["cameras"]:
            lens = LENSES[record["name"]]
            self.assertEqual(record["model"], lens.get("model", "pinhole"))
            for key in ("K", "distortion", "xi", "alpha", "beta"):
                if key in lens:
                    self.assertEqual(record[key], lens[key], record["name"])
            self.assertEqual("K" in record, record["name"] != "panorama")

    def test_tables_of_rays_go_along(self):
        """The dataset names them; one that is packed has them."""
        self.render("depth,position", "--cameras", "table,origins", "--pack")
        records = load_json(self.path("set", "cameras.json"))["cameras"]
        self.assertEqual({record["rays"].split("/")[-1] for record in records}, {"rays.npy", "origins.npy"})
        for record in records:
            self.assertTrue(os.path.exists(self.path("set", record["rays"])), record["rays"])
        for name in ("scene.json", "rays.npy", "origins.npy"):
            os.remove(self.path(name))
        os.rename(self.path("set"), self.path("moved"))
        self.dgtk("verify", self.path("moved"))
        self.dgtk("render", self.path("moved", "scene.json"), "-o", self.path("again"), "--quiet", "--visibility", "ray",
                  "--frames", "0:1", "--layers", "depth", "--cameras", "table")
        numpy.testing.assert_array_equal(numpy.load(self.path("again", "table", "depth", "000001.npy")),
                                         numpy.load(self.path("moved", "table", "depth", "000001.npy")))

    def test_what_has_no_meaning_is_refused(self):
        for layer, options in {"calibration": (), "pov": (), "disparity": ("--pairs", "fisheye:mirror")}.items():
            self.refused("render", self.scene, "-o", self.path("no"), "--cameras", "fisheye,mirror", "--layers", layer,
                         *options, status=2, says=layer)
            self.assertFalse(os.path.exists(self.path("no")))


class Wrong(Case):
    def refuse(self, lens, *says):
        document = scene()
        document["cameras"] = [{"name": "c", "eye": [0, 0, 1], "lookAt": [0, 0, 0], "width": 8, "height": 8, **lens}]
        path = self.write("scene.json", json.dumps(document))
        self.refused("render", path, "-o", self.path("set"), "--layers", "depth", status=3, says=says)

    def test_lenses_that_cannot_be(self):
        self.refuse({"distortion": [1, 2, 3]}, "distortion", "4, 5, 8, 12 or 14 numbers")
        self.refuse({"model": "fisheye", "xi": 1}, "xi")
        self.refuse({"model": "double-sphere", "xi": 1}, "xi")
        self.refuse({"model": "equirectangular", "fovY": 60}, "fovY", "equirectangular")
        self.refuse({"model": "eucm", "alpha": 2}, "alpha")
        self.refuse({"distortion": [0] * 12 + [2, 0]}, "tilt of the sensor")
        self.refuse({"model": "raytable"}, "rays")
        self.refuse({"model": "raytable", "rays": "none.npy"}, "none.npy")


if __name__ == "__main__":
    main()
