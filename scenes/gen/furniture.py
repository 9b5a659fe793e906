"""What stands in the courtyard. Each part is built about the origin, on y = 0."""

import math
import random

from . import plants, vec
from .building import Part
from .shapes import Shape, beveled_box, cylinder, lathe, rod, sphere


def fountain(radius=1.05):
    p = Part("fountain")
    r = radius
    basin = [(r + 0.12, 0.0), (r + 0.12, 0.1), None, (r + 0.1, 0.12), None, (r, 0.12), (r - 0.02, 0.2), (r - 0.02, 0.4)]
    basin += [(r + 0.02, 0.44), None, (r + 0.07, 0.45), (r + 0.09, 0.48), (r + 0.09, 0.52), (r + 0.07, 0.55), None]
    basin += [(r - 0.15, 0.55), None, (r - 0.16, 0.54), (r - 0.16, 0.3)]
    p.put("stone", lathe(basin, 40, repeat_u=6.0, repeat_v=0.9))
    foot = lathe([(r + 0.5, 0.0), (r + 0.5, 0.05), None, (r + 0.48, 0.07), None, (r + 0.1, 0.07)], 40)
    p.put("stone", foot, uv=1.2)
    water = lathe([(r - 0.16, 0.42), (0.0, 0.42)], 40)
    p.put("water", water)
    stem = [(0.26, 0.3), (0.26, 0.5), None, (0.22, 0.52), (0.13, 0.6), (0.1, 0.72), (0.13, 0.84), (0.15, 0.88)]
    stem += [(0.11, 0.93), (0.09, 1.02), (0.12, 1.08), None, (0.16, 1.09), (0.34, 1.13), (0.47, 1.21), (0.52, 1.27)]
    stem += [(0.53, 1.3), None, (0.5, 1.31), None, (0.46, 1.27), (0.2, 1.2), (0.12, 1.2)]
    p.put("stone", lathe(stem, 32, repeat_u=2.0, repeat_v=0.9))
    p.put("water", lathe([(0.48, 1.285), (0.0, 1.285)], 32))
    finial = [(0.1, 1.2), (0.08, 1.36), (0.06, 1.44), (0.1, 1.5), (0.13, 1.57), (0.11, 1.65), (0.05, 1.71), (0.0, 1.75)]
    p.put("stone", lathe(finial, 20, repeat_u=1.0, repeat_v=0.9))
    p.blocker(-0.75 * r, 0.0, -0.75 * r, 0.75 * r, 0.4, 0.75 * r)
    p.blocker(-0.95 * r, 0.0, -0.35 * r, 0.95 * r, 0.4, 0.35 * r)
    p.blocker(-0.35 * r, 0.0, -0.95 * r, 0.35 * r, 0.4, 0.95 * r)
    p.blocker(-0.32, 1.15, -0.32, 0.32, 1.27, 0.32)
    return p


def pergola(width, length, height=2.55, slat_pitch=0.3, seed=3):
    """Posts on stone feet, two beams along z, slats along x, and a vine over a part of it; spans 0…width × 0…length."""
    p = Part("pergola")
    posts, feet, iron = Shape(), Shape(), Shape()
    spans = 2
    for x in (0.0, width):
        for k in range(spans + 1):
            z = length * k / spans
            feet.add(beveled_box(x - 0.16, 0.0, z - 0.16, x + 0.16, 0.32, z + 0.16, 0.02))
            posts.add(beveled_box(x - 0.07, 0.32, z - 0.07, x + 0.07, height, z + 0.07, 0.012))
            p.blocker(x - 0.12, 0.0, z - 0.12, x + 0.12, 0.3, z + 0.12)
            for side in (-1, 1):
                if 0 <= k + side <= spans:
                    brace = beveled_box(-0.035, 0.0, -0.035, 0.035, 0.68, 0.035, 0.008)
                    iron.add(brace, vec.along((x, height - 0.45, z), (x, height + 0.02, z + side * 0.47)))
    p.put("stone", feet, uv=1.2)
    p.put("wood", posts, uv=1.0)
    p.put("wood", iron, uv=1.0)
    beams = Shape()
    for x in (0.0, width):
        beams.add(beveled_box(x - 0.06, height, -0.45, x + 0.06, height + 0.17, length + 0.45, 0.012))
    p.put("wood", _grain_along(beams, "z"))
    slats = Shape()
    count = int((length + 0.7) / slat_pitch)
    for k in range(count + 1):
        z = -0.35 + (length + 0.7) * k / count
        slats.add(beveled_box(-0.5, height + 0.13, z - 0.03, width + 0.5, height + 0.26, z + 0.03, 0.01))
    p.put("wood", _grain_along(slats, "x"))
    _vine(p, width, length, height + 0.26, seed)
    return p


