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
import subprocess

import datasets
from datasets import load_json, main, sealed
from harness import DGTK
from planted_exports import ALONE, PLANTS

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
    "imagefolder": ["README.md text"], "imagefolder-jpg": ["README.md text"], "webdataset": ["README.md text"],
    "nerf-synthetic": [r"transforms_train.json -?frames/\*/rotation"], "tum": [".*txt comment"], "tum-icl": [".*txt comment"],
    "voc": ["cam_L_000000.xml DGTk"],
}


def leaves(value, path=()):
    """(path, value) of all in a JSON document."""
    yield path, value
    for key, one in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from leaves(one, path + (key,))


def kind_of(path):
    """Where alike things stand: places in lists of numbers and in lists of those count, others do not."""
    return "/".join(key if isinstance(key, str) else str(key) if all(isinstance(one, int) for one in path[i:]) and len(path) - i <= 1 else "*"
                    for i, key in enumerate(path))


def other(value):
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        return value + (1 if isinstance(value, int) else 1e-3 * max(1, abs(value)))
    return value + "x" if isinstance(value, str) else 7


def json_changes(document):
    """(what, changed document) of one of each kind: another value, a key less, a list's last entry twice or not at all."""
    text = json.dumps(document)
    seen = set()
    for path, value in leaves(document):
        changes = []
        if path and isinstance(path[-1], str):
            changes.append(("-", lambda parent, key: parent.pop(key)))
        if isinstance(value, list) and value and path:
            changes.append(("shorter ", lambda parent, key: parent[key].pop()))
            changes.append(("longer ", lambda parent, key: parent[key].append(parent[key][-1])))
            if isinstance(value[0], list):
                changes.append(("an empty list more ", lambda parent, key: parent[key].append([])))
        elif not isinstance(value, (list, dict)):
            changes.append(("", lambda parent, key: parent.__setitem__(key, other(parent[key]))))
        for how, change in changes:
            if how + kind_of(path) not in seen:
                seen.add(how + kind_of(path))
                copy = json.loads(text)
                parent = copy
                for key in path[:-1]:
                    parent = parent[key]
                change(parent, path[-1])
                yield how + kind_of(path), copy


def text_changes(name, text, most=40):
    """Words and lines; of many those at the beginning and some others."""
    words = list(re.finditer(r"[^\s,<>=\[\]\";:()]+", text))
    body = text.find("\n---\n") if name == "README.md" else len(text)
    for word in words[:most // 2] + words[most // 2::max(1, (2 * len(words) - most) // most)]:
        line = text[text.rfind("\n", 0, word.start()) + 1:]
        try:
            changed = repr(float(word[0]) + 1e-3 * max(1, abs(float(word[0])))) if "." in word[0] else str(int(word[0]) + 1)
        except ValueError:
            changed = word[0] + "x"
        what = "text" if word.start() > body >= 0 else "comment" if line.startswith("#") else word[0]
        yield what, text[:word.start()] + changed + text[word.end():]
    for number in [word for word in words if word.start() < body and re.fullmatch("-?[0-9.]+", word[0])][:3]:
        line = text[text.rfind("\n", 0, number.start()) + 1:]
        yield "comment" if line.startswith("#") else "a letter behind a number", text[:number.end()] + "x" + text[number.end():]
    lines = text.splitlines(True)
    for at in sorted({0, 1, 2, 3, len(lines) // 2, len(lines) - 1}.intersection(range(len(lines)))):
        what = "text" if len("".join(lines[:at])) > body >= 0 else "comment" if lines[at].startswith("#") else None
        yield what or f"-line {at + 1}", "".join(lines[:at] + lines[at + 1:])
        yield what or f"twice line {at + 1}", "".join(lines[:at + 1] + lines[at:])


def changes_of(name, data):
    if name.endswith((".json", ".gltf")):
        yield from ((what, json.dumps(one, ensure_ascii=False).encode()) for what, one in json_changes(json.loads(data)))
    elif name.endswith(".jsonl"):
        rows = data.decode().splitlines()
        yield from ((what, "\n".join([json.dumps(one), *rows[1:], ""]).encode()) for what, one in json_changes(json.loads(rows[0])))
        yield "-line", "\n".join([*rows[:-1], ""]).encode()
    elif name.endswith(".ply"):
        end = data.index(b"end_header")
        yield from ((what, text.encode() + data[end:]) for what, text in text_changes(name, data[:end].decode()))
    else:
        yield from ((what, text.encode()) for what, text in text_changes(name, data.decode()))


class Words(datasets.ExportCase):
    def setUp(self):
        super().setUp()
        scene = datasets.street(self.path("scene"), width=24, height=18)
        self.dataset = self.render(scene, "boxes,amodal,objects,classes", "--for", ",".join(PLANTS))

    def judge(self, folder):
        """(status, rows with an error, all rows)."""
        done = subprocess.run([DGTK, "verify", self.dataset, "--export", folder, "--json", "--threads", "1"], capture_output=True)
        rows = {row["layer"]: row for row in json.loads(done.stdout)["residuals"]} if done.returncode in (0, 1) else {}
        return done.returncode, {layer: row for layer, row in rows.items() if row["breach"]}, rows

    def write(self, path, data):
        os.remove(path)  # it may be a link to the dataset's
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

    def sweep(self, form):
        """(rows in which errors were seen, all rows, what was not seen, what went wrong)."""
        folder = self.path(form)
        subprocess.run([DGTK, "export", self.dataset, "--format", *VARIANTS.get(form, (form,)), "-o", folder, "--quiet"], check=True)
        record = load_json(os.path.join(folder, "export.json"))
        status, _, every = self.judge(folder)
        seen, unseen, wrong = set(), [], [] if status == 0 else ["the sound export"]
        kinds = collections.OrderedDict((re.sub(r"\d+", "#", row["path"]).replace("cam_R", "cam_L"), row["path"]) for row in reversed(record["files"]))
        for name in kinds.values():
            with open(os.path.join(folder, name), "rb") as file:
                data = file.read()
            if name.endswith(PIXELS + RECORDS):
                for at in [len(data) - 1] if name.endswith(PIXELS) else range(0, len(data), len(data) // 40 + 1):
                    status, rows, _ = self.changed(folder, record, name, data[:at] + bytes([data[at] ^ 64]) + data[at + 1:])
                    seen.update(rows)
                    if status not in (0, 1):
                        wrong.append(f"{name} byte {at}: exit {status}")
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
            if form in ("bop", "yolo") or "names" in what:  # it is read by the same code in all
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
                    self.assertEqual(every - seen - found["bop"][0].intersection(("record", "export")) - {plant.row for plant in PLANTS[form]}, set(), "rows without a planted error")


if __name__ == "__main__":
    main()
