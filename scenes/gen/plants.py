"""Trees and climbers: tubes for wood, alpha-masked cards for leaves."""

import math
import random

from . import textures, vec
from .shapes import Shape, lathe, tube


LEAF_GREENS = ((0.045, 0.11, 0.018), (0.13, 0.22, 0.045))


def leaf_texture(seed=7, size=256, leaves=19, colors=LEAF_GREENS, slender=1.0):
    """A twig with leaves; alpha is 0 or 255 with a soft edge; the colour runs on under the transparent part, so that
    filtering brings in no fringe."""
    draw = random.Random(seed)
    blades = []
    for k in range(leaves):
        along_twig = (k + 0.5) / leaves
        side = 1 if k % 2 else -1
        root = (0.5 + 0.04 * math.sin(6 * along_twig), 0.97 - 0.72 * along_twig)
        spread = math.radians(side * slender * (62 - 40 * along_twig + draw.uniform(-12, 12)))
        length = (0.36 - 0.1 * abs(along_twig - 0.45)) * draw.uniform(0.85, 1.1)
        axis = (math.sin(spread), -math.cos(spread))
        blades.append((root, axis, length, length * slender * draw.uniform(0.2, 0.26), draw.random()))
    mean = vec.lerp(colors[0], colors[1], 0.45)
    field = [(0.0, mean)] * (size * size)
    for root, axis, length, half, tint in blades:
        _blade(field, size, root, axis, length, half, vec.lerp(colors[0], colors[1], tint))
    for y in range(int(0.25 * size), size):  # the twig
        center = (0.5 + 0.04 * math.sin(6 * (0.97 - y / size) / 0.72)) * size
        for x in range(int(center - 2), int(center + 3)):
            field[y * size + x] = (1.0, (0.1, 0.075, 0.04))
    pixels = bytearray()
    for alpha, color in field:
        pixels += bytes((*textures.srgb(color), textures.byte(alpha)))
    return textures.png(size, size, 4, pixels)


def _blade(field, size, root, axis, length, half, color):
    """Draws one pointed leaf over what is there."""
    reach = length + half
    x0, x1 = int((root[0] - reach) * size), int((root[0] + reach) * size)
    y0, y1 = int((root[1] - reach) * size), int((root[1] + reach) * size)
    rib = tuple(1.35 * c for c in color)
    for y in range(max(y0, 0), min(y1, size)):
        for x in range(max(x0, 0), min(x1, size)):
            dx, dy = (x + 0.5) / size - root[0], (y + 0.5) / size - root[1]
            t = (dx * axis[0] + dy * axis[1]) / length
            if not 0.0 < t < 1.0:
                continue
            across = abs(dx * axis[1] - dy * axis[0])
            width = half * (4 * t * (1 - t)) ** 0.8 * (1.15 - 0.5 * t)
            alpha = (width - across) * size + 0.5
            if alpha > 0:
                shade = rib if across * size < 0.8 else color
                old_alpha, old = field[y * size + x]
                alpha = min(alpha, 1.0)
                field[y * size + x] = (max(alpha, old_alpha), vec.lerp(old, shade, alpha))


def card(at, up, outward, size, center):
    """A leaf card rooted at `at`, growing along `up`; its front faces outward and its normals are bent away from
    center, so that a crown shades as one soft volume."""
    s = Shape()
    up = vec.normalize(up)
    side = vec.cross(up, outward)
    side = vec.normalize(side) if vec.length(side) > 1e-3 else (1.0, 0.0, 0.0)
    face = vec.cross(side, up)
    a = vec.sub(at, vec.scale(side, size / 2))
    top = vec.scale(up, size)
    s.quad(a, vec.add(a, vec.scale(side, size)), vec.add(vec.add(a, vec.scale(side, size)), top), vec.add(a, top))
    bent = []
    for p in s.positions:
        n = vec.add(vec.scale(vec.normalize(vec.sub(p, center)), 0.9), face)
        bent.append(vec.normalize(n if vec.dot(n, face) > 0.05 else face))
    s.normals = bent
    return s


def random_direction(draw):
    z = draw.uniform(-1, 1)
    a = draw.uniform(0, 2 * math.pi)
    r = math.sqrt(1 - z * z)
    return (r * math.cos(a), z, r * math.sin(a))


