"""Sky occlusion per vertex, cast against a few boxes that stand for the scene's large parts."""

import math

from . import vec

REACH = 4.5  # metres; nearer blockers darken more


def _directions(count):
    """Cosine-weighted directions about +Z, on a spiral."""
    rays = []
    for k in range(count):
        u = (k + 0.5) / count
        r, angle = math.sqrt(u), 2.399963 * k
        rays.append((round(r * math.cos(angle), 6), round(r * math.sin(angle), 6), round(math.sqrt(1 - u), 6)))
    return rays


RAYS = _directions(20)


def _first_hit(origin, ray, boxes):
    nearest = REACH
    ox, oy, oz = origin
    ix, iy, iz = (1 / c if abs(c) > 1e-9 else 1e9 for c in ray)
    for x0, y0, z0, x1, y1, z1 in boxes:
        a, b = (x0 - ox) * ix, (x1 - ox) * ix
        c, d = (y0 - oy) * iy, (y1 - oy) * iy
        e, f = (z0 - oz) * iz, (z1 - oz) * iz
        if a > b:
            a, b = b, a
        if c > d:
            c, d = d, c
        if e > f:
            e, f = f, e
        enter = a if a > c else c
        enter = enter if enter > e else e
        leave = b if b < d else d
        leave = leave if leave < f else f
        if 0 < enter <= leave and enter < nearest:
            nearest = enter
    return nearest


def _near(p, box):
    x, y, z = p
    return (
        box[0] - REACH < x < box[3] + REACH
        and box[1] - REACH < y < box[4] + REACH
        and box[2] - REACH < z < box[5] + REACH
    )


def openness(position, normal, boxes):
    """1 under the open sky or over open ground, towards 0 in corners. A box that holds the point does not count."""
    helper = (0.0, 1.0, 0.0) if abs(normal[1]) < 0.9 else (1.0, 0.0, 0.0)
    x = vec.normalize(vec.cross(helper, normal))
    y = vec.cross(normal, x)
    origin = vec.add(position, vec.scale(normal, 0.03))
    close = [b for b in boxes if _near(origin, b)]
    total = 0.0
    for a, b, c in RAYS:
        ray = vec.add(vec.add(vec.scale(x, a), vec.scale(y, b)), vec.scale(normal, c))
        total += _first_hit(origin, ray, close) / REACH
    return total / len(RAYS)


def bake(shape, boxes, cache):
    """Fills the shape's second UV set: u is the occlusion value that textures.gradient() gives back. Neighbours within
    some centimetres that face one way share a value."""
    shape.uvs2 = []
    for p, n in zip(shape.positions, shape.normals):
        key = (*(round(c * 8) for c in p), *(round(c * 1.5) for c in n))
        if key not in cache:
            value = openness(p, n, boxes) if abs(p[0]) < 12 and abs(p[2]) < 12 else 1.0
            # Light that comes in by way of other surfaces of albedo ½.
            cache[key] = round(value / (1 - 0.5 * (1 - value)) * 255) / 255
        shape.uvs2.append((cache[key], 0.5))


def open_sky(shape):
    """For what nothing stands over."""
    shape.uvs2 = [(1.0, 0.5)] * len(shape.positions)
    return shape
