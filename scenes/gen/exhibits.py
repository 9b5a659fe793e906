"""What the gallery shows, and its furniture. Each stands at the origin or hangs from it."""

import math
import random

from . import textures, vec
from .building import Part
from .shapes import Shape, beveled_box, box, cylinder, lathe, patch, rod, stitch, tube


def closed_surface(place, columns, rows):
    """A closed, smooth surface: place(u, v) has the period 1 in both, and ∂u × ∂v points outwards."""
    s = Shape()
    step = 1e-4
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i % columns / columns, j % rows / rows
            du = vec.sub(place(u + step, v), place(u - step, v))
            dv = vec.sub(place(u, v + step), place(u, v - step))
            s.vertex(place(u, v), vec.normalize(vec.cross(du, dv)), (i / columns, j / rows))
    stitch(s, columns + 1, rows + 1)
    return s


def knot(ring=0.25, winding=0.105, broad=0.088, thin=0.034, turns=2):
    """An upright trefoil knot, a band of elliptic section that turns about its own middle; centred at the origin.

    ring, winding: radii of the torus on which the knot lies; broad, thin: half axes of the section; turns: half turns
    of the section along the knot
    """

    def spine(u):
        a = 2 * math.pi * u
        r = ring + winding * math.cos(3 * a)
        return (r * math.cos(2 * a), r * math.sin(2 * a), 1.25 * winding * math.sin(3 * a))

    def surface(v, u):
        a = 2 * math.pi * u
        center = spine(u)
        along = vec.normalize(vec.sub(spine(u + 1e-4), spine(u - 1e-4)))
        out = vec.sub(center, (ring * math.cos(2 * a), ring * math.sin(2 * a), 0.0))
        out = vec.normalize(vec.sub(out, vec.scale(along, vec.dot(out, along))))
        side = vec.cross(along, out)
        b = 2 * math.pi * v
        x, y = broad * math.cos(b), thin * math.sin(b)
        c, s = math.cos(turns * a / 2), math.sin(turns * a / 2)
        return vec.add(center, vec.add(vec.scale(out, c * x - s * y), vec.scale(side, s * x + c * y)))

    return closed_surface(surface, 28, 260)


def sculpture(height=1.02):
    """The bronze knot on a plinth of the given height."""
    p = Part("sculpture")
    half = 0.24
    p.put("white paint", beveled_box(-half, 0.05, -half, half, height, half, 0.006))
    p.put("dark paint", box(-half + 0.03, 0.0, -half + 0.03, half - 0.03, 0.06, half - 0.03))
    p.put("dark paint", beveled_box(-0.11, height, -0.11, 0.11, height + 0.05, 0.11, 0.006))
    p.put("bronze", cylinder(0.014, height + 0.04, height + 0.2, 12))
    p.put("bronze", knot(), vec.translate(0.0, height + 0.5, 0.0) @ vec.rotate((0, 1, 0), 20.0))
    p.blocker(-half, 0.0, -half, half, height, half)
    return p


def plate(length, width, thickness=0.006, segments=28):
    """A flat plate with an oval, pointed outline, which hangs by one end from the origin."""
    rim = []
    for k in range(segments):
        a = 2 * math.pi * k / segments
        x = 0.5 - 0.5 * math.cos(a)
        rim.append((-width * math.sin(a) * (0.35 + 0.25 * x), -length * x))
    s, half = Shape(), thickness / 2
    for sign in (1, -1):
        base = len(s.positions)
        for x, y in rim:
            s.vertex((x, y, sign * half), (0.0, 0.0, float(sign)))
        for k in range(1, segments - 1):
            s.triangle(base, *((base + k, base + k + 1) if sign > 0 else (base + k + 1, base + k)))
    for k in range(segments):
        a, b = rim[k], rim[(k + 1) % segments]
        s.quad((*a, -half), (*b, -half), (*b, half), (*a, half))
    return s


