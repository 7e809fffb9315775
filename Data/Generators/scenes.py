# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of the thesis's figures, and those that show one ability each."""

import math

from half_circle import half_circle
from models_still import height_at
from random_numbers import Lcg
from scene_text import ThesisScene, product, quaternion, scene_json, standing

SKY = [0.62, 0.78, 0.94]
SUN = {"name": "sun", "kind": "directional", "position": [-6.0, 10.0, 8.0], "target": [0, 0, 0], "diffuse": [0.95, 0.91, 0.82],
       "ambient": [0.20, 0.22, 0.26]}


def model(name, file, position=(0, 0, 0), **more):
    item = {"name": name, "model": f"../Models/{file}", "position": list(position)}
    if "turn" in more:
        item["orientation"] = list(quaternion("y", more.pop("turn")))
    if "class_name" in more:
        item["class"] = more.pop("class_name")
    item.update(more)
    return item


def upright(name, file, position, degrees, size, **more):
    """A model with z up. MD2 has no colours of its own: how much of the light is ambient is said here."""
    if file.endswith(".md2"):
        more["materials"] = {"*": {"ambient": [0.3] * 3, "diffuse": [0.9] * 3}}
    return model(name, file, position, orientation=list(standing(degrees)), scale=[size] * 3, **more)


def on_land(x, z, sink=0.03):
    return (x, height_at(x, z) - sink, z)


def base(objects, cameras, lights=None, **more):
    scene = {"version": 1, "units": "metre", "background": SKY}
    scene.update(more)
    scene.update(objects=objects, lights=[SUN] if lights is None else lights, cameras=cameras)
    return scene_json(scene)


def camera(name, eye, look_at, width=640, height=480, fov=45, **more):
    item = {"name": name, "width": width, "height": height, "fovY": fov, "near": 0.1, "far": 200, "eye": list(eye),
            "lookAt": list(look_at)}
    item.update(more)
    return item


def demo():
    """A garden: every reader of our own, a cut-out tree, an animated creature, instanced crates; a stereo pair."""
    baseline = 0.2
    objects = [
        model("terrain", "terrain.acc", class_name="ground"),
        model("house", "house.ac", (-4.3, 0, -6.6), turn=24, class_name="building"),
        model("windmill", "windmill.gltf", on_land(3.6, -15.5), turn=-12, scale=[0.8] * 3, class_name="building", animation={"rate": 0.6}),
        model("tree", "tree.ac", (4.2, 0, -3.4), class_name="plant"),
        model("fir", "fir.ac", on_land(0.2, -9.5), class_name="plant"),
        model("table", "table.ac", (0.35, 0, 0.2), turn=-8, class_name="furniture"),
        upright("chair", "chair.3ds", (0.9, 0, -0.75), 20, 1, class_name="furniture"),
        model("vase", "vase.pov", (0.85, 0.75, 0.0), class_name="vessel"),
        model("ball", "ball.ac", class_name="toy") | {
            "position": {"keys": [[0, [-0.1, 1.25, 0.3]], [2, [0.12, 0.87, 0.32]]]},
            "orientation": {"keys": [[0, list(quaternion("z", 40))], [2, list(quaternion("z", -20))]]}},
        model("crate one", "crate.ac", (-1.9, 0, 0.1), turn=15, scale=[0.8] * 3, class_name="box"),
        model("crate two", "crate.ac", (-2.5, 0, -0.9), turn=-30, scale=[0.8] * 3, class_name="box"),
        model("crate three", "crate.ac", (-2.05, 0.8, -0.25), turn=41, scale=[0.55] * 3, class_name="box"),
        upright("creature", "creature.md2", (0, 0, 0), 0, 0.02, class_name="animal") | {
            "position": {"keys": [[0, [-0.95, 0, 1.0]], [2, [-0.8, 0, 1.16]]]},
            "orientation": list(standing(-48)), "animation": {"sequence": "walk", "offset": 2}},
        upright("rocket", "rocket.3ds", (2.0, 0, 0.75), 30, 0.85, class_name="toy"),
        model("grass one", "grass.ac", (1.35, 0, 1.5), class_name="plant"),
        model("grass two", "grass.ac", (-2.9, 0, 1.1), turn=70, class_name="plant"),
    ]
    lights = [SUN,
              {"name": "lamp", "kind": "point", "position": [2.6, 2.2, 2.4], "diffuse": [0.30, 0.22, 0.14],
               "attenuation": [1, 0.1, 0.05]},
              {"name": "spot", "kind": "spot", "position": [-0.5, 4.0, 3.0], "target": [0.6, 0.8, 0.1],
               "diffuse": [0.30, 0.29, 0.25], "coneAngle": 16, "exponent": 8}]
    cameras = [camera(name, (x, 1.75, 5.4), (x, 1.1, 0), fov=44) for name, x in (("left", 0.0), ("right", baseline))]
    return base(objects, cameras, lights, seed=1)


