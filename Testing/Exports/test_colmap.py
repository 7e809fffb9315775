# SPDX-License-Identifier: BSD-3-Clause
"""COLMAP's models and workspaces, read and used by COLMAP itself (Debian's 3.8) and by a reader written from its documents."""
import json
import os
import re
import shutil
import sqlite3
import struct
import subprocess

import numpy as np

import datasets
from datasets import layer_of, main, read_png

MODELS = {1: ("PINHOLE", 4), 4: ("OPENCV", 8), 5: ("OPENCV_FISHEYE", 8), 6: ("FULL_OPENCV", 12)}
TRACKS = ("--tracks-step", 6, "--tracks-every", 1)
ROUNDING = 1e-12  # of float64 in pixels of such pictures: one unit is 1.4e-14


class Reader:
    """Little-endian numbers one after another."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data, self.at = file.read(), 0

    def __call__(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]

    def text(self):
        end = self.data.index(b"\0", self.at)
        text, self.at = self.data[self.at:end].decode("ascii"), end + 1
        return text


def read_model(folder):
    """cameras {id: (model, w, h, numbers)}, images {name: (id, q, t, camera, places n x 3)}, points {id: (x, rgb, track)}."""
    cameras, images, points = {}, {}, {}
    read = Reader(os.path.join(folder, "cameras.bin"))
    for _ in range(read("Q")):
        number, kind, width, height = read("IiQQ")
        name, count = MODELS[kind]
        cameras[number] = name, width, height, np.array(read(f"{count}d"))
    assert read.at == len(read.data)
    read = Reader(os.path.join(folder, "images.bin"))
    for _ in range(read("Q")):
        number, *pose = read("I7d")
        camera, name = read("I"), read.text()
        places = np.array([read("ddQ") for _ in range(read("Q"))]).reshape(-1, 3)
        images[name] = number, np.array(pose[:4]), np.array(pose[4:]), camera, places
    assert read.at == len(read.data)
    read = Reader(os.path.join(folder, "points3D.bin"))
    for _ in range(read("Q")):
        number, *x = read("Q3d")
        color = read("3B")
        read("d")
        points[number] = np.array(x), color, [read("II") for _ in range(read("Q"))]
    assert read.at == len(read.data)
    return cameras, images, points


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def projected(camera, x):
    """camera_models.h: WorldToImage of the four models."""
    model, _, _, n = camera
    a, b = x[0] / x[2], x[1] / x[2]
    square = a * a + b * b
    if model == "OPENCV_FISHEYE":
        r = np.sqrt(square)
        angle = np.arctan(r)
        bent = angle * (1 + n[4] * angle**2 + n[5] * angle**4 + n[6] * angle**6 + n[7] * angle**8)
        a, b = a * bent / r, b * bent / r
    elif model != "PINHOLE":
        radial = n[4] * square + n[5] * square**2
        if model == "FULL_OPENCV":
            radial = (1 + radial + n[8] * square**3) / (1 + n[9] * square + n[10] * square**2 + n[11] * square**3) - 1
        a, b = (a + a * radial + 2 * n[6] * a * b + n[7] * (square + 2 * a * a), b + b * radial + 2 * n[7] * a * b + n[6] * (square + 2 * b * b))
    return np.array([n[0] * a + n[2], n[1] * b + n[3]])


def colmap(*arguments):
    done = subprocess.run(["colmap", *map(str, arguments)], capture_output=True, text=True, timeout=250, env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "GLOG_logtostderr": "1"})
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return done.stdout + done.stderr


def database(path, cameras, images, points):
    """Keypoints and matches of a model's tracks, as the mapper and the triangulator read them. They are up to 2e-5 px off: of an exact
    pair of rays COLMAP takes the arc cosine of a number that rounding may lift above 1, and then leaves out the track of two pictures."""
    dice = np.random.default_rng(1)
    colmap("database_creator", "--database_path", path)
    base = sqlite3.connect(path)
    for number, (model, width, height, numbers) in cameras.items():
        kind = next(key for key, value in MODELS.items() if value[0] == model)
        base.execute("INSERT INTO cameras VALUES (?, ?, ?, ?, ?, 1)", (number, kind, width, height, numbers.tobytes()))
    for name, (number, q, t, camera, places) in images.items():
        base.execute("INSERT INTO images (image_id, name, camera_id) VALUES (?, ?, ?)", (number, name, camera))
        pixels = (places[:, :2] + dice.uniform(-2e-5, 2e-5, (len(places), 2))).astype(np.float32)
        base.execute("INSERT INTO keypoints VALUES (?, ?, 2, ?)", (number, len(pixels), pixels.tobytes()))
    pairs = {}
    for _, _, track in points.values():
        for i, (one, k) in enumerate(track):
            for two, m in track[i + 1:]:
                first, second = sorted([(one, k), (two, m)])
                pairs.setdefault((first[0], second[0]), []).append((first[1], second[1]))
    eye = np.eye(3).tobytes()
    for (one, two), matches in pairs.items():
        data = np.array(matches, np.uint32)
        base.execute("INSERT INTO two_view_geometries (pair_id, rows, cols, data, config, F, E, H) VALUES (?, ?, 2, ?, 2, ?, ?, ?)",
                     (2147483647 * one + two, len(data), data.tobytes(), eye, eye, eye))
    base.commit()
    base.close()


def read_map(path):
    """mvs/mat.h: rows, columns, channels."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, channels = (int(n) for n in data.split(b"&", 3)[:3])
    start = len(b"%d&%d&%d&" % (width, height, channels))
    return np.frombuffer(data, "<f4", offset=start).reshape(channels, height, width).transpose(1, 2, 0)


