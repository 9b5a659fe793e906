"""What the tests of the command line and of the project share."""

import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("PENUMBRA_PROGRAM") or str(ROOT / "build" / "release" / "penumbra")
BUILD = pathlib.Path(os.environ.get("PENUMBRA_BUILD") or ROOT / "build" / "release")


# Of a suite that runs in the background or under nohup. A handler is not inherited: programs that the tests start have these
# signals' usual effects.
for _number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, lambda number, frame: None)


def run(*arguments, timeout=300, **options):
    """Runs penumbra; the result has returncode, stdout and stderr (text)."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, **options)


def wait_until_it_catches(number, process):
    """Waits until a process has installed a handler for the signal, however busy the machine is."""
    while process.poll() is None:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        caught = next(int(line.split()[1], 16) for line in status.splitlines() if line.startswith("SigCgt"))
        if caught >> (number - 1) & 1:
            return
        time.sleep(0.02)
    raise AssertionError(f"ended by itself with {process.returncode}")


def read_png(path):
    """The rows of a PNG without interlacing or a palette; each pixel is a tuple of 8-bit channels."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is not a PNG"
    width, height, depth, color = struct.unpack(">IIBB", data[16:26])
    assert depth == 8, f"{path} has {depth} bits a channel"
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        packed += data[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += length + 12
    lines, stride = zlib.decompress(packed), width * channels
    rows, above = [], bytes(stride)
    for y in range(height):
        line = lines[y * (stride + 1) : (y + 1) * (stride + 1)]
        above = unfilter(line[0], line[1:], above, channels)
        rows.append([tuple(above[x : x + channels]) for x in range(0, stride, channels)])
    return rows


def unfilter(kind, line, above, channels):
    """Reverses the filter of one row of a PNG (PNG specification, section 9)."""
    if kind == 0:
        return bytes(line)
    if kind == 2:
        return bytes([(value + up) & 255 for value, up in zip(line, above)])
    row = bytearray(channels) + line  # the pixel left of the first one is 0
    if kind == 1:
        for i in range(channels, len(row)):
            row[i] = (row[i] + row[i - channels]) & 255
    elif kind == 3:
        for i, up in enumerate(above, channels):
            row[i] = (row[i] + (row[i - channels] + up) // 2) & 255
    else:
        assert kind == 4, f"a PNG has no filter {kind}"
        for i, (up, corner) in enumerate(zip(above, bytes(channels) + above), channels):
            left = row[i - channels]
            by_left, by_up, by_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            if by_left <= by_up and by_left <= by_corner:
                row[i] = (row[i] + left) & 255
            else:
                row[i] = (row[i] + (up if by_up <= by_corner else corner)) & 255
    return bytes(row[channels:])


def assets(folder):
    """A folder of third-party assets; skips the test where there are none."""
    base = os.environ.get("PENUMBRA_ASSETS")
    if not base or not (pathlib.Path(base) / folder).is_dir():
        raise unittest.SkipTest(f"PENUMBRA_ASSETS has no folder {folder}")
    return pathlib.Path(base) / folder


def has_header(*path):
    """Whether the compiler finds it."""
    folders = ["/usr/include", "/usr/local/include", *os.environ.get("CPATH", "").split(":")]
    return any(pathlib.Path(folder, *path).exists() for folder in folders if folder)


def has_viewer():
    """Whether the program was built with it."""
    return re.search(r"^ +view ", run("--help").stdout, re.MULTILINE) is not None


def has_openscenegraph():
    return has_header("osgViewer", "Viewer")


def has_ogre():
    return has_header("OGRE", "OgreRoot.h")


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="penumbra-test-")


def shader_cache():
    """Where Mesa keeps compiled shaders for all programs of this user: compiling them again takes seconds."""
    cache = os.environ.get("XDG_CACHE_HOME") or str(pathlib.Path.home() / ".cache")
    return os.environ.get("MESA_SHADER_CACHE_DIR") or cache


def without_root():
    """Arguments with which subprocess runs a program as an unprivileged user; skips the test if that is impossible."""
    if os.geteuid() != 0:
        return {}
    nobody = {"user": 65534, "group": 65534}
    try:
        subprocess.run([PROGRAM, "--version"], capture_output=True, check=True, **nobody)
    except PermissionError:
        raise unittest.SkipTest("only root may read the program's folder") from None
    return nobody


class TestCase(unittest.TestCase):
    """A test with a temporary folder, which is removed afterwards."""

    def setUp(self):
        folder = temporary_folder()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def succeed(self, *arguments, **options):
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"penumbra {' '.join(map(str, arguments))}\n{result.stderr}")
        return result

    def listed(self, *what):
        """The rows that `penumbra list` has for a list's name, or for all lists."""
        return json.loads(self.succeed("list", *what, "--json").stdout)["rows"]

    def refuse(self, *arguments, code=1, **options):
        """The command must end with `code`, one line of error and no stack trace; returns that line."""
        result = run(*arguments, **options)
        self.assertEqual(result.returncode, code, f"penumbra {' '.join(map(str, arguments))}\n{result.stderr}")
        lines = result.stderr.strip().splitlines()
        errors = [line for line in lines if line.startswith("error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        return errors[0]


class _Recorder(unittest.TextTestResult):
    """Keeps each case's outcome and time for the report that ./test.sh counts."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.outcomes = {}
        self.starts = {}
        self.seconds = {}

    def startTest(self, test):
        super().startTest(test)
        self.outcomes[test.id()] = None
        self.starts[test.id()] = time.monotonic()

    def stopTest(self, test):
        super().stopTest(test)
        self.seconds[test.id()] = time.monotonic() - self.starts[test.id()]

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.outcomes[test.id()] = "skipped"

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.outcomes[test.id()] = "failure"

    def addError(self, test, err):
        super().addError(test, err)
        self.outcomes[test.id()] = "failure"

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err:
            self.outcomes[test.id()] = "failure"


def main():
    """Runs the tests of the calling file."""
    runner = unittest.TextTestRunner(verbosity=2, resultclass=_Recorder)
    result = unittest.main(module="__main__", exit=False, testRunner=runner).result
    report = os.environ.get("PENUMBRA_RESULTS")
    if report:
        suite = ElementTree.Element("testsuite")
        for name, outcome in result.outcomes.items():
            case = ElementTree.SubElement(suite, "testcase", name=name, time=f"{result.seconds.get(name, 0):.3f}")
            if outcome:
                ElementTree.SubElement(case, outcome)
        ElementTree.ElementTree(suite).write(report)
    sys.exit(not result.wasSuccessful())
