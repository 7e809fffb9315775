# SPDX-License-Identifier: BSD-3-Clause
"""POV-Ray's picture of flat ids is the object map, on all sample models and scenes, but within 1/64 pixel of an edge."""
import glob
import json
import os
from concurrent.futures import ThreadPoolExecutor

import numpy

from harness import EXTRA, SCENES, SOURCE, WHOLE, copy_scenes, load_json, main, needs_povray
from many_runs import ManyCase
from pictures import read_png
from pov_scene import Scene, Screen, ids_of, read_pnm

MODELS = os.path.join(SOURCE, "Data", "Models")
EXTENSIONS = (".ac", ".acc", ".md2", ".3ds", ".pov", ".obj", ".gltf", ".stl", ".ply", ".off", ".dae", ".fbx")
SIZE = (160, 120) if WHOLE else (80, 60)
WORKERS = 4  # POV-Ray sleeps for most of a small picture


def cameras_around(low, high, times=1):
    """Three cameras that see a box whole: centred, off-centre with unequal focal lengths and skew, orthographic."""
    centre, radius = (low + high) / 2, numpy.linalg.norm(high - low) / 2
    width, height = (int(times * size) for size in SIZE)

    def camera(name, towards, distance, **more):
        eye = centre + radius * distance * numpy.array(towards) / numpy.linalg.norm(towards)
        return {"name": name, "width": width, "height": height, "eye": eye.tolist(), "lookAt": centre.tolist(),
                "near": 0.5 * radius, "far": 6 * radius, **more}

    K = (width / 160 * numpy.array([[190, 9, 62], [0, 145, 71], [0, 0, 160 / width]])).tolist()
    return [camera("centred", (0.5, 0.35, 1), 2.9, fovY=42), camera("off-centre", (-0.9, 0.5, -0.7), 3, K=K),
            camera("orthographic", (0.3, 1, 0.6), 2.5, model="orthographic", viewHeight=2.2 * radius)]


