# SPDX-License-Identifier: BSD-3-Clause
"""MD2 models: a creature that stands, walks and jumps, and a flag in the wind."""

import math

import md2
from geometry import Mesh, add, ellipsoid, grid, turned, tube
from pictures import Canvas, clamp, mix, scale, smoothstep
from random_numbers import Lcg, fractal_noise

# Places of the creature's skin: (u0, v0, u1, v1)
HIDE, BELLY, EYE, SPIKE, FOOT = (0, 0.5, 1, 1), (0, 0.25, 0.5, 0.5), (0.5, 0.25, 0.75, 0.5), (0.75, 0.25, 1, 0.5), (0, 0, 0.5, 0.25)


def creature_skin(size=256, seed=503):
    """An atlas: spotted hide above, then belly, eye and spike, then foot."""
    blot = fractal_noise(size, size, 8, 8, seed, 4)
    random = Lcg(seed)
    canvas = Canvas.from_function(size, size, lambda x, y: scale(
        mix((0.16, 0.50, 0.34), (0.36, 0.72, 0.36), blot[y][x]), 0.9))
    for _ in range(60):
        radius = random.between(2.5, 7)
        canvas.disc(random.between(0, size), random.between(5, size / 2 - 5), radius, radius * 0.8, (0.10, 0.33, 0.30), 2.5)
    for y in range(size // 2, size):
        for x in range(size):
            u, v = (x + 0.5) / size, 1 - (y + 0.5) / size
            tone = 0.85 + 0.3 * blot[y][x]
            if v < 0.25:
                colour = scale((0.86, 0.55, 0.22), tone * (0.8 + 0.2 * math.cos(u * 60)))
            elif u < 0.5:
                colour = scale((0.93, 0.88, 0.62), tone * (0.92 + 0.08 * math.cos(v * 200)))
            elif u < 0.75:
                # the pole that looks outwards is at v = 0.5: iris and pupil there
                up = (v - 0.25) * 4
                colour = mix((0.97, 0.96, 0.92), (0.80, 0.42, 0.06), smoothstep(0.66, 0.70, up))
                colour = mix(colour, (0.03, 0.03, 0.04), smoothstep(0.82, 0.85, up))
            else:
                colour = mix((0.84, 0.30, 0.14), (0.98, 0.82, 0.30), clamp((v - 0.25) * 4))
            canvas.rows[y][x] = colour
    return canvas


def _within(place):
    u0, v0, u1, v1 = place
    margin = 0.012
    return lambda s, t: (u0 + margin + (u1 - u0 - 2 * margin) * s, v0 + margin + (v1 - v0 - 2 * margin) * t)


def _creature_parts():
    """(bone, mesh) in units of about a centimetre, Y up, facing +z; bones turn about their joints."""
    hide, belly, eye, spike, foot = (_within(p) for p in (HIDE, BELLY, EYE, SPIKE, FOOT))
    parts = [("body", ellipsoid((0, 26, 0), (11, 13, 12), 18, 12, uv=hide)),
             ("body", ellipsoid((0, 24.5, 3.4), (9, 11, 10), 14, 10, uv=belly)),
             ("head", ellipsoid((0, 45, 5), (10.5, 9, 10), 18, 12, uv=hide)),
             ("head", ellipsoid((0, 41.5, 11), (7.5, 4.6, 6.5), 14, 8, uv=belly))]
    for side in (-1, 1):
        ball = ellipsoid((0, 0, 0), (3.6, 3.6, 3.6), 12, 8, uv=eye)
        parts.append(("head", ball.moved(lambda p, s=side: add(turned(turned(p, "x", 78), "y", 16 * s), (5.2 * s, 50.5, 11)))))
        parts.append((f"arm{side}", ellipsoid((13 * side, 27, 4), (3, 7.5, 3), 10, 8, uv=hide)))
        parts.append((f"arm{side}", ellipsoid((13.4 * side, 19.5, 5.5), (3.2, 3, 3.6), 8, 6, uv=foot)))
        parts.append((f"leg{side}", ellipsoid((7 * side, 13, 0), (4.6, 10, 5.4), 12, 8, uv=hide)))
        parts.append((f"leg{side}", ellipsoid((7.6 * side, 2.6, 4), (4.8, 2.6, 8.4), 12, 6, uv=foot)))
    tail = tube([(0, 20, -8), (0, 15, -17), (0, 12, -26), (0, 14, -34), (0, 18, -39)], [6.5, 5, 3.4, 2, 0.3], 10, 0)
    for f in tail.faces:
        f.corners = [(i, hide(u % 1.0001, clamp(v / 40))) for i, (u, v) in f.corners]
    parts.append(("tail", tail))
    for k, (y, z) in enumerate(((53, -1), (48.5, -4.6), (38, -9.5), (31.5, -11.8), (24.5, -12))):
        cone = tube([(0, 0, 0), (0, 0.1, -4.6)], [2.4, 0.2], 6, 0)
        for f in cone.faces:
            f.corners = [(i, spike(clamp(u), clamp(v / 4.6))) for i, (u, v) in f.corners]
        parts.append(("head" if k < 2 else "body",
                      cone.moved(lambda p, a=y, b=z, k=k: add(turned(p, "x", (50, 25, 10, -5, -15)[k]), (0, a, b)))))
    return parts


JOINTS = {"head": (0, 38, 2), "tail": (0, 21, -8), "leg-1": (-6, 19, 0), "leg1": (6, 19, 0), "arm-1": (-10.5, 32, 3),
          "arm1": (10.5, 32, 3), "body": (0, 26, 0)}


def _creature_pose(name, t):
    """Angles about x of the bones (degrees), sway of the tail about y, height of the body and squash, at t in [0, 1)."""
    wave, twice = math.sin(2 * math.pi * t), math.sin(4 * math.pi * t)
    pose = {"lift": 0.0, "squash": 1.0, "tail_y": 0.0, "roll": 0.0}
    if name == "stand":
        pose.update(head=2.5 * wave, tail=3 * wave, tail_y=14 * wave, squash=1 + 0.012 * wave, **{"arm1": 5 * wave, "arm-1": -5 * wave})
    elif name == "walk":
        pose.update(head=3 * twice, tail_y=-18 * wave, lift=1.2 * abs(math.cos(2 * math.pi * t)), roll=3.5 * wave,
                    **{"leg1": 34 * wave, "leg-1": -34 * wave, "arm1": -30 * wave, "arm-1": 30 * wave})
    else:
        up = math.sin(math.pi * clamp((t - 0.25) / 0.55)) if 0.25 < t < 0.8 else 0.0
        crouch = smoothstep(0, 0.2, t) * (1 - smoothstep(0.2, 0.3, t)) + smoothstep(0.76, 0.82, t) * (1 - smoothstep(0.85, 1, t))
        pose.update(lift=26 * up - 1.0 * crouch, squash=1 - 0.20 * crouch + 0.08 * up, head=-14 * up + 10 * crouch,
                    tail=-30 * up + 8 * crouch,
                    **{"leg1": 26 * up, "leg-1": 18 * up, "arm1": -120 * up + 25 * crouch, "arm-1": -120 * up + 25 * crouch})
    return pose


def _posed(bone, p, pose):
    joint = JOINTS[bone]
    p = turned(tuple(a - b for a, b in zip(p, joint)), "x", pose.get(bone, 0.0))
    if bone == "tail":
        p = turned(p, "y", pose["tail_y"])
    x, y, z = add(p, joint)
    if not bone.startswith("leg"):
        y = 10 + (y - 10) * pose["squash"]
        x, z = x * (2 - pose["squash"]) ** 0.5, z * (2 - pose["squash"]) ** 0.5
        x, y, z = turned((x, y, z), "z", pose["roll"])
    return (z, x, y + pose["lift"])


def _md2_mesh(mesh):
    """Triangles with indices of their own texture coordinates."""
    uvs, index, triangles = [], {}, []
    for _, corners in mesh.triangles():
        row = []
        for vertex, uv in corners:
            key = tuple(round(c, 4) for c in uv)
            if key not in index:
                index[key] = len(uvs)
                uvs.append(key)
            row.append((vertex, index[key]))
        triangles.append(row)
    return triangles, uvs


def creature():
    """creature.md2: stand01-08, walk01-12, jump01-14."""
    mesh, bones = Mesh(), []
    for bone, part in _creature_parts():
        mesh.append(part)
        bones += [bone] * len(part.vertices)
    frames = []
    for name, count in (("stand", 8), ("walk", 12), ("jump", 14)):
        for k in range(count):
            pose = _creature_pose(name, k / count)
            frames.append((f"{name}{k + 1:02}", [_posed(b, p, pose) for b, p in zip(bones, mesh.vertices)]))
    triangles, uvs = _md2_mesh(mesh)
    return md2.document(triangles, uvs, frames, "models/creature/creature.png", (256, 256))


def flag_skin(width=128, height=64):
    """Three upright bands with a sun, and the pole's metal in the lowest rows."""
    canvas = Canvas(width, height, (0.1, 0.25, 0.55))
    for y in range(height):
        for x in range(width):
            u = x / width
            colour = (0.12, 0.24, 0.55) if u < 0.34 else (0.95, 0.93, 0.86) if u < 0.67 else (0.80, 0.22, 0.14)
            canvas.rows[y][x] = colour if y < height - 8 else scale((0.75, 0.76, 0.78), 0.6 + 0.4 * math.sin(math.pi * u))
    canvas.disc(width / 2, (height - 8) / 2, 11, 11, (0.95, 0.70, 0.10), 1.2)
    for k in range(12):
        a = 2 * math.pi * k / 12
        canvas.disc(width / 2 + 16 * math.cos(a), (height - 8) / 2 + 16 * math.sin(a), 3.4, 1.4, (0.95, 0.70, 0.10), 1.0,
                    (math.cos(a), math.sin(a)))
    return canvas


def flag():
    """flag.md2: a pole with a cloth; breeze01-12, storm01-08; skin flag.pcx."""
    pole = tube([(0, 0, 0), (0, 40, 0), (0, 92, 0)], [1.3, 1.1, 0.9], 8, 0)
    pole.append(ellipsoid((0, 93.5, 0), (2, 2, 2), 8, 6))
    for f in pole.faces:
        f.corners = [(i, (u % 1.0001, 0.05)) for i, (u, v) in f.corners]
    cloth = grid(16, 8, lambda s, t: (s, t, 0.0), lambda s, t: (s, 0.125 + 0.875 * t))
    mesh = Mesh().append(pole).append(cloth)
    fixed = len(pole.vertices)

    def at(p, phase, swing, speed):
        s, t = p[0], p[1]
        sag = 5 * s * s * (1 - swing)
        bend = swing * (9 * s**0.8) * math.sin(2 * math.pi * (1.35 * s - phase) + 0.9 * (1 - t))
        bend += swing * 2.2 * s * math.sin(2 * math.pi * (2.6 * s - speed * phase) + 2.0 * t)
        reach = 50 * s * (1 - 0.10 * swing * s)
        return (-reach, bend, 60 + 30 * t - sag - 0.6 * math.sin(2 * math.pi * (s - phase)) * s)

    frames = []
    for name, count, swing, speed in (("breeze", 12, 0.55, 1), ("storm", 8, 1.0, 2)):
        for k in range(count):
            cloth_now = [at(p, k / count, swing, speed) for p in mesh.vertices[fixed:]]
            frames.append((f"{name}{k + 1:02}", [(z, x, y) for x, y, z in mesh.vertices[:fixed]] + cloth_now))
    triangles, uvs = _md2_mesh(mesh)
    return md2.document(triangles, uvs, frames, ".flag", (128, 64))
