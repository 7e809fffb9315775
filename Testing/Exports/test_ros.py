# SPDX-License-Identifier: BSD-3-Clause
"""Bags read by ROS's own rosbag and its message classes; MCAP by a reader written from the specification."""
import glob
import hashlib
import io
import json
import os
import re
import shutil
import struct
import zlib

import numpy as np
import rosbag
import sensor_msgs.msg
import tf2_msgs.msg

import datasets
from datasets import cameras_of, layer_of, load_json, main
from judges import by_node

TYPES = {cls._type: cls for cls in (sensor_msgs.msg.Image, sensor_msgs.msg.CompressedImage, sensor_msgs.msg.CameraInfo,
                                    tf2_msgs.msg.TFMessage)}


def messages_of_bag(path):
    """(topic, nanoseconds, message) in the order of times, by rosbag. Classes are made anew from the bag's own definitions."""
    with rosbag.Bag(path) as bag:
        for connection in bag._get_connections():
            cls = TYPES[connection.datatype]
            assert connection.md5sum == cls._md5sum, connection.datatype
        return [(topic, time.to_nsec(), message) for topic, message, time in bag.read_messages()]


class Reader:
    """Numbers and texts one after another."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, code):
        values = struct.unpack_from("<" + code, self.data, self.at)
        self.at += struct.calcsize("<" + code)
        return values[0] if len(values) == 1 else values

    def bytes(self):
        size = self.take("I")
        self.at += size
        return self.data[self.at - size:self.at]

    def text(self):
        return self.bytes().decode()

    def pairs(self, code):
        inner, found = Reader(self.bytes()), []
        while inner.at < len(inner.data):
            found.append(inner.take(code))
        return found


def records(data, at, end):
    while at < end:
        op, size = struct.unpack_from("<BQ", data, at)
        yield op, at, Reader(data[at + 9:at + 9 + size]), at + 9 + size
        at += 9 + size


def messages_of_mcap(path):
    """The same of an MCAP file, through its summary; sums, indices and statistics are held to the specification."""
    with open(path, "rb") as file:
        data = file.read()
    magic = b"\x89MCAP0\r\n"
    assert data[:8] == data[-8:] == magic
    footer = len(data) - 8 - 29
    assert data[footer] == 2
    summary, offsets, total = struct.unpack_from("<QQI", data, footer + 9)
    assert zlib.crc32(data[summary:len(data) - 12]) == total
    end = summary - 13
    assert data[end] == 15 and struct.unpack_from("<I", data, end + 9)[0] == zlib.crc32(data[:end])
    schemas, channels, chunks, groups = {}, {}, [], {}
    statistics = None
    for op, at, reader, after in records(data, summary, footer):
        groups.setdefault(op, [at, at])[1] = after
        if op == 3:
            number, name, encoding, definition = reader.take("H"), reader.text(), reader.text(), reader.bytes()
            assert encoding == "ros1msg"
            schemas[number] = name, definition.decode()
        elif op == 4:
            number, schema, topic, encoding = reader.take("H"), reader.take("H"), reader.text(), reader.text()
            metadata = Reader(reader.bytes())
            words = {metadata.text(): metadata.text() for _ in range(2)}
            cls = TYPES[schemas[schema][0]]
            assert encoding == "ros1" and words == {"md5sum": cls._md5sum, "topic": topic}
            assert md5_of(schemas[schema][1]) == cls._md5sum
            channels[number] = topic, cls
        elif op == 8:
            times, place = reader.take("QQ"), reader.take("QQ")
            chunks.append((times, place, dict(reader.pairs("HQ")), reader.take("Q"), reader.text(), reader.take("QQ")))
        elif op == 11:
            statistics = reader.take("QHIIIIQQ"), dict(reader.pairs("HQ"))
        elif op == 14:
            group, begin, size = reader.take("BQQ")
            assert groups[group] == [begin, begin + size] and at >= offsets
    found, counts = [], {}
    for (first, last), (start, length), indices, index_bytes, packed, (a, b) in chunks:
        assert data[start] == 6 and packed == "" and a == b
        chunk = Reader(data[start + 9:start + length])
        assert chunk.take("QQQ") == (first, last, a)
        total, packed, size = chunk.take("I"), chunk.text(), chunk.take("Q")
        inside = chunk.data[chunk.at:]
        assert packed == "" and size == len(inside) == a and zlib.crc32(inside) == total
        listed = []
        for number, position in indices.items():
            op, size = struct.unpack_from("<BQ", data, position)
            entry = Reader(data[position + 9:position + 9 + size])
            assert op == 7 and entry.take("H") == number
            listed += [(offset, number, time) for time, offset in entry.pairs("QQ")]
        there = []
        for op, at, reader, _ in records(inside, 0, len(inside)):
            number, _, time, published = reader.take("HIQQ")
            assert op == 5 and time == published and first <= time <= last
            there.append((at, number, time))
            topic, cls = channels[number]
            found.append((topic, time, cls().deserialize(reader.data[reader.at:])))
            counts[number] = counts.get(number, 0) + 1
        assert sorted(listed) == there and index_bytes > 0
    times = [time for _, time, _ in found]
    assert statistics == ((len(found), len(schemas), len(channels), 0, 0, len(chunks), min(times), max(times)), counts)
    return found


def with_sums(data):
    """The same with the sums of what it now holds."""
    data = bytearray(data)
    for op, at, reader, after in list(records(data, 8, len(data) - 8)):
        if op == 6:
            reader.at = 28
            reader.text()
            struct.pack_into("<I", data, at + 9 + 24, zlib.crc32(reader.data[reader.at + 8:]))
        elif op == 15:
            struct.pack_into("<I", data, at + 9, zlib.crc32(data[:at]))
            summary = after
    struct.pack_into("<I", data, len(data) - 12, zlib.crc32(data[summary:len(data) - 12]))
    return bytes(data)


def md5_of(definition):
    """ROS's sum: constants first, then fields, the types of others by their own sums."""
    first, *others = re.split("=+\nMSG: ", definition)
    parts = {text.split("\n", 1)[0].split("/")[1]: text.split("\n", 1)[1] for text in others}

    def total(fields):
        lines = []
        for line in fields.strip().split("\n"):
            kind, name = line.split()
            base = kind.split("[")[0].split("/")[-1]
            lines.append(f"{total(parts[base])} {name}" if base in parts else line)
        return hashlib.md5("\n".join(lines).encode()).hexdigest()

    return total(first)


