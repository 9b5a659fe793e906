"""Scenes that each show one case: the thesis's distant caster, leaves, and things that move."""

import math

from . import plants, vec
from .glb import Glb
from .shapes import Shape, box, plane, sphere

PAVING = (0.42, 0.4, 0.37)


def thesis(
    height=320.0,
    azimuth=125.0,
    elevation=50.0,
    edge=0.3,
    piers=7,
    pier=2.4,
    opening=4.2,
    crown=16.0,
    beam=2.0,
    depth=3.0,
):
    """One distant tower whose penumbra covers the view.

    height: of the tower's top; azimuth, elevation: of the sun and of the tower that stands before it, degrees; edge:
    how far beyond the origin, away from the tower, the shadow of its top ends (V = 1/2 but for the openings); piers,
    pier, opening: count, width and clear distance of the piers of its open crown; crown: height of the openings; beam:
    height of the beam on top; depth: of the tower along z
    """
    glb = Glb()
    # Of the top's two edges, the sunward one is the silhouette.
    distance = height / math.tan(math.radians(elevation)) - edge
    slant = height / math.sin(math.radians(elevation))
    glb.camera("main", (-1.3, 2.5, 4.2), (0.05, 0.0, -0.15), 45.0)
    glb.camera("low", (-2.2, 0.7, 2.6), (0.3, 0.1, -0.6), 45.0)
    glb.camera("overview", (150.0, 90.0, 330.0), (0.0, 120.0, -120.0), 55.0, near=1.0)
    glb.sun(azimuth, elevation)
    stone, ground = glb.material("tower", (0.5, 0.47, 0.43), 0.9), glb.material("ground", PAVING, 0.95)
    clay, pale = glb.material("clay", (0.52, 0.26, 0.17), 0.8), glb.material("pale", (0.62, 0.6, 0.55), 0.7)
    size = 2 * slant
    glb.add("ground", plane(-size, -size, size, size), ground)
    width = piers * pier + (piers - 1) * opening
    tower = Shape()
    z0, z1 = -distance, -distance + depth
    tower.add(box(-width / 2, 0.0, z0, width / 2, height - crown - beam, z1, "-y"))
    for i in range(piers):
        x = -width / 2 + i * (pier + opening)
        tower.add(box(x, height - crown - beam, z0, x + pier, height - beam, z1, "-y+y"))
    tower.add(box(-width / 2, height - beam, z0, width / 2, height, z1))
    # Built on the -Z axis, then turned to the sun's azimuth.
    glb.add("tower", tower, stone, rotation=vec.axis_angle((0, 1, 0), azimuth - 180.0))
    steps = Shape()
    for i in range(4):
        steps.add(box(0.75 + 0.3 * i, 0.0, -1.9, 1.05 + 0.3 * i, 0.1 * (i + 1), -0.3, "-y"))
    glb.add("steps", steps, pale)
    glb.add("block", box(-0.25, 0.0, -0.25, 0.25, 0.5, 0.25, "-y"), clay, translation=(-1.2, 0.0, -1.2),
            rotation=vec.axis_angle((0, 1, 0), 25.0))
    ball = glb.mesh("ball", [glb.primitive(sphere(1.0, 48, 24), pale)])
    for x, z, radius in ((-0.15, -0.75, 0.3), (-0.55, 0.45, 0.16), (0.5, 0.7, 0.1)):
        glb.node("ball", translation=(x, radius, z), scale=(radius, radius, radius), mesh=ball)
    return glb


def foliage(seed=11, azimuth=-50.0, elevation=48.0, branches=11, cards=26, card_size=0.55):
    """Alpha-masked leaves: two trees and a hedge over open ground, and a wall.

    seed: of the trees' shape; azimuth, elevation: of the sun, degrees; branches, cards, card_size: of each tree, cards
    for each branch, side of a card in metres
    """
    glb = Glb()
    glb.camera("main", (1.6, 1.75, 8.2), (0.6, 1.75, 0.0), 45.0)
    glb.camera("shadow", (2.4, 1.6, 3.2), (1.9, 0.1, -0.4), 45.0)
    glb.sun(azimuth, elevation)
    leaf = glb.texture("leaves", plants.leaf_texture(), clamp=True)
    leaves = glb.material("leaves", (1.0, 1.0, 1.0), 0.75, color_texture=leaf, mask=0.5, double_sided=True)
    bark = glb.material("bark", (0.2, 0.15, 0.11), 0.9)
    glb.add("ground", plane(-30.0, -30.0, 30.0, 30.0), glb.material("ground", PAVING, 0.95))
    glb.add("wall", box(-6.0, 0.0, -3.3, 9.0, 2.4, -3.0, "-y"), glb.material("wall", (0.66, 0.58, 0.47), 0.9))
    for name, k, place, turn in (("near", 0, (-0.6, 0.0, 0.0), 0.0), ("far", 1, (4.3, 0.0, -1.0), 70.0)):
        wood, crown = plants.tree(seed + k, branches=branches, cards=cards, card_size=card_size)
        parts = [glb.primitive(wood, bark), glb.primitive(crown, leaves)]
        glb.node("tree_" + name, translation=place, rotation=vec.axis_angle((0, 1, 0), turn),
                 mesh=glb.mesh("tree_" + name, parts))
    hedge = plants.ivy(seed + 2, (-5.5, 0.0, -2.9), (5.0, 0.0, 0.0), (0.0, 1.2, 0.0), (0.0, 0.0, 1.0), 220, 0.4,
                       lambda a, b: 1.0 - b * b)
    glb.add("climber", hedge, leaves)
    return glb


