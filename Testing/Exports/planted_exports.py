# SPDX-License-Identifier: BSD-3-Clause
"""Errors that are planted in exports: of each format and row of the referee, a file, and what is changed in it."""
import io
import json
import re
import struct
import tarfile
import tempfile
from typing import Callable, NamedTuple

import h5py
import numpy as np

from pictures import read_png, write_png


def stepped(edit, step):
    """Takes a share of its step, too, where that is no whole number."""
    edit.scales = isinstance(step, float)
    return edit


def number(pattern, step, nth=0):
    """Adds to the number behind the nth place that matches: `pattern` is what stands before it."""
    place = re.compile("(?:" + pattern + r")(-?[0-9.]+(?:e-?[0-9]+)?)")

    def edit(data, share=1):
        found = list(place.finditer(data.decode()))[nth]
        value = float(found.group(1)) + step * share
        text = repr(int(value)) if isinstance(step, int) and re.fullmatch("-?[0-9]+", found.group(1)) else repr(value)
        return (data.decode()[:found.start(1)] + text + data.decode()[found.end(1):]).encode()

    return stepped(edit, step)


def word(old, new):
    return lambda data: data.replace(old.encode(), new.encode(), 1)


def packed(kind, at, step):
    """Adds to a number of a binary file."""
    def edit(data, share=1):
        value = struct.unpack_from(kind, data, at)[0]
        return data[:at] + struct.pack(kind, value + step * share) + data[at + struct.calcsize(kind):]

    return stepped(edit, step)


def double(value, step, nth=0):
    """Adds to the nth double of this value."""
    def edit(data, share=1):
        at = -1
        for _ in range(nth + 1):
            at = data.index(struct.pack("<d", value), at + 1)
        return packed("<d", at, step)(data, share)

    return stepped(edit, step)


def pixel(x, y, step=1):
    """A code of a PNG file."""
    def edit(path):
        image = read_png(path).copy()
        image[y, x] = image[y, x] + (step if np.max(image[y, x]) < 200 else -step)
        write_png(path, image)

    edit.of_path = True
    return edit


def last_bytes(step=1):
    """The last number of a file of pixels, of float32."""
    return lambda data: packed("<f", len(data) - 4 * 500, step)(data)


def archive(member, change):
    """An array of a .npz file."""
    def edit(data):
        arrays = dict(np.load(io.BytesIO(data)))
        arrays[member] = change(arrays[member])
        file = io.BytesIO()
        np.savez(file, **arrays)
        return file.getvalue()

    return edit


def member(suffix, change):
    """A file of a tar: its bytes, which may be more or fewer."""
    def edit(data):
        out = io.BytesIO()
        with tarfile.open(fileobj=io.BytesIO(data)) as old, tarfile.open(fileobj=out, mode="w", format=tarfile.USTAR_FORMAT) as new:
            changed = False
            for one in old:
                content = old.extractfile(one).read()
                if one.name.endswith(suffix) and not changed:
                    content, changed = change(content), True
                    one.size = len(content)
                new.addfile(one, io.BytesIO(content))
        return out.getvalue()

    return edit


def joined(name, content):
    """One more file in a tar, behind the first one's."""
    def edit(data):
        out = io.BytesIO()
        with tarfile.open(fileobj=io.BytesIO(data)) as old, tarfile.open(fileobj=out, mode="w", format=tarfile.USTAR_FORMAT) as new:
            for number, one in enumerate(old):
                new.addfile(one, old.extractfile(one))
                if number == 0:
                    more = tarfile.TarInfo(one.name.split(".")[0] + name)
                    more.size = len(content)
                    new.addfile(more, io.BytesIO(content))
        return out.getvalue()

    return edit


def narrower(data):
    """An array of a picture without its last column."""
    out = io.BytesIO()
    np.save(out, np.load(io.BytesIO(data))[:, :-1])
    return out.getvalue()


def shifted(values):
    values = values.copy()
    values.flat[0] += 0.01
    return values


def several(*edits):
    def edit(data, share=1):
        for one in edits:
            data = one(data, share)
        return data

    return stepped(edit, 1.0)


