# SPDX-License-Identifier: BSD-3-Clause
"""POV-Ray's picture of flat ids is the object map, on all sample models and scenes, but within 1/64 pixel of an edge."""
import json
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy

from harness import DGTK, EXTRA, SCENES, SOURCE, Case, load_json, main, needs_povray
from pov_scene import Scene, Screen, ids_of, read_pnm
from test_ldi import read_png

MODELS = os.path.join(SOURCE, "Data", "Models")
EXTENSIONS = (".ac", ".acc", ".md2", ".3ds", ".pov", ".obj", ".gltf", ".stl", ".ply", ".off", ".dae", ".fbx")
SIZE = (160, 120)
WORKERS = 4  # POV-Ray sleeps for most of a small picture


def cameras_around(low, high):
    """Three cameras that see a box whole: centred, off-centre with unequal focal lengths and skew, orthographic."""
    centre, radius = (low + high) / 2, numpy.linalg.norm(high - low) / 2
    width, height = SIZE

    def camera(name, towards, distance, **more):
        eye = centre + radius * distance * numpy.array(towards) / numpy.linalg.norm(towards)
        return {"name": name, "width": width, "height": height, "eye": eye.tolist(), "lookAt": centre.tolist(),
                "near": 0.5 * radius, "far": 6 * radius, **more}

    return [camera("centred", (0.5, 0.35, 1), 2.9, fovY=42),
            camera("off-centre", (-0.9, 0.5, -0.7), 3, K=[[190, 9, 62], [0, 145, 71], [0, 0, 1]]),
            camera("orthographic", (0.3, 1, 0.6), 2.5, model="orthographic", viewHeight=2.2 * radius)]


@needs_povray
class FlatIds(Case):
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

    def compare(self, name, scene, cameras, frame, size=None):
        """Renders and draws; returns lines that say what differs without an edge near, and counts."""
        folder = self.path(name)
        self.dgtk("render", scene, "-o", folder, "--quiet", "--visibility", "ray", "--layers", "color,objects,pov", "--renderer",
                  "povray", "--pov-flat-ids", "--threads", WORKERS, "--frames", frame, "--cameras", ",".join(cameras),
                  *(["--size", size] if size else []))
        records = {c["name"]: c for c in load_json(os.path.join(folder, "cameras.json"))["cameras"]}
        far, counts = [], numpy.zeros(3, int)
        for camera in cameras:
            expected = ids_of(read_pnm(os.path.join(folder, camera, "objects", f"{frame:06d}.ppm")))
            drawn = ids_of(read_png(os.path.join(folder, camera, "color", f"{frame:06d}.png")))
            differing = numpy.argwhere(drawn != expected)
            counts += (expected.size, (expected > 0).sum(), len(differing))
            if len(differing):
                screen = Screen(Scene(os.path.join(folder, camera, "pov", f"{frame:06d}.pov")), records[camera])
                for row, column in differing:
                    centre = numpy.array([column + 0.5, row + 0.5])
                    if not screen.near_edge(centre) and not screen.near_texel(centre):
                        far.append(f"{name} {camera}: pixel ({column}, {row}) is {drawn[row, column]}, not {expected[row, column]}")
        shutil.rmtree(folder)
        return far, counts

    def model(self, path):
        """A scene with a model alone; nothing for one without surfaces."""
        info = self.dgtk_json("info", path, damaged=path not in self.readable)
        if not info or not info["triangles"]:
            return [], numpy.zeros(3, int)
        low, high = numpy.array(info["bounds"])
        name = os.path.basename(path).replace(" ", "_") + f"_{abs(hash(path)) % 10**6}"
        scene = self.write(name + ".json", json.dumps({"version": 1, "objects": [{"name": "model", "model": path}],
                                                       "cameras": cameras_around(low, high)}))
        return self.compare(name, scene, ["centred", "off-centre", "orthographic"], 0)

    def dgtk_json(self, *arguments, damaged=False):
        """What dgtk prints; nothing for what may be damaged, and is."""
        done = subprocess.run([DGTK, *arguments, "--json"], capture_output=True, text=True, timeout=60)
        self.assertTrue(damaged or done.returncode == 0, done.stderr)
        return json.loads(done.stdout) if done.returncode == 0 else None

    def check(self, work):
        with ThreadPoolExecutor(WORKERS) as pool:
            results = list(pool.map(lambda job: job(), work))
        counts = sum(counts for _, counts in results)
        far = [line for lines, _ in results for line in lines]
        print(f"{len(results)} scenes: {counts[2]} of {counts[0]} pixels ({counts[1]} on surfaces) differ, {len(far)} not at an edge")
        self.assertGreater(counts[1], 0.02 * counts[0])
        self.assertEqual(far, [])

    def test_near_and_far_inside_an_object(self):
        """The cut is between near and far: its other sides would show other surfaces, or none."""
        model = os.path.join(MODELS, "chair.3ds")
        low, high = numpy.array(self.dgtk_json("info", model)["bounds"])
        radius = numpy.linalg.norm(high - low) / 2
        cameras = [{**camera, "near": 2.4 * radius, "far": 3.1 * radius} for camera in cameras_around(low, high)]
        scene = self.write("cut.json", json.dumps({"version": 1, "objects": [{"name": "model", "model": model}], "cameras": cameras}))
        names = [camera["name"] for camera in cameras]
        far, counts = self.compare("cut", scene, names, 0)
        self.assertEqual(far, [])
        self.assertGreater(counts[1], 1000)
        for camera in cameras:  # both planes cut something away
            camera.update(near=0.5 * radius, far=6 * radius)
        whole = self.write("whole.json", json.dumps({"version": 1, "objects": [{"name": "model", "model": model}], "cameras": cameras}))
        self.assertGreater(self.compare("whole", whole, names, 0)[1][1], counts[1] + 100)

    def test_models(self):
        paths = sorted(os.path.join(root, name) for top in (MODELS, EXTRA) if top for root, _, names in os.walk(top)
                       for name in names if os.path.splitext(name)[1].lower() in EXTENSIONS)
        self.assertGreater(len(paths), 15)
        truth = os.path.join(EXTRA, "TRUTH.json")
        self.readable = {path for path in paths if path.startswith(MODELS)}
        self.readable |= {os.path.join(EXTRA, name) for name, counts in (load_json(truth).items() if EXTRA else ()) if counts and counts.get("triangles")}
        self.check([lambda path=path: self.model(path) for path in paths])

    def sharp(self, path):
        """The scene, without what only the built-in renderer has: motion blur, depth of field, rolling shutters."""
        text = load_json(path) if path.endswith(".json") else {"cameras": []}
        if not any({"shutter", "rollingShutter", "lens"} & set(camera) for camera in text["cameras"]):
            return path
        for camera in text["cameras"]:
            camera.pop("shutter", None)
            camera.pop("lens", None)
            camera.pop("rollingShutter", None)
        for thing in text["objects"]:
            thing["model"] = os.path.join(SCENES, thing["model"])
        return self.write("sharp_" + os.path.basename(path), json.dumps(text))

    def test_scenes(self):
        work = []
        for name in sorted(os.listdir(SCENES)):
            if os.path.splitext(name)[1] in (".json", ".scene"):
                path = self.sharp(os.path.join(SCENES, name))
                info = self.dgtk_json("info", path)
                camera = info["cameras"][0]["name"]
                work.append(lambda path=path, name=name, camera=camera, frame=info["first_frame"]:
                            self.compare(name.replace(".", "_"), path, [camera], frame, "x".join(map(str, SIZE))))
        self.assertGreater(len(work), 12)
        self.check(work)


if __name__ == "__main__":
    main()
