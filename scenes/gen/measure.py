"""Scenes with known answers: a straight edge, posts, and a bar at growing heights."""

import math

from . import vec
from .glb import Glb
from .shapes import Shape, box, plane, rod

GREY, PAVING = (0.5, 0.5, 0.5), (0.42, 0.4, 0.37)


def knife_edge(
    height=5.0,
    extent=60.0,
    receiver=100.0,
    azimuth=90.0,
    elevation=90.0,
    eye=None,
    target=(0.0, 0.0, 0.0),
    fov=40.0,
    view_width=None,
):
    """A half-plane over a plane.

    height: of the caster; extent: the caster spans -extent < x < 0 and |z| < extent; receiver: half-side of the plane;
    azimuth, elevation: of the direction to the sun, degrees; eye, target, fov: of the camera "edge" (eye: default
    under the caster, 0.45 of its height); view_width: of the orthographic camera "top", metres (default height / 4)
    """
    glb = Glb()
    grey = glb.material("caster", GREY, double_sided=True)
    # The shadow's edge moves against the sun by this much per metre of height.
    slope = vec.scale(vec.sun_direction(azimuth, elevation), -height / math.sin(math.radians(elevation)))
    edge = (slope[0], 0.0, 0.0)
    if eye is None:
        eye = (edge[0], 0.45 * height, 0.6 * height)
        target = vec.add(target, edge)
    glb.camera("edge", eye, target, fov, near=0.01 * height)
    top = (edge[0], 0.9 * height, 0.0)
    glb.orthographic("top", top, edge, view_width or height / 4, near=0.01 * height, far=height)
    glb.sun(azimuth, elevation)
    glb.add("receiver", plane(-receiver, -receiver, receiver, receiver), glb.material("receiver", GREY))
    glb.add("caster", plane(-extent, -extent, 0.0, extent, height), grey)
    return glb


def posts(
    count=24,
    nearest=2.0,
    growth=0.165,
    gap=2.0,
    height=3.0,
    width=0.3,
    bar=1.5,
    x=2.5,
    azimuth=90.0,
    elevation=40.0,
    eye_height=1.7,
    view_width=1.0,
    far_object=0.0,
):
    """Identical posts, each with a bar on top, in one row from near to far.

    count, nearest, growth, gap: the first post is `nearest` metres before the eye, each next one max(gap, growth *
    distance) further; height: of the bar's upper face; width: of post and bar (square section); bar: the bar's length,
    along z; x: of the row's middle; azimuth, elevation: of the sun, degrees; eye_height: of all cameras; view_width:
    metres seen at the edge by the cameras "post_NN"; far_object: metres to a 30 m tower outside all views (0: none)
    """
    glb = Glb()
    paint, ground = glb.material("post", (0.45, 0.42, 0.38), 0.8), glb.material("ground", PAVING)
    half = width / 2
    distances = [nearest]
    while len(distances) < count:
        distances.append(distances[-1] + max(gap, growth * distances[-1]))
    eye = (0.0, eye_height, 0.0)
    glb.camera("main", eye, (0.0, eye_height - math.tan(math.radians(9.0)), -1.0), 50.0, near=0.1)
    cotangent = 1.0 / math.tan(math.radians(elevation))
    sun = (math.sin(math.radians(azimuth)), 0.0, math.cos(math.radians(azimuth)))
    for i, distance in enumerate(distances):
        edge = (x - half - height * cotangent * sun[0], 0.0, -distance - height * cotangent * sun[2])
        away = vec.length(vec.sub(edge, eye))
        fov = math.degrees(2 * math.atan(view_width / 2 * 9 / 16 / away))
        glb.camera("post_%02d" % i, eye, edge, fov, near=0.1)
    glb.sun(azimuth, elevation)
    depth = distances[-1] + 40.0
    glb.add("ground", plane(-depth / 2, -depth, depth / 2, 20.0), ground)
    shape = box(-half, 0.0, -half, half, height - width, half, "-y+y")
    shape.add(box(-half, height - width, -bar / 2, half, height, bar / 2))
    mesh = glb.mesh("post", [glb.primitive(shape, paint)])
    for i, distance in enumerate(distances):
        glb.node("post_%02d" % i, translation=(x, 0.0, -distance), mesh=mesh)
    if far_object:
        glb.add("far_object", box(-5.0, 0.0, -5.0, 5.0, 30.0, 5.0), paint, translation=(0.0, 0.0, far_object))
    return glb


HEIGHTS = (0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)


def steps(length=1.2, thickness=0.1, depth=0.6, spacing=1.7, azimuth=-20.0, elevation=50.0):
    """The same bar at growing heights: contact hardening.

    length, thickness, depth: of the bar along x, y, z; spacing: from bar to bar along x; azimuth, elevation: of the
    sun, degrees
    """
    glb = Glb()
    paint, ground = glb.material("bar", (0.55, 0.3, 0.2), 0.7), glb.material("ground", PAVING)
    glb.camera("main", (-1.5, 7.5, 11.5), (0.4, 0.9, -1.0), 38.0)
    glb.camera("low", (-9.0, 2.6, 3.6), (0.0, 0.7, -1.2), 45.0)
    glb.sun(azimuth, elevation)
    glb.add("ground", plane(-20.0, -20.0, 20.0, 20.0), ground)
    shape = box(-length / 2, 0.0, -depth / 2, length / 2, thickness, depth / 2)
    mesh = glb.mesh("bar", [glb.primitive(shape, paint)])
    for i, height in enumerate(HEIGHTS):
        x = (i - (len(HEIGHTS) - 1) / 2) * spacing
        glb.node("bar_%.2f" % height, translation=(x, height, 0.0), mesh=mesh)
    return glb


