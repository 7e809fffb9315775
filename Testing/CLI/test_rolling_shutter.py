# SPDX-License-Identifier: BSD-3-Clause
"""Rolling shutters: every row or column is what a camera of its own instant sees, to the byte; where a moving point is
seen in another picture agrees with a dense time line."""
import copy
import json
import os

import numpy

from dataset_edits import contents, plainer
from harness import SOURCE, WHOLE, load_json, main
from many_runs import ManyCase
from pictures import read_png

MODELS = os.path.join(SOURCE, "Data", "Models")
WIDTH, HEIGHT = 32, 16
LAYERS = ("depth,distance,inversedepth,objects,classes,parts,triangles,normal,shadingnormal,position,objectcoords,uv,"
          "barycentrics,color").split(",")
FORMATS = [text for layer in ("objects", "classes", "parts", "triangles") for text in (f"--{layer}-format", "npy")]
# A frame of the dense time line is as long as 1/STEPS of one: the centres of rows and columns are on it.
STEPS = 64
DURATION = 1.0


def scene(camera, steps=1):
    """A scene in which all move, with its time stretched; all numbers of frames are exact in binary."""
    def keys(*values):
        return {"keys": [[8 * steps * i, value] for i, value in enumerate(values)]}

    objects = [
        {"name": "room", "model": "crate.ac", "position": [0, -1, 0], "scale": [9, 6, 11]},
        {"name": "ball", "model": "ball.ac", "position": keys([-2.4, 1.2, 0.3], [2.3, 1.5, 0.6]),
         "orientation": keys([1, 0, 0, 0], [0.6, 0, 0.8, 0]), "scale": [2, 2, 2]},
        {"name": "crate", "model": "crate.ac", "position": keys([1.5, 0.1, 0.5], [0.8, 1.9, 0.5])},
        {"name": "creature", "model": "creature.md2", "position": keys([-1, 0.4, -0.6], [0.4, 0.4, 0.4]),
         "orientation": [0.5, -0.5, -0.5, -0.5], "scale": [0.03, 0.03, 0.03], "animation": {"sequence": "walk"}},
    ]
    # it goes while frame 4 is seen, and comes while frame 5 is
    objects.append({"name": "blink", "model": "crate.ac", "position": [-0.9, 1.6, 0.9], "scale": [0.6, 0.6, 0.6],
                    "visible": {"keys": [[0, False], [2 * steps, True], [4 * steps, False], [5 * steps, True]]}})
    for item in objects:
        item["model"] = os.path.join(MODELS, item["model"])
    eye = {"name": "eye", "width": WIDTH, "height": HEIGHT, "near": 0.05, "far": 100,
           "eye": keys([0.1, 1.4, 2.2], [0.9, 1.7, 1.8]), "lookAt": keys([0, 1.1, 0], [0.8, 1.0, 0.2]), **camera}
    lights = [{"name": "lamp", "kind": "point", "position": keys([1, 3, 2], [-1, 2.5, 2]), "shadows": True}]
    return {"version": 1, "fps": 25 * steps, "objects": objects, "lights": lights, "cameras": [eye]}


CAMERAS = {
    "down": {"rollingShutter": {"duration": DURATION}},
    "up": {"rollingShutter": {"duration": DURATION, "direction": "up"}},
    "right": {"rollingShutter": {"duration": DURATION, "direction": "right"}},
    "fisheye": {"model": "fisheye", "fovY": 150, "rollingShutter": {"duration": DURATION, "direction": "left"}},
    "table": {"model": "raytable", "rays": "timed.npy"},
}


