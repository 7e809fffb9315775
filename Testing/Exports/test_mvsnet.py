# SPDX-License-Identifier: BSD-3-Clause
"""MVSNet's cameras, pairs and depth maps, read by line numbers as MVSNet_pytorch does and by words as the original does."""
import os

import numpy as np

import datasets
import hard_scenes
from datasets import layer_of, load_json, main

LAYERS = "color,depth,objects,tracks"
TRACKS = ("--tracks-step", 6, "--tracks-every", 1)


def read_cam(path):
    """datasets/general_eval.py: lines 1 to 4, 7 to 9, 11; the original counts 29 to 31 words."""
    with open(path) as file:
        lines = [line.rstrip() for line in file]
    extrinsic = np.array(" ".join(lines[1:5]).split(), float).reshape(4, 4)
    intrinsic = np.array(" ".join(lines[7:10]).split(), float).reshape(3, 3)
    assert len(" ".join(lines).split()) == 31, path
    return extrinsic, intrinsic, [float(word) for word in lines[11].split()]


def read_pairs(path):
    with open(path) as file:
        count = int(file.readline())
        pairs = []
        for _ in range(count):
            view, row = int(file.readline()), file.readline().split()
            assert len(row) == 2 * int(row[0]) + 1
            pairs.append((view, [int(i) for i in row[1::2]], [float(s) for s in row[2::2]]))
        assert not file.read()
    return pairs


def read_pfm(path):
    with open(path, "rb") as file:
        kind, size, scale, data = file.read().split(b"\n", 3)
    assert (kind, float(scale)) == (b"Pf", -1)
    width, height = map(int, size.split())
    return np.frombuffer(data, "<f4").reshape(height, width)[::-1]


def score(x, one, two):
    """colmap2mvsnet.py: of points that two cameras see."""
    a, b = one - x, two - x
    angle = np.degrees(np.arccos((a * b).sum(axis=1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)))
    return np.exp(-(angle - 5)**2 / (2 * np.where(angle <= 5, 1, 10)**2)).sum()