def mobile(drop, seed=3):
    """Arms that hang from each other's ends and carry plates; drop: of the wire from the ceiling to the first arm."""
    draw = random.Random(seed)
    p = Part("mobile")
    colors = ("red paint", "dark paint", "yellow paint", "dark paint", "blue paint", "red paint", "dark paint")

    def hang(material, at, length, width):
        eye = vec.add(at, (0.0, -0.06, 0.0))
        p.put("wire", rod(at, eye, 0.0025, 6))
        turn = vec.rotate((0, 1, 0), draw.uniform(20.0, 160.0)) @ vec.rotate((1, 0, 0), draw.uniform(-35.0, 35.0))
        p.put(material, plate(length, width), vec.translate(*eye) @ turn)

    at = (0.0, -drop, 0.0)
    p.put("wire", rod((0.0, 0.0, 0.0), at, 0.003, 6))
    angle, size = 25.0, 1.0
    for k in range(4):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        lengths = (0.62 * size, 0.42 * size)
        bow = 0.07 * size
        ends = [vec.add(at, (sign * l * c, -bow, sign * l * s)) for sign, l in zip((1, -1), lengths)]
        arc = []
        for i in range(13):
            t = i / 6 - 1
            l = lengths[0] * max(t, 0.0) - lengths[1] * max(-t, 0.0)
            arc.append(vec.add(at, (l * c, -bow * t * t, l * s)))
        p.put("wire", tube(arc[::-1], [0.004] * 13, 6))
        hang(colors[k], ends[1], (0.4 - 0.04 * k), (0.34 - 0.03 * k))
        if k == 3:
            hang(colors[k + 1], ends[0], 0.26, 0.22)
            break
        below = vec.add(ends[0], (0.0, -0.17, 0.0))
        p.put("wire", rod(ends[0], below, 0.0025, 6))
        at, angle, size = below, angle + 118.0, size * 0.84
    return p


def bench(length=1.7, depth=0.54, height=0.45, slats=4):
    """Slats over two frames of steel; along x."""
    p = Part("bench")
    pitch = depth / slats
    for k in range(slats):
        z = -depth / 2 + (k + 0.5) * pitch
        slat = beveled_box(-length / 2, height - 0.04, z - 0.31 * pitch, length / 2, height, z + 0.31 * pitch, 0.005)
        slat.uvs = [(q[2] / 0.6 + 0.37 * k, q[0] / 1.8) for q in slat.positions]
        p.put("oak dark", slat)
    for x in (-length / 2 + 0.22, length / 2 - 0.22):
        for z in (-depth / 2 + 0.03, depth / 2 - 0.07):
            p.put("steel", box(x - 0.02, 0.0, z, x + 0.02, height - 0.04, z + 0.04))
        p.put("steel", box(x - 0.02, height - 0.08, -depth / 2 + 0.07, x + 0.02, height - 0.04, depth / 2 - 0.07))
        p.put("steel", box(x - 0.02, 0.0, -depth / 2 + 0.07, x + 0.02, 0.03, depth / 2 - 0.07))
    p.blocker(-length / 2, height - 0.04, -depth / 2, length / 2, height, depth / 2)
    return p


def barrier(places, height=0.92):
    """Posts at (x, z) with a sagging rope from each to the next."""
    p = Part("barrier")
    post = lathe([(0.0, 0.0), (0.15, 0.0), None, (0.15, 0.012), (0.14, 0.02), (0.03, 0.03), (0.018, 0.05), None,
                  (0.018, height - 0.06), None, (0.032, height - 0.05), (0.032, height - 0.02), None,
                  (0.024, height - 0.015), (0.02, height), (0.0, height + 0.006)], 24)
    for x, z in places:
        p.put("brass", post, vec.translate(x, 0.0, z))
    for a, b in zip(places, places[1:]):
        points = []
        for k in range(25):
            t = k / 24
            x, z = a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t
            points.append((x, height - 0.045 - 0.24 * 4 * t * (1 - t), z))
        p.put("red paint", tube(points, [0.013] * 25, 10))
    return p


def frame(material, width, height, border=0.07, depth=0.045):
    """Four mitred bars around an opening of width × height, whose centre is the origin, on the wall z = 0."""
    s = Shape()
    w, h = width / 2, height / 2
    # The section, from the opening outwards: (distance from the opening, distance from the wall).
    section = [(0.0, 0.004), (0.0, 0.5 * depth), (0.3 * border, 0.62 * depth), (0.42 * border, depth),
               (0.9 * border, depth), (border, 0.85 * depth), (border, 0.004)]
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    for k in range(4):
        a, b = corners[k], corners[(k + 1) % 4]
        for (d0, z0), (d1, z1) in zip(section, section[1:]):
            def at(corner, d, z):
                return (corner[0] * (w + d), corner[1] * (h + d), z)
            s.quad(at(a, d1, z1), at(b, d1, z1), at(b, d0, z0), at(a, d0, z0))
        (d0, z0), (d1, z1) = section[-1], section[0]
        s.quad(at(a, d1, z1), at(b, d1, z1), at(b, d0, z0), at(a, d0, z0))
    p = Part("frame")
    p.put(material, s)
    p.blocker(-w - border, -h - border, 0.0, w + border, h + border, 0.5 * depth)
    return p


