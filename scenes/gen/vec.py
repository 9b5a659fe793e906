"""Vectors, quaternions and affine transforms as plain tuples."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def normalize(a):
    return scale(a, 1.0 / length(a))


def lerp(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def sun_direction(azimuth, elevation):
    """To the sun; degrees, azimuth from +Z towards +X."""
    az, el = math.radians(azimuth), math.radians(elevation)
    return (math.sin(az) * math.cos(el), math.sin(el), math.cos(az) * math.cos(el))


# Quaternions are (x, y, z, w), as in glTF.


def axis_angle(axis, degrees):
    half = math.radians(degrees) / 2
    s = math.sin(half)
    a = normalize(axis)
    return (a[0] * s, a[1] * s, a[2] * s, math.cos(half))


def quat_mul(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def quat_from_axes(x, y, z):
    """The rotation whose columns are x, y and z (orthonormal, right-handed)."""
    trace = x[0] + y[1] + z[2]
    if trace > 0:
        s = math.sqrt(trace + 1) * 2
        return ((y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s, s / 4)
    if x[0] > y[1] and x[0] > z[2]:
        s = math.sqrt(1 + x[0] - y[1] - z[2]) * 2
        return (s / 4, (x[1] + y[0]) / s, (z[0] + x[2]) / s, (y[2] - z[1]) / s)
    if y[1] > z[2]:
        s = math.sqrt(1 + y[1] - x[0] - z[2]) * 2
        return ((x[1] + y[0]) / s, s / 4, (y[2] + z[1]) / s, (z[0] - x[2]) / s)
    s = math.sqrt(1 + z[2] - x[0] - y[1]) * 2
    return ((z[0] + x[2]) / s, (y[2] + z[1]) / s, s / 4, (x[1] - y[0]) / s)


def look_at(eye, target):
    """The rotation that turns a camera or light (which looks along -Z) at eye to target. Straight down, +X is right."""
    back = normalize(sub(eye, target))
    up = (0.0, 1.0, 0.0) if abs(back[1]) < 0.9999 else (0.0, 0.0, -1.0 if back[1] > 0 else 1.0)
    right = normalize(cross(up, back))
    return quat_from_axes(right, cross(back, right), back)


class Transform:
    """An affine map: three columns and an origin."""

    def __init__(self, x=(1.0, 0.0, 0.0), y=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0), origin=(0.0, 0.0, 0.0)):
        self.x, self.y, self.z, self.origin = x, y, z, origin

    def vector(self, v):
        return add(add(scale(self.x, v[0]), scale(self.y, v[1])), scale(self.z, v[2]))

    def point(self, p):
        return add(self.vector(p), self.origin)

    def normal(self, n):
        # The cofactor matrix: right under non-uniform scale too, and for mirrors up to the sign that is undone here.
        sign = 1.0 if self.determinant() > 0 else -1.0
        c = Transform(cross(self.y, self.z), cross(self.z, self.x), cross(self.x, self.y))
        return scale(normalize(c.vector(n)), sign)

    def determinant(self):
        return dot(self.x, cross(self.y, self.z))

    def __matmul__(self, inner):
        return Transform(self.vector(inner.x), self.vector(inner.y), self.vector(inner.z), self.point(inner.origin))


def translate(x, y, z):
    return Transform(origin=(x, y, z))


def stretch(x, y, z):
    return Transform((x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z))


def rotate(axis, degrees):
    x, y, z, w = axis_angle(axis, degrees)
    return Transform(
        (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
        (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
        (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)),
    )


def along(start, end):
    """The frame at start whose y axis runs to end (unit axes), for rods and branches."""
    y = normalize(sub(end, start))
    helper = (0.0, 0.0, 1.0) if abs(y[2]) < 0.9 else (1.0, 0.0, 0.0)
    x = normalize(cross(y, helper))
    return Transform(x, y, cross(x, y), start)
