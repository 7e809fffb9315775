# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that show one ability each, and the example of the thesis's appendix B.3."""

import math

from scene_text import product, quaternion
from scenes import SUN, base, camera, model, upright

APPENDIX_B3 = """3
glObject_AC: tuxedo.ac
glObject_AC: world.ac
glObject_Camera: ( 60, 0.1, 1000, 1.33 )
[ 2.45 0 -7.24999, -4.5 0 4.09998, 0 1 0 ]
2
0
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 2.45 0 -7.24999 > { 1.0000 , < 0, 0, 0 > }
< -4.5 0 4.09998 > { 1.00000 ,< 0, 0, 0 > }
2
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 0 0 0 > { 1.00 , < 0, 0, 0 > }
< 2.45 0 -7.24999 > { 1.0000 , < 0, 0, 0 > }
< -4.5 0 4.09998 > { 1.00000 ,< 0, 0, 0 > }
"""


def ground_behind():
    """A plane of 2 km that passes under and behind the camera, cutting its plane z = 0."""
    objects = [model("ground", "ground.ac"), model("house", "house.ac", (-4, 0, -9), turn=30),
               model("column", "column.obj", (1.4, 0, -2.5)), model("crate", "crate.ac", (-1.0, 0, -3.2), turn=25),
               model("crate behind", "crate.ac", (0.5, 0, 3.0))]
    cameras = [camera("level", (0, 1.5, 1.0), (0, 1.2, -5), fov=60, far=2000),
               camera("down", (0, 2.5, 1.0), (0.2, 0, -1.2), fov=75, far=2000),
               camera("grazing", (0.3, 0.05, 1.0), (0.3, 0.05, -9), fov=50, near=0.02, far=5000)]
    return base(objects, cameras)


def many_lights():
    """Twelve lights: one at the camera, one directional, four points with fall-off, six coloured spots."""
    dim = {"*": {"ambient": [0.05] * 3}}
    objects = [model("floor", "floor.ac", scale=[2, 1, 2], materials=dim)]
    for k in range(5):
        angle = math.radians(-60 + 30 * k)
        objects.append(model(f"column {k + 1}", "column.obj", (4 * math.sin(angle), 0, -3.4 * math.cos(angle)), materials=dim))
    objects += [model("vase", "vase.pov", (0, 0, -0.4), scale=[3] * 3, materials=dim),
                model("ball", "ball.ac", (1.3, 0.3, 0.6), scale=[2.5] * 3, materials=dim),
                model("crate", "crate.ac", (-1.4, 0, 0.2), turn=20, scale=[0.8] * 3, materials=dim),
                upright("creature", "creature.md2", (0.1, 0, 1.3), -85, 0.013)]
    lights = [{"name": "camera light", "kind": "head", "diffuse": [0.10, 0.10, 0.12], "specular": [0, 0, 0]},
              {"name": "moon", "kind": "directional", "position": [4, 8, -6], "target": [0, 0, 0], "diffuse": [0.25, 0.30, 0.45],
               "ambient": [0.06, 0.06, 0.08]}]
    for k, colour in enumerate(([0.9, 0.5, 0.2], [0.9, 0.6, 0.3], [0.9, 0.5, 0.2], [0.9, 0.6, 0.3])):
        angle = math.radians(-45 + 30 * k)
        lights.append({"name": f"lantern {k + 1}", "kind": "point", "position": [3.2 * math.sin(angle), 0.5, -2.7 * math.cos(angle)],
                       "diffuse": colour, "attenuation": [0.5, 0.3, 1.2]})
    for k, colour in enumerate(([1, 0.15, 0.1], [0.1, 1, 0.2], [0.15, 0.3, 1], [1, 0.9, 0.1], [1, 0.1, 0.9], [0.1, 0.95, 1])):
        angle = 2 * math.pi * k / 6
        lights.append({"name": f"spot {k + 1}", "kind": "spot", "position": [2.4 * math.sin(angle), 4.5, 2.4 * math.cos(angle)],
                       "target": [1.2 * math.sin(angle), 0, 1.2 * math.cos(angle)], "diffuse": colour, "coneAngle": 17, "exponent": 6})
    return base(objects, [camera("camera", (0, 2.6, 7.2), (0, 0.9, 0), fov=46)], lights, background=[0.02, 0.02, 0.05])


def parenting():
    """A mobile: a crate turns; what stands on it turns with it, five deep, one of the carriers invisible."""
    objects = [model("floor", "floor.ac"),
               model("turntable", "crate.ac", (0, 0, 0), scale=[1.6, 0.35, 1.6]) | {
                   "orientation": {"keys": [[f, list(quaternion("y", 3 * f))] for f in (0, 30, 60)]}},
               model("axle", "ball.ac", (0.0, 1.0, 0.0), parent="turntable", visible=False, scale=[0.625, 2.857, 0.625]),
               model("table", "table.ac", (0, 0, 0), parent="axle"),
               model("vase", "vase.pov", (0.5, 0.75, 0), parent="table"),
               model("ball", "ball.ac", (0, 0, 0), parent="vase") | {
                   "position": {"keys": [[0, [0, 0.49, 0]], [30, [0, 0.9, 0]], [60, [0, 0.49, 0]]], "interpolation": "smooth"}},
               upright("creature", "creature.md2", (-0.45, 0.75, 0), 0, 0.008, parent="table", animation={"sequence": "jump", "rate": 1.5}),
               model("flag", "flag.md2", (9, -22, 0), parent="creature", scale=[0.7] * 3, animation={"sequence": "storm", "start": 10})]
    return base(objects, [camera("camera", (0.4, 2.5, 4.2), (0, 1.05, 0), fov=40)])


