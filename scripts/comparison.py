"""The tables and plots of docs/comparison.md, made by `penumbra compare`.

  comparison.py PROGRAM FOLDER    draws, measures and writes them; FOLDER gets two reports of penumbra compare, which have
                                  each row's picture: FOLDER/defaults, and FOLDER/costs with each technique's LADDERS
  comparison.py --from FOLDER     writes them from reports that are there already
"""

import csv
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCUMENT = ROOT / "docs" / "comparison.md"
PICTURES = ROOT / "docs" / "pictures"

SCENES = ("courtyard", "foliage", "fence", "steps", "thesis")
TECHNIQUES = ("none", "hard", "shadow_volume", "pcf_hardware", "pcf_tent", "pcf", "pcf_poisson", "vsm", "evsm", "msm", "esm",
              "csm_fourier", "cssm", "vssm", "ssss", "pcss", "thesis_8x8", "slices", "slices_denoised", "backprojection",
              "brute_force", "hybrid", "hybrid_denoised")
OPTIONS = ("--sun-angle", "1", "--size", "1280x720", "--warmup", "0", "--cost-frames", "3", "--set", "maps.keep=off")

# Settings of each technique, from cheap to dear, of which the tables at equal cost show the one whose cost is nearest to
# that of pcss with its defaults.
LADDERS = {
    "hard": ("cascades.size=2048", "cascades.size=3072", "cascades.size=4096"),
    "shadow_volume": ("",),
    "pcf_hardware": ("cascades.size=2048", "cascades.size=3072"),
    "pcf_tent": ("pcf_tent.width=3", "pcf_tent.width=5", "pcf_tent.width=7", "pcf_tent.width=11", "pcf_tent.width=15"),
    "pcf": ("pcf.filter_taps=16", "pcf.filter_taps=24", "pcf.filter_taps=48", "pcf.filter_taps=96"),
    "pcf_poisson": ("pcf_poisson.taps=16", "pcf_poisson.taps=32", "pcf_poisson.taps=64", "pcf_poisson.taps=128"),
    "vsm": ("cascades.size=1024", "vsm.shrink=4", ""),
    "evsm": ("cascades.size=1024", "evsm.shrink=4,evsm.warps=1", "evsm.shrink=4"),
    "msm": ("cascades.size=1024", "msm.shrink=4,msm.format=unorm16", "msm.shrink=4"),
    "esm": ("cascades.size=1024", "cascades.size=1024,esm.fallback_taps=4", "esm.shrink=4"),
    "csm_fourier": ("cascades.size=512,csm_fourier.terms=4", "cascades.size=1024,csm_fourier.terms=4",
                    "csm_fourier.shrink=4,csm_fourier.terms=2", "csm_fourier.shrink=4,csm_fourier.terms=4"),
    "cssm": ("cascades.size=512,cssm.terms=2", "cascades.size=512,cssm.terms=4", "cascades.size=1024,cssm.terms=4"),
    "vssm": ("cascades.size=1024,vssm.cells=2", "cascades.size=1024", "depth_sums.shrink=8,vssm.cells=2",
             "depth_sums.shrink=4"),
    "ssss": ("ssss.search_taps=8,ssss.taps=8", "ssss.search_taps=8,ssss.taps=16", "ssss.search_taps=12,ssss.taps=24", ""),
    "pcss": ("",),
    "thesis_8x8": ("pcss.blocker_taps=4,pcss.filter_taps=4", ""),
    "slices": ("slices.azimuths=5,slices.samples=6", "slices.azimuths=6,slices.samples=8", ""),
    "slices_denoised": ("slices.azimuths=3,slices.samples=6", "slices.azimuths=4,slices.samples=6",
                        "slices.azimuths=4,slices.samples=8"),
    "backprojection": ("backprojection.reads=3,backprojection.masks=2", "backprojection.reads=3",
                       "backprojection.reads=5,backprojection.masks=4"),
    "brute_force": ("brute_force.blocker_taps=16,brute_force.filter_taps=16",
                    "brute_force.blocker_taps=24,brute_force.filter_taps=32",
                    "brute_force.blocker_taps=32,brute_force.filter_taps=64"),
    "hybrid": ("hybrid.rays=8", ""),
    "hybrid_denoised": ("hybrid.rays=8,hybrid.narrow=0", "hybrid.rays=8", ""),
}
EQUAL = 1.25  # a cost is equal to another if neither is more than this times the other