def turned(q):
    """A rotation of x y z w."""
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def transforms_of(messages):
    """nanoseconds -> child -> (R, t)."""
    found = {}
    for topic, time, message in messages:
        for one in message.transforms if topic == "/tf" else ():
            assert one.header.frame_id == "world" and one.header.stamp.to_nsec() == time
            t = one.transform.translation
            assert one.child_frame_id not in found.setdefault(time, {})
            found[time][one.child_frame_id] = turned(one.transform.rotation), np.array([t.x, t.y, t.z])
    return found


def pixels_of(info, points):
    """sensor_msgs/distortion_models.h: raw pixels, whole at their centres, of points in the camera's axes, by OpenCV's equations."""
    K = np.array(info.K).reshape(3, 3)
    a, b = (points[:, :2] / points[:, 2:]).T
    square = a * a + b * b
    if info.distortion_model == "equidistant":
        k1, k2, k3, k4 = info.D
        r = np.sqrt(square)
        angle = np.arctan(r)
        bent = angle * (1 + k1 * angle**2 + k2 * angle**4 + k3 * angle**6 + k4 * angle**8)
        a, b = a * bent / r, b * bent / r
    else:
        k1, k2, p1, p2, k3, k4, k5, k6 = (*info.D, 0, 0, 0)[:8]
        radial = (1 + k1 * square + k2 * square**2 + k3 * square**3) / (1 + k4 * square + k5 * square**2 + k6 * square**3)
        a, b = (a * radial + 2 * p1 * a * b + p2 * (square + 2 * a * a), b * radial + 2 * p2 * a * b + p1 * (square + 2 * b * b))
    return np.column_stack([K[0, 0] * a + K[0, 2], K[1, 1] * b + K[1, 2]])


