"""How soon the viewer's picture answers: a step of a drag, a click on a slider, and the end of a drag.

    viewer_latency.py SCENE PROGRAM... [--steps N] [--rounds N] [--size WIDTHxHEIGHT]

PROGRAM: a penumbra program; several take turns, so that a busy machine slows all of them. Medians, milliseconds: from a
step of the camera's drag and from a click on the slider of sun.angle to the first other picture, and from the release of
the button to the first picture at full size and to the last change. It needs Xvfb, openbox and xdotool.
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
from desktop import LEFT, Desktop  # noqa: E402
from viewer_drag import POINTER, after_release, drag  # noqa: E402

PAUSE = 0.004  # seconds between two looks at the window
STILL = 0.05  # seconds without a change between two steps of a drag
LONGEST = 20.0  # seconds that an answer may take


def picture_box(desktop, viewer):
    """The upper half of the picture on the screen, without what the pointer in its middle hides."""
    x0, y0 = desktop.client.position(viewer.window)
    left, top, right, bottom = viewer.box("picture")
    return x0 + left, y0 + top, x0 + right, y0 + (top + bottom) // 2 - POINTER


def wait_for_change(desktop, box, before):
    start = time.monotonic()
    while desktop.checksum(*box) == before:
        assert time.monotonic() < start + LONGEST, "no other picture"
        time.sleep(PAUSE)
    return time.monotonic() - start


def wait_until_still(desktop, box):
    last, since = desktop.checksum(*box), time.monotonic()
    while time.monotonic() < since + STILL:
        if (seen := desktop.checksum(*box)) != last:
            last, since = seen, time.monotonic()
        time.sleep(PAUSE)
    return last


def drag_steps(desktop, viewer, count):
    box = picture_box(desktop, viewer)
    x0, y0 = desktop.client.position(viewer.window)
    x, y = viewer.middle("picture")
    times = []
    for step in range(count):
        before = wait_until_still(desktop, box)
        desktop.client.move_pointer(x0 + x + 12 * (step % 2), y0 + y)
        times.append(wait_for_change(desktop, box, before))
    return times


def slider_clicks(desktop, viewer, count):
    viewer.rest()
    viewer.find("sun.angle")
    box = picture_box(desktop, viewer)
    left, top, right, bottom = viewer.box("sun.angle")
    times = []
    for click in range(count):
        viewer.rest()
        viewer.move(left + (right - left) * (5 + click % 2) // 8, (top + bottom) // 2)
        viewer.follow()
        before = desktop.checksum(*box)
        desktop.xdotool("click", LEFT)
        times.append(wait_for_change(desktop, box, before))
    return times


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--steps", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--size", default="1278x698")
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    print(f"{'program':40} {'picture':>10} {'step':>5} {'slider':>6} {'full':>5} {'end':>5} {'load':>5}")
    with Desktop(size[0] + 2, size[1] + 22) as desktop:  # a frame and a title surround the window
        for _ in range(options.rounds):
            for program in options.programs:
                viewer_module.PROGRAM = program
                with viewer_module.Viewer(desktop, options.scene, "--defaults", size=size) as viewer:
                    ends = []
                    for _ in range(max(options.steps // 2, 2)):
                        drag(desktop, viewer, 3)
                        ends.append(after_release(desktop, viewer))
                    drag(desktop, viewer, 1)
                    steps = drag_steps(desktop, viewer, options.steps)
                    desktop.xdotool("mouseup", LEFT)
                    clicks = slider_clicks(desktop, viewer, options.steps)
                    left, top, right, bottom = viewer.box("picture")
                full, end = (statistics.median(times) for times in zip(*ends[1:]))  # the first compiles shaders
                figures = [statistics.median(steps), statistics.median(clicks), full, end]
                print(f"{program[-40:]:40} {right - left:>5}x{bottom - top:<4} " +
                      " ".join(f"{1000 * each:{width}.0f}" for each, width in zip(figures, (5, 6, 5, 5))) +
                      f" {os.getloadavg()[0]:5.1f}", flush=True)


if __name__ == "__main__":
    main()