# How the parts of a plot look, which the report's page says in its style sheet.
LOOKS = {"grid": "fill='none' stroke='#e3e3e0'", "axis": "fill='none' stroke='#777'",
         "front": "fill='none' stroke='#b5541c' stroke-width='1.8' stroke-dasharray='5 4'",
         "dot": "fill='#777' stroke='#fff'", "dot on-front": "fill='#b5541c' stroke='#fff'",
         "tick": "fill='#555'", "axis-title": "fill='#555'", "label": "fill='#222'"}


HEAD = ("| technique | {}cost, ms | memory, MiB | PSNR penumbra, dB | PSNR, dB | bias | FLIP |",
        "| --- | {}--- | --- | --- | --- | --- | --- |")


def figures(row):
    penumbra, whole = (f"{float(row[name]):.1f}" if row[name] else "-" for name in ("psnr_penumbra", "psnr"))
    return (f"{float(row['cost_median_ms']):.0f} | {int(row['shadow_bytes']) / 2**20:.1f} | {penumbra} | {whole} | "
            f"{float(row['bias']):+.4f} | {float(row['flip']):.4f} |")


def table(rows):
    return "\n".join([line.format("") for line in HEAD] + [f"| `{row['technique']}` | {figures(row)}" for row in rows])


def read_rows(folder):
    with open(folder / "results.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def names_of(scenes_rows):
    return list(dict.fromkeys(row["scene"] for row in scenes_rows))


def cost(row):
    return float(row["cost_median_ms"])


def at_equal_cost(rows):
    """The table of one scene's rows nearest to the cost of pcss, and a line that names techniques without any."""
    goal = next(cost(row) for row in rows if row["technique"] == "pcss")
    chosen, apart = [], []
    for name in LADDERS:
        own = [row for row in rows if row["technique"].split(":")[0] == name]
        nearest = min(own, key=lambda row: abs(math.log(cost(row) / goal)))
        (chosen if max(cost(nearest) / goal, goal / cost(nearest)) <= EQUAL else apart).append(nearest)
    lines = [line.format("settings | " if line is HEAD[0] else "--- | ") for line in HEAD]
    for row in chosen:
        name, _, settings = row["technique"].partition(":")
        settings = " ".join(f"`{setting}`" for setting in settings.split(",") if setting) or "defaults"
        lines.append(f"| `{name}` | {settings} | {figures(row)}")
    missing = ", ".join(f"`{row['technique'].split(':')[0]}` ({cost(row):.0f} ms)" for row in apart)
    return "\n".join(lines) + (f"\n\nWithout a setting near it (the nearest cost): {missing}." if missing else "")


def sections(folder):
    rows, priced = read_rows(folder / "defaults"), read_rows(folder / "costs")
    page = (folder / "defaults" / "index.html").read_text(encoding="utf-8")
    plots = re.findall(r"<svg viewBox='0 0 760 430'.*?</svg>", page, re.S)
    scenes = names_of(rows)
    assert len(plots) == len(scenes) and names_of(priced) == scenes
    text = []
    for scene, plot in zip(scenes, plots):
        name = pathlib.Path(scene).stem
        opening, rest = plot.split(">", 1)
        rest = re.sub("class='([^']*)'", lambda match: LOOKS[match.group(1)], rest)
        picture = PICTURES / f"comparison_{name}.svg"
        picture.write_text(f"{opening} xmlns='http://www.w3.org/2000/svg' font-family='sans-serif' font-size='13'>"
                           f"<rect width='100%' height='100%' fill='#fff'/>{rest}\n", encoding="utf-8")
        text.append(f"## {name}\n\n![cost over error]({picture.relative_to(DOCUMENT.parent)})\n\n"
                    + table([row for row in rows if row["scene"] == scene])
                    + "\n\nAt the cost of `pcss`:\n\n"
                    + at_equal_cost([row for row in priced if row["scene"] == scene]))
    return "\n\n".join(text)


def compare(program, folder, techniques):
    subprocess.run([program, "compare", *(f"scenes/{name}.glb" for name in SCENES), "-o", folder, "--technique",
                    ",".join(techniques), *OPTIONS], cwd=ROOT, check=True)


def settings_of(name):
    return [f"{name}:{settings}" if settings else name for settings in LADDERS[name]]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2]).resolve()
    if sys.argv[1] != "--from":
        program = pathlib.Path(sys.argv[1]).resolve()
        compare(program, folder / "defaults", TECHNIQUES)
        compare(program, folder / "costs", [row for name in LADDERS for row in settings_of(name)])
    before = DOCUMENT.read_text(encoding="utf-8")
    head, rest = before.split("<!-- tables -->\n")
    DOCUMENT.write_text(head + "<!-- tables -->\n\n" + sections(folder) + "\n\n" + rest[rest.index("<!-- end -->"):],
                        encoding="utf-8")


if __name__ == "__main__":
    main()