def _grain_along(shape, axis):
    """Wood grain runs along v: texture coordinates for beams along x or z."""
    for i, (q, n) in enumerate(zip(shape.positions, shape.normals)):
        along, others = (q[0], (q[1], q[2])) if axis == "x" else (q[2], (q[0], q[1]))
        shape.uvs[i] = (others[0] + others[1], along)
    return shape


def _vine(p, width, length, top, seed):
    draw = random.Random(seed)
    leaves, stems = Shape(), Shape()
    for x, z, turns in ((0.0, 0.0, 5), (width, length / 2, 4), (width, 0.0, 5)):
        path, radii = [], []
        for k in range(25):
            t = k / 24
            a = turns * 2 * math.pi * t
            path.append((x + 0.105 * math.cos(a), 0.05 + (top - 0.15) * t, z + 0.105 * math.sin(a)))
            radii.append(0.03 - 0.016 * t)
        stems.add(plants.tube(path, radii, 6))
        for k in range(16):
            at = vec.add(path[9 + k % 16], (0.0, draw.uniform(-0.1, 0.1), 0.0))
            away = vec.normalize((at[0] - x, 0.25, at[2] - z))
            leaves.add(plants.card(at, vec.add(away, (0.0, -0.6, 0.0)), away, draw.uniform(0.18, 0.3), (x, at[1], z)))
    for k in range(150):
        # Dense over the far end, thinning out towards the near one.
        z = length * min(1.0, abs(draw.gauss(0.0, 0.3))) - 0.4
        x = draw.uniform(-0.5, width + 0.5)
        at = (x, top + draw.uniform(-0.08, 0.12), z)
        lean = (draw.uniform(-1, 1), draw.uniform(-0.25, 0.3), draw.uniform(-1, 1))
        facing = vec.normalize((draw.uniform(-0.5, 0.5), 1.0, draw.uniform(-0.5, 0.5)))
        leaves.add(plants.card(at, lean, facing, draw.uniform(0.25, 0.45), (x, top - 1.0, z)))
    for k in range(46):
        # Tendrils that hang from the edges.
        z = length * min(1.0, abs(draw.gauss(0.0, 0.35))) - 0.35
        x = draw.choice((-0.45, 0.0, width + 0.4)) + draw.uniform(-0.08, 0.08)
        away = vec.normalize((draw.uniform(-1, 0.3), 0.25, draw.uniform(-1, 1)))
        at = (x, top - draw.uniform(0.0, 0.3), z)
        leaves.add(plants.card(at, (away[0] * 0.4, -1.0, away[2] * 0.4), away, draw.uniform(0.25, 0.4),
                               (x, top + 0.2, z)))
    p.put("bark", stems)
    p.put("vine", leaves)


def bench(length=1.7):
    """Slats on two trestles with a back rest; along x, the sitter looks to +z."""
    p = Part("bench")
    wood, iron = Shape(), Shape()
    for k in range(4):
        z = -0.2 + 0.11 * k
        wood.add(beveled_box(-length / 2, 0.43, z, length / 2, 0.465, z + 0.09, 0.01))
    for k in range(3):
        y = 0.58 + 0.13 * k
        at = vec.translate(0.0, y, -0.235 - 0.03 * k) @ vec.rotate((1, 0, 0), -13.0)
        wood.add(beveled_box(-length / 2, -0.045, -0.015, length / 2, 0.045, 0.015, 0.008), at)
    for x in (-length / 2 + 0.2, length / 2 - 0.2):
        iron.add(beveled_box(x - 0.025, 0.0, 0.16, x + 0.025, 0.43, 0.2, 0.006))
        iron.add(beveled_box(x - 0.025, 0.39, -0.24, x + 0.025, 0.43, 0.2, 0.006))
        iron.add(rod((x, 0.0, -0.16), (x, 0.43, -0.22), 0.022, 6))
        iron.add(rod((x, 0.43, -0.235), (x, 0.92, -0.345), 0.018, 6))
    p.put("wood", _grain_along(wood, "x"))
    p.put("iron", iron)
    p.blocker(-length / 2 + 0.05, 0.42, -0.18, length / 2 - 0.05, 0.45, 0.2)
    return p


