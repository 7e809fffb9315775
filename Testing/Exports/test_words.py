# SPDX-License-Identifier: BSD-3-Clause
"""Every number and every word that an export says is judged: each is changed, left out or doubled, one at a time, and `dgtk verify --export`
must say so, but for what is free: comments, and names of whom made it. It must never end in another way.

No row of the referee is left in which no test has seen an error."""
import collections
import concurrent.futures
import hashlib
import json
import os
import re
import shutil

import datasets
import pictures
from datasets import load_json, main, sealed
from planted_exports import ALONE, PLANTS
from word_changes import changes_of, json_changes

PIXELS = (".png", ".jpg", ".pfm", ".npy", ".flo", ".flo5", ".dsp5", ".dpt")
RECORDS = (".cam", ".bin", ".npz", ".pkl", ".hdf5", ".tar", ".bag", ".mcap")

# Formats with other options than the usual ones, whose documents look different.
VARIANTS = {"colmap-txt": ("colmap", "--model-format", "txt"), "yolo-oriented": ("yolo", "--labels", "oriented"), "tum-icl": ("tum", "--dialect", "icl-nuim"),
            "imagefolder-jpg": ("imagefolder", "--image-format", "jpg")}

# "FILE PLACE" of what need not be seen, by format; "" for all.
FREE = {
    "": [r"export.json -?(conventions|layers)\b.*", "export.json shorter layers", r"export.json -?files/\*/encoding.*", r"export.json longer files/\*/encoding/.*"],
    "bop": [r"scene_gt_coco.json -?(info|licenses).*", r"scene_gt_coco.json -?categories/\*/supercategory", r"dataset_info.json -?made_by"],
    "coco": [r"instances_train.json -?(info|licenses).*"],
    "coco-panoptic": [r"panoptic_train.json -?(info|licenses).*", r"panoptic_train.json categories/\*/color/."],
    "colmap-txt": [".*txt comment", "images.txt 1"], "flyingthings": ["camera_data.txt twice line 8"],
    "gltf": [r"scene.gltf -?asset/generator", r"scene.gltf -?animations/\*/name", r"scene.gltf -nodes/\*/(rotation|scale)"],  # the usual rotation and scale
    "imagefolder": ["README.md text"], "webdataset": ["README.md text"],
    "nerf-synthetic": [r"transforms_train.json -?frames/\*/rotation"], "tum": [".*txt comment"], "tum-icl": [".*txt comment"],
    "voc": ["cam_L_000000.xml DGTk"],
}


