"""The scenes in the tree are what their generator writes, and what stands for solid things is closed."""

import collections
import subprocess
import sys

import support

sys.path.insert(0, str(support.ROOT / "scenes"))
from gen import exhibits, lamps  # noqa: E402


def open_edges(shape):
    """Edges that no triangle runs along in the other direction; vertices at one place count as one."""
    places = [tuple(round(c, 6) + 0.0 for c in p) for p in shape.positions]
    edges = collections.Counter()
    for i in range(0, len(shape.indices), 3):
        a, b, c = (places[k] for k in shape.indices[i:i + 3])
        if len({a, b, c}) == 3:
            for edge in ((a, b), (b, c), (c, a)):
                edges[edge] += 1
    return [edge for edge, count in edges.items() if edges[edge[::-1]] != count]


def volume(shape):
    """Of a closed shape; negative where its triangles face inwards."""
    total = 0.0
    for i in range(0, len(shape.indices), 3):
        a, b, c = (shape.positions[k] for k in shape.indices[i:i + 3])
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


class Scenes(support.TestCase):
    def test_generated(self):
        result = subprocess.run([sys.executable, support.ROOT / "scenes" / "generate.py", "--check"],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_solid_things_are_closed(self):
        outside, lining = lamps.shade()
        solids = {"knot": exhibits.knot(), "plate": exhibits.plate(0.4, 0.3), "shade": outside.add(lining),
                  "frame": exhibits.frame("gilt", 1.0, 0.7).shapes["gilt"]}
        for name, shape in solids.items():
            with self.subTest(name):
                self.assertEqual(open_edges(shape), [])
                self.assertGreater(volume(shape), 0)

    def test_normals_agree_with_triangles(self):
        knot = exhibits.knot()
        for i in range(0, len(knot.indices), 3):
            a, b, c = (knot.positions[k] for k in knot.indices[i:i + 3])
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            face = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            for k in knot.indices[i:i + 3]:
                self.assertGreater(sum(f * n for f, n in zip(face, knot.normals[k])), 0)

    def test_black_bodies(self):
        for kelvin in (2700.0, 3200.0, 4000.0, 4200.0):
            red, green, blue = lamps.black_body(kelvin)
            self.assertEqual(max(red, green, blue), 1)
            self.assertEqual(red > green > blue, kelvin < 4000, kelvin)
        # The published chromaticity of a black body of 2700 K, x = 0.4599, y = 0.4106, in linear sRGB.
        x, y = 0.4599, 0.4106
        z = 1 - x - y
        row = (3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.969266 * x + 1.8760108 * y + 0.041556 * z,
               0.0556434 * x - 0.2040259 * y + 1.0572252 * z)
        for a, b in zip(lamps.linear_srgb(2700.0), row):
            self.assertAlmostEqual(a * y, b, delta=0.004)


if __name__ == "__main__":
    support.main()