def tiles():
    """Figure 4.3: an image of 1280 x 960, rendered as tiles of 320 x 240."""
    random = Lcg(43)
    objects = [model("terrain", "terrain.acc"), model("house", "house.ac", (0, 0, -3), turn=-28),
               model("tree left", "tree.ac", (-5.2, 0, -1.5)), model("tree right", "tree.ac", (5.6, 0, -3.4), turn=120, scale=[1.15] * 3),
               model("fir", "fir.ac", on_land(-7.5, -8)), model("fir two", "fir.ac", on_land(8.5, -11), turn=50),
               model("windmill", "windmill.gltf", on_land(-7.2, -13), turn=10),
               model("crate", "crate.ac", (3.0, 0, 1.2), turn=20), model("crate top", "crate.ac", (3.1, 1, 1.15), turn=-12, scale=[0.6] * 3),
               upright("flag", "flag.md2", (-2.6, 0, 2.2), 155, 0.03),
               upright("creature", "creature.md2", (0.9, 0, 2.3), -75, 0.022)]
    for k in range(24):
        x, z = random.between(-6, 6), random.between(1.5, 4.8)
        objects.append(model(f"grass {k + 1}", "grass.ac", (x, 0, z), turn=random.between(0, 180), scale=[random.between(0.6, 1)] * 3))
    return base(objects, [camera("camera", (1.2, 2.3, 9.6), (0.1, 1.75, 0), 1280, 960, 44)])


def stereo():
    """Figure 4.7: two parallel cameras 0.12 m apart along x, above a table's still life."""
    objects = [model("room", "room.ac"), model("table", "table.ac"),
               model("vase", "vase.pov", (-0.42, 0.75, -0.12)),
               model("ball", "ball.ac", (0.08, 0.87, 0.16), orientation=list(product(quaternion("z", 25), quaternion("x", 60)))),
               model("crate", "crate.ac", (0.52, 0.75, -0.12), turn=35, scale=[0.22] * 3),
               upright("creature", "creature.md2", (-0.12, 0.75, -0.2), -80, 0.007),
               upright("rocket", "rocket.3ds", (-1.35, 0, -1.3), 30, 0.85),
               upright("chair", "chair.3ds", (0.2, 0, -0.85), -15, 1),
               model("column", "column.obj", (1.75, 0, -1.35)), model("column two", "column.obj", (-0.75, 0, -1.6))]
    lights = [{"name": "key", "kind": "point", "position": [-2.5, 4, 3], "diffuse": [0.72, 0.68, 0.62], "ambient": [0.2, 0.2, 0.22]},
              {"name": "fill", "kind": "directional", "position": [3, 2, 2], "target": [0, 0, 0], "diffuse": [0.20, 0.22, 0.27]}]
    cameras = [camera(name, (x, 1.55, 2.1), (x, 0.85, 0), fov=44, near=0.1, far=100) for name, x in (("left", -0.06), ("right", 0.06))]
    return base(objects, cameras, lights, background=[0.30, 0.33, 0.38])


BALL_KEYS = (0, 3, 6, 8, 10, 12, 14, 17, 20, 22, 24, 27, 30, 32, 34, 37, 40, 43, 46, 48, 50, 53)


def ball_at(frame):
    """Place and turn of the bouncing ball: it falls on the table, bounces twice and leaves it."""
    gravity, contact = 0.0104, 0.87
    x = -0.75 + 0.035 * frame
    if frame <= 12:
        y = contact + gravity * (144 - frame * frame) / 2
    else:
        start, up = (12, 10.0) if frame <= 32 else (32, 8.0)
        y = contact + gravity * (up * (frame - start) - (frame - start) ** 2 / 2)
    return (x, y, 0.05), quaternion("z", -11.0 * frame)


def bouncing_ball():
    """Figures 4.14 (a) and 5.4: 54 frames of a ball that bounces off a table."""
    scene, still = ThesisScene(), (1, 0, 0, 0)
    scene.model("AC", "../Models/room.ac", lambda frame: ((0, 0, 0), still))
    scene.model("AC", "../Models/table.ac", lambda frame: ((0, 0, 0), still))
    scene.model("AC", "../Models/vase.pov", lambda frame: ((-0.55, 0.75, -0.25), still))
    scene.model("3DS", "../Models/chair.3ds", lambda frame: ((1.0, 0, -0.8), standing(-35)))
    scene.model("AC", "../Models/ball.ac", ball_at)
    scene.light("lamp", (0.72, 0.69, 0.63), (0.6, 0.6, 0.6), (0.2, 0.2, 0.22), (-1.2, 2.6, 2.4))
    scene.camera(45, 0.1, 100, 4 / 3, (0.45, 1.6, 3.1), (0.12, 0.98, 0))
    return scene.text(BALL_KEYS)