F = 43.45584412271571
GT = "test/000001/scene_gt_info.json"
LABEL = "training/label_2/000000.txt"
BOX, COLMAP = "annotations/instances_train.json", "sparse/0/"
PANOPTIC = "annotations/panoptic_train.json"
XML = "Annotations/cam_L_000000.xml"
# A calibration of KITTI's has the focal length and the centre twice, which must agree.
KITTI = several(number("K_02: ", 5e-8), number("P_rect_02: ", 5e-8))


def stereo(folder, disparity):
    calib = folder + "calib.txt"
    return [("doffs", calib, number("doffs=", 5e-8)), ("baseline", calib, number("baseline=", 5e-8)),
            ("intrinsics", calib, number(r"cam0=\[", 5e-8)), ("size", calib, number("width=", 1)),
            ("range", calib, number("vmax=", -2)), ("disparity", disparity, last_bytes())]


def colmap(folder, depth):
    def places(data, share=1):
        name = 8 + 4 + 7 * 8 + 4  # the first picture's, then how many places, then their u, v and point
        return packed("<d", data.index(b"\0", name) + 1 + 8, 5e-8)(data, share)

    plants = [("places", folder + "images.bin", stepped(places, 1.0)), ("intrinsics", folder + "cameras.bin", packed("<d", 32, 5e-8)), ("size", folder + "cameras.bin", packed("<Q", 16, 1)),
              ("pose", folder + "images.bin", packed("<d", 44, 5e-8)), ("colors", folder + "points3D.bin", packed("<B", 40, -3)),
              ("reprojection", folder + "points3D.bin", packed("<d", 16, 3e-5))]
    return plants + [("depth", depth, last_bytes())] if depth else plants


def recording(file, left, *also):
    """K of a camera, with P that must be the same; where an object is; and a baseline, of the right camera, or of the left one, which leads
    to no camera."""
    def intrinsics(data, share=1):
        at = data.index(struct.pack("<9d", F, 0, 23.5, 0, F, 17.5, 0, 0, 1))
        return several(packed("<d", at, 5e-8), packed("<d", at + 144, 5e-8))(data, share)

    def baseline(data, share=1):
        at = data.index(struct.pack("<6d", F, 0, 23.5, 0 if left else -0.2 * F, 0, F))
        return packed("<d", at + 24, 1e-5)(data, share)

    return [("intrinsics", file, stepped(intrinsics, 1.0), also), ("baseline", file, stepped(baseline, 1.0)),
            ("pose of objects", file, double(-1.9, 5e-8))]


class Plant(NamedTuple):
    row: str  # that must name the error
    file: str
    edit: Callable
    also: tuple = ()  # rows that see it by their nature, such as sums of a file
    named: str = None  # the file that is named, where it is another
    alone: bool = False  # another plant changes what its row compares with