MOTION_END, LOOP = 2.0, 4.0


def moving(azimuth=35.0, elevation=45.0):
    """Casters that move for 2 s and rest until 4 s: rigid, skinned and morphing, over still receivers.

    azimuth, elevation: of the sun, degrees
    """
    glb = Glb()
    glb.camera("main", (0.0, 3.4, 8.6), (-0.3, 0.75, -0.3), 42.0)
    glb.camera("side", (7.5, 2.2, 5.0), (0.0, 0.7, 0.0), 45.0)
    glb.sun(azimuth, elevation)
    ground, wall = glb.material("ground", PAVING, 0.95), glb.material("wall", (0.6, 0.57, 0.52), 0.9)
    glb.add("ground", plane(-20.0, -20.0, 20.0, 20.0), ground)
    glb.add("wall", box(-6.0, 0.0, -3.2, 6.0, 2.6, -3.0, "-y"), wall)
    for x in (-4.2, -1.2, 1.4, 4.0):
        glb.add("block", box(-0.3, 0.0, -0.3, 0.3, 0.4, 0.3, "-y"), wall, translation=(x, 0.0, -1.9))
    channels = _rigid(glb) + _bending(glb) + _morphing(glb)
    glb.animation("all", channels)
    return glb


def _rigid(glb):
    red, blue = glb.material("red", (0.5, 0.12, 0.08), 0.6), glb.material("blue", (0.1, 0.2, 0.45), 0.6)
    slider = glb.add("slider", box(-0.4, -0.25, -0.3, 0.4, 0.25, 0.3), red, translation=(-4.5, 1.4, 0.4))
    bar = glb.add("bar", box(-1.1, -0.06, -0.06, 1.1, 0.06, 0.06), blue, translation=(-2.1, 1.9, -0.6))
    jumper = glb.add("jumper", box(-0.25, 0.0, -0.25, 0.25, 0.5, 0.25), blue, translation=(-4.4, 0.0, 1.8))
    ball = glb.add("ball", sphere(0.3, 32, 16), red, translation=(-1.6, 0.3, 1.7))
    slides = [(x, 1.4, 0.4) for x in (-4.5, -2.5, -4.5, -2.5, -4.5, -4.5)]
    turns = [vec.axis_angle((0, 1, 0), 90.0 * k) for k in (*range(9), 8)]
    jumps = [(x, 0.0, 1.8) for x in (-4.4, -3.7, -3.0, -3.7, -4.4, -4.4)]
    still, place = (0.0, 0.0, 0.0), (-1.6, 0.3, 1.7)
    hops = []
    for k in range(5):
        leaving = (0.0, 5.0 if k < 4 else 0.0, 0.0)
        hops += [(0.0, -5.0 if k else 0.0, 0.0), place, leaving]
    hops += [still, place, still]
    half_seconds = [0.0, 0.5, 1.0, 1.5, MOTION_END, LOOP]
    return [
        (slider, "translation", "LINEAR", half_seconds, slides),
        (bar, "rotation", "LINEAR", [k / 4 for k in range(9)] + [LOOP], turns),
        (jumper, "translation", "STEP", half_seconds, jumps),
        (ball, "translation", "CUBICSPLINE", half_seconds, hops),
    ]


