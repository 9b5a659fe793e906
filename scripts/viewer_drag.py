"""How quickly the viewer follows a drag of the camera: updates a second, time between two, and processor time of each.

    viewer_drag.py SCENE PROGRAM... [--seconds S] [--rounds N] [--size WIDTHxHEIGHT]

PROGRAM: a penumbra program; several take turns, so that a busy machine slows all of them. An update is a change of the
window's pixels. It needs Xvfb, openbox and xdotool.
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
from desktop import Desktop  # noqa: E402

PAUSE = 0.01  # seconds between two looks at the window
POINTER = 40  # pixels above the pointer, which is a part of the screen's pixels, that are left out


def processor_time(process):
    """Of all its threads, seconds."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def drag(desktop, viewer, seconds):
    """Returns the times of the updates and the processor time."""
    x0, y0 = desktop.client.position(viewer.window)
    left, top, right, bottom = viewer.box("picture")
    x, y = x0 + (left + right) // 2, y0 + (top + bottom) // 2
    box = (x0 + left, y0 + top, x0 + right, y - POINTER)
    desktop.client.move_pointer(x, y)
    desktop.xdotool("mousedown", 1)
    start, step = time.monotonic(), 0
    last, times, spent = None, [], 0
    while (now := time.monotonic()) < start + seconds:
        step += 1
        way = abs(step % 400 - 200)
        desktop.client.move_pointer(x - 100 + way, y)
        if (picture := desktop.checksum(*box)) != last:
            if not times:
                spent = processor_time(viewer.process.pid)
            last = picture
            times.append(now)
        time.sleep(PAUSE)
    spent = processor_time(viewer.process.pid) - spent
    desktop.xdotool("mouseup", 1)
    return times, spent


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--seconds", type=float, default=15)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", default="1278x700")
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    print(f"{'program':40} {'picture':>10} {'updates/s':>9} {'interval, ms':>12} {'CPU/update, ms':>14} {'load':>5}")
    with Desktop(max(1280, size[0] + 2), max(800, size[1] + 100)) as desktop:  # a frame and a title surround the window
        for _ in range(options.rounds):
            for program in options.programs:
                viewer_module.PROGRAM = program
                with viewer_module.Viewer(desktop, options.scene, "--defaults", size=size) as viewer:
                    drag(desktop, viewer, options.seconds / 3)  # shaders are compiled, the pace is found
                    times, spent = drag(desktop, viewer, options.seconds)
                    left, top, right, bottom = viewer.box("picture")
                intervals = [b - a for a, b in zip(times, times[1:])]
                if not intervals:
                    print(f"{program:40} fewer than two updates")
                    continue
                print(f"{program[-40:]:40} {right - left:>5}x{bottom - top:<4} {1 / statistics.mean(intervals):9.2f} "
                      f"{1000 * statistics.median(intervals):12.0f} {1000 * spent / len(intervals):14.0f} "
                      f"{os.getloadavg()[0]:5.1f}", flush=True)


if __name__ == "__main__":
    main()