PLANTS = {form: [Plant(*one) for one in rows] for form, rows in {
    "bop": [
        ("intrinsics", "test/000001/scene_camera.json", number(r'"cam_K":\[', 5e-8)),
        ("pose", "test/000001/scene_camera.json", number(r'"cam_t_w2c":\[', 1e-3)),
        ("poses", "test/000001/scene_gt.json", number(r'"cam_t_m2c":\[', 1.0, 4), ("instances",)),
        ("vertices", "test/000001/scene_gt.json", number(r'"cam_t_m2c":\[', 1e-3, 3), (), "models/models_info.json"),
        ("bbox_obj", GT, number(r'"bbox_obj":\[', 1)), ("bbox_visib", GT, number(r'"bbox_visib":\[', 1)),
        ("px_count_all", GT, number('"px_count_all":', 1, 1)), ("px_count_visib", GT, number('"px_count_visib":', 1, 2)),
        ("px_count_valid", GT, number('"px_count_valid":', 1)), ("visib_fract", GT, number('"visib_fract":', 1e-11)),
        ("models_info", "models/models_info.json", number('"min_x":', 5e-8), ("models_eval",), "models/obj_000001.ply"),
        ("models", "models_eval/obj_000004.ply", number("end_header\n", 1.0)),
        ("coco", "test/000001/scene_gt_coco.json", number('"area":', 1)),
        ("mask", "test/000001/mask_visib/000000_000000.png", pixel(20, 20, 255)),
        ("amodal mask", "test/000001/mask/000000_000000.png", pixel(20, 20, 255)),
        ("depth", "test/000001/depth/000000.png", pixel(20, 20)), ("color", "test/000001/rgb/000000.png", pixel(20, 20))],
    "coco": [
        ("area", BOX, number('"area":', 1)), ("box", BOX, number(r'"bbox":\[', 1)), ("category", BOX, number('"category_id":', 1)),
        ("size", BOX, number('"width":', 1)), ("ids", BOX, number('"id":', 7, 5)), ("names", BOX, word('"frame":1', '"frame":0')),
        ("color", "train/cam_L_000000.png", pixel(20, 20))],
    "coco-panoptic": [
        ("area", PANOPTIC, number('"area":', 1)), ("box", PANOPTIC, number(r'"bbox":\[', 1)),
        ("category", PANOPTIC, number('"category_id":', 1)), ("size", PANOPTIC, number('"width":', 1)),
        ("objects", "annotations/panoptic_train/cam_R_000000.png", pixel(20, 20), ("segments",)), ("color", "train/cam_L_000000.png", pixel(20, 20))],
    "colmap": [*colmap(COLMAP, None), ("objects", "masks/cam_L/000000.png.png", pixel(20, 20, 255)),
               ("color", "images/cam_L/000000.png", pixel(20, 20))],
    "colmap-dense": [*colmap("sparse/", "stereo/depth_maps/cam_L/000000.png.geometric.bin"),
                     ("normal", "stereo/normal_maps/cam_R/000000.png.geometric.bin", last_bytes())],
    "eth3d": stereo("two_view_training/cam_L_000000/", "two_view_training_gt/cam_L_000001/disp0GT.pfm"),
    "middlebury": stereo("cam_L_000000/", "cam_L_000001/disp0GT.pfm"),
    "flyingthings": [("pose", "camera_data/TRAIN/A/0000/camera_data.txt", number("R 1 0 0 ", 5e-8)),
                     ("disparity", "disparity/TRAIN/A/0000/left/0006.pfm", last_bytes()),
                     ("disparity_forward", "disparity_change/TRAIN/A/0000/into_future/left/0006.pfm", last_bytes()),
                     ("flow_backward", "optical_flow/TRAIN/A/0000/into_past/right/OpticalFlowIntoPast_0007_R.pfm", last_bytes()),
                     ("objects", "object_index/TRAIN/A/0000/left/0007.pfm", last_bytes())],
    "gltf": [("intrinsics", "scene.gltf", number(r'"K":\s*\[\s*\[\s*', 5e-8)), ("field of view", "scene.gltf", number('"yfov": ?', 5e-8), (), None, True),
             ("size", "scene.gltf", number('"width": ?', 1))],
    "hdf5": [("intrinsics", "0.hdf5", word("43.4558", "43.4559"))],
    "imagefolder": [
        ("camera", "train/metadata.jsonl", number(r'"K":\[\[', 5e-8), ("croissant",)), ("time", "train/metadata.jsonl", number('"seconds":', 1e-10)),
        ("poses", "train/metadata.jsonl", number(r'"scale":\[', 5e-8)), ("unit", "train/metadata.jsonl", number('"metres_per_unit":', 1e-3)),
        ("box", "train/metadata.jsonl", number(r'"bbox":\[\[', 1)), ("color", "train/cam_L_000000.png", pixel(20, 20))],
    "kitti2015": [("intrinsics", "training/calib_cam_to_cam/000000.txt", KITTI),
                  ("rotation", "training/calib_cam_to_cam/000000.txt", number("R_02: ", 5e-8)),
                  ("baseline", "training/calib_cam_to_cam/000000.txt", number("T_03: ", 5e-8)),
                  ("disparity", "training/disp_occ_0/000000_10.png", pixel(20, 20)),
                  ("objects", "training/obj_map/000000_10.png", pixel(20, 20)),
                  ("color", "training/image_3/000000_11.png", pixel(20, 20))],
    "kitti-depth": [("intrinsics", "train/cam_L/calib_cam_to_cam.txt", KITTI), ("size", "train/cam_R/calib_cam_to_cam.txt", number("S_02: ", 1)),
                    ("distortion", "train/cam_R/calib_cam_to_cam.txt", number("D_02: ", 5e-8)),
                    ("rotation", "train/cam_R/calib_cam_to_cam.txt", number("R_rect_02: ", 5e-8)),
                    ("baseline", "train/cam_R/calib_cam_to_cam.txt", number("T_02: ", 5e-8)),
                    ("depth", "train/cam_L/proj_depth/groundtruth/image_02/0000000000.png", pixel(20, 20))],
    "kitti-object": [("alpha", LABEL, number("Car 0 0 ", 1e-10), (), None, True), ("truncated", LABEL, number("wall ", 1e-10)),
                     ("occluded", LABEL, number("van [0-9.]+ ", 1)), ("box", LABEL, number("Car 0 2 [-0-9.]+ ", 1)),
                     ("type", LABEL, word("Misc", "Tram")), ("box 3d centre", LABEL, number("18 33 26 [0-9.]+ [0-9.]+ [0-9.]+ ", 5e-8)),
                     ("intrinsics", "training/calib/000001.txt", number("P2: ", 5e-8)),
                     ("rotation", "training/calib/000001.txt", number("R0_rect: ", 5e-8)),
                     ("baseline", "training/calib/000001.txt", number("P2: [0-9.]+ 0 [0-9.]+ ", 5e-8)),
                     ("scanner", "training/calib/000001.txt", number("Tr_velo_to_cam: ", 5e-8))],
    "kitti-odometry": [("pose", "poses/00.txt", number("1 0 0 0 0 1 0 0 0 0 1 ", 1e-6, 1)),
                       ("first pose", "poses/00.txt", number("^1 ", 5e-8)), ("time", "sequences/00/times.txt", word("4.000000000000e-02", "4.000100000000e-02")),
                       ("intrinsics", "sequences/00/calib.txt", number("P2: ", 5e-8)),
                       ("baseline", "sequences/00/calib.txt", number("P3: [0-9.]+ 0 [0-9.]+ ", 5e-8)),
                       ("scanner", "sequences/00/calib.txt", number("Tr: ", 5e-8))],
    "rosbag": recording("dataset.bag", True), "mcap": recording("dataset.mcap", False, "recording"),
    "mvsnet": [("pose", "cams/00000000_cam.txt", number("1 0 0 ", 5e-8)), ("intrinsics", "cams/00000000_cam.txt", number("intrinsic\n", 5e-8)),
               ("range", "cams/00000000_cam.txt", several(number("\n\n", 5e-8), number("192 ", 5e-8))), ("scores", "cams/pair.txt", number("\n3 3 ", 1e-3)),
               ("depth", "rendered_depth_maps/00000001.pfm", last_bytes())],
    "nerf-synthetic": [("intrinsics", "transforms_train.json", number('"camera_angle_x": ', 5e-8)),
                       ("pose", "transforms_train.json", number(r'"transform_matrix":\[\[1.0,-0.0,-0.0,', 5e-8)),
                       ("color_rgba", "train/r_0.png", pixel(20, 20))],
    "sintel": [("intrinsics", "training/camdata_left/cam_L/frame_0001.cam", packed("<d", 4, 5e-8)),
               ("pose", "training/camdata_left/cam_L/frame_0001.cam", packed("<d", 4 + 72 + 24, 5e-8)),
               ("tag", "training/camdata_left/cam_L/frame_0002.cam", packed("<f", 0, 1)),
               ("depth", "training/depth/cam_L/frame_0001.dpt", last_bytes()),
               ("flow_forward", "training/flow/cam_L/frame_0001.flo", last_bytes())],
    "spring": [("intrinsics", "train/0001/cam_data/intrinsics.txt", number("^", 5e-8)),
               ("pose", "train/0001/cam_data/extrinsics.txt", number("1 0 0 ", 5e-8))],
    "tapvid": [("points", "cam_L/tracks.npz", archive("points", shifted), (), "tapvid.pkl"), ("queries", "cam_L/tracks.npz", archive("query_points", shifted)),
               ("occluded", "cam_R/tracks.npz", archive("occluded", np.logical_not))],
    "transforms": [("intrinsics", "transforms.json", number('"fl_x": ', 5e-8)), ("angle", "transforms.json", number('"camera_angle_x": ', 1e-10), (), None, True),
                   ("pose", "transforms.json", number(r'"transform_matrix":\[\[1.0,-0.0,-0.0,', 5e-8)),
                   ("size", "transforms.json", number('"w": ', 1)), ("distortion", "transforms.json", number('"k1": ', 5e-8)),
                   ("depth", "depth/cam_L_000000.png", pixel(20, 20)), ("objects", "masks/cam_L_000000.png", pixel(20, 20, 255))],
    "tum": [("pose", "cam_L/groundtruth.txt", number("\n0.040000 ", 5e-8)), ("intrinsics", "cam_L/calibration.txt", number("^", 5e-8)),
            ("time", "cam_L/rgb.txt", number("\n(?=0.04)", 1e-3), ("associations",), "cam_L/groundtruth.txt"), ("depth", "cam_L/depth/0.040000.png", pixel(20, 20))],
    "voc": [("box", XML, number("<xmin>", 1)), ("category", XML, word("<name>wall", "<name>Car")),
            ("size", XML, number("<width>", 1)), ("truncated", XML, word("<truncated>1", "<truncated>0")),
            ("occluded", XML, word("<occluded>0", "<occluded>1"))],
    "webdataset": [("members", "train-000000.tar", joined(".notes.txt", b"of nobody")), ("camera", "train-000000.tar", word("43.4558", "43.4559"), ("croissant",)), ("time", "train-000000.tar", word('"seconds":0.04', '"seconds":0.05')),
                   ("size", "train-000000.tar", member(".disparity.npy", narrower)), ("poses", "train-000000.tar", word('"scale":[1.0', '"scale":[1.1')), ("unit", "train-000000.tar", word('per_unit":1.0', 'per_unit":1.1'))],
    "yolo": [("box", "labels/train/cam_L_000000.txt", number("^0 ", 5e-8)), ("category", "labels/train/cam_L_000001.txt", number("^", 1))],
}.items()}


