"""What the tests of the command line share: scenes, sizes, and pictures read without the program's own code."""

import os
import struct
import zlib

from support import ROOT, unfilter

# Every OpenGL error of these tests ends the program.
os.environ["PENUMBRA_DEBUG"] = "1"

SMALL = ("--size", "96x54")
# Clearing maps of the usual size and their pyramids, 80 MB, takes as long as all else that a small picture needs.
SMALL_MAPS = ("--set", "cascades.size=512", "--set", "lamps.size=256")


def scene(name):
    return ROOT / "scenes" / f"{name}.glb"


def own_scenes():
    return sorted((ROOT / "scenes").glob("*.glb"))


def read_exr_header(path):
    """Attributes by name; channels as a list of names, strings as text, other values as bytes."""
    return _exr_header(path.read_bytes())[0]


def _exr_header(data):
    """The attributes and where they end."""
    assert data[:4] == b"\x76\x2f\x31\x01", "no EXR file"
    at, attributes = 8, {}
    while data[at] != 0:
        name, kind, rest = data[at:at + 1024].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        value = data[at + 4:at + 4 + size]
        at += 4 + size
        if kind == b"string":
            value = value.decode()
        elif kind == b"chlist":
            value = _channels(value)
        attributes[name.decode()] = value
    return attributes, at + 1


def _channels(value):
    names, at = [], 0
    while value[at] != 0:
        name = value[at:].split(b"\0", 1)[0]
        names.append(name.decode())
        at += len(name) + 1 + 16
    return names


def read_exr(path):
    """Channels by name, each a list of rows: 32-bit float, ZIP compression, as the program writes."""
    data = path.read_bytes()
    header, offsets = _exr_header(data)
    assert header["compression"] == b"\x03", "not ZIP"
    left, low, right, high = struct.unpack("<4i", header["dataWindow"])
    width, height, names = right - left + 1, high - low + 1, header["channels"]
    rows = {name: [] for name in names}
    for offset in struct.unpack_from(f"<{(height + 15) // 16}Q", data, offsets):
        line, size = struct.unpack_from("<2i", data, offset)
        count = min(16, height - line)
        lines = _exr_lines(data[offset + 8:offset + 8 + size], count * width * 4 * len(names))
        for at in range(count * len(names)):
            rows[names[at % len(names)]].append(struct.unpack_from(f"<{width}f", lines, at * width * 4))
    return rows


def _exr_lines(packed, size):
    """A block without its compression: differences of bytes, the even ones before the odd ones."""
    if len(packed) == size:
        return packed
    raw = bytearray(zlib.decompress(packed))
    for i in range(1, size):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    lines = bytearray(size)
    lines[0::2], lines[1::2] = raw[:(size + 1) // 2], raw[(size + 1) // 2:]
    return bytes(lines)


def read_png(path):
    """Width, height, channels and rows of bytes."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG file"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack_from(">IIBB", body)
            assert depth == 8
            channels = {0: 1, 2: 3, 6: 4}[color]
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    return width, height, channels, _unfilter(zlib.decompress(packed), width * channels, height, channels)


def _unfilter(raw, stride, height, channels):
    rows, above = [], bytes(stride)
    for at in range(0, height * (stride + 1), stride + 1):
        above = unfilter(raw[at], raw[at + 1:at + 1 + stride], above, channels)
        rows.append(above)
    return rows