def pot(height, radius, plant, seed):
    """A clay pot; plant: "shrub", "flowers", "agave" or "" (empty)."""
    p = Part("pot")
    r, h = radius, height
    profile = [(0.66 * r, 0.0), (0.72 * r, 0.03), (0.94 * r, 0.5 * h), (0.99 * r, 0.78 * h), (0.95 * r, 0.84 * h), None]
    profile += [(1.06 * r, 0.86 * h), (1.1 * r, 0.9 * h), (1.1 * r, 0.97 * h), (1.06 * r, h), None]
    profile += [(0.95 * r, h), None, (0.93 * r, 0.8 * h)]
    p.put("clay", lathe(profile, 24, repeat_u=2.0, repeat_v=1.2))
    p.put("earth", lathe([(0.94 * r, 0.88 * h), (0.0, 0.9 * h)], 24))
    p.blocker(-0.6 * r, 0.0, -0.6 * r, 0.6 * r, h, 0.6 * r)
    draw = random.Random(seed)
    leaves = Shape()
    center = (0.0, h + 0.75 * r, 0.0)
    if plant in ("shrub", "flowers"):
        for _ in range(44):
            d = plants.random_direction(draw)
            d = (d[0], 0.25 + 0.9 * abs(d[1]), d[2])
            at = vec.add((0.0, 0.92 * h, 0.0), vec.scale(d, r * draw.uniform(0.3, 1.15)))
            away = vec.normalize(vec.sub(at, (0.0, 0.7 * h, 0.0)))
            up = vec.add(vec.scale(away, 0.7), vec.scale(plants.random_direction(draw), 0.7))
            leaves.add(plants.card(at, up, away, r * draw.uniform(0.8, 1.15), center))
        p.put("leaves", leaves)
    if plant == "flowers":
        places = []
        for _ in range(26):
            d = plants.random_direction(draw)
            d = vec.normalize((d[0], 0.2 + abs(d[1]), d[2]))
            places.append((vec.add((0.0, 0.95 * h, 0.0), vec.scale(d, r * draw.uniform(1.35, 1.75))), d))
        p.put("flowers", plants.blossoms(places, seed))
    if plant == "agave":
        p.put("agave", _agave(draw, 0.9 * h, r))
    return p


def _agave(draw, y, r):
    """Thick pointed leaves in a rosette, each a bent, folded blade with two sides."""
    s = Shape()
    for k in range(19):
        angle = 2.39996 * k
        rise = 0.25 + 1.0 * k / 19
        length = r * (2.0 - 0.5 * k / 19) * draw.uniform(0.9, 1.1)
        out = (math.cos(angle), 0.0, math.sin(angle))
        side = (-out[2], 0.0, out[0])
        spine, widths = [], (0.1, 0.14, 0.12, 0.07, 0.0)
        for i in range(5):
            t = i / 4
            lift = rise * t - 0.25 * t * t
            spine.append(vec.add((0.0, y + length * lift, 0.0), vec.scale(out, 0.05 + length * t * (1.1 - 0.4 * rise))))
        for i in range(4):
            a, b = spine[i], spine[i + 1]
            wa, wb = widths[i] * r * 1.6, widths[i + 1] * r * 1.6
            for sign in (1, -1):
                edge_a = vec.add(vec.add(a, vec.scale(side, sign * wa)), (0.0, 0.35 * wa, 0.0))
                edge_b = vec.add(vec.add(b, vec.scale(side, sign * wb)), (0.0, 0.35 * wb, 0.0))
                ring = [a, edge_a, edge_b, b] if sign < 0 else [a, b, edge_b, edge_a]
                n = vec.cross(vec.sub(ring[2], ring[0]), vec.sub(ring[3], ring[1]))
                if n[1] < 0:
                    ring.reverse()
                if wb > 0:
                    s.quad(*ring)
                else:
                    tri = [q for i_q, q in enumerate(ring) if i_q == 0 or q not in ring[:i_q]]
                    n = vec.normalize(vec.cross(vec.sub(tri[1], tri[0]), vec.sub(tri[2], tri[0])))
                    s.triangle(*(s.vertex(q, n) for q in tri[:3]))
    return s


