"""Images as rows of bytes, tiling noise, and a PNG writer."""

import math
import random
import struct
import zlib


def png(width, height, channels, pixels):
    """8-bit PNG; channels 1, 3 or 4; every row is filtered by its difference from the row above."""
    stride = width * channels
    rows = bytearray()
    above = bytes(stride)
    for y in range(height):
        row = bytes(pixels[y * stride : (y + 1) * stride])
        rows.append(2)
        rows += bytes((a - b) & 255 for a, b in zip(row, above))
        above = row

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    data = zlib.compress(bytes(rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def byte(value):
    """0…1 to 0…255."""
    return 0 if value <= 0 else 255 if value >= 1 else int(value * 255 + 0.5)


def srgb(linear):
    """A linear colour to sRGB bytes."""
    return tuple(byte(12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055) for c in linear)


def noise(size, cells, seed, cells_v=None):
    """size² values in 0…1, smooth, tiling, with cells × cells_v random lattice points."""
    cells_v = cells_v or cells
    draw = random.Random(seed)
    lattice = [[draw.random() for _ in range(cells)] for _ in range(cells_v)]

    def stations(count):
        for k in range(size):
            x = k * count / size
            i = int(x)
            f = x - i
            yield i, (i + 1) % count, f * f * (3 - 2 * f)

    wide = [[row[i] + (row[j] - row[i]) * f for i, j, f in stations(cells)] for row in lattice]
    values = []
    for i, j, f in stations(cells_v):
        values += [a + (b - a) * f for a, b in zip(wide[i], wide[j])]
    return values


def fractal(size, cells, octaves, seed):
    """Octaves of noise, each half as strong as the one before, 0…1."""
    total = [0.0] * (size * size)
    weight, sum_of_weights = 1.0, 0.0
    for k in range(octaves):
        layer = noise(size, cells << k, seed + k)
        total = [t + weight * v for t, v in zip(total, layer)]
        sum_of_weights += weight
        weight /= 2
    return [t / sum_of_weights for t in total]


def normal_map(size, heights, metres):
    """RGB bytes from a tiling height field: heights in metres over a square of side `metres` (green up, as glTF)."""
    pixels = bytearray()
    slope = size / (2 * metres)
    for y in range(size):
        up, down = ((y - 1) % size) * size, ((y + 1) % size) * size
        here = y * size
        for x in range(size):
            dx = (heights[here + (x + 1) % size] - heights[here + x - 1 if x else here + size - 1]) * slope
            dy = (heights[up + x] - heights[down + x]) * slope
            inverse = 0.5 / math.sqrt(dx * dx + dy * dy + 1)
            pixels += bytes((byte(0.5 - dx * inverse), byte(0.5 - dy * inverse), byte(0.5 + inverse)))
    return pixels


def gradient():
    """256 × 1 grey ramp. As an occlusion texture it turns the second UV set's u into an occlusion value per vertex."""
    return png(256, 4, 3, bytes(v for _ in range(4) for v in range(256) for _ in range(3)))