READ_MCAP = """
const fs = require("fs"), crypto = require("crypto"), { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const data = fs.readFileSync(process.argv[1]);
function row(schemas, channels, message) {
  const channel = channels.get(message.channelId);
  return [channel.topic, schemas.get(channel.schemaId).name, String(message.logTime), crypto.createHash("sha256").update(message.data).digest("hex")];
}
async function main() {
  const bytes = (from, count) => new Uint8Array(data.subarray(Number(from), Number(from + count)));
  const file = await McapIndexedReader.Initialize({ readable: { size: async () => BigInt(data.length), read: async (from, count) => bytes(from, count) } });
  const indexed = [], streamed = [], schemas = new Map(), channels = new Map();
  for await (const message of file.readMessages()) indexed.push(row(file.schemasById, file.channelsById, message));
  const stream = new McapStreamReader({ validateCrcs: true });
  stream.append(new Uint8Array(data));
  for (let record; (record = stream.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") streamed.push(row(schemas, channels, record));
  }
  if (!stream.done()) throw new Error("the file ends early");
  return { indexed, streamed };
}
main().then((found) => console.log(JSON.stringify(found)));
"""


class Ros(datasets.ExportCase):
    METRES = 0.5
    NAMES = {"left eye": "left_eye", "right.eye": "right_eye"}

    def setUp(self):
        super().setUp()
        self.dataset = self.render(datasets.in_units(datasets.stereo(self.path("scene")), self.METRES), "color,depth,position")
        exports = {form: self.export(self.dataset, form) for form in ("rosbag", "mcap")}
        self.folders, self.records = ({form: export[i] for form, export in exports.items()} for i in (0, 1))
        self.messages = messages_of_bag(os.path.join(self.folders["rosbag"], "dataset.bag"))

    def by_topic(self, topic):
        return {round((time / 1e9 - 1) * 25): message for name, time, message in self.messages if name == topic}

    def test_both_hold_the_same(self):
        found = messages_of_mcap(os.path.join(self.folders["mcap"], "dataset.mcap"))
        both = [sorted((time, topic, str(message)) for topic, time, message in rows) for rows in (found, self.messages)]
        self.assertEqual(*both)
        self.assertEqual({time for _, time, _ in found}, {1000000000, 1040000000, 1080000000})
        with rosbag.Bag(os.path.join(self.folders["rosbag"], "dataset.bag")) as bag:
            for connection in bag._get_connections():
                self.assertEqual(md5_of(connection.msg_def), connection.md5sum)
            self.assertEqual(bag.get_message_count(), 30)

    def test_the_reader_of_foxglove(self):
        """Through the index, and from beginning to end with every sum checked: the messages of the bag, byte for byte."""
        path = os.path.join(self.folders["mcap"], "dataset.mcap")
        expected = []
        for topic, time, message in self.messages:
            data = io.BytesIO()
            message.serialize(data)
            expected.append([topic, message._type, str(time), hashlib.sha256(data.getvalue()).hexdigest()])
        for one in by_node(self, ["@mcap/core"], READ_MCAP, path).values():
            self.assertEqual(sorted(one), sorted(expected))
        with open(path, "rb") as file:
            data = bytearray(file.read())
        data[len(data) // 2] ^= 1
        damaged = self.write("damaged.mcap", bytes(data))
        said = by_node(self, ["@mcap/core"], READ_MCAP.replace("\nmain()", "\nmain().catch((error) => ({ refused: error.message }))"), damaged)
        self.assertRegex(said["refused"], "(?i)crc")

    def test_pictures(self):
        """Colours as they are, depths rounded to float, by as much as the record says."""
        values, largest, roundings = 0, 0, 0
        for camera, name in self.NAMES.items():
            colors, depths = self.by_topic(f"/{name}/image_raw/compressed"), self.by_topic(f"/{name}/depth/image_raw")
            self.assertEqual((sorted(colors), sorted(depths)), ([0, 1, 2], [0, 1, 2]))
            for frame in range(3):
                with open(os.path.join(self.dataset, camera, "color", f"{frame:06d}.png"), "rb") as file:
                    self.assertEqual(colors[frame].data, file.read())
                image = depths[frame]
                self.assertEqual((image.encoding, image.is_bigendian, image.header.frame_id), ("32FC1", 0, name + "_optical_frame"))
                found = np.frombuffer(image.data, "<f4").reshape(image.height, image.step // 4)
                expected = layer_of(self.dataset, "depth", camera, frame) * self.METRES
                expected[~np.isfinite(expected)] = np.nan
                np.testing.assert_array_equal(found, expected.astype(np.float32))
                values += np.isfinite(expected).sum()
                largest = max(largest, np.nanmax(np.abs(found - expected)))
                roundings = max(roundings, np.nanmax(np.abs(found - expected) / np.abs(expected)) / 5.97e-8)
        for form, record in self.records.items():
            report = self.referee(self.dataset, self.folders[form])
            row, = (row for row in report["residuals"] if row["unit"] == "roundings to float32")
            self.assertAlmostEqual(row["largest"], roundings, delta=1e-9)
            depth = next(row for row in record["layers"] if row["layer"] == "depth")
            self.assertEqual((depth["values"], depth["unit"], depth["without_code"]), (values, "m", 0))
            self.assertAlmostEqual(depth["largest_rounding"], largest, delta=1e-6 * largest)

    def test_points_are_where_the_surface_is(self):
        """depth_image_proc's formula with K of CameraInfo, then tf: the layer of positions comes out."""
        places = transforms_of(self.messages)
        largest = 0
        for camera, name in self.NAMES.items():
            infos, depths = self.by_topic(f"/{name}/depth/camera_info"), self.by_topic(f"/{name}/depth/image_raw")
            self.assertEqual(str(infos), str(self.by_topic(f"/{name}/camera_info")))
            for frame, image in depths.items():
                K = np.array(infos[frame].K).reshape(3, 3)
                z = np.frombuffer(image.data, "<f4").reshape(image.height, image.width).astype(float)
                v, u = np.nonzero(np.isfinite(z))
                z = z[v, u]
                points = np.stack([(u - K[0, 2]) * z / K[0, 0], (v - K[1, 2]) * z / K[1, 1], z])
                R, t = places[image.header.stamp.to_nsec()][name + "_optical_frame"]
                expected = layer_of(self.dataset, "position", camera, frame)[v, u].T * self.METRES
                largest = max(largest, np.abs(R @ points + t[:, None] - expected).max())
        self.assertLess(largest, 1e-6)
        print(f"points are {largest:.1e} m off the surface")

    def test_transforms(self):
        poses = load_json(os.path.join(self.dataset, "poses.json"))["poses"]
        cameras = cameras_of(self.dataset)
        for time, there in transforms_of(self.messages).items():
            frame = round((time / 1e9 - 1) * 25)
            self.assertEqual(sorted(there), ["back_wall_1", "block_3", "block__kleiner___schr__g_4", "left_eye_optical_frame",
                                             "r__ter_Ring_v2_2", "right_eye_optical_frame"])
            for child, (R, t) in there.items():
                if child.endswith("_frame"):
                    camera = next(one for name, one in cameras.items() if name[1] == frame and self.NAMES[name[0]] + "_optical_frame" == child)
                    expected = camera["R"].T, -camera["R"].T @ camera["t"]
                else:
                    pose = next(one for one in poses if one["frame"] == frame and one["id"] == int(child.rsplit("_", 1)[1]))
                    expected = np.array(pose["R"]), np.array(pose["t"])
                self.assertLess(np.abs(R - expected[0]).max(), 1e-12)
                self.assertLess(np.abs(t - expected[1] * self.METRES).max(), 1e-12)

    def test_sheared_objects_have_no_axes(self):
        """A turned child of an unevenly scaled, turned parent: the record names it."""
        path = datasets.stereo(self.path("sheared"))
        with open(path, encoding="utf-8") as file:
            scene = json.load(file)
        scene["objects"][0].update(scale=[1, 2, 1], orientation=[0.92388, 0, 0, 0.382683])
        scene["objects"][2].update(parent=scene["objects"][0]["name"], orientation=[0.92388, 0, 0, 0.382683])
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        folder, record = self.export(self.render(path, "color,depth"), "rosbag")
        self.assertEqual(record["conventions"]["sheared_objects_without_axes"], scene["objects"][2]["name"])
        self.assertNotIn("sheared_objects_without_axes", self.records["rosbag"]["conventions"])
        for places in transforms_of(messages_of_bag(os.path.join(folder, "dataset.bag"))).values():
            ids = {child.rsplit("_", 1)[1] for child in places}
            self.assertTrue("3" not in ids and {"1", "2"} <= ids, ids)

    def test_a_pair_rectifies(self):
        """stereo_image_proc: z = fx baseline / disparity, baseline = -P[3] / fx of the right camera."""
        left, right = self.by_topic("/left_eye/camera_info")[1], self.by_topic("/right_eye/camera_info")[1]
        self.assertEqual(left.P[3], 0)
        self.assertAlmostEqual(-right.P[3] / right.P[0], 0.12 * self.METRES, places=12)
        self.assertEqual((left.K[2], left.K[5], left.distortion_model, tuple(left.D)), (47.5, 35.5, "plumb_bob", (0,) * 5))

    def test_what_is_a_pair(self):
        """Rows in common, to rounding, of plain pinholes that look the same way: each pair at a height of its own, its right camera with
        one thing changed. The referee has the same opinion."""
        K = [[80, 0, 47.5], [0, 80, 35.5], [0, 0, 1]]
        other = lambda row, column, value: {"K": [[value if (i, k) == (row, column) else K[i][k] for k in range(3)] for i in range(3)]}  # noqa: E731
        rows = [({}, True), (other(0, 2, 30.5), True), (other(1, 2, 35.5 + 1e-9), True), ({"distortion": [0, 0, 0, 0]}, True),
                ({"near": 0.2}, True), (other(1, 2, 35.5 + 1e-6), False), (other(0, 0, 80.001), False), (other(1, 1, 80.001), False),
                ({"height": 70}, False), ({"width": 95}, False), ({"distortion": [0, 0, 0, 1e-4]}, False), ({"at": 1e-3}, False),
                ({"up": 1e-3}, False), ({"ahead": 1e-3}, False), ({"right": -0.1}, False)]
        cameras = []
        for number, (change, _) in enumerate(rows):
            height = 0.01 * number
            x, at, ahead, up = (change.get(key, usual) for key, usual in (("right", 0.1), ("at", 0), ("ahead", 0), ("up", 0)))
            lens = {key: value for key, value in change.items() if key not in ("right", "at", "ahead", "up")}
            cameras.append(datasets._camera(f"left {number}", [-0.1, height, 4.5], [-0.1, height, 0], K=K))
            cameras.append(datasets._camera(f"right {number}", [x, height + up, 4.5 + ahead], [x + at, height + up, 0], **{"K": K, **lens}))
        os.mkdir(self.path("pairs"))
        scene = datasets._write(self.path("pairs"), "pairs", {"objects": datasets._objects(), "cameras": cameras})
        folder, _ = self.export(self.render(datasets.in_units(scene, self.METRES), "color,depth"), "rosbag")
        infos = {topic: message for topic, _, message in messages_of_bag(os.path.join(folder, "dataset.bag")) if topic.endswith("/camera_info")}
        for number, (change, pair) in enumerate(rows):
            with self.subTest(change=change):
                left, right = (infos[f"/{side}_{number}/camera_info"] for side in ("left", "right"))
                self.assertEqual(left.P[3], 0)
                self.assertAlmostEqual(-right.P[3] / right.P[0], 0.2 * self.METRES if pair else 0, places=12)

    def test_lenses(self):
        """Points of the dataset, by tf and CameraInfo, are in the pixels in which it sees them."""
        dataset = self.render(datasets.in_units(datasets.lenses(self.path("lenses"))), "color,depth,objects,tracks", "--tracks-step", 6)
        folder, record = self.export(dataset, "rosbag", "--image-format", "jpg", "--unit-metres", self.METRES)
        messages = messages_of_bag(os.path.join(folder, "dataset.bag"))
        infos = {topic: message for topic, _, message in messages}
        x = np.array([point["x"] for point in load_json(os.path.join(dataset, "tracks", "points.json"))["points"]]) * self.METRES
        [places] = transforms_of(messages).values()
        for name in ("plain", "radial", "mild", "fish"):
            seen = np.load(os.path.join(dataset, name, "tracks", "000000.npy"))
            use = seen[:, 2] == 1
            R, t = places[name + "_optical_frame"]
            pixels = pixels_of(infos[f"/{name}/camera_info"], (x[use] - t) @ R)
            self.assertGreater(use.sum(), 50)
            self.assertLess(np.abs(pixels + 0.5 - seen[use, :2]).max(), 1e-4)
        models = {name: (infos[f"/{name}/camera_info"].distortion_model, len(infos[f"/{name}/camera_info"].D)) for name in ("plain", "radial", "mild", "fish")}
        self.assertEqual(models, {"plain": ("plumb_bob", 5), "radial": ("rational_polynomial", 8), "mild": ("plumb_bob", 5), "fish": ("equidistant", 4)})
        self.assertEqual(tuple(infos["/mild/camera_info"].D), (-0.2, 0.05, 0.001, -0.002, 0))
        self.assertEqual(infos["/fish/camera_info"].K[2], 47)
        self.assertEqual(infos["/fish/image_raw/compressed"].format, "jpeg")
        self.assertEqual(infos["/fish/image_raw/compressed"].data[:2], b"\xff\xd8")
        self.assertGreater(next(row for row in record["layers"] if row["layer"] == "color")["largest_rounding"], 0)

    def test_depth_beside_and_behind_a_fisheye_is_none(self):
        dataset = self.render(datasets.room(self.path("room")), "color,depth")
        expected = {camera: layer_of(dataset, "depth", camera, 0) for camera in ("wide", "beside")}
        behind = sum((z <= 0).sum() for z in expected.values())
        self.assertGreater(behind, 1000)
        folder, record = self.export(dataset, "rosbag")
        self.assertIn({"layer": "depth", "values": 2 * 72 * 96, "without_code": behind},
                      [{key: row[key] for key in ("layer", "values", "without_code")} for row in record["layers"]])
        for topic, _, message in messages_of_bag(os.path.join(folder, "dataset.bag")):
            if topic.endswith("/depth/image_raw"):
                z = expected[topic.split("/")[1]]
                found = np.frombuffer(message.data, "<f4").reshape(z.shape)
                self.assertTrue(np.array_equal(found, np.where(z > 0, z, np.nan).astype(np.float32), equal_nan=True))
        self.export(dataset, "mcap")

    def test_names_parts_and_what_is_refused(self):
        path = datasets.many(self.path("many"), 4)
        with open(path, encoding="utf-8") as file:
            scene = json.load(file)
        for camera, name in zip(scene["cameras"], ("a-b", "a_b", "a b", "3d")):
            camera["name"] = name
        scene["cameras"][3]["eye"] = {"keys": [[0, [0, 0, 5]], [3, [0, 1, 5]]]}
        datasets._write(self.path("many"), "many", scene)
        dataset = self.render(path, "color,depth")
        folder, _ = self.export(dataset, "mcap", "--split", "train=0:1,val=2:3")
        self.assertEqual(sorted(os.listdir(folder)), ["export.json", "train.mcap", "val.mcap"])
        topics = {topic for topic, _, _ in messages_of_mcap(os.path.join(folder, "val.mcap"))}
        self.assertLessEqual({"/a_b/camera_info", "/a_b_2/camera_info", "/a_b_3/camera_info", "/3d/camera_info"}, topics)
        scene["cameras"][1].update(model="eucm", alpha=0.5, beta=1, K=[[80, 0, 48], [0, 80, 36], [0, 0, 1]])
        dataset = self.render(datasets._write(self.path("many"), "many", scene), "color,depth")
        for form in ("rosbag", "mcap"):
            self.refused("export", dataset, "--format", form, "-o", self.path("none"), status=2, says=("a_b", "eucm", "plumb_bob"))
        self.assertFalse(os.path.exists(self.path("none")))

    def test_what_no_recording_can_hold(self):
        """Sizes of messages and seconds have 32 bits: datasets that say they have more are refused before anything is written."""
        def edited(name, change):
            copy = self.path(f"copy-{len(os.listdir(self.folder))}")
            shutil.copytree(self.dataset, copy)
            document = load_json(os.path.join(copy, name))
            change(document)
            self.write(os.path.join(copy, name), json.dumps(document))
            return copy

        most = 2**32 // 13
        for says, held, none in (
                (f"have more than {most} pixels, which the format cannot hold",
                 edited("cameras.json", lambda document: document["cameras"][0].update(width=most, height=1)),
                 edited("cameras.json", lambda document: document["cameras"][0].update(width=most + 1, height=1))),
                ("frame 2 has no time: seconds have 32 bits", edited("manifest.json", lambda document: document.update(fps=2 / (2.0**32 - 2.5))),
                 edited("manifest.json", lambda document: document.update(fps=2 / (2.0**32 - 1.5))))):
            for form, messages in (("rosbag", messages_of_bag), ("mcap", messages_of_mcap)):
                folder = self.path(f"{form}-{os.path.basename(held)}")
                if "pixels" in says:  # the limit lets it pass, its pictures do not
                    self.refused("export", held, "--format", form, "-o", folder, "--quiet", status=3, says=f"size differs from the camera's (expected {most} x 1, ")
                else:
                    self.dgtk("export", held, "--format", form, "-o", folder, "--quiet")
                    last = max(time for _, time, _ in messages(glob.glob(os.path.join(folder, "dataset.*"))[0]))
                    self.assertLess(abs(last - (2**32 * 10**9 - 15 * 10**8)), 1000)  # nanoseconds of a double
                self.refused("export", none, "--format", form, "-o", self.path("none"), status=2, says=(form, says))
        self.assertFalse(os.path.exists(self.path("none")))

    def test_the_referee_reads_every_number_of_a_recording(self):
        """One number of each kind is another, and all sums are those of the changed file: its own row, or the reader's word for it."""
        path = os.path.join(self.folders["mcap"], "dataset.mcap")
        with open(path, "rb") as file:
            data = file.read()
        summary = next(at for op, at, _, after in records(data, 8, len(data) - 8) if op == 15) + 13
        places = {(op, at < summary): at + 9 for op, at, _, _ in reversed(list(records(data, 8, len(data) - 8)))}
        texts = lambda at, count: at if count == 0 else texts(at + 4 + struct.unpack_from("<I", data, at)[0], count - 1)  # noqa: E731
        chunk, message = places[6, True], texts(places[6, True] + 28, 1) + 8
        index = places[8, False]
        statistics = places[11, False]
        footer = len(data) - 8 - 20
        rows = [("profile", places[1, True] + 4, "B"), ("/tf", places[3, True] + 6, "B"), ("schema", texts(places[3, True] + 2, 1) + 4, "B"),
                ("channel", texts(places[4, True] + 4, 1) + 4, "B"), ("/tf", data.index(b"md5sum", places[4, True]) + 10, "B"),
                ("first time of a chunk", chunk, "Q"), ("last time of a chunk", chunk + 8, "Q"), ("chunk", chunk + 16, "Q"),
                ("chunk", texts(chunk + 28, 1), "Q"), ("publish time", message + 9 + 2 + 4 + 8, "Q"),
                ("message index", places[7, True] + 2 + 4, "Q"), ("message index", places[7, True] + 2 + 4 + 8, "Q"),
                *(("chunk index", index + at, "Q") for at in (0, 8, 16, 24)), ("chunk index", index + 32 + 4, "H"), ("chunk index", index + 32 + 4 + 2, "Q"),
                *(("chunk index", texts(index + 32, 1) + at, "Q") for at in (0, 12, 20)),
                ("messages", statistics, "Q"), ("schemas", statistics + 8, "H"), ("channels", statistics + 10, "I"), ("attachments", statistics + 14, "I"),
                ("metadata", statistics + 18, "I"), ("chunks", statistics + 22, "I"), ("first time", statistics + 26, "Q"),
                ("last time", statistics + 34, "Q"), ("messages of channels", statistics + 42 + 4 + 2, "Q"),
                ("summary offset", places[14, False] + 1, "Q"), ("summary offset", places[14, False] + 9, "Q"),
                ("summary", footer, "Q"), ("summary offsets", footer + 8, "Q")]
        for name, at, kind in rows:
            with self.subTest(name=name, at=at):
                changed = lambda old: with_sums(old[:at] + struct.pack("<" + kind, struct.unpack_from("<" + kind, old, at)[0] ^ 1) +  # noqa: E731
                                                old[at + struct.calcsize(kind):])
                self.assertRegex(self.planted(self.dataset, self.folders["mcap"], "dataset.mcap", changed), f"\\({name}\\)")
        for name, at in (("sum of a chunk", chunk + 24), ("sum of the data", summary - 4), ("sum of the summary", footer + 16)):
            with self.subTest(name=name):
                self.assertRegex(self.planted(self.dataset, self.folders["mcap"], "dataset.mcap", lambda old: old[:at] + bytes([old[at] ^ 1]) + old[at + 1:]),
                                 f"\\({name}\\)")

    def test_the_referee_finds(self):
        bag = lambda change: self.planted(self.dataset, self.folders["rosbag"], "dataset.bag", change)  # noqa: E731
        mcap = lambda change: self.planted(self.dataset, self.folders["mcap"], "dataset.mcap", change)  # noqa: E731
        number = lambda value: struct.pack("<d", value)  # noqa: E731
        for file in (bag, mcap):
            self.assertIn("layer intrinsics", file(lambda data: data.replace(number(47.5), number(48), 1)))
            self.assertIn("layer color", file(lambda data: data.replace(b"IDAT", b"IDAU", 1)))
        right = next(message for topic, _, message in self.messages if topic == "/right_eye/camera_info")
        self.assertIn("layer baseline", bag(lambda data: data.replace(number(right.P[3]), number(0))))
        image = next(message for topic, _, message in self.messages if topic == "/left_eye/depth/image_raw")
        row = image.data[4 * 96 * 30:4 * 96 * 31]
        self.assertIn("layer depth", bag(lambda data: data.replace(row, row[4:] + row[:4], 1)))
        ring = next(one for one in self.messages[0][2].transforms if one.child_frame_id.startswith("r__ter"))
        x = number(ring.transform.translation.x)
        self.assertIn("layer pose of objects", bag(lambda data: data.replace(x, number(1.5), 1)))
        self.assertIn("layer recording", bag(lambda data: data.replace(b"float64 w\n", b"float32 w\n", 1)))
        self.assertIn("layer recording", mcap(lambda data: data[:-20] + b"\1" + data[-19:]))


if __name__ == "__main__":
    main()
