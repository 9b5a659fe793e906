"""How the ray-traced truth converges: docs/pictures/truth_convergence.svg.

  convergence.py PROGRAM

RMSE over the receivers of scenes/knife_edge.glb, 96 x 54 pixels under a sun of 8 degrees, of 64 to 4096 rays a pixel
against 65,536 rays of another seed; and the slope of a line through its logarithms, which is printed.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
RAYS = (64, 128, 256, 512, 1024, 2048, 4096)
WIDTH, HEIGHT, LEFT, BOTTOM = 480, 300, 70, 50


def errors(program):
    def trace(path, rays, seed):
        subprocess.run([program, "truth", ROOT / "scenes/knife_edge.glb", "-o", path, "--camera", "top", "--sun-angle", "8",
                        "--size", "96x54", "--spp", str(rays), "--seed", str(seed), "--quiet", "--no-cache"], check=True)

    with tempfile.TemporaryDirectory() as folder:
        converged, traced = pathlib.Path(folder) / "converged.exr", pathlib.Path(folder) / "traced.exr"
        trace(converged, 65536, 1)
        for rays in RAYS:
            trace(traced, rays, 0)
            printed = subprocess.run([program, "diff", traced, converged, "--layer", "shadow", "--mask", "receiver",
                                      "--json", "-"], check=True, capture_output=True, text=True).stdout
            yield json.loads(printed)["figures"]["rmse"]


def slope_of(values):
    xs, ys = [math.log(n) for n in RAYS], [math.log(v) for v in values]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    slope = sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)
    return slope, my - slope * mx


def svg(values, slope, offset):
    top, bottom = 10 ** math.ceil(math.log10(max(values))), 10 ** math.floor(math.log10(min(values)))

    def x(rays):
        return LEFT + (WIDTH - LEFT - 20) * math.log(rays / RAYS[0]) / math.log(RAYS[-1] / RAYS[0])

    def y(value):
        return 20 + (HEIGHT - BOTTOM - 20) * math.log(top / value) / math.log(top / bottom)

    def text(at_x, at_y, what, anchor="middle", more=""):
        return f'<text x="{at_x:.1f}" y="{at_y:.1f}" text-anchor="{anchor}"{more}>{what}</text>'

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>']
    for rays in RAYS:
        parts += [f'<path d="M{x(rays):.1f} 20V{HEIGHT - BOTTOM}" stroke="#ddd"/>', text(x(rays), HEIGHT - BOTTOM + 18, rays)]
    for power in range(round(math.log10(bottom)), round(math.log10(top)) + 1):
        parts += [f'<path d="M{LEFT} {y(10 ** power):.1f}H{WIDTH - 20}" stroke="#ddd"/>',
                  text(LEFT - 8, y(10 ** power) + 4, f"{10 ** power:g}", "end")]
    ends = [(n, math.exp(offset + slope * math.log(n))) for n in (RAYS[0], RAYS[-1])]
    parts.append(f'<path d="M{x(ends[0][0]):.1f} {y(ends[0][1]):.1f}L{x(ends[1][0]):.1f} {y(ends[1][1]):.1f}" stroke="#d97" '
                 'stroke-width="2"/>')
    parts += [f'<circle cx="{x(n):.1f}" cy="{y(v):.1f}" r="4" fill="#246"/>' for n, v in zip(RAYS, values)]
    parts += [text((LEFT + WIDTH) / 2, HEIGHT - 10, "rays a pixel"),
              text(18, HEIGHT / 2 - 10, "RMSE", more=f' transform="rotate(-90 18 {HEIGHT / 2 - 10:.0f})"'),
              text(WIDTH - 30, 38, f"rays to the power of {slope:.2f}", "end", ' fill="#a53"')]
    return "\n".join([*parts, "</svg>", ""])


def main():
    values = list(errors(sys.argv[1]))
    slope, offset = slope_of(values)
    (ROOT / "docs/pictures/truth_convergence.svg").write_text(svg(values, slope, offset))
    for rays, value in zip(RAYS, values):
        print(f"{rays:5d} {value:.6f}")
    print(f"slope {slope:.3f}")


if __name__ == "__main__":
    main()