def read_fused(path):
    """Points and normals of COLMAP's fused.ply."""
    with open(path, "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    count = int(re.search(rb"element vertex (\d+)", head).group(1))
    kind = np.dtype([("x", "<f4", 3), ("n", "<f4", 3), ("c", "u1", 3)])
    return np.frombuffer(data, kind, count)


class Sparse(datasets.ExportCase):
    def reprojection(self, model):
        cameras, images, points = read_model(model)
        largest, count = 0, 0
        for number, q, t, camera, places in images.values():
            self.assertEqual(len(set(places[:, 2])), len(places))
            for i, (u, v, point) in enumerate(places):
                x, _, track = points[int(point)]
                self.assertIn((number, i), track)
                largest = max(largest, np.abs(projected(cameras[camera], rotation(q) @ x + t) - [u, v]).max())
                count += 1
        self.assertEqual(count, sum(len(track) for _, _, track in points.values()))
        return largest, count

    def adjusted(self, model):
        """The model after bundle adjustment. Of the residuals before it COLMAP says their mean; `model_analyzer` would read the file's own."""
        adjusted = self.path("adjusted")
        os.mkdir(adjusted)
        said = colmap("bundle_adjuster", "--input_path", model, "--output_path", adjusted)
        self.assertLess(float(re.search(r"Initial cost : (\S+) \[px\]", said)[1]), ROUNDING)
        return adjusted

    def test_colmap_agrees_with_every_number(self):
        """Reprojection is 0, all points are triangulated again, and bundle adjustment moves nothing."""
        dataset = self.render(datasets.walk(self.path("scene"), frames=5, empty=False), "color,objects,tracks", *TRACKS)
        folder, _ = self.export(dataset, "colmap")
        model = os.path.join(folder, "sparse", "0")
        largest, count = self.reprojection(model)
        self.assertLess(largest, ROUNDING)
        self.assertGreater(count, 500)
        said = colmap("model_analyzer", "--path", model)
        cameras, images, points = read_model(model)
        self.assertRegex(said, rf"Points: {len(points)}\b")

        database(self.path("base.db"), cameras, images, points)
        again = self.path("again")
        os.mkdir(again)
        bare = self.path("bare")
        os.mkdir(bare)
        colmap("model_converter", "--input_path", model, "--output_path", bare, "--output_type", "TXT")
        with open(os.path.join(bare, "images.txt")) as file:
            lines = [line for line in file if not line.startswith("#")]
        with open(os.path.join(bare, "images.txt"), "w") as file:
            file.writelines(line if i % 2 == 0 else "\n" for i, line in enumerate(lines))
        open(os.path.join(bare, "points3D.txt"), "w").close()
        colmap("point_triangulator", "--database_path", self.path("base.db"), "--image_path", os.path.join(folder, "images"),
               "--input_path", bare, "--output_path", again, "--clear_points", 1, "--Mapper.tri_min_angle", 1e-4,
               "--Mapper.filter_min_tri_angle", 1e-4, "--Mapper.tri_ignore_two_view_tracks", 0)
        _, _, found = read_model(again)
        truth = np.array([x for x, _, _ in points.values()])
        apart = np.array([np.linalg.norm(truth - x, axis=1).min() for x, _, _ in found.values()])
        print(f"{len(found)} of {len(points)} points triangulated, {np.median(apart):.1e} apart")
        tracks, taken = ({frozenset(map(tuple, track)) for _, _, track in model.values()} for model in (points, found))
        self.assertGreater(sum(len(track) == 2 for track in tracks), 10)
        self.assertEqual(tracks, taken)
        # 2e-5 px at 4.5 units, f 87 px and 0.24 to 1.2 units between two views are 4e-6 to 2e-5 units, more where a track is of the nearest two
        self.assertLess(np.median(apart), 1.2e-5)
        self.assertLess(apart.max(), 2e-4)

        adjusted = self.adjusted(model)
        for one, two in zip(read_model(model)[0].values(), read_model(adjusted)[0].values()):
            self.assertLess(np.abs(one[3] - two[3]).max(), ROUNDING)

    def test_lenses_project_as_ours(self):
        dataset = self.render(datasets.lenses(self.path("scene")), "color,objects,tracks", *TRACKS)
        folder, _ = self.export(dataset, "colmap")
        cameras, _, _ = read_model(os.path.join(folder, "sparse", "0"))
        self.assertEqual(sorted(kind for kind, *_ in cameras.values()), ["FULL_OPENCV", "OPENCV", "OPENCV_FISHEYE", "PINHOLE"])
        largest, count = self.reprojection(os.path.join(folder, "sparse", "0"))
        self.assertGreater(count, 500)
        self.assertLess(largest, ROUNDING)
        self.adjusted(os.path.join(folder, "sparse", "0"))

    def test_what_is_beside_or_behind_a_fisheye(self):
        """COLMAP divides by z: it has no place for what a wider fisheye sees of it; of that there is no observation."""
        dataset = self.render(datasets.room(self.path("scene")), "color,objects,tracks", *TRACKS)
        folder, record = self.export(dataset, "colmap")
        model = os.path.join(folder, "sparse", "0")
        largest, count = self.reprojection(model)
        self.assertLess(largest, 1e-9)  # beside the camera the arc tangent is of a large number
        x = np.array([point["x"] for point in datasets.load_json(os.path.join(dataset, "tracks", "points.json"))["points"]])
        seen, ahead = [], []
        for (camera, _), entry in datasets.cameras_of(dataset).items():
            seen.append(np.load(os.path.join(dataset, camera, "tracks", "000000.npy"))[:, 2] == 1)
            ahead.append((x @ entry["R"].T + entry["t"])[:, 2] > 0)
        seen, ahead = np.array(seen), np.array(ahead)
        self.assertEqual(count, 2 * np.all(seen & ahead, axis=0).sum())
        [layer] = [one for one in record["layers"] if one["layer"] == "tracks"]
        self.assertEqual((layer["values"], layer["without_code"]), (seen.sum(), (seen & ~ahead).sum()))
        self.assertGreater(min(count, layer["without_code"]), 100)
        self.adjusted(model)
        self.refused("export", dataset, "--format", "colmap", "-o", self.path("no"), "--out-of-range", "refuse", status=2,
                     says=f"{(seen & ~ahead)[0].sum()} values of layer tracks (camera 'beside', frame 0) have no code in the format")
        self.assertFalse(os.path.exists(self.path("no")))

        def turned(data):  # the first camera looks the other way: 180 degrees about its y, then x and z change their signs
            q = struct.unpack_from("<7d", data, 12)
            return data[:12] + struct.pack("<7d", -q[2], q[3], q[0], -q[1], -q[4], q[5], -q[6]) + data[68:]

        rows = self.planted(dataset, folder, "sparse/0/images.bin", turned, rows=True)["residuals"]
        self.assertEqual([row["largest"] for row in rows if row["layer"] == "reprojection"], ["inf"])

    def test_what_moves_is_masked_or_has_a_model_a_frame(self):
        dataset = self.render(datasets.stereo(self.path("scene")), "color,objects,tracks", *TRACKS)
        folder, record = self.export(dataset, "colmap")
        for entry in record["names"]:
            mask = read_png(os.path.join(folder, "masks", entry["name"][len("images/"):] + ".png"))[..., 0]
            ids = layer_of(dataset, "objects", entry["camera"], entry["frame"])
            self.assertTrue(np.array_equal(mask == 0, np.isin(ids, [3, 4])))
        largest, count = self.reprojection(os.path.join(folder, "sparse", "0"))
        self.assertLess(largest, ROUNDING)
        self.assertGreater(count, 300)
        each, _ = self.export(dataset, "colmap", "--moving", "frame", "--picture-names", "flat")
        self.assertEqual(sorted(os.listdir(each)), ["export.json", "images", "sparse"])
        self.assertEqual(sorted(os.listdir(os.path.join(each, "sparse"))), ["000000", "000001", "000002"])
        self.assertIn("left_eye_000000.png", os.listdir(os.path.join(each, "images")))
        objects = {i + 1: point["object"] for i, point in
                   enumerate(datasets.load_json(os.path.join(dataset, "tracks", "points.json"))["points"])}
        for frame in ("000000", "000002"):
            largest, _ = self.reprojection(os.path.join(each, "sparse", frame))
            self.assertLess(largest, ROUNDING)
            held = {objects[point] for point in read_model(os.path.join(each, "sparse", frame))[2]}
            self.assertTrue({3, 4} & held, "points of what moves")

    def test_text_is_the_same_model(self):
        dataset = self.render(datasets.walk(self.path("scene")), "color,objects,tracks", *TRACKS)  # its last frame is empty
        one, _ = self.export(dataset, "colmap")
        two, _ = self.export(dataset, "colmap", "--model-format", "txt", "--image-format", "jpg")
        back = self.path("back")
        os.mkdir(back)
        colmap("model_converter", "--input_path", os.path.join(two, "sparse", "0"), "--output_path", back, "--output_type", "BIN")
        for first, second in zip(read_model(os.path.join(one, "sparse", "0")), read_model(back)):
            self.assertEqual(sorted(str(key).replace(".png", "") for key in first), sorted(str(key).replace(".jpg", "") for key in second))
        first, second = (read_model(model)[2] for model in (os.path.join(one, "sparse", "0"), back))
        for number, (x, color, track) in first.items():
            self.assertTrue(np.array_equal(x, second[number][0]))
            self.assertEqual((color, track), second[number][1:])

    def test_the_referee_finds_what_is_wrong(self):
        dataset = self.render(datasets.walk(self.path("scene"), empty=False), "color,objects,tracks", *TRACKS)
        folder, _ = self.export(dataset, "colmap")

        def changed(at):
            return lambda data: data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]

        self.assertIn("layer intrinsics", self.planted(dataset, folder, "sparse/0/cameras.bin", changed(8 + 24 + 16 + 5)))
        self.assertIn("layer pose", self.planted(dataset, folder, "sparse/0/images.bin", changed(8 + 4 + 32 + 16 + 6)))
        self.assertRegex(self.planted(dataset, folder, "sparse/0/points3D.bin", changed(8 + 8 + 5)), "layer reprojection")
        self.assertRegex(self.planted(dataset, folder, "sparse/0/points3D.bin", changed(8 + 8 + 24)), "layer colors")
        self.assertRegex(self.planted(dataset, folder, "sparse/0/points3D.bin", lambda data: data[:-1]), "ends early")

    def test_refusals(self):
        scene = datasets.lenses(self.path("scene"))
        dataset = self.render(scene, "color,depth,normal,objects,tracks")
        self.refused("export", dataset, "--format", "colmap-dense", "-o", self.path("no"), status=2, says=("colmap-dense", "fish"))
        self.refused("export", dataset, "--format", "colmap", "-o", self.path("no"), "--split", "train=0:0", status=2, says="no parts")
        plain = self.render(scene, "color")
        self.refused("export", plain, "--format", "colmap", "-o", self.path("no"), status=2, says="lacks layers")
        self.assertFalse(os.path.exists(self.path("no")))


