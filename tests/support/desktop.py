"""A virtual desktop for one test: an X server without a screen, a window manager, and simulated input."""

import ctypes
import dataclasses
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib

from x11 import PATIENCE, Connection

LEFT, MIDDLE, RIGHT, WHEEL_UP, WHEEL_DOWN = 1, 2, 3, 4, 5
_libc = ctypes.CDLL(None)


def wait_for(condition, what, pause=0.03):
    """Waits until the condition returns something true, and returns that; fails after a long time."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        time.sleep(pause)
    raise AssertionError(f"waited in vain for {what() if callable(what) else what}")


def start(command, **options):
    """Starts a process in its own process group. It ends with the test, also if the test is killed."""
    prctl_death_signal = 1
    return subprocess.Popen(list(map(str, command)), start_new_session=True,
                            preexec_fn=lambda: _libc.prctl(prctl_death_signal, signal.SIGKILL), **options)


def end(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


@dataclasses.dataclass
class Picture:
    """A picture of 8-bit RGB, rows top to bottom."""

    width: int
    height: int
    rows: list

    def crop(self, left, top, right, bottom):
        left, top, right, bottom = max(left, 0), max(top, 0), min(right, self.width), min(bottom, self.height)
        return Picture(right - left, bottom - top, [row[3 * left:3 * right] for row in self.rows[top:bottom]])

    def colors(self):
        return set().union(*(_pixels(row) for row in self.rows))

    def differing(self, other, by=0):
        """The share of pixels with a channel that differs by more than so many levels."""
        assert (self.width, self.height) == (other.width, other.height), "pictures of different sizes"
        count = 0
        for row, others in zip(self.rows, other.rows):
            if row != others:
                count += sum(abs(r - red) > by or abs(g - green) > by or abs(b - blue) > by
                             for (r, g, b), (red, green, blue) in zip(_pixels(row), _pixels(others)))
        return count / (self.width * self.height)

    def save_png(self, path):
        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

        path = pathlib.Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        lines = b"".join(b"\0" + row for row in self.rows)
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 1)) +
                         chunk(b"IEND", b""))


class Desktop:
    """To be used in a with statement. Xvfb, openbox and xdotool are needed: without one of them tests fail."""

    def __init__(self, width=1280, height=720, resources=""):
        self._size, self._resources = (width, height), resources
        self.corner = width - 1, height - 1

    def __enter__(self):
        for program in ("Xvfb", "openbox", "xdotool"):
            assert shutil.which(program), f"there is no {program}: scripts/packages.txt lists what tests need"
        self._folder = tempfile.TemporaryDirectory(prefix="penumbra-desktop-", ignore_cleanup_errors=True)
        self._processes = []
        try:
            self._start_server()
            self.client = Connection(self.name)
            if self._resources:
                self.client.set_resources(self._resources)
            self._start_manager()
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(self, *_):
        self.client.close()
        self._stop()

    def _stop(self):
        for process in reversed(self._processes):
            end(process)
        self._folder.cleanup()

    def _start_server(self):
        readable, writable = os.pipe()
        width, height = self._size
        # -noreset: otherwise the server frees all resources when its last client disconnects.
        self._processes.append(start(
            ["Xvfb", "-displayfd", writable, "-screen", "0", f"{width}x{height}x24", "-fbdir", self._folder.name,
             "-nolisten", "tcp", "-noreset"], pass_fds=(writable,), stderr=subprocess.DEVNULL))
        os.close(writable)
        with os.fdopen(readable) as pipe:
            number = pipe.readline().strip()
        assert number, "Xvfb did not start"
        self.name = f":{number}"

    def _start_manager(self):
        self._processes.append(start(["openbox"], env=self.environment(), stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL))
        wait_for(lambda: self._xdotool("get_num_desktops", check=False).returncode == 0, "openbox")

    def environment(self):
        variables = {key: value for key, value in os.environ.items() if key != "WAYLAND_DISPLAY"}
        return {**variables, "DISPLAY": self.name, "XDG_CONFIG_HOME": f"{self._folder.name}/config"}

    def _xdotool(self, *arguments, check=True):
        result = subprocess.run(["xdotool", *map(str, arguments)], capture_output=True, text=True,
                                env=self.environment(), timeout=PATIENCE)
        assert not check or result.returncode == 0, f"xdotool {arguments}: {result.stderr}"
        return result

    def xdotool(self, *arguments):
        return self._xdotool(*arguments).stdout.strip()

    def keyboard(self, layout):
        """Makes it a keyboard of that layout, such as "de"."""
        subprocess.run(["setxkbmap", layout], check=True, env=self.environment(), timeout=PATIENCE)

    def find_window(self, process):
        found = self._xdotool("search", "--onlyvisible", "--pid", process, check=False).stdout.split()
        return int(found[-1]) if found else None

    def move(self, x, y):
        self.xdotool("mousemove", x, y)

    def screenshot(self, left=0, top=0, right=None, bottom=None):
        """The whole screen, or a part of it."""
        data = pathlib.Path(self._folder.name, "Xvfb_screen0").read_bytes()
        head = struct.unpack_from(">25I", data)  # XWDFileHeader
        width, height, stride, colors = head[4], head[5], head[12], head[19]
        left, top = max(left, 0), max(top, 0)
        right, bottom = width if right is None else min(right, width), height if bottom is None else min(bottom, height)
        start = head[0] + 12 * colors
        lines = (start + y * stride for y in range(top, bottom))
        return Picture(right - left, bottom - top, [_rgb(data[at + 4 * left:at + 4 * right]) for at in lines])

    def checksum(self, left, top, right, bottom):
        """Of some rows of the screen within a rectangle: it tells whether a picture has changed, in a few milliseconds."""
        return zlib.adler32(self.some_rows(left, top, right, bottom))

    def some_rows(self, left, top, right, bottom):
        """Every eighth row within a rectangle: four bytes for each pixel."""
        data = pathlib.Path(self._folder.name, "Xvfb_screen0").read_bytes()
        width, height = self._size
        pixels = len(data) - 4 * width * height
        return b"".join(data[pixels + 4 * (y * width + left):pixels + 4 * (y * width + right)]
                        for y in range(top, bottom, 8))


def _pixels(row):
    """Red, green and blue of each pixel."""
    return zip(row[0::3], row[1::3], row[2::3])


def _rgb(row):
    """RGB from pixels of four bytes: blue, green, red, unused."""
    pixels = bytearray(len(row) // 4 * 3)
    pixels[0::3], pixels[1::3], pixels[2::3] = row[2::4], row[1::4], row[0::4]
    return bytes(pixels)
