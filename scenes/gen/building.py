"""Parts of buildings. Each is built along +x and faces +z; a transform puts it in its place."""

import math
import random

from . import occlusion, vec
from .shapes import Shape, beveled_box, box, lathe, patch, stitch


class Part:
    """A named thing of several materials, and the boxes that stand for it when sky occlusion is cast."""

    def __init__(self, name):
        self.name, self.shapes, self.boxes = name, {}, []

    def put(self, material, shape, at=None, uv=None):
        """uv: metres of one texture repeat, projected in the part's own frame; None keeps the shape's own."""
        if uv:
            shape.box_uvs(uv)
        self.shapes.setdefault(material, Shape()).add(shape, at)

    def blocker(self, *box):
        self.boxes.append(box)

    def add(self, other, at):
        for material, shape in other.shapes.items():
            self.put(material, shape, at)
        for b in other.boxes:
            corners = [at.point((b[i], b[j], b[k])) for i in (0, 3) for j in (1, 4) for k in (2, 5)]
            self.boxes.append(tuple(f(c[a] for c in corners) for f in (min, max) for a in range(3)))


def levels(y0, y1, step=0.55):
    count = max(1, round((y1 - y0) / step))
    return [y0 + (y1 - y0) * k / count for k in range(count + 1)]


def arched_wall(bays, bay, radius, spring, top, segments=14):
    """The face of a wall over round arches, at z = 0: from the springing line up to top."""
    face = Shape()
    edges = []  # (x, lower y), with the arch's curve between its two springing points
    for k in range(bays):
        center = (k + 0.5) * bay
        edges.append((k * bay, spring))
        for i in range(segments + 1):
            angle = math.pi * (1 - i / segments)
            edges.append((center + radius * math.cos(angle), spring + radius * math.sin(angle)))
    edges.append((bays * bay, spring))
    crown = spring + radius + 0.12
    rows = levels(crown, top, 0.7) if top > crown + 0.1 else [top]
    for y in [None] + rows:
        for x, low in edges:
            face.vertex((x, low if y is None else y, 0.0), (0.0, 0.0, 1.0))
    stitch(face, len(edges), len(rows) + 1)
    return face


def soffit(bays, bay, radius, spring, thickness, segments=14):
    """The undersides: of each arch (smooth), and of the wall between two arches."""
    curve, flat = Shape(), Shape()
    for k in range(bays):
        center, base = (k + 0.5) * bay, len(curve.positions)
        for z in (-thickness, 0.0):
            for i in range(segments + 1):
                angle = math.pi * (1 - i / segments)
                c, s = math.cos(angle), math.sin(angle)
                curve.vertex((center + radius * c, spring + radius * s, z), (-c, -s, 0.0))
        stitch(curve, segments + 1, 2, base)
        for x0, x1 in ((k * bay, center - radius), (center + radius, (k + 1) * bay)):
            flat.quad((x0, spring, -thickness), (x1, spring, -thickness), (x1, spring, 0.0), (x0, spring, 0.0))
    return curve.add(flat)


def archivolt(center, radius, spring, width=0.13, proud=0.035, segments=14):
    """A moulding round an arch: a flat band that stands before the wall."""
    ring = Shape()

    def strip(r0, z0, r1, z1, normal):
        base = len(ring.positions)
        for r, z in ((r0, z0), (r1, z1)):
            for i in range(segments + 1):
                angle = math.pi * (1 - i / segments)
                c, s = math.cos(angle), math.sin(angle)
                n = (0.0, 0.0, 1.0) if normal == 0 else (normal * c, normal * s, 0.0)
                ring.vertex((center + r * c, spring + r * s, z), n)
        stitch(ring, segments + 1, 2, base)

    strip(radius, proud, radius + width, proud, 0)
    strip(radius + width, proud, radius + width, 0.0, 1)
    strip(radius, 0.0, radius, proud, -1)
    for side in (-1, 1):
        x0, x1 = sorted((center + side * radius, center + side * (radius + width)))
        ring.quad((x0, spring, 0.0), (x1, spring, 0.0), (x1, spring, proud), (x0, spring, proud))
    return ring


def column(height, radius=0.15, segments=20):
    """A round column with a square plinth and abacus; stands at the origin."""
    s = beveled_box(-0.235, 0.0, -0.235, 0.235, 0.1, 0.235, 0.012)
    r = radius
    low = [(0.225, 0.1), (0.235, 0.125), (0.225, 0.15), None, (0.195, 0.155), (0.185, 0.18), (0.2, 0.2), None]
    low += [(0.2, 0.215), None, (r + 0.005, 0.235), (r, 0.3)]
    top = height
    shaft = [(r * 0.98, 0.3 + 0.35 * (top - 0.55)), (r * 0.87, top - 0.3), None]
    cap = [(r * 0.87 + 0.025, top - 0.3), (r * 0.87 + 0.032, top - 0.285), (r * 0.87 + 0.025, top - 0.27), None]
    cap += [(r * 0.87, top - 0.265), (r * 0.9, top - 0.2), (r * 1.12, top - 0.14), (r * 1.45, top - 0.1)]
    s.add(lathe(low + shaft + cap, segments, repeat_u=1.0, repeat_v=1.0))
    s.add(beveled_box(-0.245, top - 0.1, -0.245, 0.245, top, 0.245, 0.012))
    return s


