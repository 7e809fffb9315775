#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times `dgtk` as users run it: whole processes on scenes of OBJ files, which the first run makes.

usage: whole_processes.py DGTK [--scenes S,M,L] [--rounds 3] [--work FOLDER] [--growth] [--exports] [--export-growth [--formats A,B]]

S, M, L: 10,000, 200,000 and 2,000,000 triangles in 10, 50 and 200 objects, 20 frames, one of them moving, 640x480.
Prints medians. start: dgtk --help, info of a model, and one 320x240 frame of depth and ids, beside `true`.
load: a frame of 16x12 pixels of depth, as a whole process; beside it, sha256sum of the same files, and the ratio.
again: the same with models that are kept; all else is measured without.
frame: (time of N frames - time of 2) / (N - 2), of colour, exact layers, both flows, and of all six, and the most memory.
--growth: many pictures, cameras and objects of a tiny scene, time and memory for each.
--exports: 200 and 1000 pictures of 640x480 to COCO, COLMAP and BOP, beside rendering them.
--export-growth: every format, or these, of 200 and 2000 frames of two 16x12 cameras: memory a frame of an export into a new folder (the least is
the dataset's own tables), over a finished one with --replace, of one that was killed half way with --resume, of a share that does it all, of merging, and
of dgtk verify --export."""
import argparse
import json
import math
import os
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

SCENES = {"S": (10, 1000, 10), "M": (50, 4000, 50), "L": (100, 10000, 200)}  # models, triangles of each, objects
LAYERS = {"colour": "color", "exact": "depth,normal,objects", "flows": "flow_forward,flow_backward",
          "all six": "color,depth,normal,objects,flow_forward,flow_backward"}


def timed(command):
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    error = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status:
        sys.exit(" ".join(command) + ": " + error.decode(errors="replace"))
    return time.perf_counter() - start, usage.ru_maxrss / 1024


def sphere(path, triangles, seed):
    dice = random.Random(seed)
    rings = max(4, int(math.sqrt(triangles / 4)))
    columns = 2 * rings
    waves = [(dice.randint(1, 5), dice.random() * 6, 0.1 * dice.random()) for _ in range(4)]
    with open(path, "w", encoding="ascii") as file:
        for i in range(rings + 1):
            for j in range(columns + 1):
                a, b = math.pi * i / rings, 2 * math.pi * j / columns
                r = 1 + sum(h * math.sin(n * b + p) * math.sin(a) for n, p, h in waves)
                x, y, z = math.sin(a) * math.cos(b), math.cos(a), -math.sin(a) * math.sin(b)
                file.write(f"v {r * x:.9g} {r * y:.9g} {r * z:.9g}\nvt {j / columns:.6g} {1 - i / rings:.6g}\nvn {x:.6g} {y:.6g} {z:.6g}\n")
        for i in range(rings):
            for j in range(columns):
                a = i * (columns + 1) + j + 1
                for face in ((a, a + columns + 1, a + columns + 2), (a, a + columns + 2, a + 1)):
                    file.write("f " + " ".join(f"{k}/{k}/{k}" for k in face) + "\n")


def make_scene(folder, models, triangles, objects):
    os.makedirs(folder)
    for i in range(models):
        sphere(f"{folder}/m{i}.obj", triangles, i)
    side = math.ceil(math.sqrt(objects))
    placed = [{"name": f"o{i}", "model": f"m{i % models}.obj", "scale": 1.2, "position": [3 * (i % side - side / 2), 0, 3 * (i // side - side / 2)]}
              for i in range(objects)]
    placed[0]["position"] = {"keys": [[0, [-2, 2, 0]], [21, [2, 2, 0]]]}
    around = [[f, [3 * side * math.cos(0.05 * f), side, 3 * side * math.sin(0.05 * f)]] for f in range(22)]
    scene = {"version": 1, "objects": placed, "cameras": [{"name": "c", "eye": {"keys": around}, "lookAt": [0, 0, 0], "fovY": 40}],
             "lights": [{"name": "sun", "kind": "directional", "position": [3, 9, 5], "target": [0, 0, 0]}]}
    with open(f"{folder}/scene.json", "w", encoding="ascii") as file:
        json.dump(scene, file)


class Bench:
    def __init__(self, dgtk, rounds, work):
        self.dgtk, self.rounds, self.work = os.path.abspath(dgtk), rounds, work

    def median(self, command):
        runs = [timed(command) for _ in range(self.rounds)]
        return statistics.median(r[0] for r in runs), statistics.median(r[1] for r in runs)

    def render(self, scene, *words):
        out = os.path.join(self.work, "out")
        shutil.rmtree(out, ignore_errors=True)
        return self.median([self.dgtk, "render", scene, "-o", out, "--replace", "--quiet", *words])

    def start(self, model):
        for name, command in (("true", ["true"]), ("--help", [self.dgtk, "--help"]), ("info", [self.dgtk, "info", model])):
            print(f"start  {name:<22} {1e3 * self.median(command)[0]:8.0f} ms")

    def scene(self, name):
        folder = os.path.join(self.work, name)
        if not os.path.exists(folder + "/scene.json"):
            shutil.rmtree(folder, ignore_errors=True)
            make_scene(folder, *SCENES[name])
        scene = folder + "/scene.json"
        if name == "S":
            self.start(folder + "/m0.obj")
            print(f"start  {'a small frame':<22} {1e3 * self.render(scene, '--frames', '1', '--size', '320x240', '--layers', 'depth,objects')[0]:8.0f} ms")
        small = ("--frames", "1", "--size", "16x12", "--layers", "depth")
        load = self.render(scene, *small)
        files = [f"{folder}/{file}" for file in sorted(os.listdir(folder))]
        reference = self.median(["sha256sum", *files])[0]
        print(f"load   {name:<22} {1e3 * load[0]:8.0f} ms {load[1]:8.0f} MB {load[0] / reference:8.2f} x sha256sum")
        os.environ["DGTK_CACHE"] = "2048"
        self.render(scene, *small)
        again = self.render(scene, *small)
        os.environ["DGTK_CACHE"] = "0"
        print(f"again  {name:<22} {1e3 * again[0]:8.0f} ms {again[1]:8.0f} MB {again[0] / reference:8.2f} x sha256sum")
        last = 8 if name == "L" else 20
        for what, layers in LAYERS.items():
            two = self.render(scene, "--frames", "1:2", "--layers", layers)
            many = self.render(scene, "--frames", f"1:{last}", "--layers", layers)
            print(f"frame  {name + ', ' + what:<22} {1e3 * (many[0] - two[0]) / (last - 2):8.0f} ms {many[1]:8.0f} MB")

    def growth(self):
        folder = os.path.join(self.work, "growth")
        os.makedirs(folder, exist_ok=True)
        for i in range(100):
            with open(f"{folder}/m{i}.obj", "w", encoding="ascii") as file:
                file.write(f"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 {1 + i / 100}\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n")
        camera = {"name": "c", "eye": [0, 0, 60], "lookAt": [0, 0, 0]}
        moving = {"model": "m0.obj", "position": {"keys": [[0, [0, 0, 0]], [99999, [1, 0, 0]]]}}
        rows = [("pictures", n, [moving], [camera], f"0:{n - 1}") for n in (1000, 10000, 100000)]
        rows += [("cameras", n, [{"model": "m0.obj"}], [dict(camera, name=f"c{i}", eye=[0, 0, 5 + i * 0.001]) for i in range(n)], "0") for n in (200, 2000)]
        rows += [("objects", n, [{"model": f"m{i % 100}.obj", "position": [0.3 * (i % 250) - 37, 0.3 * (i // 250) - 30, 0]} for i in range(n)], [camera], "0")
                 for n in (5000, 50000)]
        for what, count, objects, cameras, frames in rows:
            with open(folder + "/scene.json", "w", encoding="ascii") as file:
                json.dump({"version": 1, "objects": objects, "cameras": cameras, "keyFrames": [0, 99999]}, file)
            seconds, memory = self.render(folder + "/scene.json", "--frames", frames, "--size", "16x12", "--layers", "depth")
            print(f"growth {count:>7} {what:<14} {seconds:8.2f} s {memory:9.0f} MB {1e6 * seconds / count:8.0f} us each")


    def exports(self):
        """Exports of a dataset beside rendering what they need, and memory for five times the pictures."""
        folder = os.path.join(self.work, "S")
        if not os.path.exists(folder + "/scene.json"):
            make_scene(folder, *SCENES["S"])
        with open(folder + "/scene.json", encoding="ascii") as file:
            scene = json.load(file)
        scene.update(units="metre", keyFrames=[0, 999])
        with open(folder + "/long.json", "w", encoding="ascii") as file:
            json.dump(scene, file)
        formats = ["coco", "colmap", "bop"]
        for frames in (200, 1000):
            data = os.path.join(self.work, f"exported{frames}")
            rendered = timed([self.dgtk, "render", folder + "/long.json", "-o", data, "--replace", "--quiet", "--size", "640x480",
                              "--frames", f"0:{frames - 1}", "--for", ",".join(formats)])
            print(f"export {f'{frames} pictures, rendered':<24} {rendered[0]:8.1f} s {rendered[1]:8.0f} MB")
            total = 0
            for form in formats:
                out = os.path.join(self.work, "export")
                shutil.rmtree(out, ignore_errors=True)
                seconds, memory = timed([self.dgtk, "export", data, "--format", form, "-o", out, "--quiet"])
                total += seconds
                print(f"export {f'{frames} pictures, {form}':<24} {seconds:8.1f} s {memory:8.0f} MB")
            print(f"export {f'{frames} pictures, all':<24} {total:8.1f} s {total / rendered[0]:8.2f} x rendering")
            shutil.rmtree(data)

    def export_growth(self, chosen):
        folder = os.path.join(self.work, "export-growth")
        os.makedirs(folder, exist_ok=True)
        corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        with open(folder + "/box.obj", "w", encoding="ascii") as file:
            file.writelines("v %g %g %g\n" % corner for corner in corners)
            file.write("f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")
        rows = json.loads(subprocess.run([self.dgtk, "list", "exporters", "--json"], check=True, capture_output=True).stdout)["exporters"]
        forms = chosen.split(",") if chosen else [row["format"] for row in rows]
        few, many = 200, 2000
        move = {"keys": [[0, [-1, 0, 0]], [many - 1, [1, 0, 0]]]}
        cameras = [{"name": name, "fovY": 45, "near": 0.1, "far": 100, "eye": [x, 0, 8], "lookAt": [x, 0, 0]} for name, x in (("left", -0.1), ("right", 0.1))]
        with open(folder + "/scene.json", "w", encoding="ascii") as file:
            json.dump({"version": 1, "units": "metre", "fps": 25, "cameras": cameras, "objects": [{"model": "box.obj", "name": "box", "class": "box", "position": move}]}, file)
        memory = {}
        for frames in (few, many):
            data = f"{folder}/data{frames}"
            timed([self.dgtk, "render", folder + "/scene.json", "-o", data, "--replace", "--quiet", "--size", "16x12", "--frames", f"0:{frames - 1}", "--for", ",".join(forms)])
            for form in forms:
                memory[form, frames] = self.export_kinds(data, form, folder + "/out")
        kinds = list(memory[forms[0], few])
        print(f"{'KB a frame':<20}" + "".join(f"{kind:>9}" for kind in kinds) + "   MB at most")
        for form in forms:
            growth = [1024 * (memory[form, many][kind] - memory[form, few][kind]) / (many - few) for kind in kinds]
            print(f"export {form:<13}" + "".join(f"{each:9.2f}" for each in growth) + f"{max(memory[form, many].values()):13.1f}", flush=True)

    def export_kinds(self, data, form, out):
        """The most memory of each way to make an export, and of the referee."""
        command = [self.dgtk, "export", data, "--format", form, "-o", out, "--quiet"]
        shutil.rmtree(out, ignore_errors=True)
        seconds, fresh = timed(command)
        found = {"new": fresh, "replace": timed(command + ["--replace"])[1], "verify": timed([self.dgtk, "verify", data, "--export", out])[1]}
        shutil.rmtree(out)
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as killed:
            time.sleep(seconds / 2)
            killed.kill()
        found["resume"] = timed(command + ["--resume"])[1]
        shutil.rmtree(out)
        found["share"] = timed(command + ["--shard", "0/1"])[1]
        found["merge"] = timed([self.dgtk, "merge", out])[1]
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dgtk")
    parser.add_argument("--scenes", default="S,M,L")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--work", default=os.path.join(tempfile.gettempdir(), "dgtk-whole-processes"))
    parser.add_argument("--growth", action="store_true")
    parser.add_argument("--exports", action="store_true")
    parser.add_argument("--export-growth", action="store_true")
    parser.add_argument("--formats", help="of --export-growth, else all")
    words = parser.parse_args()
    os.makedirs(words.work, exist_ok=True)
    os.environ.update(XDG_CACHE_HOME=os.path.abspath(words.work), DGTK_CACHE="0")
    bench = Bench(words.dgtk, words.rounds, words.work)
    for name in words.scenes.split(",") if words.scenes else []:
        bench.scene(name)
    if words.growth:
        bench.growth()
    if words.exports:
        bench.exports()
    if words.export_growth:
        bench.export_growth(words.formats)


if __name__ == "__main__":
    main()
