"""How much of the teeth on round bodies render.soft_terminator takes away, and what it costs: docs/command-line.md.

  terminator.py PROGRAM SCENE [OPTION...]    options of `penumbra render` for the view

Neighbouring pixels of one smooth body and colour, of which one shows a triangle that faces the sun and the other one that
faces away, are a step where their displayed colours differ by more than 8 of 255. Steps are what looks like teeth. The price
is the pixels of triangles that face the sun which are darker by more than 8 of 255. Drawn with --technique none, 640 x 360
pixels.
"""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "app"), str(ROOT / "tests" / "support")]

from pictures import read_exr, read_exr_header, read_png  # noqa: E402

WIDTH, HEIGHT, VISIBLE = 640, 360, 8


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def render(program, path, arguments, soft):
    subprocess.run([program, "render", *arguments, "--technique", "none", "--samples", "1", "--size", f"{WIDTH}x{HEIGHT}",
                    "--set", "render.dither=false", "--set", f"render.soft_terminator={soft}", "--quiet", "-o", path,
                    "--aov", "normal,geometric_normal,depth,albedo"], check=True)


def drawn(program, folder, arguments, soft):
    """The displayed green of each pixel, row by row."""
    path = folder / f"{soft}.png"
    render(program, path, arguments, soft)
    return [row[1::3] for row in read_png(path)[3]]


class View:
    """What the pixels show, whatever lights it."""

    def __init__(self, program, folder, arguments):
        path = folder / "view.exr"
        render(program, path, arguments, "false")
        layers = read_exr(path)
        self.sun = [float(part) for part in read_exr_header(path)["penumbra:sun.to_light"].split()]
        self.depth = layers["depth.Z"]
        self.albedo = [layers[f"albedo.{channel}"] for channel in "RGB"]
        self.smooth, self.flat = ([layers[f"{name}.{axis}"] for axis in "XYZ"] for name in ("normal", "geometric_normal"))

    def faces_sun(self, x, y):
        return dot([axis[y][x] for axis in self.flat], self.sun) > 0

    def same_body(self, a, b):
        (x, y), (u, v) = a, b
        near, far = sorted((self.depth[y][x], self.depth[v][u]))
        normals = dot([axis[y][x] for axis in self.smooth], [axis[v][u] for axis in self.smooth])
        colors = max(abs(channel[y][x] - channel[v][u]) for channel in self.albedo)
        return near > 0 and far - near < 0.02 * near and normals > 0.99 and colors < 0.02

    def edges(self):
        """Pairs of neighbours at which a smooth body turns away from the sun."""
        for y in range(HEIGHT - 1):
            for x in range(WIDTH - 1):
                for other in ((x + 1, y), (x, y + 1)):
                    if self.same_body((x, y), other) and self.faces_sun(x, y) != self.faces_sun(*other):
                        yield (x, y), other


def steps(picture, edges):
    sizes = [abs(picture[y][x] - picture[v][u]) for (x, y), (u, v) in edges]
    return sum(size > VISIBLE for size in sizes), max(sizes, default=0)


def main():
    program, arguments = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        view = View(program, folder, arguments)
        hard, soft = (drawn(program, folder, arguments, value) for value in ("false", "true"))
    edges = list(view.edges())
    lit = [(x, y) for y in range(HEIGHT) for x in range(WIDTH) if view.depth[y][x] > 0 and view.faces_sun(x, y)]
    darker = sum(hard[y][x] - soft[y][x] > VISIBLE for x, y in lit)
    (before, most_before), (after, most_after) = steps(hard, edges), steps(soft, edges)
    print(f"{len(edges)} pairs; steps {before} -> {after}, the largest {most_before} -> {most_after} of 255; "
          f"darker {darker} of {len(lit)} pixels ({100 * darker / max(len(lit), 1):.2f} %)")


if __name__ == "__main__":
    main()
