"""How soon the viewer answers a click on its panel while it draws a full picture, and at rest.

    viewer_clicks.py SCENE PROGRAM... [--clicks N] [--rounds N] [--size WIDTHxHEIGHT]

PROGRAM: a penumbra program; several take turns, so that a busy machine slows all of them. Each click is on a tab, some
time after the camera has moved, and is answered when the panel's pixels change. It needs Xvfb, openbox and xdotool.
"""

import argparse
import os
import pathlib
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "support"))

import viewer as viewer_module  # noqa: E402
from desktop import LEFT, RIGHT, Desktop  # noqa: E402

PAUSE = 0.005  # seconds between two looks at the window
LONGEST = 20.0  # seconds that an answer may take
TABS = ("tab Scene", "tab Shadow")
REST = 0.25  # seconds after the last motion, when the full picture begins


def turn_sun(desktop, viewer):
    x, y = viewer.middle("picture")
    viewer.move(x, y)
    desktop.xdotool("mousedown", RIGHT)
    for step in (0, 20, 40):
        viewer.follow()
        viewer.move(x + step, y)
    viewer.follow()
    desktop.xdotool("mouseup", RIGHT)


def answer_time(desktop, viewer, tab, delay):
    """Seconds from a click on a tab to its answer. `delay`: after a full picture could begin; None: at rest."""
    x0, y0 = desktop.client.position(viewer.window)
    _, _, _, below = viewer.box(tab)
    left, _, _, bottom = viewer.box("picture")
    box = (x0, y0 + below + 4, x0 + left - 8, y0 + bottom)
    if delay is not None:
        turn_sun(desktop, viewer)
    viewer.move(*viewer.middle(tab))
    time.sleep(REST + (delay or 0))
    before = desktop.checksum(*box)
    start = time.monotonic()
    desktop.xdotool("click", LEFT)
    while desktop.checksum(*box) == before:
        assert time.monotonic() < start + LONGEST, "no answer"
        time.sleep(PAUSE)
    return time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--clicks", type=int, default=12)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", default="1898x1050")
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    print(f"{'program':40} {'picture':>10} {'at rest, ms':>11} {'median, ms':>10} {'largest, ms':>11} {'load':>5}")
    with Desktop(1920, 1080) as desktop:
        for _ in range(options.rounds):
            for program in options.programs:
                viewer_module.PROGRAM = program
                with viewer_module.Viewer(desktop, options.scene, "--defaults", size=size) as viewer:
                    times, rests = [], []
                    for click in range(options.clicks):
                        delay = 0.1 + 0.6 * click / options.clicks  # within the time that the picture takes
                        times.append(answer_time(desktop, viewer, TABS[0], delay))
                        viewer.rest()
                        rests.append(answer_time(desktop, viewer, TABS[1], None))
                        viewer.rest()
                    left, top, right, bottom = viewer.box("picture")
                print(f"{program[-40:]:40} {right - left:>5}x{bottom - top:<4} {1000 * statistics.median(rests):11.0f} "
                      f"{1000 * statistics.median(times):10.0f} "
                      f"{1000 * max(times):11.0f} {os.getloadavg()[0]:5.1f}", flush=True)


if __name__ == "__main__":
    main()
