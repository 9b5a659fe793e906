"""How quickly the viewer follows a drag of the camera: updates a second, time between two, and processor time of each;
and how soon after the button's release it shows the first picture at full size, and the last change.

    viewer_drag.py SCENE PROGRAM... [--seconds S] [--rounds N] [--size WIDTHxHEIGHT]

PROGRAM: a penumbra program; several take turns, so that a busy machine slows all of them. An update is a change of the
window's pixels. The first picture at full size is the first that differs from the last one by 3 levels of 255 at most, on
average: those in motion differ by more, as their shadows are others. It needs Xvfb, openbox and xdotool.
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
AT_REST = 1.5  # seconds without a change after which there will be none
ALIKE = 3.0  # levels of 255
POINTER = 40  # pixels above the pointer, which is a part of the screen's pixels, that are left out


def processor_time(process):
    """Of all its threads, seconds."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def drag(desktop, viewer, seconds):
    """Returns the times of the updates and the processor time. The button is still down then."""
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
    return times, spent


def difference(one, other):
    """Of the green of two results of some_rows(), levels on average."""
    return statistics.mean(abs(a - b) for a, b in zip(one[1::20], other[1::20]))


def after_release(desktop, viewer):
    """Seconds from the release of the button to the first picture at full size, and to the last change. The pointer
    rests where a drag has left it, with the button down."""
    x0, y0 = desktop.client.position(viewer.window)
    left, top, right, bottom = viewer.box("picture")
    box = (x0 + left, y0 + top, x0 + right, y0 + (top + bottom) // 2 - POINTER)
    moving = desktop.some_rows(*box)
    desktop.xdotool("mouseup", 1)
    start = time.monotonic()
    pictures = [(start, moving)]
    while (now := time.monotonic()) < pictures[-1][0] + AT_REST or not viewer.has("idle"):
        if (seen := desktop.some_rows(*box)) != pictures[-1][1]:
            pictures.append((now, seen))
        time.sleep(PAUSE)
    last = pictures[-1][1]
    first = next(at for at, seen in pictures if difference(seen, last) <= ALIKE)
    return first - start, pictures[-1][0] - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scene")
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--seconds", type=float, default=15)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", default="1278x700")
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    print(f"{'program':40} {'picture':>10} {'updates/s':>9} {'interval, ms':>12} {'CPU/update, ms':>14} "
          f"{'full, ms':>8} {'end, ms':>7} {'load':>5}")
    with Desktop(max(1280, size[0] + 2), max(800, size[1] + 100)) as desktop:  # a frame and a title surround the window
        for _ in range(options.rounds):
            for program in options.programs:
                viewer_module.PROGRAM = program
                with viewer_module.Viewer(desktop, options.scene, "--defaults", size=size) as viewer:
                    drag(desktop, viewer, options.seconds / 3)  # shaders are compiled, the pace is found
                    after_release(desktop, viewer)
                    times, spent = drag(desktop, viewer, options.seconds)
                    full, end = after_release(desktop, viewer)
                    left, top, right, bottom = viewer.box("picture")
                intervals = [b - a for a, b in zip(times, times[1:])]
                if not intervals:
                    print(f"{program:40} fewer than two updates")
                    continue
                print(f"{program[-40:]:40} {right - left:>5}x{bottom - top:<4} {1 / statistics.mean(intervals):9.2f} "
                      f"{1000 * statistics.median(intervals):12.0f} {1000 * spent / len(intervals):14.0f} "
                      f"{1000 * full:8.0f} {1000 * end:7.0f} {os.getloadavg()[0]:5.1f}", flush=True)


if __name__ == "__main__":
    main()