def textured(data):
    """A picture on the first material, which is on none."""
    asset = json.loads(data)
    asset["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    return json.dumps({**asset, "textures": [{"source": 0}], "images": [{"uri": "textures/none.png"}]}).encode()


def upright(data):
    """The first rotation that is none is 1.1 as long."""
    return data.replace(struct.pack("<4d", 0, 0, 0, 1), struct.pack("<4d", 0, 0, 0, 1.1), 1)


def stored(name, change, **how):
    """A dataset of an HDF5 file."""
    def edit(path):
        with h5py.File(path, "r+") as file:
            value = change(file[name][()])
            del file[name]
            file.create_dataset(name, data=value, **how)

    edit.of_path = True
    return edit


def same_colors(data):
    """The second category has the colour of the first."""
    colors = list(re.finditer(rb'"color":(\[[0-9,]*\])', data))
    return data[:colors[1].start(1)] + colors[0].group(1) + data[colors[1].end(1):]


def mirrored(data):
    """A PNG with its columns the other way round."""
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        file.write(data)
        file.flush()
        write_png(file.name, read_png(file.name)[:, ::-1].copy())
        with open(file.name, "rb") as changed:
            return changed.read()


def no_number(at):
    """Of an array of a .npz file."""
    def change(values):
        values = values.copy()
        values.flat[at] = np.nan
        return values

    return change


def no_coordinate(axis):
    """Of the last point of a cloud: three float32 and three bytes."""
    at = 4 * axis - 15
    return lambda data, _: data[:at] + struct.pack("<f", np.nan) + data[at + 4:]


# What is no number, beside the numbers above that have a step: in each component, as a maximum may lose it.
NO_NUMBERS = {
    "tapvid": [Plant(row, "cam_L/tracks.npz", lambda data, _, array=array, at=at: archive(array, no_number(at))(data))
               for row, array, width in (("points", "points", 2), ("queries", "query_points", 3)) for at in range(width)],
    "transforms": [Plant("points", "points.ply", no_coordinate(axis)) for axis in range(3)]}

# Rows that are planted one at a time.
ALONE = {form: [Plant(*one) for one in rows] for form, rows in {
    "coco-panoptic": [("colors", PANOPTIC, same_colors)],
    "flyingthings": [("flow_forward", "optical_flow/TRAIN/A/0000/into_future/left/OpticalFlowIntoFuture_0006_L.pfm", last_bytes()),
                     ("disparity_backward", "disparity_change/TRAIN/A/0000/into_past/left/0007.pfm", last_bytes())],
    "gltf": [("texture coordinates", "scene.gltf", lambda data: re.sub(rb'"POSITION": ([0-9]+)', rb'"POSITION": \1, "TEXCOORD_0": \1', data, count=1)), ("textures", "scene.gltf", textured)],
    "hdf5": [("flow_forward", "0.hdf5", stored("forward_flow_0", lambda flow: flow + 1)), ("flow_backward", "1.hdf5", stored("backward_flow_0", lambda flow: flow + 1)),
             ("shape", "0.hdf5", stored("depth_0", lambda depth: depth[:-1])), ("attributes", "0.hdf5", word("back wall", "back walx")), ("times", "0.hdf5", stored("depth_0", lambda depth: depth, track_times=True))],
    "imagefolder": [("licence", "README.md", word("pretty_name", "license: mit\npretty_name")),
                    ("lines", "train/metadata.jsonl", lambda data: data + data.splitlines(True)[0])],
    "kitti2015": [("flow_forward", "training/flow_occ/000000_10.png", pixel(12, 12)), ("disparity_forward", "training/disp_occ_1/000000_10.png", pixel(12, 12))],
    "mcap": [("quaternion", "dataset.mcap", upright), ("lens", "dataset.mcap", word("plumb_bob", "plumb_bop")), ("objects", "dataset.mcap", word("_2", "_7"))],
    "rosbag": [("quaternion", "dataset.bag", upright), ("lens", "dataset.bag", word("plumb_bob", "plumb_bop")), ("objects", "dataset.bag", word("_2", "_7")),
               ("recording", "dataset.bag", word("32FC1", "32FC2"))],
    "sintel": [("flow_forward_class", "training/occlusions/cam_L/frame_0001.png", pixel(12, 12, 255)),
               ("disparity_class", "training/outofframe/cam_L/frame_0001.png", pixel(12, 12, 255))],
    "spring": [(layer, f"train/0001/{name}_left/{name}_left_0001.{kind}", stored(key, lambda values: values + 1)) for layer, name, kind, key in
               (("disparity", "disp1", "dsp5", "disparity"), ("disparity_forward", "disp2_FW", "dsp5", "disparity"),
                ("flow_forward", "flow_FW", "flo5", "flow"))] +
              [("disparity_backward", "train/0001/disp2_BW_left/disp2_BW_left_0002.dsp5", stored("disparity", lambda values: values + 1))],
    "transforms": [("colors", "points.ply", lambda data: data[:-1] + bytes([data[-1] ^ 1]))],
    "tapvid": [("tracks", "cam_L/tracks.npz", archive("track", lambda tracks: tracks + 1)), ("videos", "tapvid.pkl", word("cam_L", "cam_X"))],
    "webdataset": [("licence", "README.md", word("pretty_name", "license: mit\npretty_name")),
                   *((layer, "train-000000.tar", member(f".{layer}.png", mirrored)) for layer in
                     ("classes", "color", "color_rgba", "flow_forward_class", "disparity_backward_class", "disparity_class", "disparity_forward_class", "flow_backward_class", "objects")),
                   *((layer, "train-000000.tar", member(f".{layer}.npy", lambda data: data[:-1] + bytes([data[-1] ^ 1]))) for layer in
                     ("disparity_backward", "tracks"))],
}.items()}
