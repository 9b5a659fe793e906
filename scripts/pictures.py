"""The pictures of docs/techniques.md and docs/command-line.md, drawn by the program.

  pictures.py PROGRAM            draws all into docs/pictures
  pictures.py PROGRAM NAME...    draws these
  pictures.py --list             their names

Every picture is the shadow mask of a scene of scenes/ (or another picture of the frame, where its row says so).
"""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "pictures"

# A place with sharp and soft edges, one that is all penumbra, one where things move.
SOFT = ["scenes/courtyard.glb", "--camera", "fountain", "--sun-angle", "3", "--size", "320x180"]
WIDE = ["scenes/thesis.glb", "--size", "320x180"]
MOVING = ["scenes/moving.glb", "--size", "320x180", "--sun-angle", "2"]
FEW = ["--technique", "thesis_8x8", "--set", "filter.penumbra=none", "--set", "filter.visibility=none"]


def techniques():
    return {f"technique_{name}": SOFT + ["--technique", name]
            for name in ("none", "hard", "shadow_volume", "pcf", "pcf_hardware", "pcf_tent", "pcf_poisson", "vsm", "evsm",
                         "msm", "esm", "csm_fourier", "cssm", "pcss", "slices", "backprojection", "ssss", "vssm",
                         "brute_force", "hybrid", "hybrid_denoised", "thesis_8x8")}


def volumes():
    wires = ["scenes/fence.glb", "--size", "320x180", "--set", "cascades.size=1024"]
    return {f"volume_{name}": wires + ["--technique", name] for name in ("hard", "shadow_volume")}


def layers():
    below = WIDE + ["--sun-angle", "2", "--technique"]
    fine = [setting for name in ("azimuths", "samples") for setting in ("--set", f"slices.{name}=32")]
    rows = {f"layers_{count}": below + ["slices", *fine, "--set", f"maps.layers={count}"] for count in (1, 2)}
    return {**rows, "layers_truth": below + ["truth"]}


def screen_space():
    # A post hides a part of its shadow; a shadow wider than the picture.
    post = ["scenes/posts.glb", "--eye", "3.8,1.7,-1.95", "--target", "-1,0,-2.05", "--fov", "30", "--sun-angle", "8",
            "--size", "320x180", "--technique"]
    return {"screen_silhouette": post + ["ssss"], "screen_silhouette_truth": post + ["truth"],
            "screen_outside": WIDE + ["--sun-angle", "2", "--technique", "ssss"]}


def patterns():
    names = ("vogel", "regular", "uniform", "poisson", "poisson_hierarchical", "hammersley", "halton")
    return {f"pattern_{name}": WIDE + FEW + ["--set", f"sampling.filter_pattern={name}", "--set",
                                             f"sampling.blocker_pattern={name}", "--set", "sampling.noise=none"]
            for name in names}


def noises():
    return {f"noise_{name}": WIDE + FEW + ["--set", "pcss.filter_taps=1", "--set", f"sampling.noise={name}"]
            for name in ("none", "white", "blue", "void_and_cluster", "interleaved_gradient", "spatiotemporal",
                         "heitz_belcour")}


def filters():
    rows = {f"filter_{name}": SOFT + ["--technique", "thesis_8x8", "--set", f"filter.visibility={name}"]
            for name in ("none", "box", "gaussian", "bilateral_separable")}
    for name in ("none", "median"):
        rows[f"filter_penumbra_{name}"] = (SOFT + ["--technique", "thesis_8x8", "--set", "pcss.blocker_taps=4", "--set",
                                                    f"filter.penumbra={name}"], "penumbra")
    return rows


def failures():
    scene = ["scenes/failures.glb", "--size", "320x180"]
    wide = [setting for name in ("vsm", "evsm", "esm") for setting in ("--set", f"{name}.radius=0.2")]
    settings = {"vsm": ["--set", "vsm.bleeding=0"], "esm": ["--set", "esm.classification=none"],
                "csm_fourier": ["--set", "csm_fourier.terms=4"]}
    shown = {"bleeding": ("vsm", "evsm", "truth"), "contact": ("csm_fourier", "msm", "truth"),
             "shelf": ("esm", "vsm", "truth")}
    return {f"failure_{camera}_{name}": scene + wide + ["--camera", camera, "--technique", name] + settings.get(name, [])
            for camera, names in shown.items() for name in names}


def histories():
    still = MOVING + ["--technique", "thesis", "--frames", "44:60"]
    rows = {f"history_map_{name}": still + ["--set", f"movement.map={name}"] for name in ("none", "maximum")}
    rows["history_refused"] = (MOVING + ["--technique", "thesis", "--frames", "44:46"], "history")
    return rows


def terminator():
    balls = {"moving": ["--eye=-2.1,0.7,3.6", "--target=-2.05,0.5,2.4", "--fov", "32"],
             "thesis": ["--eye=-0.25,0.6,1.3", "--target=-0.25,0.35,-0.7", "--fov", "25"]}
    return {f"terminator_{scene}_{soft}": ([f"scenes/{scene}.glb", "--size", "320x200", "--sun", "90,25", *view, "--set",
                                            f"render.soft_terminator={soft}"], "color")
            for scene, view in balls.items() for soft in ("false", "true")}


PICTURES = {**techniques(), **volumes(), **layers(), **screen_space(), **patterns(), **noises(), **filters(), **failures(),
            **histories(), **terminator()}


def options_of(name):
    """Options of `penumbra render`, and what their last picture is called behind a full stop, if it is an AOV."""
    row = PICTURES[name]
    arguments, aov = row if isinstance(row, tuple) else (row, "shadow")
    return (arguments, "") if aov == "color" else (arguments + ["--aov", aov], f".{aov}")


def draw(program, name):
    arguments, aov = options_of(name)
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / ("p_#.png" if "--frames" in arguments else "p.png")
        subprocess.run([program, "render", *arguments, "-o", picture, "--quiet"], cwd=ROOT, check=True)
        made = sorted(pathlib.Path(folder).glob(f"*{aov}.png"))[-1]
        (FOLDER / f"{name}.png").write_bytes(made.read_bytes())


def main():
    if "--list" in sys.argv:
        print("\n".join(PICTURES))
        return
    FOLDER.mkdir(exist_ok=True)
    for name in sys.argv[2:] or PICTURES:
        draw(pathlib.Path(sys.argv[1]).resolve(), name)


if __name__ == "__main__":
    main()
