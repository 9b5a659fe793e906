"""Triangle meshes: counter-clockwise from outside, smooth normals on what is round."""

import math

from . import vec


class Shape:
    def __init__(self):
        self.positions, self.normals, self.uvs, self.uvs2, self.indices = [], [], [], [], []
        self.joints, self.weights = [], []

    def vertex(self, position, normal, uv=(0.0, 0.0)):
        self.positions.append(position)
        self.normals.append(normal)
        self.uvs.append(uv)
        return len(self.positions) - 1

    def triangle(self, a, b, c):
        self.indices += (a, b, c)

    def quad(self, a, b, c, d, uvs=((0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0))):
        """Four corners, counter-clockwise; by default the texture's lower left is at a."""
        normal = vec.normalize(vec.cross(vec.sub(b, a), vec.sub(d, a)))
        i = [self.vertex(p, normal, uv) for p, uv in zip((a, b, c, d), uvs)]
        self.indices += (i[0], i[1], i[2], i[0], i[2], i[3])

    def add(self, other, at=None):
        """Appends a shape, placed by a transform (a mirroring one turns the triangles round)."""
        base = len(self.positions)
        flip = False
        if at:
            self.positions += [at.point(p) for p in other.positions]
            self.normals += [at.normal(n) for n in other.normals]
            flip = at.determinant() < 0
        else:
            self.positions += other.positions
            self.normals += other.normals
        self.uvs += other.uvs
        self.uvs2 += other.uvs2
        for i in range(0, len(other.indices), 3):
            a, b, c = (base + k for k in other.indices[i : i + 3])
            self.indices += (a, c, b) if flip else (a, b, c)
        return self

    def box_uvs(self, size):
        """Texture coordinates by projecting along the normal's main axis; size in metres of one repeat."""
        for i, (p, n) in enumerate(zip(self.positions, self.normals)):
            ax, ay, az = abs(n[0]), abs(n[1]), abs(n[2])
            if ay >= ax and ay >= az:
                uv = (p[0], p[2])
            elif ax >= az:
                uv = (-p[2] if n[0] > 0 else p[2], -p[1])
            else:
                uv = (p[0] if n[2] > 0 else -p[0], -p[1])
            self.uvs[i] = (uv[0] / size, uv[1] / size)
        return self


def plane(x0, z0, x1, z1, y=0.0):
    """One quad, facing up."""
    s = Shape()
    s.quad((x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0))
    return s


def patch(corner, u, v, steps_u, steps_v):
    """A rectangle of vertices from corner along u and v, facing u × v; texture coordinates 0 to 1."""
    s = Shape()
    normal = vec.normalize(vec.cross(u, v))
    for j in range(steps_v + 1):
        for i in range(steps_u + 1):
            a, b = i / steps_u, j / steps_v
            s.vertex(vec.add(corner, vec.add(vec.scale(u, a), vec.scale(v, b))), normal, (a, 1 - b))
    stitch(s, steps_u + 1, steps_v + 1)
    return s


def stitch(s, width, height, base=0):
    """Triangles over a grid of vertices that are in place: counter-clockwise where columns × rows faces out."""
    for j in range(height - 1):
        for i in range(width - 1):
            a = base + j * width + i
            s.indices += (a, a + 1, a + width + 1, a, a + width + 1, a + width)


def box(x0, y0, z0, x1, y1, z1, skip=""):
    """skip: faces left out, of "-x", "+x", …, in one string."""
    s = Shape()
    p = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    faces = {
        "-x": (0, 4, 6, 2),
        "+x": (5, 1, 3, 7),
        "-y": (0, 1, 5, 4),
        "+y": (6, 7, 3, 2),
        "-z": (1, 0, 2, 3),
        "+z": (4, 5, 7, 6),
    }
    for name, corners in faces.items():
        if name not in skip:
            s.quad(*(p[i] for i in corners))
    return s