def door(width, height):
    """A plank door in a stone frame with a lintel; its sill is at the origin, against the wall z = 0."""
    p = Part("door")
    w = width / 2
    frame = Shape()
    frame.add(beveled_box(-w - 0.18, 0.0, -0.02, -w, height, 0.08, 0.01))
    frame.add(beveled_box(w, 0.0, -0.02, w + 0.18, height, 0.08, 0.01))
    frame.add(beveled_box(-w - 0.24, height, -0.02, w + 0.24, height + 0.22, 0.1, 0.01))
    p.put("stone", frame, uv=1.2)
    planks = Shape()
    count = 5
    for k in range(count):
        x0 = -w + width * k / count
        planks.add(beveled_box(x0 + 0.003, 0.0, 0.0, x0 + width / count - 0.003, height, 0.035, 0.008))
    planks.add(box(-w, 0.0, 0.0, w, height, 0.02, "-x+x-y+y-z"))  # nothing shines through between the planks
    p.put("dark wood", planks, uv=1.0)
    iron = Shape()
    for y in (0.4, height - 0.4):
        iron.add(box(-w + 0.03, y, 0.035, w - 0.12, y + 0.05, 0.045))
    iron.add(beveled_box(w - 0.16, height * 0.47, 0.035, w - 0.08, height * 0.47 + 0.14, 0.06, 0.01))
    p.put("iron", iron)
    return p


def window(width, height):
    """A shuttered window: stone frame, panes, and louvred leaves that stand open; sill at the origin."""
    p = Part("window")
    w = width / 2
    frame = Shape()
    for x0, x1 in ((-w - 0.1, -w), (w, w + 0.1)):
        frame.add(beveled_box(x0, 0.0, -0.02, x1, height, 0.07, 0.01))
    frame.add(beveled_box(-w - 0.14, height, -0.02, w + 0.14, height + 0.12, 0.09, 0.01))
    frame.add(beveled_box(-w - 0.18, -0.1, -0.02, w + 0.18, 0.0, 0.14, 0.012))
    p.put("stone", frame, uv=1.2)
    panes = Shape()
    panes.quad((-w, 0.0, 0.012), (w, 0.0, 0.012), (w, height, 0.012), (-w, height, 0.012))
    p.put("glass", panes)
    bars = box(-0.03, 0.0, 0.012, 0.03, height, 0.04, "-z")
    for y in (0.0, height * 0.36, height * 0.7, height - 0.04):
        bars.add(box(-w, y, 0.012, w, y + 0.035, 0.032, "-z"))
    p.put("wood", bars, uv=1.0)
    leaf = Shape()
    leaf_width = w + 0.02
    leaf.add(box(0.0, 0.0, 0.0, 0.06, height, 0.04))
    leaf.add(box(leaf_width - 0.06, 0.0, 0.0, leaf_width, height, 0.04))
    for y in (0.0, height * 0.48, height - 0.07):
        leaf.add(box(0.06, y, 0.0, leaf_width - 0.06, y + 0.07, 0.04))
    slats = 22
    for k in range(slats):
        y = 0.07 + (height - 0.14) * k / slats
        leaf.quad((0.06, y, 0.036), (leaf_width - 0.06, y, 0.036), (leaf_width - 0.06, y + 0.05, 0.006),
                  (0.06, y + 0.05, 0.006))
    leaf.add(box(0.06, 0.07, 0.0, leaf_width - 0.06, height - 0.07, 0.006, "-x+x-y+y"))
    leaf.box_uvs(1.0)
    for side in (1, -1):
        hinge = vec.translate(side * (w + 0.1), 0.0, 0.075) @ vec.rotate((0, 1, 0), -side * 14.0)
        p.put("shutter", leaf, hinge @ vec.stretch(float(side), 1.0, 1.0))
    return p