def read_rigs(folder):
    """rigs {id: {camera: (q, t)}}, frames [(rig, q, t, {image: camera})], as "Output Format" of 3.12 has them."""
    rigs, frames = {}, []
    read = Reader(os.path.join(folder, "rigs.bin"))
    for _ in range(read("Q")):
        number, count, kind, first = read("IIiI")
        assert kind == 0
        rigs[number] = {first: (np.array([1., 0, 0, 0]), np.zeros(3))}
        for _ in range(count - 1):
            kind, camera, has_pose, *pose = read("iIB7d")
            assert (kind, has_pose) == (0, 1)
            rigs[number][camera] = np.array(pose[:4]), np.array(pose[4:])
    assert read.at == len(read.data)
    read = Reader(os.path.join(folder, "frames.bin"))
    for number in range(read("Q")):
        found, rig, *pose = read("II7d")
        assert found == number + 1
        data = [read("iIQ") for _ in range(read("I"))]
        assert all(kind == 0 for kind, _, _ in data)
        frames.append((rig, np.array(pose[:4]), np.array(pose[4:]), {image: camera for _, camera, image in data}))
    assert read.at == len(read.data)
    return rigs, frames


class Rigs(datasets.ExportCase):
    def test_a_moving_pair_is_a_rig(self):
        """Poses through the rig are the pictures' own, and rig_bundle_adjuster moves nothing."""
        scene = datasets.stereo(self.path("scene"))
        with open(scene, encoding="utf-8") as file:
            whole = json.load(file)
        whole["cameras"].append(datasets._camera("still", [0.2, 0.3, 5], [0, 0, 0]))
        with open(scene, "w", encoding="utf-8") as file:
            json.dump(whole, file)
        dataset = self.render(scene, "color,objects,tracks", *TRACKS)
        folder, _ = self.export(dataset, "colmap", "--rigs")
        model = os.path.join(folder, "sparse", "0")
        cameras, images, points = read_model(model)
        by_number = {number: (q, t, camera) for number, q, t, camera, _ in images.values()}
        rigs, frames = read_rigs(model)
        self.assertEqual([sorted(rig) for rig in rigs.values()], [[1, 2], [3]])
        self.assertEqual([(rig, len(pictures)) for rig, _, _, pictures in frames], [(1, 2), (2, 1)] * 3)
        self.assertEqual(sorted(image for *_, pictures in frames for image in pictures), sorted(by_number))
        for rig, q, t, pictures in frames:
            for image, camera in pictures.items():
                own_q, own_t, own_camera = by_number[image]
                self.assertEqual(camera, own_camera)
                turn, place = rigs[rig][camera]
                self.assertLess(np.abs(rotation(turn) @ rotation(q) - rotation(own_q)).max(), 1e-14)
                self.assertLess(np.abs(rotation(turn) @ t + place - own_t).max(), 1e-14)

        adjusted = self.path("adjusted")
        os.mkdir(adjusted)
        said = colmap("rig_bundle_adjuster", "--input_path", model, "--output_path", adjusted, "--rig_config_path",
                      os.path.join(model, "rig_config.json"), "--estimate_rig_relative_poses", 0)
        self.assertRegex(said, r"Cameras: 2\s+Snapshots: 3")
        self.assertLess(float(re.search(r"Initial cost : (\S+)", said).group(1)), 1e-12)
        for name, (_, q, t, *_) in read_model(adjusted)[1].items():
            self.assertLess(max(np.abs(q - images[name][1]).max(), np.abs(t - images[name][2]).max()), 1e-14)
        [rig] = datasets.load_json(os.path.join(model, "rig_config.json"))  # rig_configurator's keys say the same
        self.assertEqual([camera.get("ref_sensor") for camera in rig["cameras"]], [True, None])
        self.assertEqual(rig["cameras"][1]["cam_from_rig_translation"], rig["cameras"][1]["rel_tvec"])

        text, _ = self.export(dataset, "colmap", "--rigs", "--model-format", "txt")
        with open(os.path.join(text, "sparse", "0", "rigs.txt")) as file:
            self.assertEqual([line.split()[:4] for line in file][1:], [["1", "2", "CAMERA", "1"], ["2", "1", "CAMERA", "3"]])
        each, _ = self.export(dataset, "colmap", "--rigs", "--moving", "frame", "--picture-names", "flat")
        self.assertEqual(len(read_rigs(os.path.join(each, "sparse", "000001"))[1]), 2)
        self.assertIn("layer pose", self.planted(dataset, folder, "sparse/0/frames.bin", lambda data: data[:62] + bytes([data[62] ^ 16]) + data[63:]))
        self.assertIn("layer rigs", self.planted(dataset, folder, "sparse/0/rig_config.json", lambda data: data.replace(b"-0.12", b"-0.13", 1)))

    def test_refusals(self):
        one = self.render(datasets.many(self.path("one"), 2), "color,objects,tracks")
        self.refused("export", one, "--format", "colmap", "-o", self.path("no"), "--rigs", status=2, says=("rigs:", "no two cameras"))
        scene = datasets.stereo(self.path("scene"), 2)
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        with open(scene, "w", encoding="utf-8") as file:
            file.write(text.replace('"right.eye"', '"top left eye"'))
        names = self.render(scene, "color,objects,tracks")
        self.refused("export", names, "--format", "colmap", "-o", self.path("no"), "--rigs", status=2, says=("rigs:", "left_eye/", "rename camera"))
        self.assertFalse(os.path.exists(self.path("no")))