def beveled_box(x0, y0, z0, x1, y1, z1, bevel):
    """A box whose twelve edges are cut by flat bevels and whose eight corners by triangles."""
    s = Shape()
    low, high = (x0, y0, z0), (x1, y1, z1)

    def corner(signs, pushed):
        # The corner's vertex on the face of axis `pushed`: on the face itself, inset along the other two.
        return tuple(
            (high[a] if signs[a] > 0 else low[a]) - (0 if a == pushed else bevel * signs[a]) for a in range(3)
        )

    def face(points, outward):
        normal = vec.cross(vec.sub(points[1], points[0]), vec.sub(points[2], points[0]))
        if vec.dot(normal, outward) < 0:
            points = points[::-1]
        if len(points) == 4:
            s.quad(*points)
        else:
            n = vec.normalize(outward)
            s.triangle(*(s.vertex(p, n) for p in points))

    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        for sign in (-1, 1):
            ring = []
            for sb, sc in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                signs = [0, 0, 0]
                signs[a], signs[b], signs[c] = sign, sb, sc
                ring.append(corner(signs, a))
            outward = [0, 0, 0]
            outward[a] = sign
            face(ring, outward)
            for sb in (-1, 1):
                ends = []
                for sc in (-1, 1):
                    signs = [0, 0, 0]
                    signs[a], signs[b], signs[c] = sign, sb, sc
                    ends.append((corner(signs, a), corner(signs, b)))
                outward = [0, 0, 0]
                outward[a], outward[b] = sign, sb
                face([ends[0][0], ends[1][0], ends[1][1], ends[0][1]], outward)
    for sx in (-1, 1):
        for sy in (-1, 1):
            for sz in (-1, 1):
                signs = (sx, sy, sz)
                face([corner(signs, a) for a in range(3)], signs)
    return s


def lathe(profile, segments, repeat_u=1.0, repeat_v=1.0):
    """Turns a profile of (radius, height) about +Y, from bottom to top for outside walls. A None in the profile is a
    crease: the normal breaks there. Radii of zero close the ends."""
    s = Shape()
    runs, run = [], []
    for point in profile:
        if point is None:
            last = run[-1]
            runs.append(run)
            run = [last]
        else:
            run.append(point)
    runs.append(run)
    for run in runs:
        _lathe_run(s, run, segments, repeat_u, repeat_v)
    return s


def _lathe_run(s, run, segments, repeat_u, repeat_v):
    normals = []
    for k in range(len(run)):
        a, b = run[max(k - 1, 0)], run[min(k + 1, len(run) - 1)]
        d = math.hypot(b[0] - a[0], b[1] - a[1])
        normals.append(((b[1] - a[1]) / d, -(b[0] - a[0]) / d))
    base = len(s.positions)
    travelled = 0.0
    for k, (radius, height) in enumerate(run):
        if k:
            travelled += math.hypot(radius - run[k - 1][0], height - run[k - 1][1])
        for i in range(segments + 1):
            angle = -2 * math.pi * (i % segments) / segments
            c, z = math.cos(angle), math.sin(angle)
            n = (c * normals[k][0], normals[k][1], z * normals[k][0])
            uv = (repeat_u * i / segments, -travelled * repeat_v)
            s.vertex((c * radius, height, z * radius), n, uv)
    width = segments + 1
    for k in range(len(run) - 1):
        for i in range(segments):
            a = base + k * width + i
            if run[k][0] > 0:
                s.triangle(a, a + 1, a + width + 1)
            if run[k + 1][0] > 0:
                s.triangle(a, a + width + 1, a + width)


def cylinder(radius, y0, y1, segments=16, top=None, caps=True):
    """A (tapering) cylinder about +Y."""
    top = radius if top is None else top
    profile = [(radius, y0), (top, y1)]
    if caps:
        profile = [(0.0, y0), (radius, y0), None, (top, y1), None, (0.0, y1)]
    return lathe(profile, segments)


def sphere(radius, segments=24, rings=12):
    profile = []
    for k in range(rings + 1):
        angle = math.pi * k / rings
        edge = k in (0, rings)
        profile.append((0.0 if edge else radius * math.sin(angle), -radius * math.cos(angle)))
    s = lathe(profile, segments)
    s.normals = [vec.normalize(p) for p in s.positions]
    return s


def rod(start, end, radius, segments=8, top=None, caps=True):
    """A cylinder from point to point."""
    length = vec.length(vec.sub(end, start))
    return Shape().add(cylinder(radius, 0.0, length, segments, top, caps), vec.along(start, end))


def tube(points, radii, segments=8):
    """A smooth tube through points with a radius at each; the ends are open."""
    s = Shape()
    travelled = 0.0
    side = None
    for k, p in enumerate(points):
        ahead = points[min(k + 1, len(points) - 1)]
        behind = points[max(k - 1, 0)]
        axis = vec.normalize(vec.sub(ahead, behind))
        if side is None:
            side = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.8 else (0.0, 0.0, 1.0)
        side = vec.normalize(vec.sub(side, vec.scale(axis, vec.dot(side, axis))))
        other = vec.cross(axis, side)
        if k:
            travelled += vec.length(vec.sub(p, points[k - 1]))
        for i in range(segments + 1):
            angle = 2 * math.pi * (i % segments) / segments
            n = vec.add(vec.scale(side, math.cos(angle)), vec.scale(other, math.sin(angle)))
            s.vertex(vec.add(p, vec.scale(n, radii[k])), n, (i / segments, -travelled))
    stitch(s, segments + 1, len(points))
    return s