class Mvsnet(datasets.ExportCase):
    def test_views_of_one_frame(self):
        dataset = self.render(datasets.many(self.path("scene"), cameras=12), LAYERS, *TRACKS)
        folder, record = self.export(dataset, "mvsnet")
        pairs = read_pairs(os.path.join(folder, "cams", "pair.txt"))
        self.assertEqual([view for view, _, _ in pairs], list(range(12)))
        points = load_json(os.path.join(dataset, "tracks", "points.json"))["points"]
        x = np.array([point["x"] for point in points])
        seen, centres = [], []
        for number, entry in enumerate(record["names"]):
            self.assertEqual(entry["name"], f"blended_images/{number:08d}.jpg")
            E, K, (least, step, planes, most) = read_cam(os.path.join(folder, "cams", f"{number:08d}_cam.txt"))
            places = np.load(os.path.join(dataset, entry["camera"], "tracks", "000000.npy"))
            use = places[:, 2] == 1
            there = (E @ np.column_stack([x, np.ones(len(x))]).T)[:3]
            pixels = (K @ there)[:2] / there[2]
            self.assertLess(np.abs(pixels.T - places[:, :2])[use].max(), 1e-9)
            depth = layer_of(dataset, "depth", entry["camera"], 0)
            found = read_pfm(os.path.join(folder, "rendered_depth_maps", f"{number:08d}.pfm"))
            self.assertTrue(np.array_equal(found, np.where(np.isfinite(depth), depth, 0).astype(np.float32)))
            self.assertEqual((least, planes), (depth[np.isfinite(depth)].min(), 192))
            self.assertAlmostEqual(least + 191 * step, most, places=9)
            seen.append(use)
            centres.append(-E[:3, :3].T @ E[:3, 3])
        for view, others, scores in pairs:
            self.assertEqual(len(others), 10)
            expected = {other: score(x[seen[view] & seen[other]], centres[view], centres[other]) for other in set(range(12)) - {view}}
            self.assertEqual(others, sorted(expected, key=lambda i: (-expected[i], i))[:10])
            self.assertTrue(np.allclose(scores, [expected[i] for i in others], rtol=1e-6))
        said = self.planted(dataset, folder, "cams/pair.txt", lambda text: text.replace(b"\n10 ", b"\n10 1", 1))
        self.assertRegex(said, "layer (pairs|scores)")
        said = self.planted(dataset, folder, "cams/00000003_cam.txt", lambda text: text.replace(b"intrinsic\n", b"intrinsic\n1", 1))
        self.assertIn("layer intrinsics", said)

    def test_many_views_are_scored_with_the_best_by_a_sample(self):
        """Of 120 views on a circle, some of them behind the wall, the ten others are all but the best ten."""
        count = 120
        dataset = self.render(datasets.many(self.path("scene"), cameras=count), LAYERS, "--size", "48x36", "--tracks-step", 4, "--tracks-every", 1)
        folder, record = self.export(dataset, "mvsnet")
        x = np.array([point["x"] for point in load_json(os.path.join(dataset, "tracks", "points.json"))["points"]])
        seen = [np.load(os.path.join(dataset, entry["camera"], "tracks", "000000.npy"))[:, 2] == 1 for entry in record["names"]]
        poses = [read_cam(os.path.join(folder, "cams", f"{number:08d}_cam.txt"))[0] for number in range(count)]
        centres = [-E[:3, :3].T @ E[:3, 3] for E in poses]
        for view, others, scores in read_pairs(os.path.join(folder, "cams", "pair.txt"))[::7]:
            expected = {other: score(x[seen[view] & seen[other]], centres[view], centres[other]) for other in set(range(count)) - {view}}
            best = [one for one in sorted(expected.values(), reverse=True)[:10] if one > 0]
            self.assertEqual(len(set(others) - {view}), len(best))
            self.assertTrue(np.allclose(scores, [expected[i] for i in others], rtol=1e-6))
            self.assertGreater(sum(scores), 0.98 * sum(best))

    def test_moving_cameras_and_refusals(self):
        dataset = self.render(datasets.stereo(self.path("scene")), LAYERS, *TRACKS)
        folder, record = self.export(dataset, "mvsnet", "--depth-planes", 64)
        for number, entry in enumerate(record["names"]):
            ids = layer_of(dataset, "objects", entry["camera"], entry["frame"])
            found = read_pfm(os.path.join(folder, "rendered_depth_maps", f"{number:08d}.pfm"))
            self.assertTrue(np.array_equal(found > 0, np.isin(ids, [1, 2])), "what moves has no depth")
            self.assertEqual(read_cam(os.path.join(folder, "cams", f"{number:08d}_cam.txt"))[2][2], 64)
        empty = self.render(datasets.walk(self.path("walk")), LAYERS, *TRACKS)
        folder, _ = self.export(empty, "mvsnet")
        self.assertEqual(read_pairs(os.path.join(folder, "cams", "pair.txt"))[3], (3, [], []))
        self.assertEqual(read_cam(os.path.join(folder, "cams", "00000003_cam.txt"))[2][::3], [0.1, 100])
        flat = self.render(hard_scenes.flat(self.path("flat")), LAYERS)
        folder, _ = self.export(flat, "mvsnet")
        least, step, planes, most = read_cam(os.path.join(folder, "cams", "00000000_cam.txt"))[2]
        self.assertEqual(len(np.arange(least, step * (planes - 0.5) + least, step)), 192, "as the loaders make their planes")
        self.assertAlmostEqual(most, 1.01 * least)
        lens = self.render(datasets.lenses(self.path("lenses")), LAYERS)
        self.refused("export", lens, "--format", "mvsnet", "-o", self.path("no"), status=2, says=("mvsnet", "pinhole"))
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