def fence(azimuth=55.0, elevation=18.0, pickets=(0.05, 0.03, 0.02, 0.01), wires=(0.02, 0.01, 0.005)):
    """Thin casters under a low sun: pickets and wires from 5 cm to 5 mm.

    azimuth, elevation: of the sun, degrees; pickets: widths, metres, one field of the fence each; wires: diameters
    """
    glb = Glb()
    wood, metal = glb.material("wood", (0.5, 0.36, 0.22), 0.8), glb.material("wire", (0.3, 0.3, 0.32), 0.5)
    ground = glb.material("ground", PAVING)
    glb.camera("main", (-1.9, 1.7, 3.0), (-0.2, 0.3, -1.0), 50.0)
    glb.camera("close", (-0.4, 0.6, 1.3), (0.3, 0.1, -0.6), 40.0)
    # The sun stands behind the fence, so that the shadows come towards the camera.
    glb.sun(180.0 - azimuth, elevation)
    glb.add("ground", plane(-25.0, -25.0, 25.0, 25.0), ground)
    field, z = 1.4, -1.2
    start = -field * (len(pickets) + len(wires)) / 2
    bars, lines = Shape(), Shape()
    for k, width in enumerate(pickets):
        x0 = start + k * field
        _pickets(bars, x0, field, z, width)
    for k, diameter in enumerate(wires):
        x0 = start + (len(pickets) + k) * field
        _wires(lines, x0, field, z, diameter)
    for k in range(len(pickets) + len(wires) + 1):
        x = start + k * field
        bars.add(box(x - 0.06, 0.0, z - 0.06, x + 0.06, 1.3, z + 0.06, "-y"))
    glb.add("pickets", bars, wood)
    glb.add("wires", lines, metal)
    return glb


def _pickets(shape, x0, field, z, width):
    for y in (0.25, 0.95):
        shape.add(box(x0 + 0.06, y, z - 0.015, x0 + field - 0.06, y + 0.05, z + 0.015))
    pitch = 3 * width
    count = int((field - 0.2) / pitch)
    for i in range(count):
        x = x0 + field / 2 + (i - (count - 1) / 2) * pitch
        tall = 1.2 if width >= 0.02 else 1.1
        shape.add(box(x - width / 2, 0.05, z + 0.015, x + width / 2, tall, z + 0.015 + min(width, 0.02)))


def _wires(shape, x0, field, z, diameter):
    for i in range(9):
        y = 0.15 + i * 0.13
        shape.add(rod((x0, y, z), (x0 + field, y, z), diameter / 2, 6, caps=False))
    for i in range(1, 12):
        x = x0 + field * i / 12
        shape.add(rod((x, 0.05, z), (x, 1.22, z), diameter / 2, 6))


def failures(low=0.5, high=4.0, azimuth=90.0, elevation=60.0):
    """What maps that are filtered before they are compared get wrong: boards above each other, a post on the ground, a
    shelf below a roof.

    low, high: heights of the two boards, metres; azimuth, elevation: of the sun, degrees
    """
    glb = Glb()
    paint, ground = glb.material("board", (0.5, 0.42, 0.3), 0.8), glb.material("ground", PAVING)
    glb.camera("main", (0.5, 4.5, 8.5), (0.2, 0.5, -0.5), 45.0)
    glb.sun(azimuth, elevation)
    glb.add("ground", plane(-12.0, -12.0, 12.0, 12.0), ground)

    def towards_sun(point, rise):
        """Where a ray of the sun's centre that passes through a point is higher by `rise`."""
        sun = vec.sun_direction(azimuth, elevation)
        return vec.add(point, vec.scale(sun, rise / sun[1]))

    def board(name, center, half_x, half_z):
        shape = box(-half_x, -0.03, -half_z, half_x, 0.03, half_z)
        glb.add(name, shape, paint, translation=center)

    # The shadow of the high board ends in the middle of the low one's.
    below = (-3.0, 0.0, 0.0)
    board("low board", towards_sun(below, low), 0.9, 0.9)
    board("high board", vec.add(towards_sun(below, high), (0.0, 0.0, -0.9)), 0.9, 0.9)
    glb.camera("bleeding", vec.add(below, (-2.2, 1.0, 0.7)), vec.add(below, (0.0, 0.0, 0.1)), 45.0)
    # A post that touches the ground, under a net of beams.
    glb.add("post", box(-0.08, 0.0, -0.08, 0.08, 1.2, 0.08, "-y"), paint, translation=(0.4, 0.0, 0.0))
    glb.camera("contact", (0.2, 0.9, 1.6), (0.1, 0.1, 0.0), 40.0)
    # A shelf whose far edge is seen beside the ground, and a roof that shadows the shelf up to 10 cm from this edge.
    shelf = (3.2, 1.6, 0.0)
    board("shelf", shelf, 0.5, 0.9)
    board("roof", vec.add(towards_sun(vec.add(shelf, (0.0, 0.03, 0.0)), 1.5), (0.1, 0.0, 0.0)), 0.5, 0.9)
    glb.camera("shelf", (2.2, 2.9, 1.2), vec.add(shelf, (-0.25, 0.0, 0.0)), 40.0)
    return glb