def side_by_side(models):
    """A scene of models, of which (path, low, high) are given, as large as the largest, in a square that all cameras see from its sides."""
    largest = max(numpy.linalg.norm(high - low) / 2 for _, low, high in models)
    across, along = numpy.array([0.81, 0, -0.59]), numpy.array([-0.17, 0.96, -0.23])
    things, side, step = [], int(numpy.ceil(numpy.sqrt(len(models)))), 2 * largest
    for i, (path, low, high) in enumerate(models):
        scale = largest / (numpy.linalg.norm(high - low) / 2)
        place = step * ((i % side - (side - 1) / 2) * across + (i // side - (side - 1) / 2) * along)
        things.append({"name": f"{i} {os.path.basename(path)}", "model": path, "scale": [scale] * 3,
                       "position": (place - scale * (low + high) / 2).tolist()})
    reach = numpy.ones(3) * (step * (side - 1) / numpy.sqrt(2) + largest) / numpy.sqrt(3)
    return {"version": 1, "objects": things, "cameras": cameras_around(-reach, reach, side)}


@needs_povray
class FlatIds(ManyCase):
    def test_differences_are_explained_by_edges_only(self):
        """What a camera sees that is moved by less than the 1/64 pixel differs at edges; by more, also elsewhere."""
        with open(os.path.join(SCENES, "cameras_all_kinds.json"), encoding="utf-8") as file:
            scene = json.load(file)
        for thing in scene["objects"]:
            thing["model"] = os.path.join(SCENES, thing["model"])
        camera = {**scene["cameras"][0], "width": 320, "height": 200, "K": [[350, 0, 125], [0, 280, 130], [0, 0, 1]], "near": 9, "far": 11}
        names = {"still": 0, "little": 0.011, "much": 0.2}
        scene["cameras"] = [{**camera, "name": name, "K": [[350, 0, 125 + by], [0, 280, 130 - by], [0, 0, 1]]}
                            for name, by in names.items()]
        folder = self.path("d")
        self.dgtk("render", self.write("s.json", json.dumps(scene)), "-o", folder, "--layers", "objects,pov", "--pov-flat-ids", "--visibility",
                  "ray", "--quiet", "--frames", "0")
        record = next(c for c in load_json(os.path.join(folder, "cameras.json"))["cameras"] if c["name"] == "still")
        screen = Screen(Scene(os.path.join(folder, "still", "pov", "000000.pov")), record)
        ids = {name: ids_of(read_pnm(os.path.join(folder, name, "objects", "000000.ppm"))) for name in names}
        for name, far in (("little", False), ("much", True)):
            pixels = numpy.argwhere(ids[name] != ids["still"])[:, ::-1] + 0.5
            explained = [screen.near_edge(pixel) or screen.near_texel(pixel) for pixel in pixels]
            self.assertGreater(len(pixels), 4)
            self.assertEqual(not all(explained), far, f"{name}: {sum(explained)} of {len(pixels)}")

    def compare(self, scenes, out, cameras, frame=0, options=()):
        """Renders and draws a scene, or all of a folder; returns what differs without an edge near, and counts of each picture.

        `cameras`: of each of the folders that the run makes, below `out`.
        """
        shares = range(WORKERS if len(cameras) > 1 else 1)
        command = ("render", scenes, "--quiet", "--visibility", "ray", "--pov-flat-ids", "--threads", WORKERS // len(shares), "--frames", frame, *options)
        with ThreadPoolExecutor(len(shares)) as pool:
            list(pool.map(lambda share: self.dgtk(*command, "-o", self.path(out), "--layers", "color,objects", "--renderer", "povray",
                                                  *(("--shard", f"{share}/{len(shares)}") if len(shares) > 1 else ())), shares))
        far, counts = [], {}
        for name in [os.path.join(folder, camera) for folder in cameras for camera in cameras[folder]]:
            expected = ids_of(read_pnm(self.path(out, name, "objects", f"{frame:06d}.ppm")))
            drawn = ids_of(read_png(self.path(out, name, "color", f"{frame:06d}.png"), (8, 3)))
            differing = numpy.argwhere(drawn != expected)
            counts[name] = numpy.array([expected.size, (expected > 0).sum(), len(differing)]), numpy.unique(expected)
            if len(differing):
                written = self.path(out + " as scenes")
                if not os.path.exists(written):
                    self.dgtk(*command, "-o", written, "--layers", "pov")
                folder, camera = os.path.split(os.path.join(written, name))
                record = next(c for c in load_json(os.path.join(folder, "cameras.json"))["cameras"] if c["name"] == camera)
                screen = Screen(Scene(os.path.join(folder, camera, "pov", f"{frame:06d}.pov")), record)
            for row, column in differing:
                centre = numpy.array([column + 0.5, row + 0.5])
                if not screen.near_edge(centre) and not screen.near_texel(centre):
                    far.append(f"{name}: pixel ({column}, {row}) is {drawn[row, column]}, not {expected[row, column]}")
        return far, counts

    def dgtk_json(self, *arguments, damaged=False):
        """What dgtk prints; nothing for what may be damaged, and is."""
        done = self.ran(*arguments, "--json", timeout=60)
        self.assertTrue(damaged or done.returncode == 0, done.stderr)
        return json.loads(done.stdout) if done.returncode == 0 else None

    def check(self, *found):
        far = [line for lines, _ in found for line in lines]
        counts = sum(counted for _, pictures in found for counted, _ in pictures.values())
        print(f"{sum(len(pictures) for _, pictures in found)} pictures: {counts[2]} of {counts[0]} pixels ({counts[1]} on surfaces) differ, "
              f"{len(far)} not at an edge")
        self.assertGreater(counts[1], 0.02 * counts[0])
        self.assertEqual(far, [])

    def test_near_and_far_inside_an_object(self):
        """The cut is between near and far: its other sides would show other surfaces, or none."""
        model = os.path.join(MODELS, "chair.3ds")
        low, high = numpy.array(self.dgtk_json("info", model)["bounds"])
        radius = numpy.linalg.norm(high - low) / 2
        cameras = [{**camera, "near": 2.4 * radius, "far": 3.1 * radius} for camera in cameras_around(low, high, 160 / SIZE[0])]
        scene = {"version": 1, "objects": [{"name": "model", "model": model}], "cameras": cameras}
        names = {"": [camera["name"] for camera in cameras]}
        far, cut = self.compare(self.write("cut.json", json.dumps(scene)), "cut", names)
        self.assertEqual(far, [])
        seen = sum(counts[1] for counts, _ in cut.values())
        self.assertGreater(seen, 1000)
        for camera in cameras:  # both planes cut something away
            camera.update(near=0.5 * radius, far=6 * radius)
        _, whole = self.compare(self.write("whole.json", json.dumps(scene)), "whole", names)
        self.assertGreater(sum(counts[1] for counts, _ in whole.values()), seen + 100)

    def test_models(self):
        """Sixteen of like sizes in a scene: POV-Ray takes longer to start than to draw one."""
        paths = sorted(os.path.join(root, name) for top in (MODELS, EXTRA) if top for root, _, names in os.walk(top)
                       for name in names if os.path.splitext(name)[1].lower() in EXTENSIONS)
        self.assertGreater(len(paths), 15)
        truth = os.path.join(EXTRA, "TRUTH.json")
        readable = {path for path in paths if path.startswith(MODELS)}
        readable |= {os.path.join(EXTRA, name) for name, counts in (load_json(truth).items() if EXTRA else ()) if counts and counts.get("triangles")}
        models = []
        for path in paths:
            info = self.dgtk_json("info", path, damaged=path not in readable)
            if info and info["triangles"]:
                models.append((path, *numpy.array(info["bounds"])))
        models.sort(key=lambda model: numpy.linalg.norm(model[2] - model[1]))
        groups = {f"{i:03d}": models[i:i + 16] for i in range(0, len(models), 16)}
        os.mkdir(self.path("groups"))
        for name, group in groups.items():
            self.write(f"groups/{name}.json", json.dumps(side_by_side(group)))
        far, counts = self.compare(self.path("groups"), "models", {name: ["centred", "off-centre", "orthographic"] for name in groups})
        for name, (_, seen) in counts.items():
            self.assertEqual(set(range(1, len(groups[name.split("/")[0]]) + 1)) - set(seen), set(), f"{name}: not all models are seen")
        self.check((far, counts))

    @staticmethod
    def sharp(scene):
        """The first camera alone, and without what only the built-in renderer has: motion blur, depth of field, rolling shutters."""
        scene["cameras"] = [{key: value for key, value in scene["cameras"][0].items() if key not in ("shutter", "lens", "rollingShutter")}]

    def test_scenes(self):
        size, found = ("--size", "x".join(map(str, SIZE))), []
        names = copy_scenes(self.folder, self.sharp, lambda name: name.endswith(".json"))
        cameras = {name: [load_json(os.path.join(SCENES, name + ".json"))["cameras"][0]["name"]] for name in names}
        for path in sorted(glob.glob(f"{SCENES}/*.scene")):
            info = self.dgtk_json("info", path)
            camera = info["cameras"][0]["name"]
            found.append(self.compare(path, os.path.basename(path), {"": [camera]}, info["first_frame"], (*size, "--cameras", camera)))
        self.assertGreater(len(cameras) + len(found), 12)
        self.check(*found, self.compare(self.path("Scenes"), "scenes", cameras, options=size))


if __name__ == "__main__":
    main()