def picture(canvas, material, width, height, border=0.07):
    """A painted canvas in its frame; centre at the origin, on the wall z = 0."""
    p = Part("picture")
    p.add(frame(material, width, height, border), vec.Transform())
    front = patch((-width / 2, -height / 2, 0.014), (width, 0.0, 0.0), (0.0, height, 0.0), 2, 2)
    p.put(canvas, front)
    p.put("dark paint", box(-width / 2, -height / 2, 0.002, width / 2, height / 2, 0.012))
    return p


def relief(width, height):
    """A plaster relief of rising waves in a frame; centre at the origin, on the wall z = 0."""
    p = Part("relief")
    columns, rows = 96, 72

    def surface(i, j):
        u, v = i / columns - 0.5, j / rows - 0.5
        far = math.hypot(u + 0.14, 0.8 * (v + 0.1))
        bulge = math.exp(-9.0 * far * far)
        wave = 0.5 + 0.5 * math.cos(30.0 * far + math.atan2(v + 0.1, u + 0.14))
        wave *= min(1.0, 12.0 * far) ** 2
        edge = min(1.0, 9.0 * min(0.5 - abs(u), 0.5 - abs(v)))
        return (u * width, v * height, 0.01 + edge * (0.05 * bulge + 0.028 * wave))

    s = Shape()
    for j in range(rows + 1):
        for i in range(columns + 1):
            du = vec.sub(surface(min(i + 1, columns), j), surface(max(i - 1, 0), j))
            dv = vec.sub(surface(i, min(j + 1, rows)), surface(i, max(j - 1, 0)))
            s.vertex(surface(i, j), vec.normalize(vec.cross(du, dv)), (i / columns, 1 - j / rows))
    stitch(s, columns + 1, rows + 1)
    p.put("gypsum", s)
    p.put("gypsum", box(-width / 2, -height / 2, 0.001, width / 2, height / 2, 0.008))
    p.add(frame("dark paint", width, height, 0.05, 0.05), vec.Transform())
    return p


def screen(width=0.62, height=1.75, panels=3, fold=28.0):
    """A folding screen of lattices; its first panel starts at the origin and runs along x."""
    p = Part("screen")
    at, turn = (0.0, 0.0, 0.0), fold
    bar = 0.018
    for k in range(panels):
        s = Shape()
        for x in (0.0, width - 0.045):
            s.add(box(x, 0.0, -0.0175, x + 0.045, height, 0.0175))
        for y in (0.08, 0.62, height - 0.05):
            s.add(box(0.045, y, -0.015, width - 0.045, y + 0.05, 0.015))
        for i in range(1, 6):
            x = 0.045 + (width - 0.09) * i / 6
            s.add(box(x - bar / 2, 0.67, 0.0005, x + bar / 2, height - 0.05, 0.0125))
        for j in range(1, 12):
            y = 0.67 + (height - 0.72) * j / 12
            s.add(box(0.045, y - bar / 2, -0.0125, width - 0.045, y + bar / 2, -0.0005))
        s.add(box(0.045, 0.13, -0.008, width - 0.045, 0.62, 0.008))
        s.uvs = [((q[0] + 0.2 * q[2]) / 0.6, q[1] / 1.8) for q in s.positions]
        place = vec.translate(*at) @ vec.rotate((0, 1, 0), turn)
        p.put("oak dark", s, place)
        at, turn = place.point((width + 0.004, 0.0, 0.0)), -turn
    return p


def canvas(seed, colors, size=128):
    """A painting as a PNG: fields of colour with soft, brushed edges, from top to bottom over the first colour."""
    draw = random.Random(seed)
    ground = colors[0]
    cloud, brush = textures.fractal(size, 4, 3, seed), textures.noise(size, 6, seed + 40, 64)
    edges, top = [], 0.07
    shares = [draw.uniform(0.7, 1.6) for _ in colors[1:]]
    for color, share in zip(colors[1:], shares):
        bottom = top + 0.86 * share / sum(shares)
        edges.append((top + 0.012, bottom - 0.012, color))
        top = bottom
    pixels = bytearray()
    for i in range(size * size):
        x, y = (i % size + 0.5) / size, (i // size + 0.5) / size
        wander = 0.05 * (cloud[i] - 0.5)
        color = ground
        for low, high, paint in edges:
            inside = min(x - 0.08, 0.92 - x, y - low, high - y) + wander
            color = vec.lerp(color, paint, min(max(inside / 0.025, 0.0), 1.0) * (0.75 + 0.25 * brush[i]))
        tone = 0.75 + 0.35 * cloud[i] + 0.15 * (brush[i] - 0.5)
        pixels += bytes(round(b / 4) * 4 if b < 252 else 252 for b in textures.srgb(vec.scale(color, tone)))
    return textures.png(size, size, 3, pixels)
