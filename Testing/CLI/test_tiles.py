# SPDX-License-Identifier: BSD-3-Clause
"""The tile size, EGL or OSMesa change no byte of a layer, and the layer tiles is the picture cut."""
import os
import shutil
import subprocess

from harness import DGTK, SCENES, WHOLE, Case, digests, main

# One with cut-outs, textures and animation, one with a ground plane that passes under and behind the camera, one with many lights.
SCENE_NAMES = ("demo.json", "ground_plane_behind.json", "lights_many.json")

# What a pixel's own surface decides: cheap, so whole pictures in every scene.
PIXEL_LAYERS = ("color,depth,distance,inversedepth,objects,classes,parts,triangles,normal,shadingnormal,position,objectcoords,"
                "uv,barycentrics,calibration,tiles")


def available(backend):
    listed = subprocess.run([DGTK, "list", "gl"], capture_output=True, text=True, check=True).stdout
    row = [line for line in listed.splitlines() if line.split()[:1] == [backend]]
    return bool(row) and " not available" not in row[0]


class Tiles(Case):
    def render(self, scene, folder, *options):
        self.dgtk("render", os.path.join(SCENES, scene), "-o", self.path(folder), "--quiet", "--size", "160x120",
                  "--frames", "0", *options)
        return self.path(folder)

    def test_tile_sizes_and_backends(self):
        self.assertTrue(available("egl"), "EGL software rendering is expected everywhere")
        self.assertTrue(available("osmesa"), "OSMesa is expected everywhere")
        # What cuts is the same code for both, and for all scenes; one size that divides nothing is tried with OSMesa, and with each scene, too.
        tiles = {"egl": ("80x60", "32x24", "49x31", "1000x1000"), "osmesa": ("49x31",)}
        for scene in SCENE_NAMES:
            for gl, sizes in tiles.items() if WHOLE or scene == SCENE_NAMES[0] else (("egl", ("49x31",)), ("osmesa", ())):
                whole = self.render(scene, f"{scene}-{gl}", "--layers", PIXEL_LAYERS, "--gl", gl)
                layers = without_tiles(whole)
                for tile in sizes:
                    with self.subTest(scene=scene, gl=gl, tile=tile):
                        cut = self.render(scene, f"{scene}-{gl}-{tile}", "--layers", PIXEL_LAYERS, "--gl", gl, "--tile", tile)
                        self.assertEqual(layers, without_tiles(cut))
                        shutil.rmtree(cut)
            with self.subTest(scene=scene):
                self.assert_same_files(self.path(f"{scene}-egl"), self.path(f"{scene}-osmesa"))

    def test_tiles_put_together_are_the_picture(self):
        folder = self.render("demo.json", "tiled", "--layers", "color,tiles", "--tile", "49x31")
        self.dgtk("compare", folder, folder)
        import zlib
        camera = sorted(n for n in os.listdir(folder) if os.path.isdir(os.path.join(folder, n)))[0]
        whole = read_png(os.path.join(folder, camera, "color", "000000.png"), zlib)
        for row in range(4):
            for column in range(4):
                tile = read_png(os.path.join(folder, camera, "tiles", f"000000_{row}_{column}.png"), zlib)
                for y, line in enumerate(tile):
                    begin = column * 49 * 3
                    self.assertEqual(line, whole[row * 31 + y][begin:begin + len(line)])


def without_tiles(folder):
    """Digests of what does not say how the picture was cut."""
    found = {n: d for n, d in digests(folder).items() if "/tiles/" not in n and n != "manifest.json"}
    assert found, folder
    return found


def read_png(path, zlib):
    """Rows of an 8-bit RGB PNG, read without the library under test."""
    with open(path, "rb") as file:
        data = file.read()
    width, height = int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    assert data[24:26] == b"\x08\x02"
    packed, at = b"", 8
    while at < len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    raw, rows, above = zlib.decompress(packed), [], bytes(3 * width)
    for y in range(height):
        line = bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        unfilter(raw[y * (3 * width + 1)], line, above)
        rows.append(bytes(line))
        above = rows[-1]
    return rows


def unfilter(kind, line, above):
    for i in range(len(line)):
        left = line[i - 3] if i >= 3 else 0
        corner = above[i - 3] if i >= 3 else 0
        up = above[i]
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + up) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + up) // 2) & 255
        elif kind == 4:
            p = left + up - corner
            best = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            line[i] = (line[i] + best) & 255


if __name__ == "__main__":
    main()