class Dense(datasets.ExportCase):
    def test_fused_points_lie_on_the_surfaces(self):
        """stereo_fusion's points are on the wall's plane to float32; half a pixel in cx, cy would be 1e-2 off."""
        scene = datasets.many(self.path("scene"), cameras=6)
        dataset = self.render(scene, "color,depth,normal,objects,tracks", "--size", "192x144", *TRACKS)
        folder, _ = self.export(dataset, "colmap-dense")
        for camera in ("cam 0", "cam 5"):
            name = os.path.join(folder, "stereo", "{}", camera.replace(" ", "_"), "000000.png.geometric.bin")
            depth = layer_of(dataset, "depth", camera, 0)
            self.assertTrue(np.array_equal(read_map(name.format("depth_maps"))[..., 0], np.where(np.isfinite(depth), depth, 0).astype(np.float32)))
            normals = layer_of(dataset, "normal", camera, 0)
            found = read_map(name.format("normal_maps"))
            self.assertTrue(np.array_equal(found, np.nan_to_num(normals, nan=0).astype(np.float32)))
            self.assertLessEqual(found[..., 2].max(), 0.2)
        fused = self.path("fused.ply")
        colmap("stereo_fusion", "--workspace_path", folder, "--workspace_format", "COLMAP", "--input_type", "geometric",
               "--output_path", fused, "--StereoFusion.min_num_pixels", 2, "--StereoFusion.max_reproj_error", 0.5)
        points = read_fused(fused)
        wall = np.abs(points["x"][:, 2] + 2.9)
        near = wall[(wall < 0.05) & (points["n"][:, 2] > 0.999)]
        print(f"{len(points)} points fused, {len(near)} on the wall, {near.mean():.1e} off")
        self.assertGreater(len(near), 3000)
        self.assertLess(near.mean(), 1e-6)  # float32 of 7.4 units is rounded by 2.4e-7 at most

        # the same with the sparse model's matrix, half a pixel away
        sparse, _ = self.export(dataset, "colmap")
        wrong = self.path("wrong")
        shutil.copytree(folder, wrong)
        for name in ("cameras.bin", "images.bin", "points3D.bin"):
            shutil.copy(os.path.join(sparse, "sparse", "0", name), os.path.join(wrong, "sparse", name))
        colmap("stereo_fusion", "--workspace_path", wrong, "--workspace_format", "COLMAP", "--input_type", "geometric",
               "--output_path", fused, "--StereoFusion.min_num_pixels", 2, "--StereoFusion.max_reproj_error", 0.5)
        points = read_fused(fused)
        off = np.abs(points["x"][:, 2] + 2.9)
        wall = off[(off < 0.05) & (points["n"][:, 2] > 0.999)]
        print(f"half a pixel away {wall.mean():.1e} off")
        self.assertGreater(wall.mean(), 5e-3)

    def test_what_moves_has_no_depth(self):
        dataset = self.render(datasets.stereo(self.path("scene")), "color,depth,normal,objects,tracks", *TRACKS)
        folder, _ = self.export(dataset, "colmap-dense")
        found = read_map(os.path.join(folder, "stereo", "depth_maps", "left_eye", "000001.png.geometric.bin"))[..., 0]
        ids = layer_of(dataset, "objects", "left eye", 1)
        self.assertTrue(np.array_equal(found > 0, np.isin(ids, [1, 2])))
        each, _ = self.export(dataset, "colmap-dense", "--moving", "frame")
        found = read_map(os.path.join(each, "frame_000001", "stereo", "depth_maps", "left_eye", "000001.png.geometric.bin"))[..., 0]
        self.assertTrue(np.array_equal(found > 0, ids > 0))
        said = self.planted(dataset, folder, "stereo/depth_maps/left_eye/000001.png.geometric.bin", lambda data: data[:40] + bytes([data[40] ^ 32]) + data[41:])
        self.assertIn("layer depth", said)


if __name__ == "__main__":
    main()
