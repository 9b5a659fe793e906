"""The tables and plots of docs/comparison.md, made by `penumbra compare`.

  comparison.py PROGRAM FOLDER    draws, measures and writes them; FOLDER gets the report of penumbra compare, which has
                                  each row's picture
  comparison.py --from FOLDER     writes them from a report that is there already
"""

import csv
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
              "brute_force", "hybrid")
OPTIONS = ("--sun-angle", "1", "--size", "1280x720", "--warmup", "0", "--cost-frames", "3", "--set", "maps.keep=off")

# How the parts of a plot look, which the report's page says in its style sheet.
LOOKS = {"grid": "fill='none' stroke='#e3e3e0'", "axis": "fill='none' stroke='#777'",
         "front": "fill='none' stroke='#b5541c' stroke-width='1.8' stroke-dasharray='5 4'",
         "dot": "fill='#777' stroke='#fff'", "dot on-front": "fill='#b5541c' stroke='#fff'",
         "tick": "fill='#555'", "axis-title": "fill='#555'", "label": "fill='#222'"}


def table(rows):
    lines = ["| technique | cost, ms | memory, MiB | PSNR penumbra, dB | PSNR all, dB | bias | FLIP |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        penumbra, whole = (f"{float(row[name]):.1f}" if row[name] else "-" for name in ("psnr_penumbra_db", "psnr_db"))
        lines.append(f"| `{row['technique']}` | {float(row['cost_median_ms']):.0f} | "
                     f"{int(row['shadow_bytes']) / 2**20:.1f} | {penumbra} | {whole} | {float(row['bias']):+.4f} | "
                     f"{float(row['flip']):.4f} |")
    return "\n".join(lines)


def sections(folder):
    with open(folder / "results.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    plots = re.findall(r"<svg viewBox='0 0 760 430'.*?</svg>", (folder / "index.html").read_text(encoding="utf-8"), re.S)
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    assert len(plots) == len(scenes)
    text = []
    for scene, plot in zip(scenes, plots):
        name = pathlib.Path(scene).stem
        opening, rest = plot.split(">", 1)
        rest = re.sub("class='([^']*)'", lambda match: LOOKS[match.group(1)], rest)
        picture = PICTURES / f"comparison_{name}.svg"
        picture.write_text(f"{opening} xmlns='http://www.w3.org/2000/svg' font-family='sans-serif' font-size='13'>"
                           f"<rect width='100%' height='100%' fill='#fff'/>{rest}\n", encoding="utf-8")
        text.append(f"## {name}\n\n![cost over error]({picture.relative_to(DOCUMENT.parent)})\n\n"
                    + table([row for row in rows if row["scene"] == scene]))
    return "\n\n".join(text)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])
    if sys.argv[1] != "--from":
        subprocess.run([sys.argv[1], "compare", *(f"scenes/{name}.glb" for name in SCENES), "-o", folder, "--technique",
                        ",".join(TECHNIQUES), *OPTIONS], cwd=ROOT, check=True)
    before = DOCUMENT.read_text(encoding="utf-8")
    head, rest = before.split("<!-- tables -->\n")
    DOCUMENT.write_text(head + "<!-- tables -->\n\n" + sections(folder) + "\n\n" + rest[rest.index("<!-- end -->"):],
                        encoding="utf-8")


if __name__ == "__main__":
    main()