class Words(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        scene = datasets.street(self.path("scene"), width=24, height=18)
        self.dataset = self.render(scene, "boxes,amodal,objects,classes", "--for", ",".join(PLANTS))

    def judge(self, folder):
        """(status, rows with an error, all rows)."""
        done = self.runs.run("verify", self.dataset, "--export", folder, "--json", "--threads", "1")
        self.assertRegex(done.stderr, b"^(dgtk: .*\n)?$")  # nothing of a library's
        rows = {row["layer"]: row for row in json.loads(done.stdout)["residuals"]} if done.returncode in (0, 1) else {}
        return done.returncode, {layer: row for layer, row in rows.items() if row["breach"]}, rows

    def write(self, path, data):
        os.remove(path)  # it may be a link to the dataset's
        self.write_new(path, data)

    @staticmethod
    def write_new(path, data):
        with open(path, "wb") as file:
            file.write(data)

    def changed(self, folder, record, name, data):
        """Judges an export with another file, which export.json knows."""
        path = os.path.join(folder, name)
        with open(path, "rb") as file:
            old = file.read()
        files = [dict(row, sha256=hashlib.sha256(data).hexdigest(), bytes=len(data)) if row["path"] == name else row for row in record["files"]]
        self.write(path, data)
        self.write(os.path.join(folder, "export.json"), sealed({**record, "files": files}))
        found = self.judge(folder)
        self.write(path, old)
        return found

    def planted_in(self, path, edit):
        """The bytes of a file with an error."""
        copy = self.path("copy" + hashlib.sha256(path.encode()).hexdigest() + os.path.splitext(path)[1])
        shutil.copyfile(path, copy)
        if hasattr(edit, "of_path"):
            edit(copy)
        with open(copy, "rb") as file:
            data = file.read()
        return data if hasattr(edit, "of_path") else edit(data)

    def smaller(self, name, data):
        """(what lacks, the bytes) of a picture."""
        if name.endswith(".jpg"):
            yield "its end", data[:2 * len(data) // 3]
            height = data.index(b"\xff\xc0") + 5  # high byte, low byte
            yield "a row", data[:height + 1] + bytes([data[height + 1] - 1]) + data[height + 2:]
        if name.endswith(".png") and data[25] != 3:  # with a palette
            source = self.path("whole" + hashlib.sha256(data).hexdigest())
            self.write_new(source, data)
            image = pictures.read_png(source)
            for what, part in (("a row", image[:-1]), ("a column", image[:, :-1])):
                pictures.write_png(source, part)
                with open(source, "rb") as file:
                    yield what, file.read()

    def sweep(self, form):
        """(rows in which errors were seen, all rows, what was not seen, what went wrong)."""
        folder = self.path(form)
        self.dgtk("export", self.dataset, "--format", *VARIANTS.get(form, (form,)), "-o", folder, "--quiet",
                  *(("--cameras", "cam L") if form == "bop" else ()))  # its files are the most: a folder for each camera
        record = load_json(os.path.join(folder, "export.json"))
        status, _, every = self.judge(folder)
        seen, unseen, wrong = set(), [], [] if status == 0 else ["the sound export"]
        kinds = collections.OrderedDict((re.sub(r"\d+", "#", row["path"]).replace("cam_R", "cam_L"), row["path"]) for row in reversed(record["files"]))
        for name in kinds.values():
            if form == "imagefolder-jpg" and not name.endswith(".jpg"):
                continue  # the words are those of imagefolder
            with open(os.path.join(folder, name), "rb") as file:
                data = file.read()
            if name.endswith(PIXELS + RECORDS):
                for at in [len(data) - 1] if name.endswith(PIXELS) else range(0, len(data), len(data) // 40 + 1):
                    status, rows, _ = self.changed(folder, record, name, data[:at] + bytes([data[at] ^ 64]) + data[at + 1:])
                    seen.update(rows)
                    if status not in (0, 1):
                        wrong.append(f"{name} byte {at}: exit {status}")
                for what, smaller in self.smaller(name, data):
                    status, _, _ = self.changed(folder, record, name, smaller)
                    if status not in (1, 3):
                        wrong.append(f"{name} {what} less: exit {status}")
                continue
            for what, changed in changes_of(name, data):
                status, rows, _ = self.changed(folder, record, name, changed) if changed != data else (1, {}, None)
                place = f"{os.path.basename(name)} {what}"
                seen.update(rows)
                if status == 0:
                    unseen.append(place)
                elif status != 1:
                    wrong.append(f"{place}: exit {status}")
        for what, changed in json_changes({key: value for key, value in record.items() if key != "sha256"}):
            if form in ("kitti2015", "yolo") or "names" in what:  # it is read by the same code in all
                self.write(os.path.join(folder, "export.json"), sealed(changed))
                status, rows, _ = self.judge(folder)
                seen.update(rows)
                if status == 0:
                    unseen.append(f"export.json {what}")
                elif status not in (1, 3):  # 3: it cannot be read
                    wrong.append(f"export.json {what}: exit {status}")
        for plant in ALONE.get(form, ()):
            _, rows, _ = self.changed(folder, record, plant.file, self.planted_in(os.path.join(folder, plant.file), plant.edit))
            if plant.row not in rows:
                wrong.append(f"row {plant.row} has no error: {sorted(rows)}")
            seen.add(plant.row)
        return seen, set(every), unseen, wrong

    def test_every_word_is_judged(self):
        forms = [*PLANTS, *VARIANTS]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            found = dict(zip(forms, pool.map(self.sweep, forms)))
        for form, (seen, every, unseen, wrong) in found.items():
            free = FREE[""] + FREE.get(form, [])
            with self.subTest(form):
                self.assertEqual(wrong, [])
                self.assertEqual([place for place in unseen if not any(re.fullmatch(one, place) for one in free)], [])
                self.assertEqual([one for one in FREE.get(form, []) if not any(re.fullmatch(one, place) for place in unseen)], [], "is seen")
                if form in PLANTS:
                    self.assertEqual(every - seen - found["kitti2015"][0].intersection(("record", "export")) - {plant.row for plant in PLANTS[form]}, set(), "rows without a planted error")


if __name__ == "__main__":
    main()