def steps_of(name):
    """Steps of the dense time line after the frame's own, of every pixel's centre."""
    y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH]
    rows = (2 * y + 1 - HEIGHT) * STEPS // (2 * HEIGHT)
    columns = (2 * x + 1 - WIDTH) * STEPS // (2 * WIDTH)
    return {"down": rows, "up": -rows, "right": columns, "fisheye": -columns, "table": (x // 8 - 3 * (y // 4)) * 4}[name]


def frames_of(instants):
    """Frames of the dense time line that have them."""
    return f"{4 * STEPS + instants[0]}:{4 * STEPS + instants[-1]}:{numpy.gcd.reduce(numpy.diff(instants))}"


class RollingShutters(ManyCase):
    def save_table(self, across=1, down=1):
        """Rays of a pinhole, with a time for each block of 8 x 4 pixels; of every so many columns and rows."""
        y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH]
        rays = numpy.stack([(x + 0.5 - WIDTH / 2) / 20, (y + 0.5 - HEIGHT / 2) / 20, numpy.ones((HEIGHT, WIDTH)),
                            steps_of("table") / STEPS], axis=-1)
        numpy.save(self.path("timed.npy"), rays[::down, ::across])
        rays[..., 3] = 0
        numpy.save(self.path("still.npy"), rays[::down, ::across])

    def render(self, folder, description, layers, frames, *options, run=None):
        path = self.write(folder + ".json", json.dumps(description))
        (run or self.dgtk)("render", path, "-o", self.path(folder), "--layers", layers, "--frames", frames, "--quiet", "--replace",
                  *options)
        return path

    def values(self, folder, layer, frame, camera="eye"):
        if layer == "color":
            return numpy.array(read_png(self.path(folder, camera, layer, f"{frame:06d}.png")))
        return numpy.load(self.path(folder, camera, layer, f"{frame:06d}.npy"))

    def still(self, name, steps):
        camera = copy.deepcopy(CAMERAS[name])
        camera.pop("rollingShutter", None)
        if "rays" in camera:
            camera["rays"] = "still.npy"
        return scene(camera, steps)

    def test_every_pixel_is_what_a_camera_of_its_instant_sees(self):
        self.save_table()
        for name, camera in CAMERAS.items():
            with self.subTest(name):
                steps = steps_of(name)
                self.render("rolling", scene(camera), ",".join(LAYERS), "4", *FORMATS)
                instants = sorted(set(steps.flat))
                self.assertGreater(len(instants), 8)
                self.render("still", self.still(name, STEPS), ",".join(LAYERS), frames_of(instants), *FORMATS)
                for layer in LAYERS:
                    rolling = self.values("rolling", layer, 4)
                    for step in instants:
                        then = self.values("still", layer, 4 * STEPS + step)
                        self.assertEqual(rolling[steps == step].tobytes(), then[steps == step].tobytes(), f"{layer} {step}")

    def test_samples_of_a_pixel_have_the_time_of_its_row(self):
        steps = steps_of("down")
        options = ("--samples", "3")
        self.render("rolling", scene(CAMERAS["down"]), "color,alpha", "4", *options)
        self.render("still", self.still("down", STEPS), "color,alpha", frames_of(sorted(set(steps.flat))), *options)
        for layer in ("color", "alpha"):
            rolling = read_png(self.path("rolling", "eye", layer, "000004.png"))
            for y in range(HEIGHT):
                then = read_png(self.path("still", "eye", layer, f"{4 * STEPS + steps[y, 0]:06d}.png"))
                self.assertTrue((rolling[y] == then[y]).all(), f"{layer} {y}")

    def test_filters_take_samples_beyond_the_border(self):
        """Of what stands still, a picture is the same with and without a shutter, its border, too."""
        options = ("--samples", "2", "--filter", "lanczos")
        for name in ("down", "right"):
            with self.subTest(name):
                standing = scene(CAMERAS[name])
                for item in standing["objects"] + standing["lights"] + standing["cameras"]:
                    for key, value in item.items():
                        if isinstance(value, dict) and "keys" in value:
                            item[key] = value["keys"][0][1]
                    item.pop("animation", None)
                self.render("rolling", standing, "color", "0", *options)
                standing["cameras"][0].pop("rollingShutter")
                self.render("still", standing, "color", "0", *options)
                rolling, still = (read_png(self.path(folder, "eye", "color", "000000.png")) for folder in ("rolling", "still"))
                self.assertTrue((rolling == still).all())
                self.assertGreater(len(numpy.unique(still.reshape(-1, 3), axis=0)), 50)

    def test_moving_points_are_seen_where_a_dense_time_line_sees_them(self):
        """Flow and its classes, against positions of the same points by still cameras at times on either side."""
        fine = 4096
        rows = {"down": (lambda x, y: y / HEIGHT - 0.5, [(x, y) for y in range(1, HEIGHT, 4) for x in range(2 + y % 3, WIDTH, 6)]),
                "right": (lambda x, y: x / WIDTH - 0.5, [(x, y) for x in range(1, WIDTH, 5) for y in range(2 + x % 3, HEIGHT, 4)])}
        kinds = set()
        for name, (when, picked) in rows.items():
            self.render("rolling", scene(CAMERAS[name]), "flow_forward,objects", "4",
                        "--flow_forward-format", "npy", "--objects-format", "npy")
            flow = self.values("rolling", "flow_forward", 4)
            objects = self.values("rolling", "objects", 4)
            classes = read_png(self.path("rolling", "eye", "flow_forward", "000004.png"))[..., 0]
            self.assertGreater(len({int(objects[y, x]) for x, y in picked}), 2)
            starts = {}  # one run for the points of an instant
            for x, y in picked:
                here = numpy.array([x + 0.5, y + 0.5])
                there = here + flow[y, x]
                at = fine * (5 + DURATION * when(*numpy.clip(there, 0, [WIDTH, HEIGHT])))
                starts.setdefault(round(fine * (4 + DURATION * when(*here))), []).append((x, y, there, at))
            for start, points in starts.items():
                ends = {int(at) + after - start for *_, at in points for after in (0, 1)}
                self.render("dense", self.still(name, fine), "correspondence", str(start), "--pairs", ",".join(f"eye:eye+{end}" for end in ends))
                for x, y, there, at in points:
                    layers = [f"correspondence_eye+{int(at) + after - start}" for after in (0, 1)]
                    between = [self.values("dense", layer, start)[y, x] for layer in layers]
                    expected = between[0] + (at - int(at)) * (between[1] - between[0])
                    self.assertLess(numpy.abs(expected - there).max(), 1e-6, f"{name} {x} {y}")
                    seen = {int(read_png(self.path("dense", "eye", layer, f"{start:06d}.png"))[y, x, 0]) for layer in layers}
                    self.assertIn(classes[y, x], seen, f"{name} {x} {y}")
                    kinds |= seen
        self.assertGreaterEqual(len(kinds), 3)

    def test_datasets_of_rolling_cameras_are_verified(self):
        self.save_table(4, 2)
        description = scene(CAMERAS["down"])
        creature, = (item for item in description["objects"] if item["name"] == "creature")
        if not WHOLE:  # boxes are of all triangles at all times of all rows
            creature["model"] = self.write("creature.md2", plainer(contents(creature["model"]), 1000))
        plain = description["cameras"][0]
        description["cameras"] = []
        for name, camera in {**CAMERAS, "still": {}, "table rolling": {**CAMERAS["table"], "rollingShutter": {"duration": 0.25, "direction": "up"}}}.items():
            own = {key: value for key, value in plain.items() if key != "rollingShutter"}
            description["cameras"].append({**own, **camera, "name": name, "width": WIDTH // 4, "height": HEIGHT // 2})
        layers = (",".join(LAYERS) + ",edges,flow_forward,flow_backward,sceneflow,correspondence,alpha,coverage,ldi,"
                  "boxes,amodal,points,tracks,matting,depth_noisy")
        self.render("all", description, layers, "3:4", "--flow_forward-format", "npy,flo", "--matte", "ball,crate",
                    "--points-step", "2", "--tracks-step", "4", "--tracks-every", "1", "--pairs", "down:still,still:down+1,fisheye:right,table:up", "--samples", "2")
        report = json.loads(self.dgtk("verify", self.path("all"), "--json").stdout)
        counts = {(row["check"], row["layer"]): row["count"] for row in report["residuals"]}
        for key in (("motion", "flow_forward"), ("class", "flow_forward"), ("motion", "sceneflow"),
                    ("class", "correspondence_down+1"), ("boxes", "projected"), ("points", "tracks"), ("tracks", "classes"), ("ldi", "surfaces"),
                    ("alpha", "coverage"), ("cameras", "cameras")):
            self.assertGreater(counts.get(key, 0), 0, f"{key} of {sorted(counts)}")

    def test_points_that_overtake_the_shutter_are_verified(self):
        """Far out on a ground that turns, also where it passes the plane of the camera."""
        ground = {"name": "ground", "model": os.path.join(MODELS, "ground.ac"), "scale": [0.5, 0.5, 0.5],
                  "position": {"keys": [[1, [0.77, 0.38, -1]], [5, [0.43, 0.4, 0]]]},
                  "orientation": {"keys": [[0, [0.574907, -0.583051, 0.472471, -0.326045]], [2, [-0.826396, -0.041877, -0.055489, -0.558781]]],
                                  "interpolation": "smooth"}}
        cameras = [{"name": "wide", "model": "fisheye", "K": [[11, 0, 20.5], [0, 10, 13.5], [0, 0, 1]], "distortion": [0.02, -0.004, 0.0006, -5e-5],
                    "width": 41, "height": 31, "near": 1, "far": 8, "eye": [-1.9, 1.525, 7.075], "lookAt": [0, 0.5, 0]},
                   {"name": "rolls", "K": [[66, 0, 21], [0, 60, 16], [0, 0, 1]], "width": 41, "height": 31, "near": 1, "far": 500,
                    "position": [-0.895592449590572, 1.2, 6], "orientation": [0, 1, 0, 0], "rollingShutter": {"duration": 0.9, "direction": "up"}}]
        self.render("fast", {"objects": [ground], "cameras": cameras}, "depth,objects,correspondence,flow_backward", "2", "--size", "39x49",
                    "--pairs", "wide:rolls,rolls:rolls-1")
        report = json.loads(self.dgtk("verify", self.path("fast"), "--json").stdout)
        self.assertGreater(next(row["count"] for row in report["residuals"] if row["layer"] == "correspondence_rolls"), 0)

    def test_tall_pictures_of_what_moves_fast_are_verified(self):
        """Where the rounding of a time is more than that of a place."""
        wall = {"name": "wall", "model": os.path.join(MODELS, "crate.ac"), "scale": [30, 30, 1],
                "position": {"keys": [[0, [0, 0, -14]], [2, [1, 0.5, -2]], [4, [0, 0, -9]]], "interpolation": "smooth"}}
        camera = {"name": "tall", "model": "fisheye", "K": [[25, 0, 21], [0, 25, 16], [0, 0, 1]], "distortion": [0.02, -0.004, 0.0006, -5e-5],
                  "width": 41, "height": 31, "near": 0.5, "far": 50, "position": [0, 0, 6], "orientation": [0, 1, 0, 0],
                  "rollingShutter": {"duration": 1.7, "direction": "left"}}
        self.render("tall", {"objects": [wall], "cameras": [camera]}, "sceneflow,flow_forward", "1", "--size", "25x3000",
                    "--sceneflow-format", "npy", "--flow_forward-format", "npy")
        report = json.loads(self.dgtk("verify", self.path("tall"), "--json").stdout)
        self.assertGreater(next(row["count"] for row in report["residuals"] if row["layer"] == "sceneflow"), 0)

    def test_bytes_do_not_depend_on_threads_nor_on_what_else_is_asked(self):
        self.save_table()
        layers = "color,depth,objects,flow_forward,alpha,ldi,boxes"
        for name in ("right", "table"):
            self.render("one", scene(CAMERAS[name]), layers, "4", "--threads", "1", run=self.alone)
            self.render("five", scene(CAMERAS[name]), layers, "4", "--threads", "5")
            self.assert_same_files(self.path("one", "eye"), self.path("five", "eye"))
            self.render("some", scene(CAMERAS[name]), "depth,flow_forward", "4")
            for file in ("depth/000004.npy", "flow_forward/000004.flo", "flow_forward/000004.png"):
                self.assertEqual(contents(self.path("one", "eye", file)), contents(self.path("some", "eye", file)))

    def test_what_knows_one_instant_only_refuses(self):
        path = self.write("one.json", json.dumps(scene(CAMERAS["down"])))
        run = ("render", path, "-o", self.path("out"), "--frames", "4")
        for layers, *options in (["calibration"], ["depth", "--visibility", "raster"], ["color", "--renderer", "vtk"],
                                 ["color", "--renderer", "povray"], ["pov"], ["depth", "--depth-format", "dgd"]):
            self.refused(*run, "--layers", layers, *options, status=2, says=("'eye' (pinhole) has a rolling shutter"))
        self.dgtk(*run, "--layers", "ldi", "--quiet")
        self.refused("warp", self.path("out", "eye", "ldi", "000004.ldi"), "--to", "eye", "-o", self.path("warped.png"),
                     status=2, says="rolling shutter")
        # Of layers that were not named, those that need one instant are left out, and said.
        for word, layers in (("usual", []), ("all", ["--layers", "all"])):
            said = self.dgtk("render", path, "-o", self.path(word), "--frames", "4", "--size", "16x8", *layers).stderr
            left = {row["layer"]: row for row in load_json(self.path(word, "manifest.json"))["empty"]}
            self.assertIn("layers without a file: ", said)
            self.assertEqual(left["calibration"], {"layer": "calibration", "pictures": 1, "of": 1,
                                                   "needs": "a camera with a linear projection and no rolling shutter"})
            self.assertEqual("pov" in left, word == "all")
            self.dgtk("verify", self.path(word))
        known = json.loads(self.dgtk("info", path, "--json").stdout)["cameras"][0]
        self.assertEqual(known["rollingShutter"], {"duration": DURATION, "direction": "down"})
        record = load_json(self.path("out", "cameras.json"))["cameras"][0]
        self.assertEqual(record["rollingShutter"], {"duration": DURATION, "direction": "down"})
        for bad in ({"duration": -1}, {"duration": 1, "direction": "inward"}):
            self.write("bad.json", json.dumps(scene({"rollingShutter": bad})))
            self.refused("info", self.path("bad.json"), status=3, says="rollingShutter")


if __name__ == "__main__":
    main()
