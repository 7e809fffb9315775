# SPDX-License-Identifier: BSD-3-Clause
"""alpha, coverage, matting, boxes, amodal and points from the files on disk, against other renders and NumPy."""
import json
import os
import struct

import numpy as np

from pictures import read_exr, read_png
from harness import SCENES, Case, digests, load_json, main

DEMO = os.path.join(SCENES, "demo.json")  # has an animated MD2 and a spinning glTF
LAYERS = "alpha,coverage,boxes,amodal,points"


def cryptomatte_hash(name):
    """MurmurHash3_x86_32 with seed 0, and the exponent's bit flipped where needed."""
    data, mask = name.encode(), 0xffffffff
    value = 0

    def mix(k):
        k = k * 0xcc9e2d51 & mask
        return (k << 15 | k >> 17) * 0x1b873593 & mask
    for i in range(0, len(data) // 4 * 4, 4):
        value ^= mix(struct.unpack("<I", data[i:i + 4])[0])
        value = ((value << 13 | value >> 19) * 5 + 0xe6546b64) & mask
    tail = data[len(data) // 4 * 4:]
    value ^= mix(int.from_bytes(tail, "little"))
    value ^= len(data)
    for shift, factor in ((16, 0x85ebca6b), (13, 0xc2b2ae35), (16, 1)):
        value = (value ^ value >> shift) * factor & mask
    return value ^ (1 << 23) if value >> 23 & 255 in (0, 255) else value


def read_ids(path):
    with open(path, "rb") as file:
        data = file.read()
    width, height = map(int, data.split(b"\n")[1].split())
    p = np.frombuffer(data[-width * height * 3:], np.uint8).reshape(height, width, 3).astype(np.int64)
    return p[..., 0] << 16 | p[..., 1] << 8 | p[..., 2]


def decode(mask, width, height):
    values = np.repeat(np.arange(len(mask["counts"])) % 2, mask["counts"])
    return values.reshape(width, height).T.astype(bool)


class ObjectsTruth(Case):
    def render(self, folder, *options, scene=DEMO):
        self.dgtk("render", scene, "-o", self.path(folder), "--quiet", *options)
        return self.path(folder)

    def test_alpha_and_coverage_are_the_thesis_rule_on_a_picture_four_times_as_large(self):
        small = self.render("small", "--layers", "alpha,coverage", "--samples", 4, "--size", "160x120", "--frames", "1",
                            "--cameras", "left")
        large = self.render("large", "--layers", "objects,depth", "--size", "640x480", "--frames", "1", "--cameras", "left",
                            "--visibility", "ray")
        blocks = lambda a: a.reshape(120, 4, 160, 4).transpose(0, 2, 1, 3).reshape(120, 160, 16)
        ids = blocks(read_ids(os.path.join(large, "left/objects/000001.ppm")))
        depth = blocks(np.load(os.path.join(large, "left/depth/000001.npy")))
        nearest = np.take_along_axis(ids, depth.argmin(axis=2)[..., None], axis=2)
        count = (ids == nearest).sum(axis=2)
        alpha = read_png(os.path.join(small, "left/alpha/000001.png"))
        found = alpha[..., 0] << 16 | alpha[..., 1] << 8 | alpha[..., 2]
        self.assertLessEqual((found != nearest[..., 0]).sum(), 3)  # rays through edges, rounded differently
        same = found == nearest[..., 0]
        wrong = alpha[..., 3] != np.floor(255 * count / 16 + 0.5)
        self.assertLessEqual((wrong & same).sum(), 3)
        self.assertGreater((alpha[..., 3] < 255).sum(), 500)

        header, channels = read_exr(os.path.join(small, "left/coverage/000001.exr"))
        key = f"cryptomatte/{cryptomatte_hash('CryptoObject'):08x}"[:19] + "/"
        self.assertEqual(header[key + "name"], b"CryptoObject")
        manifest = json.loads(header[key + "manifest"])
        objects = load_json(os.path.join(small, "objects.json"))["objects"]
        self.assertEqual(manifest, {o["name"]: f"{cryptomatte_hash(o['name']):08x}" for o in objects})
        bits = {0: 0, **{cryptomatte_hash(o["name"]): o["id"] for o in objects}}
        ranks = []
        for level in range(len(channels) // 4):
            for i, c in (("r", "g"), ("b", "a")):
                name = f"CryptoObject{level:02d}."
                raw = np.ascontiguousarray(channels[name + i]).view(np.uint32)
                self.assertEqual(set(np.unique(raw)) - set(bits), set(), "ids that are no hash of a name")
                ranks.append((np.vectorize(bits.get)(raw), np.rint(channels[name + c].astype(float) * 16).astype(int)))
        self.assertGreaterEqual(len(ranks), 6)
        self.assertTrue((sum(c for _, c in ranks) == 16).all())
        for before, after in zip(ranks, ranks[1:]):
            self.assertTrue((before[1] >= after[1]).all())
        differing = np.zeros((120, 160), bool)
        for identity in range(len(objects) + 1):
            covered = sum(np.where(i == identity, c, 0) for i, c in ranks)
            differing |= covered != (ids == identity).sum(axis=2)
            own = found == identity  # alpha and coverage come from the same samples
            self.assertTrue((np.floor(255 * covered[own] / 16 + 0.5) == alpha[own][:, 3]).all())
        self.assertLessEqual(differing.sum(), 5)

    def test_one_sample_is_the_objects_layer(self):
        for engine in ("raster", "ray"):
            folder = self.render(engine, "--layers", "alpha,objects", "--size", "160x120", "--frames", "0", "--cameras",
                                 "left", "--visibility", engine)
            alpha = read_png(os.path.join(folder, "left/alpha/000000.png"))
            ids = read_ids(os.path.join(folder, "left/objects/000000.ppm"))
            self.assertTrue(((alpha[..., 0] << 16 | alpha[..., 1] << 8 | alpha[..., 2]) == ids).all())
            self.assertTrue((alpha[..., 3] == 255).all())

    def test_boxes_and_amodal_masks(self):
        folder = self.render("boxes", "--layers", "boxes,amodal,objects,objectcoords,position", "--size", "160x120",
                             "--frames", "1", "--cameras", "right", "--visibility", "ray")
        ids = read_ids(os.path.join(folder, "right/objects/000001.ppm"))
        amodal = load_json(os.path.join(folder, "right/amodal/000001.json"))
        self.assertEqual((amodal["width"], amodal["height"]), (160, 120))
        masks = {m["id"]: decode(m, 160, 120) for m in amodal["masks"]}
        own = np.load(os.path.join(folder, "right/objectcoords/000001.npy")).astype(float)
        world = np.load(os.path.join(folder, "right/position/000001.npy")).astype(float)
        camera = [c for c in load_json(os.path.join(folder, "cameras.json"))["cameras"] if c["name"] == "right"][0]
        pose = [f for f in camera["frames"] if f["frame"] == 1][0] if "frames" in camera else camera
        boxes = load_json(os.path.join(folder, "right/boxes/000001.json"))
        self.assertEqual((boxes["camera"], boxes["frame"]), ("right", 1))
        names = [o["name"] for o in load_json(os.path.join(folder, "objects.json"))["objects"]]
        self.assertEqual([o["name"] for o in boxes["objects"]], names)
        hidden = 0
        for o in boxes["objects"]:
            visible = ids == o["id"]
            mask = masks.get(o["id"], np.zeros_like(visible))
            self.assertFalse((visible & ~mask).any())
            self.assertEqual((o["pixels_visible"], o["pixels_amodal"]), (visible.sum(), mask.sum()))
            hidden += o["pixels_amodal"] - o["pixels_visible"]
            for pixels, box in ((visible, o["box_visible"]), (mask, o["box_amodal"])):
                y, x = np.nonzero(pixels)
                self.assertEqual(box, [x.min(), y.min(), x.max() + 1, y.max() + 1] if len(x) else None)
            if mask.any():
                self.assertAlmostEqual(o["visible_fraction"], visible.sum() / mask.sum())
            if mask.any() and np.array(o["box3d"])[:, 2].min() > 0:
                clipped = np.clip(o["box_projected"], 0, [160, 120, 160, 120])
                self.assertTrue((clipped[:2] <= np.add(o["box_amodal"][:2], 0.5)).all())
                self.assertTrue((clipped[2:] >= np.subtract(o["box_amodal"][2:], 0.5)).all())
            matrix = np.array(o["matrix"])
            if o["R"] is not None:
                composed = np.array(o["R"]) @ np.diag(o["scale"])
                self.assertLess(abs(composed - matrix[:, :3]).max(), 1e-9)
                self.assertAlmostEqual(np.linalg.det(o["R"]), 1)
            corners = np.array(o["box3d"])
            inside = np.linalg.solve(matrix[:, :3], (corners - matrix[:, 3]).T).T
            for bit in range(3):
                side = np.array([i >> bit & 1 for i in range(8)], bool)
                self.assertLess(np.ptp(inside[side, bit]), 1e-6)
                self.assertTrue((inside[side, bit].min() >= inside[~side, bit].max() - 1e-9))
            if visible.any():
                in_camera = world[visible] @ np.array(pose["R"]).T + np.array(pose["t"])
                self.assertLess(abs(own[visible] @ matrix[:, :3].T + matrix[:, 3] - in_camera).max(), 1e-4)
                self.assertTrue((own[visible] >= inside.min(axis=0) - 1e-5).all())
                self.assertTrue((own[visible] <= inside.max(axis=0) + 1e-5).all())
        self.assertGreater(hidden, 1000)
        # each object by itself shows what is amodal; the terrain, the rigid and the deforming ones
        scene = load_json(DEMO)
        for name in ("terrain", "house", "creature", "crate three"):
            alone = dict(scene, objects=[dict(o, model=os.path.join(SCENES, o["model"])) for o in scene["objects"]
                                         if o["name"] == name])
            frame = 1 if "keys" in json.dumps(alone["objects"]) else 0  # what does not move has frame 0 only
            solo = self.render(f"only {name}", "--layers", "objects", "--size", "160x120", "--frames", frame, "--cameras",
                               "right", "--visibility", "ray", scene=self.write(f"{name}.json", json.dumps(alone)))
            picture = read_ids(os.path.join(solo, f"right/objects/00000{frame}.ppm"))
            with self.subTest(name=name):
                self.assertLessEqual(((picture > 0) != masks[names.index(name) + 1]).sum(), 2)

    def test_points(self):
        folder = self.render("points", "--layers", "points,position,normal,objects", "--size", "160x120", "--frames", "1",
                             "--points-step", 3, "--visibility", "ray")
        cloud = load_json(os.path.join(folder, "points/000001.json"))
        self.assertEqual((cloud["frame"], cloud["cameras"]), (1, ["left", "right"]))
        with open(os.path.join(folder, "points/000001.ply"), "rb") as file:
            text, body = file.read().split(b"end_header\n", 1)
        kind = np.dtype([("x", "<f8", 3), ("n", "<f4", 3), ("rgb", "u1", 3), ("object", "<u4"), ("triangle", "<u4")])
        ply = np.frombuffer(body, kind)
        self.assertIn(f"element vertex {len(ply)}\n".encode(), text)
        points = cloud["points"]
        self.assertEqual(len(points), len(ply))
        self.assertTrue((np.array([p["x"] for p in points]) == ply["x"]).all())
        self.assertTrue(([p["object"] for p in points] == ply["object"]).all())
        self.assertTrue(([p["triangle"] for p in points] == ply["triangle"]).all())
        self.assertLess(abs(np.linalg.norm(ply["n"], axis=1) - 1).max(), 1e-5)
        self.assertGreater(len(np.unique(ply["rgb"], axis=0)), 20)
        files = {c: {l: os.path.join(folder, c, l, "000001") for l in ("position", "normal", "objects")} for c in cloud["cameras"]}
        position = [np.load(files[c]["position"] + ".npy").astype(float) for c in cloud["cameras"]]
        normal = [np.load(files[c]["normal"] + ".npy").astype(float) for c in cloud["cameras"]]
        ids = [read_ids(files[c]["objects"] + ".ppm") for c in cloud["cameras"]]
        poses = {}
        for camera in load_json(os.path.join(folder, "cameras.json"))["cameras"]:
            pose = [f for f in camera["frames"] if f["frame"] == 1][0] if "frames" in camera else camera
            poses[camera["name"]] = (np.array(pose["K"] if "K" in pose else camera["K"]), np.array(pose["R"]), np.array(pose["t"]))
        seen_by = [0, 0]
        both = 0
        for p, n in zip(points, ply["n"]):
            x = np.array(p["x"])
            first = p["track"][0]
            seen_by[first[0]] += 1
            both += len(p["track"]) == 2
            self.assertEqual(sorted(s[0] for s in p["track"]), [s[0] for s in p["track"]])
            # the camera that it comes from has it at a pixel of the grid
            column, row = first[1] - 0.5, first[2] - 0.5
            self.assertEqual((column % 3, row % 3), (1, 1))
            at = int(row), int(column)
            self.assertLess(abs(position[first[0]][at] - x).max(), 1e-5 * max(1, abs(x).max()))
            self.assertEqual(ids[first[0]][at], p["object"])
            K, R, t = poses[cloud["cameras"][first[0]]]
            self.assertLess(abs(R @ n - normal[first[0]][at]).max(), 1e-5)
            for camera, u, v in p["track"]:
                K, R, t = poses[cloud["cameras"][camera]]
                projected = K @ (R @ x + t)
                self.assertLess(abs(projected[:2] / projected[2] - [u, v]).max(), 1e-6)
        grid = [(ids[c][1::3, 1::3] > 0).sum() for c in (0, 1)]
        self.assertLessEqual(abs(seen_by[0] - grid[0]), 2)  # no camera comes before the first; rays on edges
        self.assertLess(seen_by[1], grid[1] / 4)
        self.assertGreater(seen_by[1], 0)
        self.assertGreater(both, grid[0] / 2)

    def test_matting(self):
        options = ("--size", "160x120", "--frames", "1", "--cameras", "left", "--samples", 4, "--color-bits", 16)
        folder = self.render("matting", "--layers", "matting,coverage,color", "--matte", "creature,crate one", *options)
        scene = load_json(DEMO)
        for name in ("creature", "crate one"):
            stem = os.path.join(folder, "left", f"matting_{name}", "000001_")
            alpha, F, B, C, trimap = (read_png(stem + n + ".png") for n in
                                      ("alpha", "foreground", "background", "composite", "trimap"))
            self.assertEqual((alpha.shape[2], F.shape[2], trimap.shape[2]), (1, 3, 1))
            self.assertGreater((alpha == 65535).sum(), 50)
            self.assertGreater(((alpha > 0) & (alpha < 65535)).sum(), 50)
            a = alpha / 65535
            self.assertLess(abs(a * F + (1 - a) * B - C).max(), 1)
            self.assertTrue((F[alpha[..., 0] == 0] == 0).all())
            # trimap: no pixel is surely one thing that is not; the band is narrow
            self.assertTrue((alpha[trimap == 0] == 0).all() and (alpha[trimap == 255] == 65535).all())
            self.assertEqual(set(np.unique(trimap)), {0, 128, 255})
            # alpha is the coverage, but for the engines' opinion of edges
            _, channels = read_exr(os.path.join(folder, "left/coverage/000001.exr"))
            key = np.array([cryptomatte_hash(name)], np.uint32).view(np.float32)[0]
            covered = sum(np.where(channels[c] == key, channels[c[:-1] + {"r": "g", "b": "a"}[c[-1]]], 0)
                          for c in channels if c[-1] in "rb")
            self.assertLess(abs(covered - a[..., 0]).max(), 0.2)
            self.assertLess(abs(covered - a[..., 0]).mean(), 1e-3)
            # where the object is alone, foreground is the picture
            color = read_png(os.path.join(folder, "left/color/000001.png"))
            alone = alpha[..., 0] == 65535
            self.assertLessEqual(abs(F[alone] - color[alone]).max(), 1)
            self.assertLessEqual(abs(C[alpha[..., 0] == 0] - B[alpha[..., 0] == 0]).max(), 0)
            # the background is the picture of the scene without the object
            rest = dict(scene, objects=[dict(o, model=os.path.join(SCENES, o["model"])) for o in scene["objects"] if o["name"] != name])
            path = self.write("rest.json", json.dumps(rest))
            plate = self.render(f"without {name}", "--layers", "color", *options, scene=path)
            picture = read_png(os.path.join(plate, "left/color/000001.png"))
            self.assertLessEqual((abs(picture - B) > 1).sum(), 3)

    def test_same_bytes(self):
        common = ("--layers", LAYERS + ",matting", "--matte", "creature", "--samples", 2, "--size", "96x72", "--frames", "0:2:2")
        self.render("one", *common, "--threads", 1)
        for name, options in (("five", ("--threads", 5)), ("osmesa", ("--threads", 2, "--gl", "osmesa"))):
            self.assert_same_files(self.path("one"), self.render(name, *common, *options))
        # each layer alone, and one frame alone
        for layer in LAYERS.split(","):
            alone = digests(self.render(layer, "--layers", layer, "--samples", 2, "--size", "96x72", "--frames", "2"))
            whole = digests(self.path("one"))
            names = [n for n in alone if "/" in n]
            self.assertGreater(len(names), 0)
            for name in names:
                self.assertEqual(alone[name], whole[name], name)

    def test_refusals(self):
        self.refused("render", DEMO, "-o", self.path("a"), "--layers", "matting", status=2, says="the names of the objects")
        self.refused("render", DEMO, "-o", self.path("a"), "--layers", "matting", "--matte", "nobody", status=2, says="--matte: the scene has no object 'nobody'")
        self.refused("render", DEMO, "-o", self.path("a"), "--layers", "points", "--points-step", "0", status=2,
                     says="--points-step")
        self.assertFalse(os.path.exists(self.path("a")))


if __name__ == "__main__":
    main()
