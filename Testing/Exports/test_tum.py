# SPDX-License-Identifier: BSD-3-Clause
"""TUM RGB-D, read as the benchmark's tools do: associate.py, evaluate_ate.py, evaluate_rpe.py, generate_pointcloud.py."""
import json
import os
import re
import shutil

import numpy as np

import datasets
from datasets import layer_of, load_json, main, read_png


def read_file_list(path):
    """associate.py: stamps to words; lines that begin with # are left out."""
    with open(path) as file:
        rows = [line.split(" ") for line in file.read().split("\n") if line and line[0] != "#"]
    return {float(row[0]): row[1:] for row in rows}


def associate(first, second, most=0.02):
    """associate.py: each stamp with the nearest of the other list, each once."""
    close = sorted((abs(a - b), a, b) for a in first for b in second if abs(a - b) < most)
    found, used_a, used_b = [], set(), set()
    for _, a, b in close:
        if a not in used_a and b not in used_b:
            used_a.add(a)
            used_b.add(b)
            found.append((a, b))
    return sorted(found)


def align(model, data):
    """evaluate_ate.py: Horn's rotation and translation, and the remaining distances."""
    centred = [points - points.mean(axis=1, keepdims=True) for points in (model, data)]
    u, _, vh = np.linalg.svd((centred[0] @ centred[1].T).T)
    fix = np.diag([1, 1, np.sign(np.linalg.det(u) * np.linalg.det(vh))])
    rotation = u @ fix @ vh
    shift = data.mean(axis=1, keepdims=True) - rotation @ model.mean(axis=1, keepdims=True)
    return np.linalg.norm(rotation @ model + shift - data, axis=0)


def transform44(row):
    """evaluate_rpe.py: tx ty tz qx qy qz qw."""
    t, q = np.array(row[:3], float), np.array(row[3:], float)
    q = q * np.sqrt(2 / q.dot(q))
    q = np.outer(q, q)
    return np.array([[1 - q[1, 1] - q[2, 2], q[0, 1] - q[2, 3], q[0, 2] + q[1, 3], t[0]],
                     [q[0, 1] + q[2, 3], 1 - q[0, 0] - q[2, 2], q[1, 2] - q[0, 3], t[1]],
                     [q[0, 2] - q[1, 3], q[1, 2] + q[0, 3], 1 - q[0, 0] - q[1, 1], t[2]], [0, 0, 0, 1]])


def relative_errors(truth, found):
    """evaluate_rpe.py with a step of one pose (Sturm et al. 2012): translations and angles, each (n - 1)."""
    steps = [[np.linalg.inv(a) @ b for a, b in zip(poses, poses[1:])] for poses in (truth, found)]
    errors = [np.linalg.inv(a) @ b for a, b in zip(*steps)]
    angles = [np.arctan2(np.linalg.norm([e[2, 1] - e[1, 2], e[0, 2] - e[2, 0], e[1, 0] - e[0, 1]]), np.trace(e[:3, :3]) - 1) for e in errors]
    return np.array([np.linalg.norm(e[:3, 3]) for e in errors]), np.array(angles)


def cloud(sequence, stamp, depth_name, pose):
    """generate_pointcloud.py with the intrinsics of calibration.txt: world points of the pixels that have a depth."""
    with open(os.path.join(sequence, "calibration.txt")) as file:
        fx, fy, cx, cy = map(float, file.read().split())
    codes = read_png(os.path.join(sequence, depth_name), (16, 1))[..., 0]
    v, u = np.nonzero(codes)
    z = codes[v, u] / 5000
    points = np.stack([(u - cx) * z / fx, (v - cy) * z / fy, z, np.ones(len(z))])
    return (pose @ points)[:3], u, v