def _bending(glb):
    """A pillar 2.4 m tall on four joints, 0.6 m apart; each vertex follows the two joints next to its height."""
    pillar, joints, link = Shape(), 4, 0.6
    ring, rows, radius = 16, 24, 0.22
    for j in range(rows + 1):
        y = joints * link * j / rows
        r = radius * (1 - 0.4 * j / rows)
        place = y / link - 0.5
        low = min(max(int(math.floor(place)), 0), joints - 2)
        share = min(max(place - low, 0.0), 1.0)
        for i in range(ring + 1):
            a = -2 * math.pi * (i % ring) / ring
            n = (math.cos(a), 0.0, math.sin(a))
            pillar.vertex((r * n[0], y, r * n[2]), n, (i / ring, 1 - j / rows))
            pillar.joints.append((low, low + 1, 0, 0))
            pillar.weights.append((1 - share, share, 0.0, 0.0))
    for j in range(rows):
        for i in range(ring):
            a = j * (ring + 1) + i
            pillar.triangle(a, a + 1, a + ring + 2)
            pillar.triangle(a, a + ring + 2, a + ring + 1)
    _cap(pillar, ring, joints, joints * link, radius * 0.6)
    root = glb.node("pillar_root", translation=(0.4, 0.0, 0.4))
    chain, parent = [], root
    for k in range(joints):
        parent = glb.node("joint_%d" % k, parent, translation=(0.0, link if k else 0.0, 0.0))
        chain.append(parent)
    binds = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -link * k, 0, 1) for k in range(joints)]
    green = glb.material("green", (0.12, 0.35, 0.16), 0.7)
    mesh = glb.mesh("pillar", [glb.primitive(pillar, green)])
    # Beside its joints, not below them: a skinned mesh stands where its joints are.
    glb.node("pillar", mesh=mesh, skin=glb.skin("pillar", chain, binds))
    times = [0.0, 0.5, 1.0, 1.5, MOTION_END, LOOP]
    bends = [vec.axis_angle((0.3, 0, 1), angle) for angle in (0.0, -25.0, 0.0, 25.0, 0.0, 0.0)]
    return [(joint, "rotation", "LINEAR", times, bends) for joint in chain]


def _cap(pillar, ring, joints, y, radius):
    center = pillar.vertex((0.0, y, 0.0), (0.0, 1.0, 0.0))
    edge = []
    for i in range(ring):
        a = -2 * math.pi * i / ring
        edge.append(pillar.vertex((radius * math.cos(a), y, radius * math.sin(a)), (0.0, 1.0, 0.0)))
    for i in range(ring):
        pillar.triangle(center, edge[i], edge[(i + 1) % ring])
    pillar.joints += [(joints - 2, joints - 1, 0, 0)] * (ring + 1)
    pillar.weights += [(0.0, 1.0, 0.0, 0.0)] * (ring + 1)


def _morphing(glb):
    """A ball with two targets: a tall spindle and a wide square cushion. Normals are those of the target's surface."""
    ball = sphere(0.55, 32, 24)

    def deltas(deform):
        moved = [deform(p) for p in ball.positions]
        normals = _smooth_normals(moved, ball)
        return (
            [vec.sub(b, a) for a, b in zip(ball.positions, moved)],
            [vec.sub(b, a) for a, b in zip(ball.normals, normals)],
        )

    def spindle(p):
        return (0.45 * p[0], 1.9 * p[1], 0.45 * p[2])

    def cushion(p):
        norm = sum(abs(c / 0.55) ** 6 for c in (p[0], p[2])) ** (1 / 6)
        flat = math.hypot(p[0], p[2]) / 0.55
        grow = 1.45 * (flat / norm if norm > 1e-6 else 1.0)
        return (grow * p[0], 0.4 * p[1], grow * p[2])

    violet = glb.material("violet", (0.35, 0.18, 0.42), 0.6)
    mesh = glb.mesh("blob", [glb.primitive(ball, violet, [deltas(spindle), deltas(cushion)])], [0.0, 0.0])
    node = glb.node("blob", translation=(3.3, 1.25, 0.2), mesh=mesh)
    weights = [0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0]
    return [(node, "weights", "LINEAR", [0.0, 0.5, 1.0, 1.5, MOTION_END, LOOP], weights)]


def _smooth_normals(positions, shape):
    """Area-weighted, shared between vertices at one place (the sphere's seam and poles)."""
    sums = {}
    keys = [tuple(round(c, 6) for c in p) for p in shape.positions]
    for i in range(0, len(shape.indices), 3):
        a, b, c = shape.indices[i : i + 3]
        n = vec.cross(vec.sub(positions[b], positions[a]), vec.sub(positions[c], positions[a]))
        for k in (a, b, c):
            sums[keys[k]] = vec.add(sums.get(keys[k], (0.0, 0.0, 0.0)), n)
    return [vec.normalize(sums[key]) for key in keys]
