"""Scenes that test shadow maps where surfaces touch: faces in one place, faces that meet at shallow angles, folds."""

import math

from . import vec
from .glb import Glb
from .shapes import Shape, box, plane, stitch

GREY, PAVING, CLOTH = (0.5, 0.5, 0.5), (0.42, 0.4, 0.37), (0.55, 0.42, 0.3)


def coincident(gaps=(0.0, 0.0005, 0.001, 0.002, 0.005, 0.01), wedge=0.02, azimuth=60.0, elevation=32.0):
    """Surfaces in one place: sheets before a wall, a ramp and the ground, which face what they cover.

    gaps: between each sheet and what it covers, metres; wedge: the gap of the last sheet grows from 0 to that; azimuth,
    elevation: of the sun, degrees
    """
    glb = Glb()
    stone, ground = glb.material("stone", GREY, 0.9), glb.material("ground", PAVING)
    lining = glb.material("lining", (0.5, 0.25, 0.2), 0.9)
    glb.camera("main", (0.6, 2.2, 6.2), (0.0, 0.75, 0.0), 45.0)
    glb.sun(azimuth, elevation)
    glb.add("ground", plane(-12.0, -12.0, 12.0, 12.0), ground)
    glb.add("wall", box(-4.0, 0.0, -0.3, 4.0, 2.2, 0.0, "-y"), stone)
    ramp = Shape()
    ramp.quad((-4.0, 0.0, 2.6), (4.0, 0.0, 2.6), (4.0, 0.8, 1.2), (-4.0, 0.8, 1.2))
    ramp.quad((4.0, 0.0, 1.2), (-4.0, 0.0, 1.2), (-4.0, 0.8, 1.2), (4.0, 0.8, 1.2))
    glb.add("ramp", ramp, stone)
    sheets = Shape()
    width, pitch = 0.8, 7.6 / (len(gaps) + 1)
    for i in range(len(gaps) + 1):
        x0 = -3.8 + i * pitch + (pitch - width) / 2
        x1 = x0 + width
        low, high = (gaps[i], gaps[i]) if i < len(gaps) else (0.0, wedge)
        sheets.add(_sheet((x0, 0.4, 0.0), (x1, 0.4, 0.0), (x1, 2.0, 0.0), (x0, 2.0, 0.0), low, high))
        sheets.add(_sheet((x0, 0.1, 2.425), (x1, 0.1, 2.425), (x1, 0.7, 1.375), (x0, 0.7, 1.375), low, high))
        sheets.add(_sheet((x0, 0.0, 3.6), (x1, 0.0, 3.6), (x1, 0.0, 2.9), (x0, 0.0, 2.9), low, high))
    glb.add("sheets", sheets, lining)
    return glb


def _sheet(a, b, c, d, low, high):
    """A quad off the one that is given by its corners counter-clockwise, by `low` at a and b and `high` at c and d; it
    faces that one."""
    normal = vec.normalize(vec.cross(vec.sub(b, a), vec.sub(d, a)))
    lifted = [vec.add(p, vec.scale(normal, gap)) for p, gap in ((a, low), (b, low), (c, high), (d, high))]
    s = Shape()
    s.quad(lifted[3], lifted[2], lifted[1], lifted[0])
    return s


def tent(sides=14, radius=5.0, fold=0.8, height=2.6, eaves=0.9, azimuth=-90.0, elevation=10.0):
    """Large faces that meet at shallow angles, along ridges and valleys.

    sides: corners of the tent, every other one a valley; radius: of the ridges' feet, metres; fold: radius of the valleys'
    feet as a part of that; height: of the top; eaves: of the walls; azimuth, elevation: of the sun, degrees
    """
    glb = Glb()
    cloth, ground = glb.material("cloth", CLOTH, 0.9, double_sided=True), glb.material("ground", PAVING)
    glb.camera("seams", (-7.0, 3.4, 4.5), (-2.5, 1.6, 1.0), 35.0)
    glb.camera("main", (3.5, 4.2, 10.5), (0.0, 1.2, 0.0), 45.0)
    glb.sun(azimuth, elevation)
    glb.add("ground", plane(-30.0, -30.0, 30.0, 30.0), ground)
    roof = Shape()
    feet = []
    for k in range(sides):
        r = radius * (1.0 if k % 2 == 0 else fold)
        angle = 2 * math.pi * k / sides
        feet.append((r * math.sin(angle), eaves, r * math.cos(angle)))
    for k in range(sides):
        a, b = feet[k], feet[(k + 1) % sides]
        top = (0.0, height, 0.0)
        normal = vec.normalize(vec.cross(vec.sub(b, a), vec.sub(top, a)))
        roof.triangle(*(roof.vertex(p, normal) for p in (a, b, top)))
        roof.quad((a[0], 0.0, a[2]), (b[0], 0.0, b[2]), b, a)
    glb.add("tent", roof, cloth)
    return glb


def curtain(width=4.0, height=2.6, fold=0.36, depth=0.09, steps=28, azimuth=78.0, elevation=20.0):
    """A curtain in smooth folds, which the sun grazes.

    width, height: of the curtain; fold, depth: width and depth of a fold; steps: quads across a fold; azimuth,
    elevation: of the sun, degrees (the curtain faces azimuth 0)
    """
    glb = Glb()
    cloth, ground = glb.material("cloth", CLOTH, 0.9, double_sided=True), glb.material("ground", PAVING)
    glb.camera("main", (0.5, 1.6, 3.4), (0.0, 1.2, 0.0), 42.0)
    glb.camera("close", (0.4, 1.5, 1.1), (0.2, 1.3, 0.0), 40.0)
    glb.sun(azimuth, elevation)
    glb.add("ground", plane(-10.0, -10.0, 10.0, 10.0), ground)
    s = Shape()
    columns, rows = round(width / fold * steps), 8
    for j in range(rows + 1):
        y = 0.05 + (height - 0.05) * j / rows
        for i in range(columns + 1):
            x = width * (i / columns - 0.5)
            phase = 2 * math.pi * x / fold + 0.5 * math.sin(1.7 * x + 0.9 * y)
            turn = 2 * math.pi / fold + 0.85 * math.cos(1.7 * x + 0.9 * y)
            rise = 0.45 * math.cos(1.7 * x + 0.9 * y)
            open_ = depth / 2 * (1.15 - 0.3 * y / height)
            slope_x, slope_y = open_ * math.cos(phase) * turn, open_ * math.cos(phase) * rise
            s.vertex((x, y, open_ * math.sin(phase)), vec.normalize((-slope_x, -slope_y, 1.0)))
    stitch(s, columns + 1, rows + 1)
    glb.add("curtain", s, cloth)
    return glb