def trees_grass():
    """Figure 5.2: thin polygons and cut-outs, for alpha maps."""
    random = Lcg(52)
    objects = [model("terrain", "terrain.acc", class_name="ground"), model("tree", "tree.ac", (-1.7, 0, -2.2), class_name="tree"),
               model("tree two", "tree.ac", (2.4, 0, -3.4), turn=140, scale=[1.1] * 3, class_name="tree"),
               model("fir", "fir.ac", (0.7, 0, -6.3), class_name="tree"), model("fir two", "fir.ac", on_land(-5.5, -8.5), class_name="tree")]
    for k in range(14):
        x, z = random.between(-2.3, 2.3), random.between(-0.6, 2.6)
        objects.append(model(f"reeds {k + 1}", "reeds.ac", (x, 0, z), turn=random.between(0, 360),
                             scale=[random.between(0.7, 1.0)] * 3, class_name="grass"))
    for k in range(16):
        x, z = random.between(-3, 3), random.between(-1.5, 2.4)
        objects.append(model(f"grass {k + 1}", "grass.ac", (x, 0, z), turn=random.between(0, 360), class_name="grass"))
    return base(objects, [camera("camera", (0.2, 1.55, 5.6), (0, 1.55, 0), fov=44)])


def terrain_grass():
    """Figure 5.3: a terrain model and a grass model, many times."""
    random = Lcg(53)
    objects = [model("terrain", "terrain.acc", class_name="terrain")]
    for k in range(260):
        away = 16 * math.sqrt(random.unit())
        side = random.between(-0.62, 0.62)
        x, z = away * math.sin(side), 7.5 - away * math.cos(side) - 1.2
        objects.append(model(f"grass {k + 1}", "grass.ac", on_land(x, z), turn=random.between(0, 360),
                             scale=[random.between(0.8, 1.6)] * 3, class_name="grass"))
    return base(objects, [camera("camera", (0, 1.7, 8.0), (0, 0.55, 0), fov=46)])


def outdoor():
    """Figure B.2: a single camera before a wood of 240 trees around a house."""
    random = Lcg(2)
    objects = [model("terrain", "terrain.acc", class_name="ground"), model("house", "house.ac", (-1.2, 0, -1.5), turn=22, class_name="building"),
               model("windmill", "windmill.gltf", on_land(5.0, -11.5, 0.2), turn=-5, class_name="building"),
               upright("creature", "creature.md2", (2.2, 0, 3.3), -60, 0.024, class_name="animal"),
               upright("flag", "flag.md2", (4.0, 0, 0.6), 10, 0.036, class_name="flag"),
               model("crate", "crate.ac", (-4.4, 0, 2.3), turn=30, class_name="box"),
               model("crate two", "crate.ac", (-3.3, 0, 2.6), turn=-15, scale=[0.7] * 3, class_name="box")]
    placed = []
    while len(placed) < 240:
        x, z = random.between(-19, 19), random.between(-19, 9)
        if math.hypot(x + 0.5, z - 1.5) < 7.2 or math.hypot(x - 5, z + 11.5) < 2.4 or (abs(x) < 2.6 + 0.35 * z and z > 3):
            continue
        if any(math.hypot(x - a, z - b) < 0.9 for a, b in placed):
            continue
        placed.append((x, z))
        file, size = ("fir.ac", random.between(0.6, 1.15)) if random.unit() < 0.55 else ("tree.ac", random.between(0.6, 1.05))
        objects.append(model(f"tree {len(placed)}", file, on_land(x, z, 0.05), turn=random.between(0, 360), scale=[size] * 3, class_name="tree"))
    return base(objects, [camera("camera", (2.6, 4.8, 14.0), (0.3, 2.0, 0), fov=48)])


FILES = {"demo.json": demo, "fig_4_3_tiles.json": tiles, "fig_4_7_stereo.json": stereo, "fig_4_14_bouncing_ball.scene": bouncing_ball,
         "fig_5_2_trees_grass.json": trees_grass, "fig_5_3_terrain_grass.json": terrain_grass, "fig_b1_half_circle.scene": half_circle,
         "fig_b2_outdoor.json": outdoor}