def tiled_roof(length, run, rise, courses=4, column_width=0.26, seed=1):
    """Barrel tiles on a slope that rises from z = 0 to z = -run. Each course overlaps the one below it."""
    draw = random.Random(seed)
    s = Shape()
    columns = max(1, round(length / column_width))
    width = length / columns
    profile = []  # (x share of the column, height): a pan, then a cover
    for i in range(4):
        a = math.pi * (1 + i / 4)
        profile.append((0.21 + 0.21 * math.cos(a), 0.035 * math.sin(a)))
    for i in range(6):
        a = math.pi * (1 - i / 5)
        profile.append((0.71 + 0.29 * math.cos(a), 0.085 * math.sin(a)))
    slope = vec.normalize((0.0, rise, -run))
    normal = vec.cross((1.0, 0.0, 0.0), slope)
    size = math.hypot(run, rise) / courses
    lift, base = 0.04, 0.035
    for c in range(courses):
        for k in range(columns):
            u, v = draw.random(), draw.random()
            out = lift + draw.uniform(-0.008, 0.008)
            rows = []
            for along, up in ((0.0, base - 0.035 if c == 0 else base), (0.0, base + out), (1.02, base)):
                at = vec.add(vec.scale(slope, (c + along) * size), vec.scale(normal, up))
                closed = c == 0 and not rows  # the lowest edge is flat, so that no light comes in under the tiles
                heights = [-0.035 if closed else h for _, h in profile]
                rows.append([vec.add(vec.add(at, vec.scale(normal, h)), ((k + x) * width, 0.0, 0.0))
                             for (x, _), h in zip(profile, heights)])
            _strip(s, rows[0], rows[1], (u, v), 0.05)
            _strip(s, rows[1], rows[2], (u, v), 0.3)
    return occlusion.open_sky(s)


def _strip(s, low, high, uv, stretch):
    """Quads between two profiles, smooth along them."""
    n = len(low)
    faces = [vec.normalize(vec.cross(vec.sub(low[i + 1], low[i]), vec.sub(high[i], low[i]))) for i in range(n - 1)]
    base = len(s.positions)
    for j, row in enumerate((low, high)):
        for i in range(n):
            normal = vec.add(faces[max(i - 1, 0)], faces[min(i, n - 2)])
            if i in (0, n - 1) or i == 4:
                normal = faces[min(i, n - 2)]
            s.vertex(row[i], vec.normalize(normal), (uv[0] + 0.1 * i / n, uv[1] + stretch * j))
    stitch(s, n, 2, base)


def eaves(length, run, rise, overhang, seed):
    """A roof on a wall whose face is z = 0: tiles, boards under them, and rafter tails. y = 0 is the wall's top."""
    p = Part("eaves")
    slope = rise / run
    drop = overhang * slope
    lift = 0.14
    place = vec.translate(0.0, lift - drop, overhang)
    p.put("clay", tiled_roof(length, run + overhang, rise + drop, seed=seed), place)
    front, back = (lift - drop - 0.01, overhang - 0.02), (lift + rise - 0.01, -run)
    boards = Shape()
    boards.quad((0.0, back[0], back[1]), (length, back[0], back[1]), (length, front[0], front[1]),
                (0.0, front[0], front[1]))
    p.put("wood", boards, uv=1.0)
    verge = Shape()
    for x, order in ((0.0, 1), (length, -1)):
        corners = [(x, back[0], back[1]), (x, front[0], front[1]), (x, front[0] + 0.06, front[1]),
                   (x, back[0] + 0.06, back[1])]
        verge.quad(*corners[::order])
    p.put("clay", occlusion.open_sky(verge.box_uvs(1.0)))
    tails = Shape()
    count = round(length / 0.55)
    angle = math.degrees(math.atan2(slope, 1.0))
    for k in range(count):
        x = (k + 0.5) * length / count
        tail = beveled_box(-0.04, -0.11, -0.25, 0.04, 0.0, math.hypot(overhang, drop) - 0.03, 0.008)
        tails.add(tail, vec.translate(x, lift - 0.012, 0.0) @ vec.rotate((1, 0, 0), angle))
    p.put("dark wood", tails, uv=1.0)
    p.blocker(0.0, -drop + 0.1, -run, length, 0.3, overhang)
    return p


def coping_wall(length, height, thickness=0.3):
    """A free wall with a coping of stone; its face is z = 0 and it stands behind that."""
    p = Part("wall")
    columns, rows = max(2, round(length / 0.7)), max(2, round(height / 0.5))
    body = patch((0.0, 0.0, 0.0), (length, 0.0, 0.0), (0.0, height, 0.0), columns, rows)
    body.add(patch((length, 0.0, -thickness), (-length, 0.0, 0.0), (0.0, height, 0.0), columns, rows))
    for x, z0, z1 in ((0.0, -thickness, 0.0), (length, 0.0, -thickness)):
        body.quad((x, 0.0, z0), (x, 0.0, z1), (x, height, z1), (x, height, z0))
    p.put("white plaster", body, uv=2.6)
    stones = Shape()
    count = round(length / 0.62)
    for k in range(count):
        x0, x1 = length * k / count, length * (k + 1) / count
        stones.add(beveled_box(x0 + 0.004, height, -thickness - 0.05, x1 - 0.004, height + 0.09, 0.05, 0.015))
    p.put("stone", stones, uv=1.2)
    p.blocker(0.0, 0.0, -thickness + 0.01, length, height, -0.01)
    return p