class Tum(datasets.ExportCase):
    METRES = 0.5

    def setUp(self):
        super().setUp()
        self.dataset = self.render(datasets.in_units(datasets.walk(self.path("scene"), empty=False), self.METRES), "color,depth,position")
        self.sequence, self.record = self.export(self.dataset, "tum", "--unit-metres", self.METRES)

    def lists(self):
        return [read_file_list(os.path.join(self.sequence, name)) for name in ("rgb.txt", "depth.txt", "groundtruth.txt")]

    def test_lists_and_times(self):
        rgb, depth, truth = self.lists()
        self.assertEqual(associate(rgb, depth), [(f / 25, f / 25) for f in range(4)])
        self.assertEqual(associate(rgb, truth), [(f / 25, f / 25) for f in range(4)])
        with open(os.path.join(self.sequence, "associations.txt")) as file:
            for line, (stamp, name) in zip(file, sorted(rgb.items())):
                text = f"{stamp:.6f}"
                self.assertEqual(line, f"{text} rgb/{text}.png {text} depth/{text}.png\n")
        for row in truth.values():
            self.assertEqual(len(row), 7)  # one space between, none behind
            self.assertAlmostEqual(np.linalg.norm(np.array(row[3:], float)), 1, places=12)

    def test_trajectory(self):
        """The absolute trajectory error against the dataset's cameras is 0."""
        _, _, truth = self.lists()
        cameras = datasets.cameras_of(self.dataset)
        found = np.array([truth[stamp][:3] for stamp in sorted(truth)], float).T
        expected = np.array([-cameras["Kamera 1", f]["R"].T @ cameras["Kamera 1", f]["t"] for f in range(4)]).T * self.METRES
        self.assertLess(align(found, expected).max(), 1e-12)
        self.assertLess(np.abs(found - expected).max(), 1e-12)

    def test_relative_errors(self):
        """0 against the dataset's cameras; where one pose is moved or turned, or all are, what that comes to."""
        _, _, truth = self.lists()
        found = [transform44(truth[stamp]) for stamp in sorted(truth)]
        cameras = datasets.cameras_of(self.dataset)
        expected = []
        for frame in range(4):
            own = cameras["Kamera 1", frame]
            expected.append(np.vstack([np.column_stack([own["R"].T, -own["R"].T @ own["t"] * self.METRES]), [0, 0, 0, 1]]))
        moves, turns = relative_errors(expected, found)
        self.assertLess(max(moves.max(), turns.max()), 1e-12)
        step = np.eye(4)
        step[:3, 3] = [0.03, 0, 0.04]
        angle = 0.1
        turn = np.eye(4)
        turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        moves, turns = relative_errors(expected, [found[0], found[1] @ step, *found[2:]])
        np.testing.assert_allclose(moves, [0.05, 0.05, 0], atol=1e-12)
        self.assertLess(turns.max(), 1e-12)
        _, turns = relative_errors(expected, [found[0], found[1] @ turn, *found[2:]])
        np.testing.assert_allclose(turns, [angle, angle, 0], atol=1e-12)
        moves, turns = relative_errors(expected, [step @ turn @ pose for pose in found])  # of another world
        self.assertLess(max(moves.max(), turns.max()), 1e-12)

    def test_clouds_coincide(self):
        """Points of every frame lie where the scene's surface is, within the rounding of depth: K, poses and quaternions agree."""
        rgb, depth, truth = self.lists()
        largest = 0
        for frame, stamp in enumerate(sorted(depth)):
            points, u, v = cloud(self.sequence, stamp, depth[stamp][0], transform44(truth[stamp]))
            expected = layer_of(self.dataset, "position", "Kamera 1", frame)[v, u].T * self.METRES
            largest = max(largest, np.abs(points - expected).max())
        self.assertLess(largest, 1.3e-4)
        self.assertGreater(largest, 5e-5)
        print(f"clouds are {largest:.2e} m off, depth is rounded by 1e-4 m")

    def test_the_clouds_of_two_frames(self):
        """Points of one frame, seen in another, have that frame's depth where both see the surface."""
        _, depth, truth = self.lists()
        stamps = sorted(depth)
        points, _, _ = cloud(self.sequence, stamps[0], depth[stamps[0]][0], transform44(truth[stamps[0]]))
        camera = np.linalg.inv(transform44(truth[stamps[1]])) @ np.vstack([points, np.ones(points.shape[1])])
        with open(os.path.join(self.sequence, "calibration.txt")) as file:
            fx, fy, cx, cy = map(float, file.read().split())
        u, v = fx * camera[0] / camera[2] + cx, fy * camera[1] / camera[2] + cy
        codes = read_png(os.path.join(self.sequence, depth[stamps[1]][0]), (16, 1))[..., 0] / 5000
        inside = (u > 1) & (v > 1) & (u < codes.shape[1] - 2) & (v < codes.shape[0] - 2)
        x, y = np.floor(u[inside]).astype(int), np.floor(v[inside]).astype(int)
        a, b = u[inside] - x, v[inside] - y
        four = [codes[y, x], codes[y, x + 1], codes[y + 1, x], codes[y + 1, x + 1]]
        smooth = (np.max(four, axis=0) - np.min(four, axis=0) < 0.01) & (np.min(four, axis=0) > 0)
        there = (1 - b) * ((1 - a) * four[0] + a * four[1]) + b * ((1 - a) * four[2] + a * four[3])
        apart = np.abs(there - camera[2][inside])[smooth]
        self.assertGreater(len(apart), 1000)
        self.assertLess(np.median(apart), 2e-4)

    def test_icl_nuim(self):
        """Numbered frames, depth first, fy < 0: points of all frames lie on the surface of a world whose y is turned round."""
        folder, record = self.export(self.dataset, "tum", "--unit-metres", self.METRES, "--dialect", "icl-nuim")
        self.assertEqual(record["conventions"]["dialect"], "icl-nuim")
        with open(os.path.join(folder, "associations.txt")) as file:
            self.assertEqual(file.read().split("\n")[:2], ["0 depth/0.png 0 rgb/0.png", "1 depth/1.png 1 rgb/1.png"])
        with open(os.path.join(folder, "calibration.txt")) as file:
            fy = float(file.read().split()[1])
        self.assertLess(fy, 0)
        truth = read_file_list(os.path.join(folder, "groundtruth.txt"))
        self.assertEqual(sorted(truth), [0, 1, 2, 3])
        for frame in range(4):
            pose = transform44(truth[frame])
            self.assertAlmostEqual(np.linalg.det(pose[:3, :3]), 1, places=9)
            points, u, v = cloud(folder, frame, f"depth/{frame}.png", pose)
            expected = layer_of(self.dataset, "position", "Kamera 1", frame)[v, u].T * self.METRES * np.array([[1], [-1], [1]])
            self.assertLess(np.abs(points - expected).max(), 1.3e-4)
        self.assertIn("layer pose", self.planted(self.dataset, folder, "groundtruth.txt", lambda text: text.replace(b"0.15", b"0.25", 1)))
        self.assertIn("layer intrinsics", self.planted(self.dataset, folder, "calibration.txt", lambda text: text.replace(b" -", b" ", 1)))

    def test_eth3d_slam(self):
        folder, _ = self.export(self.dataset, "tum", "--unit-metres", self.METRES, "--dialect", "eth3d-slam")
        self.assertFalse(os.path.exists(os.path.join(folder, "associations.txt")))
        for name, other in (("associated.txt", "associations.txt"), ("groundtruth.txt", "groundtruth.txt"), ("calibration.txt", "calibration.txt")):
            with open(os.path.join(folder, name)) as file, open(os.path.join(self.sequence, other)) as own:
                self.assertEqual(file.read(), own.read())

    def test_several_cameras_and_the_referee(self):
        dataset = self.render(datasets.stereo(self.path("stereo")), "color,depth")
        folder, _ = self.export(dataset, "tum", "--image-format", "jpg")
        self.assertEqual(sorted(os.listdir(folder)), ["export.json", "left_eye", "right_eye"])
        planted = lambda name, change: self.planted(self.dataset, self.sequence, name, change)  # noqa: E731

        def swapped(text):
            head, *rows = text.split(b"\n0.040000 ")
            words = rows[0].split(b" ")
            words[3], words[4] = words[4], words[3]
            return head + b"\n0.040000 " + b" ".join(words)

        self.assertIn("layer pose", planted("groundtruth.txt", swapped))
        short = planted("groundtruth.txt", lambda text: re.sub(rb"(\n0\.040000 [^\n]*) [^ \n]+\n", rb"\1\n", text))
        with open(os.path.join(self.sequence, "groundtruth.txt"), encoding="utf-8") as file:
            rows = [line for line in file.read().split("\n") if line and line[0] != "#"]
        at = 1 + next(i for i, row in enumerate(rows) if row.startswith("0.040000 "))
        self.assertRegex(short, rf"groundtruth\.txt: found line {at}: ")
        self.assertIn(f"(line {at})", planted("groundtruth.txt", lambda text: text.replace(b"\n0.040000 ", b"\n0.041000 ", 1)))
        self.assertRegex(planted("depth.txt", lambda text: text.replace(b"\n0.080000", b"\n0.081000", 1)), "layer (time|associations)")
        lists = ("rgb.txt", "depth.txt", "groundtruth.txt", "associations.txt")  # which agree with each other then, but not with the dataset
        found = planted(lists, lambda text: re.sub(rb"(^|\n|png )0\.080000 ", rb"\g<1>0.080001 ", text))
        self.assertEqual(set(re.findall(r"layer (\w+)", found)), {"time"})
        self.assertIn("layer associations", planted("associations.txt", lambda text: text.replace(b"depth/0.080000", b"depth/0.120000", 1)))
        self.assertIn("layer intrinsics", planted("calibration.txt", lambda text: text.replace(b" 47.5 ", b" 48 ")))
        with open(os.path.join(self.sequence, "depth", "0.080000.png"), "rb") as file:
            other = file.read()
        self.assertIn("layer depth", planted("depth/0.040000.png", lambda data: other))

    def test_a_unit_that_the_dataset_says(self):
        """To a millionth, which is the rounding of a factor that somebody writes down."""
        self.export(self.dataset, "tum", "--unit-metres", self.METRES * (1 + 5e-7))
        for metres in (self.METRES * (1 + 2e-6), self.METRES * (1 - 2e-6), 1e-3):
            self.refused("export", self.dataset, "--format", "tum", "-o", self.path("none"), "--unit-metres", repr(metres), status=2,
                         says=f"unit-metres: the dataset says how long its unit is (expected 0.5, found {metres!r})")
        self.assertFalse(os.path.exists(self.path("none")))

    def test_frames_without_a_time(self):
        """Times are whole microseconds of 63 bits; numbered frames have none."""
        def paced(last):
            copy = self.path(f"paced{last}")
            shutil.copytree(self.dataset, copy)
            manifest = load_json(os.path.join(copy, "manifest.json"))
            self.write(os.path.join(copy, "manifest.json"), json.dumps({**manifest, "fps": 3 / last}))
            return copy

        folder, _ = self.export(paced(9.1e12), "tum", verify=False)
        self.assertIn("9100000000000.000000.png", os.listdir(os.path.join(folder, "rgb")))
        beyond = paced(9.3e12)
        self.refused("export", beyond, "--format", "tum", "-o", self.path("none"), status=2, says="tum: frame 3 has no time: microseconds have 63 bits")
        self.assertFalse(os.path.exists(self.path("none")))
        self.export(beyond, "tum", "--dialect", "icl-nuim", verify=False)


if __name__ == "__main__":
    main()