def all_cameras():
    """Every kind of camera: K with its centre aside and fx unlike fy, orthographic, animated field of view, a moving pose."""
    objects = [model("terrain", "terrain.acc"), model("house", "house.ac", (0, 0, -2)), model("tree", "tree.ac", (4.3, 0, 0.6)),
               model("crate", "crate.ac", (-3, 0, 2), turn=20), upright("creature", "creature.md2", (0.8, 0, 2.4), -90, 0.02),
               model("column", "column.obj", (-1.9, 0, 2.6))]
    cameras = [
        {"name": "matrix", "width": 640, "height": 400, "K": [[700, 0, 250], [0, 560, 260], [0, 0, 1]], "near": 0.1, "far": 200,
         "eye": [3, 2.2, 9], "lookAt": [0, 1.4, 0]},
        {"name": "orthographic", "model": "orthographic", "width": 480, "height": 480, "viewHeight": 9, "near": 0.1, "far": 200,
         "eye": [8, 8, 10], "lookAt": [0, 1.5, 0]},
        camera("zoom", (-4, 2.5, 10), (0, 1.5, 0)) | {"fovY": {"keys": [[0, 60], [8, 18]]}},
        camera("wide pixels", (0, 2, 10), (0, 1.5, 0), 360, 480) | {"aspect": 1.2},
        {"name": "flight", "width": 640, "height": 480, "fovY": 50, "near": 0.1, "far": 200,
         "position": {"keys": [[0, [0, 3, 11]], [4, [5, 3, 10]], [8, [9, 3, 5]]], "interpolation": "smooth"},
         "orientation": {"keys": [[f, list(product(quaternion("y", d), product(quaternion("x", -8), quaternion("x", 180))))]
                                  for f, d in ((0, 0), (4, 27), (8, 60))]}}]
    return base(objects, cameras)


def fisheye_rig():
    """A vehicle on its way past a house: a pinhole ahead, fisheyes of 200 degrees to four sides, a panorama above."""
    objects = [model("terrain", "terrain.acc"), model("house", "house.ac", (-5, 0, -3)), model("tree", "tree.ac", (4.6, 0, 1.6)),
               model("fir", "fir.ac", (3.2, 0, 4)), model("crate", "crate.ac", (-2.6, 0, 1.1), turn=27),
               upright("creature", "creature.md2", (2.4, 0, 3.6), -90, 0.02, animation={"sequence": "walk"}),
               model("column", "column.obj", (-2.2, 0, 4.2))]

    def on_the_way(name, right, up, back, degrees, **lens):
        """Its place on the vehicle and where it looks, from ahead to the left."""
        turned = product(quaternion("y", degrees), quaternion("x", 180))
        return {"name": name, "near": 0.05, "far": 200, **lens,
                "position": {"keys": [[0, [right, up, 3 + back]], [8, [right, up, -1 + back]]]}, "orientation": list(turned)}

    fisheye = {"model": "fisheye", "width": 640, "height": 640, "K": [[175, 0, 320], [0, 175, 320], [0, 0, 1]],
               "distortion": [0.02, -0.004, 0.0006, -0.00005]}
    return base(objects, [on_the_way("ahead", 0.13, 1.4, -0.63, 3, width=640, height=400, fovY=50),
                          on_the_way("front", 0, 0.7, -2, 0, **fisheye), on_the_way("left", -0.9, 1, 0, 90, **fisheye),
                          on_the_way("back", 0, 0.9, 2, 180, **fisheye), on_the_way("right", 0.9, 1, 0, -90, **fisheye),
                          on_the_way("above", 0, 1.9, 0, 0, model="equirectangular", width=720, height=360)])


def passing_train():
    """A house with posts before it and a crate that turns, from a train: by a rolling shutter, and seen at once."""
    crate = model("crate", "crate.ac")
    crate["position"] = {"keys": [[0, [-1.8, 0.5, 1.6]], [4, [0.2, 2.1, 1.6]]]}
    crate["orientation"] = {"keys": [[0, [1, 0, 0, 0]], [2, [0, 0, 0, 1]], [4, [-1, 0, 0, 0]]]}
    objects = [model("terrain", "terrain.acc"), model("house", "house.ac", (-3.2, 0, -3)), model("tree", "tree.ac", (3.4, 0, -1.2)),
               model("fir", "fir.ac", (1.2, 0, -2)), model("post", "column.obj", (-0.6, 0, 2.2)),
               model("second post", "column.obj", (1.4, 0, 2.2)), crate]
    window = {"near": 0.05, "far": 200, "width": 480, "height": 320, "fovY": 42,
              "eye": {"keys": [[0, [-2.5, 1.3, 6.4]], [4, [1.5, 1.3, 6.4]]]},
              "lookAt": {"keys": [[0, [-2.5, 1.1, 0]], [4, [1.5, 1.1, 0]]]}}
    return base(objects, [{"name": "train", "rollingShutter": {"duration": 0.9}, **window}, {"name": "still", **window}],
                lights=[{**SUN, "shadows": True}])


FILES = {"appendix_b3.scene": lambda: APPENDIX_B3, "ground_plane_behind.json": ground_behind, "lights_many.json": many_lights,
         "parenting.json": parenting, "cameras_all_kinds.json": all_cameras,
         "fisheye_rig.json": fisheye_rig, "rolling_shutter.json": passing_train}
