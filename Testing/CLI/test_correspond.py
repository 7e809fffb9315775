# SPDX-License-Identifier: BSD-3-Clause
"""Correspondence, disparity, flow and the layers of one pixel that came with them, from files on disk by plain numpy."""
import json
import os

import numpy

from harness import SCENES, Case, load_json, main
from pictures import read_png

STEREO = os.path.join(SCENES, "dataset_stereo.json")
FLOW = os.path.join(SCENES, "dataset_flow.json")
CLASSES = ["no surface", "visible", "occluded", "self-occluded", "outside", "behind"]


def camera_of(folder, name, frame=0):
    for record in load_json(os.path.join(folder, "cameras.json"))["cameras"]:
        if record["name"] == name and record["frame"] == frame:
            return {key: numpy.array(record[key]) for key in ("K", "R", "t")}
    raise KeyError(name)


def project(camera, points):
    x = points @ camera["R"].T + camera["t"]
    x = x @ camera["K"].T
    return x[..., :2] / x[..., 2:]


def centres(shape):
    y, x = numpy.mgrid[0:shape[0], 0:shape[1]]
    return numpy.stack([x + 0.5, y + 0.5], axis=-1)


class Correspond(Case):
    def layer(self, *names):
        return numpy.load(self.path("out", *names))

    def render(self, scene, layers, *options):
        self.dgtk("render", scene, "-o", self.path("out"), "--quiet", "--layers", layers, *options)

    def test_stereo_pair(self):
        self.render(STEREO, "depth,position,correspondence,disparity", "--disparity-format", "npy")
        left, right = camera_of(self.path("out"), "left"), camera_of(self.path("out"), "right")
        found = self.layer("left", "correspondence_right", "000000.npy")
        expected = project(right, self.layer("left", "position", "000000.npy"))
        self.assertLess(numpy.nanmax(abs(found - expected)), 1e-9)
        baseline = numpy.linalg.norm(right["R"].T @ right["t"] - left["R"].T @ left["t"])
        for name in ("left", "right"):
            disparity = self.layer(name, "disparity", "000000.npy")
            depth = self.layer(name, "depth", "000000.npy")
            self.assertLess(numpy.nanmax(abs(disparity - left["K"][0, 0] * baseline / depth)), 1e-9)

    def test_given_points_are_the_dense_ones(self):
        self.render(STEREO, "correspondence,objects", "--cameras", "left", "--pairs", "left:right", "--objects-format", "npy")
        dense = self.layer("left", "correspondence_right", "000000.npy")
        objects = self.layer("left", "objects", "000000.npy")
        kinds = read_png(self.path("out", "left", "correspondence_right", "000000.png"))[..., 0]
        names = {row["id"]: row["name"] for row in load_json(self.path("out", "objects.json"))["objects"]}
        places = [(10, 20), (160, 120), (311, 200), (90, 150)]
        places += [tuple(map(int, numpy.argwhere(kinds == kind)[0][::-1])) for kind in numpy.unique(kinds)]
        points = self.write("points.txt", "# x y\n" + "\n".join(f"{x + 0.5}, {y + 0.5}" for x, y in places))
        arguments = ["correspond", STEREO, "--from", "left", "--to", "right", "--points", points]
        matches = json.loads(self.dgtk(*arguments, "--json").stdout)["matches"]
        self.assertEqual(len(matches), len(places))
        for (x, y), match in zip(places, matches):
            self.assertLess(abs(numpy.array(match["to"]) - dense[y, x]).max(), 1e-9)
            self.assertEqual(match["from"], [x + 0.5, y + 0.5])
            self.assertEqual((match["class"], match["object"]), (kinds[y, x], objects[y, x]))
            self.assertEqual(match["visibility"], CLASSES[match["class"]])
            self.assertEqual(match["name"], names[match["object"]])
        lines = self.dgtk(*arguments).stdout.splitlines()
        self.assertEqual(len([line for line in lines if not line.startswith("#")]), len(places))

    def test_pairs_with_a_step_in_time(self):
        self.render(FLOW, "correspondence,flow_forward", "--frames", "0:1", "--pairs", "camera:camera+1", "--flow_forward-format", "npy")
        flow = self.layer("camera", "flow_forward", "000000.npy")
        there = self.layer("camera", "correspondence_camera+1", "000000.npy")
        self.assertLess(numpy.nanmax(abs(there - centres(there.shape) - flow)), 1e-12)
        self.assertGreater(numpy.nanmax(abs(flow)), 1)

    def test_the_ends_of_the_scene_have_no_flow(self):
        self.render(FLOW, "flow_forward,flow_backward,sceneflow")
        names = {layer: sorted(os.listdir(self.path("out", "camera", layer))) for layer in ("flow_forward", "flow_backward", "sceneflow")}
        self.assertEqual(names["flow_forward"], ["000000.flo", "000000.png", "000001.flo", "000001.png"])
        self.assertEqual(names["flow_backward"], ["000001.flo", "000001.png", "000002.flo", "000002.png"])
        self.assertEqual(names["sceneflow"], ["000000.npy", "000001.npy"])

    def test_scene_flow_of_a_still_object_is_zero(self):
        self.render(FLOW, "sceneflow,objects", "--frames", "0", "--objects-format", "npy")
        motion, objects = self.layer("camera", "sceneflow", "000000.npy"), self.layer("camera", "objects", "000000.npy")
        self.assertEqual(abs(motion[objects == 1]).max(), 0)  # the wall; the camera's own motion does not count
        self.assertGreater(abs(motion[objects == 3]).max(), 0.01)  # the ball comes nearer

    def test_pixel_geometry(self):
        self.render(STEREO, "depth,inversedepth,barycentrics,normal,shadingnormal,objects,classes,edges", "--cameras", "left",
                    "--objects-format", "npy", "--classes-format", "npy", "--edges-format", "npy")
        depth = self.layer("left", "depth", "000000.npy")
        self.assertLess(abs(self.layer("left", "inversedepth", "000000.npy") * depth - 1).max(), 1e-15)
        weights = self.layer("left", "barycentrics", "000000.npy")
        self.assertLess(abs(weights.sum(axis=2) - 1).max(), 1e-12)
        self.assertGreater(weights.min(), -1e-9)
        normal, shading = self.layer("left", "normal", "000000.npy"), self.layer("left", "shadingnormal", "000000.npy")
        self.assertLess(abs(numpy.linalg.norm(shading, axis=2) - 1).max(), 1e-12)
        cosine = (normal * shading).sum(axis=2)
        self.assertGreater(cosine.min(), 0.9)
        objects = self.layer("left", "objects", "000000.npy")
        flat = objects <= 3  # walls and the box; the ball is smooth
        self.assertGreater(cosine[flat].min(), 1 - 1e-6)
        self.assertLess(cosine[~flat].min(), 1 - 1e-4)
        ids = {o["id"]: o["class_id"] for o in load_json(self.path("out", "objects.json"))["objects"]}
        self.assertEqual(ids, {1: 1, 2: 1, 3: 2, 4: 2})
        self.assertTrue((self.layer("left", "classes", "000000.npy") == numpy.vectorize(ids.get)(objects)).all())
        border = numpy.zeros(objects.shape, bool)
        vertical, horizontal = objects[1:] != objects[:-1], objects[:, 1:] != objects[:, :-1]
        border[1:] |= vertical
        border[:-1] |= vertical
        border[:, 1:] |= horizontal
        border[:, :-1] |= horizontal
        self.assertTrue(((self.layer("left", "edges", "000000.npy") == 255) == border).all())

    def test_refusals(self):
        points = self.write("points.txt", "1 2\n3\n")
        views = ["--from", "left", "--to", "right"]
        self.refused("correspond", STEREO, *views, "--points", points, status=3, says=("points.txt:2", "two numbers"))
        self.refused("correspond", STEREO, *views, "--points", self.write("far.txt", "400 10"), status=3, says=("far.txt:1", "outside"))
        self.refused("correspond", STEREO, *views, "--points", self.write("nan.txt", "nan 3"), status=3, says="found nan")
        for far in ("320.001 10", "10 240.001", "-0.001 10", "10 -0.001"):
            self.refused("correspond", STEREO, *views, "--points", self.write("far.txt", far), status=3, says="expected 0 to 320, 0 to 240")
        corners = self.write("corners.txt", "0 0\n320 0\n0 240\n320 240")  # the borders of the image belong to it
        self.assertEqual(len(json.loads(self.dgtk("correspond", STEREO, *views, "--points", corners, "--json").stdout)["matches"]), 4)
        self.refused("correspond", STEREO, "--from", "middle", "--to", "right", "--points", points, status=2, says="'middle'")
        self.refused("correspond", STEREO, "--from", "left", "--points", points, status=2, says="--to")
        self.refused("correspond", STEREO, "--from", "left@7", "--to", "right", "--points", points, status=2, says="frame")
        self.refused("render", STEREO, "-o", self.path("x"), "--layers", "correspondence", "--pairs", "left:top", status=2, says="'left:top'")
        self.refused("render", FLOW, "-o", self.path("x"), "--layers", "disparity", status=2, says="two cameras side by side")

    def test_same_bytes_for_any_number_of_threads(self):
        layers = "correspondence,disparity,edges,classes"
        for threads in ("1", "3"):
            self.dgtk("render", STEREO, "-o", self.path(threads), "--quiet", "--layers", layers, "--threads", threads)
        self.assert_same_files(self.path("1"), self.path("3"))


if __name__ == "__main__":
    main()
