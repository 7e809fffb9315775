# SPDX-License-Identifier: BSD-3-Clause
"""Point tracks, read by NumPy as TAP-Vid's evaluation takes them."""
import os
import pickle

import numpy as np

import datasets
import hard_scenes
from datasets import load_json, main, read_png

TRACKS = ("--tracks-step", 6, "--tracks-every", 1)


class Tapvid(datasets.ExportCase):
    def check(self, dataset, folder, record):
        """Each video against the dataset; how many places are hidden, and how many there are."""
        points = load_json(os.path.join(dataset, "tracks", "points.json"))["points"]
        hidden, count = 0, 0
        with open(os.path.join(folder, "tapvid.pkl"), "rb") as file:
            pickled = pickle.load(file)  # as evaluation_datasets.py's create_davis_dataset()
        self.assertEqual(sorted(pickled), sorted({entry["name"].split("/")[0] for entry in record["names"]}))
        for video in sorted({entry["name"].split("/")[0] for entry in record["names"]}):
            entries = [entry for entry in record["names"] if entry["name"].startswith(video + "/")]
            places = np.stack([np.load(os.path.join(dataset, entry["camera"], "tracks", f"{entry['frame']:06d}.npy")) for entry in entries], axis=1)
            with np.load(os.path.join(folder, video, "tracks.npz")) as arrays:
                self.assertEqual(sorted(arrays.files), ["object", "occluded", "points", "query_points", "track"])
                found = {name: arrays[name] for name in arrays.files}
            self.assertEqual((found["points"].dtype, found["occluded"].dtype), (np.float32, bool))
            self.assertLessEqual(set(np.unique(found["occluded"].view(np.uint8))), {0, 1})
            frames = pickled[video]["video"]
            self.assertEqual((frames.dtype, frames.shape), (np.uint8, (len(entries), 72, 96, 3)))
            for t, entry in enumerate(entries):
                self.assertTrue(np.array_equal(frames[t], read_png(os.path.join(dataset, entry["camera"], "color", f"{entry['frame']:06d}.png"))))
            for name in ("points", "occluded"):
                self.assertEqual(pickled[video][name].dtype, found[name].dtype)
                self.assertTrue(np.array_equal(pickled[video][name], found[name]))
            seen = places[..., 2] == 1
            self.assertEqual(found["track"].tolist(), np.nonzero(seen.any(axis=1))[0].tolist())
            own = places[found["track"]]
            self.assertEqual(found["object"].tolist(), [points[i]["object"] for i in found["track"]])
            self.assertTrue(np.array_equal(found["occluded"], own[..., 2] != 1))
            pixels = found["points"] * [96, 72]
            self.assertLess(np.abs(pixels - np.nan_to_num(own[..., :2])).max(initial=0), 1e-4 + np.abs(own[..., :2][np.isfinite(own[..., :2])]).max(initial=0) * 1e-6)
            for (t, y, x), track, covered in zip(found["query_points"], own, found["occluded"]):
                self.assertEqual(int(t), np.argmin(covered))
                self.assertLess(np.abs(track[int(t), :2] - [x, y]).max(), 1e-4)
            hidden += found["occluded"].sum()
            count += found["occluded"].size
        return hidden, count

    def test_videos(self):
        dataset = self.render(datasets.stereo(self.path("scene"), frames=5), "color,tracks", *TRACKS)
        folder, record = self.export(dataset, "tapvid")
        self.assertEqual(sorted(os.listdir(folder)), ["export.json", "left_eye", "right_eye", "tapvid.pkl"])
        self.assertEqual(sorted(os.listdir(os.path.join(folder, "left_eye"))), ["frames", "tracks.npz"])
        hidden, count = self.check(dataset, folder, record)
        self.assertGreater(hidden, 50)
        self.assertGreater(count, 2000)
        for at in (200, 3000, 5000):  # the sums of members betray each bit
            said = self.planted(dataset, folder, "left_eye/tracks.npz", lambda data, at=at: data[:at] + bytes([data[at] ^ 1]) + data[at + 1:])
            self.assertIn("tracks.npz", said)
        for at in (3000, -3000):  # of a picture, and of what is covered
            self.assertIn("tapvid.pkl", self.planted(dataset, folder, "tapvid.pkl", lambda data, at=at: data[:at] + bytes([data[at] ^ 1]) + data[at:][1:]))
        plain, _ = self.export(dataset, "tapvid", "--pickle", "off")
        self.assertFalse(os.path.exists(os.path.join(plain, "tapvid.pkl")))

    def test_an_empty_frame_lenses_and_refusals(self):
        dataset = self.render(datasets.walk(self.path("walk")), "color,tracks", *TRACKS)
        folder, record = self.export(dataset, "tapvid", "--image-format", "jpg")
        self.check(dataset, folder, record)
        with np.load(os.path.join(folder, "Kamera_1", "tracks.npz")) as arrays:
            self.assertTrue(arrays["occluded"][:, 3].all())
        nothing = self.render(hard_scenes.nothing(self.path("nothing")), "color,tracks")
        folder, record = self.export(nothing, "tapvid")
        self.assertEqual(self.check(nothing, folder, record), (0, 0))  # with sums of members that NumPy takes
        lenses = self.render(datasets.lenses(self.path("lenses")), "color,tracks", *TRACKS)
        self.check(lenses, *self.export(lenses, "tapvid"))
        self.refused("export", self.render(self.path("walk", "walk.json"), "color"), "--format", "tapvid", "-o", self.path("no"), status=2, says="lacks layers")
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    main()