def lantern(drop):
    """Hangs from the origin on a chain of the given length."""
    p = Part("lantern")
    iron = rod((0.0, 0.0, 0.0), (0.0, -drop, 0.0), 0.008, 5, caps=False)
    y = -drop
    iron.add(lathe([(0.17, y - 0.1), (0.15, y - 0.08), (0.05, y - 0.01), (0.02, y), (0.0, y + 0.01)], 6))
    iron.add(lathe([(0.0, y - 0.46), (0.1, y - 0.45), (0.11, y - 0.43), None, (0.0, y - 0.43)], 6))
    for k in range(6):
        a = math.pi * k / 3
        c, s = math.cos(a), math.sin(a)
        iron.add(rod((0.105 * c, y - 0.44, 0.105 * s), (0.15 * c, y - 0.09, 0.15 * s), 0.009, 4, caps=False))
    iron.add(lathe([(0.0, y - 0.1), (0.165, y - 0.1)], 6))
    p.put("iron", iron)
    glow = Shape().add(sphere(0.055, 12, 8), vec.translate(0.0, y - 0.3, 0.0) @ vec.stretch(1.0, 1.4, 1.0))
    p.put("lamp", glow)
    return p


def planter(size, height):
    """A square stone bed for a tree."""
    p = Part("planter")
    s, w = size / 2, 0.16
    stone = Shape()
    for k in range(4):
        side = beveled_box(-s, 0.0, s - w, s - w, height, s, 0.02)
        stone.add(side, vec.rotate((0, 1, 0), 90.0 * k))
    p.put("stone", stone, uv=1.2)
    earth = Shape()
    i = s - w + 0.01
    earth.quad((-i, height - 0.08, i), (i, height - 0.08, i), (i, height - 0.08, -i), (-i, height - 0.08, -i))
    p.put("earth", earth)
    p.blocker(-s + 0.02, 0.0, -s + 0.02, s - 0.02, height - 0.1, s - 0.02)
    return p


def jar(height=0.7):
    """A tall oil jar."""
    p = Part("jar")
    shape = [(0.35, 0.0), (0.42, 0.04), (0.62, 0.25), (0.68, 0.45), (0.6, 0.68), (0.4, 0.82), (0.34, 0.87), None]
    shape += [(0.4, 0.9), (0.43, 0.94), (0.41, 0.98), (0.36, 0.98), None, (0.3, 0.9), (0.3, 0.6)]
    profile = [q and (q[0] * height * 0.5, q[1] * height) for q in shape]
    p.put("clay", lathe(profile, 24, repeat_u=2.0, repeat_v=1.2))
    p.put("earth", cylinder(0.3 * height * 0.5, 0.0, 0.72 * height, 12))
    p.blocker(-0.22 * height, 0.0, -0.22 * height, 0.22 * height, 0.85 * height, 0.22 * height)
    return p


def festoon(start, end, sag, bulbs):
    """A sagging cord with glowing bulbs."""
    p = Part("festoon")
    points = []
    for k in range(25):
        t = k / 24
        q = vec.lerp(start, end, t)
        points.append((q[0], q[1] - 4 * sag * t * (1 - t), q[2]))
    p.put("iron", plants.tube(points, [0.011] * 25, 5))
    for k in range(bulbs):
        t = (k + 0.5) / bulbs
        q = vec.lerp(start, end, t)
        q = (q[0], q[1] - 4 * sag * t * (1 - t), q[2])
        p.put("iron", rod(vec.add(q, (0.0, 0.012, 0.0)), vec.add(q, (0.0, -0.07, 0.0)), 0.018, 6))
        p.put("lamp", Shape().add(sphere(0.042, 10, 7), vec.translate(q[0], q[1] - 0.1, q[2])))
    return p

