"""How the error of a technique falls with its taps: error_over_taps.py SCENE -o FILE.csv

Draws the shadows of a scene with more and more taps, and compares each with ray-traced truth. The figures go to a CSV
file; where Matplotlib is installed, a plot of them is written beside it. The parts between "# %%" are the cells of a
notebook.
"""

# %% The scene and what is measured
import argparse
import csv
import pathlib

import penumbra

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("scene")
parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="CSV file to write")
parser.add_argument("--technique", default="pcss")
parser.add_argument("--param", default="pcss.filter_taps")
parser.add_argument("--taps", type=int, nargs="+", default=[2, 4, 8, 16, 32, 64, 128])
parser.add_argument("--size", default="320x180")
parser.add_argument("--sun-angle", type=float, default=2)
parser.add_argument("--spp", type=int, default=64, help="rays of each pixel of the truth")
options = parser.parse_args()

scene = penumbra.open(options.scene, size=options.size, sun_angle=options.sun_angle)
scene.select(options.technique)

# %% The truth, which is traced once
truth = scene.truth(samples=options.spp)

# %% A picture and its error for each number of taps
rows = []
for taps in options.taps:
    scene[options.param] = taps
    figures = penumbra.difference(scene.render("shadow"), truth["shadow"], truth["receiver"])
    rows.append({"taps": taps, "rmse": figures["rmse"], "psnr_penumbra": figures["psnr_penumbra"]})
    print(f"{taps:4} taps: rms error {figures['rmse']:.4f}, {figures['psnr_penumbra']:.2f} dB in penumbrae")

options.output.parent.mkdir(parents=True, exist_ok=True)
with options.output.open("w", newline="") as file:
    writer = csv.DictWriter(file, rows[0])
    writer.writeheader()
    writer.writerows(rows)

# %% The plot
try:
    import matplotlib
except ImportError:
    print(f"wrote {options.output}; with Matplotlib there would be a plot, too")
else:
    matplotlib.use("Agg")  # a file, without a display
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(layout="constrained")
    axes.loglog(options.taps, [row["rmse"] for row in rows], marker="o")
    axes.set_title(f"{options.technique}, {options.spp} rays a pixel for the truth")
    axes.set_xlabel(options.param)
    axes.set_xticks(options.taps, options.taps)
    axes.set_xticks([], minor=True)
    axes.set_ylabel("rms error")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter("{x:g}")
    figure.savefig(options.output.with_suffix(".png"))
    print(f"wrote {options.output} and {options.output.with_suffix('.png')}")