def tree(seed, height=4.5, radius=0.11, crown=1.6, branches=11, cards=26, card_size=0.55, segments=9):
    """Wood and leaves of a small tree that stands at the origin; crown: its radius; cards: on each branch."""
    draw = random.Random(seed)
    fork = height - 1.75 * crown
    center = (0.0, height - crown, 0.0)
    trunk = [(0.0, -0.05, 0.0)]
    lean = draw.uniform(0, 2 * math.pi)
    steps = 8
    for k in range(1, steps + 1):
        y = (height - 0.9 * crown) * k / steps
        sway = 0.07 * crown * math.sin(3.0 * k / steps)
        trunk.append((sway * math.cos(lean), y, sway * math.sin(lean)))
    girth = [radius * (1.35 if k == 0 else 1.0 - 0.75 * k / steps) for k in range(steps + 1)]
    wood, leaves = tube(trunk, girth, segments), Shape()
    for b in range(branches):
        share = (b + 0.5) / branches
        level = fork + (height - 1.0 * crown - fork) * share
        k = min(int(level / (height - 0.9 * crown) * steps), steps - 1)
        base = vec.lerp(trunk[k], trunk[k + 1], level / (height - 0.9 * crown) * steps - k)
        angle = 2.39996 * b + draw.uniform(-0.3, 0.3)
        tip_height = height - 2 * crown + 2 * crown * (0.15 + 0.8 * share)
        ring = crown * 0.93 * math.sqrt(max(0.05, 1 - ((tip_height - center[1]) / crown) ** 2))
        tip = (ring * math.cos(angle), tip_height, ring * math.sin(angle))
        bow = vec.add(vec.lerp(base, tip, 0.5), (0.0, -0.1 * crown, 0.0))
        path = [vec.lerp(vec.lerp(base, bow, t), vec.lerp(bow, tip, t), t) for t in (0, 0.25, 0.5, 0.75, 1)]
        thick = radius * (0.5 - 0.25 * share)
        wood.add(tube(path, [thick * (1 - 0.8 * i / 4) for i in range(5)], 5))
        _dress(leaves, draw, path, center, crown, cards, card_size)
    return wood, leaves


def _dress(leaves, draw, path, center, crown, cards, size):
    for c in range(cards):
        t = 4 * math.sqrt(draw.uniform(0.06, 1.0))
        i = min(int(t), 3)
        at = vec.lerp(path[i], path[i + 1], t - i)
        at = vec.add(at, vec.scale(random_direction(draw), 0.22 * crown * draw.random()))
        outward = vec.normalize(vec.sub(at, center))
        up = vec.add(vec.scale(outward, 0.8), vec.scale(random_direction(draw), 0.9))
        facing = vec.normalize(vec.add(vec.add(outward, (0.0, 0.4, 0.0)), vec.scale(random_direction(draw), 0.6)))
        leaves.add(card(at, up, facing, size * draw.uniform(0.7, 1.15), center))


def ivy(seed, corner, u, v, normal, cards, size, fill):
    """Leaf cards that hug the wall corner + a·u + b·v; fill(a, b) in 0…1 says how dense."""
    draw = random.Random(seed)
    leaves = Shape()
    while cards:
        a, b = draw.random(), draw.random()
        if draw.random() > fill(a, b):
            continue
        cards -= 1
        at = vec.add(corner, vec.add(vec.scale(u, a), vec.scale(v, b)))
        at = vec.add(at, vec.scale(normal, draw.uniform(0.02, 0.12)))
        down = vec.add((0.0, draw.uniform(-1.0, 0.3), 0.0), vec.scale(random_direction(draw), 0.6))
        down = vec.add(down, vec.scale(normal, draw.uniform(0.1, 0.6) - vec.dot(down, normal)))
        facing = vec.normalize(vec.add(vec.scale(normal, 1.2), vec.scale(random_direction(draw), 0.6)))
        center = vec.sub(at, vec.add(vec.scale(normal, 0.8), (0.0, 0.5, 0.0)))
        leaves.add(card(at, down, facing, size * draw.uniform(0.6, 1.1), center))
    return leaves


def cypress(seed, height, radius, cards):
    """A dark core (closed) and the cards around it."""
    draw = random.Random(seed)

    def reach(t):
        return radius * (0.25 + 0.75 * min(1.0, t * 5)) * math.sqrt(max(0.0, 1 - t)) * (1 - 0.25 * t)

    core = lathe([(0.8 * reach(k / 10), 0.25 + (height - 0.6) * k / 10) for k in range(11)], 10)
    leaves = Shape()
    for _ in range(cards):
        t = 0.97 * draw.random() ** 1.25
        a = draw.uniform(0, 2 * math.pi)
        out = (math.cos(a), 0.15, math.sin(a))
        at = (0.75 * reach(t) * out[0], 0.15 + (height - 0.8) * t, 0.75 * reach(t) * out[2])
        up = vec.add((0.35 * out[0], 1.0, 0.35 * out[2]), vec.scale(random_direction(draw), 0.35))
        facing = vec.normalize(vec.add(out, vec.scale(random_direction(draw), 0.5)))
        leaves.add(card(at, up, facing, draw.uniform(0.5, 0.8), (0.0, at[1] - 0.4, 0.0)))
    return core, leaves


def blossoms(places, seed):
    """Small five-sided cups at (position, outward direction)."""
    draw = random.Random(seed)
    s = Shape()
    for at, out in places:
        frame = vec.along(at, vec.add(at, out))
        size = draw.uniform(0.03, 0.05)
        middle = s.vertex(at, out)
        rim = []
        for k in range(5):
            a = -2 * math.pi * k / 5
            q = frame.point((size * math.cos(a), 0.35 * size, size * math.sin(a)))
            rim.append(s.vertex(q, vec.normalize(vec.sub(vec.scale(out, 2.0), vec.scale(vec.sub(q, at), 12.0)))))
        for k in range(5):
            s.triangle(middle, rim[k], rim[(k + 1) % 5])
    return s

