"""The courtyard's materials: paving, plaster, stone, wood and clay, all drawn here."""

import random

from . import plants, textures, vec

PAVING_SIZE = 2.4  # metres of one repeat
PLASTER_SIZE = 2.6
STONE_SIZE = 1.2
WOOD_SIZE = 1.0


def _paint(size, values, dark, light):
    """A two-colour ramp through values in 0…1; colours are quantised, which halves the file."""
    ramp = [textures.srgb(vec.lerp(dark, light, k / 63)) for k in range(64)]
    return textures.png(size, size, 3, b"".join(bytes(ramp[min(max(int(v * 64), 0), 63)]) for v in values))


def _stones(size, seed):
    """Slabs in rows of unequal height and length. Per pixel: (slab, distance to its edge in metres)."""
    draw = random.Random(seed)
    rows, y = [], 0
    for share in (0.16, 0.2, 0.14, 0.18, 0.13, 0.19):
        bottom = y + round(share * size)
        cuts, x = [], draw.randrange(size)
        first = x
        while x < first + size - size // 9:
            cuts.append(x)
            x += round(size * draw.uniform(0.15, 0.3))
        rows.append((y, bottom, cuts))
        y = bottom
    field = [None] * (size * size)
    slab = 0
    for top, bottom, cuts in rows:
        for i, left in enumerate(cuts):
            right = cuts[i + 1] if i + 1 < len(cuts) else cuts[0] + size
            for y in range(top, bottom):
                dy = min(y - top, bottom - 1 - y) + 0.5
                for x in range(left, right):
                    dx = min(x - left, right - 1 - x) + 0.5
                    # Rounded corners.
                    soft = 0.02 * size
                    if dx < soft and dy < soft:
                        edge = soft - ((soft - dx) ** 2 + (soft - dy) ** 2) ** 0.5
                    else:
                        edge = min(dx, dy)
                    field[(y % size) * size + x % size] = (slab, edge / size * PAVING_SIZE)
            slab += 1
    return field, slab


def paving():
    """Base colour, normal and roughness PNGs of worn limestone slabs, PAVING_SIZE metres a repeat."""
    size = 512
    field, count = _stones(size, 3)
    draw = random.Random(5)
    tints = [(draw.random(), draw.uniform(-1, 1), draw.uniform(-1, 1)) for _ in range(count)]
    coarse, fine = textures.fractal(size, 6, 4, 21), textures.fractal(size, 64, 2, 31)
    colors, heights, rough = bytearray(), [], bytearray()
    grout, dark, light = (0.15, 0.115, 0.08), (0.2, 0.15, 0.1), (0.44, 0.36, 0.26)
    ramp = [textures.srgb(vec.lerp(dark, light, k / 47)) for k in range(48)]
    joint = textures.srgb(grout)
    for i, (slab, edge) in enumerate(field):
        tint, tilt_x, tilt_y = tints[slab]
        wander = 0.004 * (coarse[i] - 0.5)
        inside = min(max((edge + wander - 0.003) / 0.013, 0.0), 1.0)
        inside = inside * inside * (3 - 2 * inside)
        value = 0.6 * tint + 0.6 * (coarse[i] - 0.25) + 0.25 * (fine[i] - 0.5)
        color = ramp[min(max(int(value * 48), 0), 47)]
        mix = round(inside * 8) / 8
        colors += bytes(int(a + (b - a) * mix) for a, b in zip(joint, color))
        x, y = i % size / size, i // size / size
        slope = 0.0015 * (tilt_x * x + tilt_y * y)
        heights.append(0.007 * inside + 0.0025 * coarse[i] + 0.0008 * fine[i] + slope * inside)
        if i // size % 2 == 0 and i % 2 == 0:
            worn = 0.9 - 0.3 * inside * (1 - coarse[i])
            rough += bytes((0, textures.byte(round(worn * 32) / 32), 0))
    half = size // 2
    return (
        textures.png(size, size, 3, colors),
        textures.png(size, size, 3, textures.normal_map(size, heights, PAVING_SIZE)),
        textures.png(half, half, 3, rough),
    )


def plaster():
    """Base colour and normal PNGs of brushed lime plaster, PLASTER_SIZE metres a repeat."""
    size = 256
    clouds, grain = textures.fractal(size, 3, 4, 41), textures.fractal(size, 32, 3, 51)
    values = [0.95 * (c - 0.5) + 0.3 * (g - 0.5) + 0.55 for c, g in zip(clouds, grain)]
    heights = [0.006 * c + 0.0055 * g for c, g in zip(clouds, grain)]
    normal = textures.png(size, size, 3, textures.normal_map(size, heights, PLASTER_SIZE))
    return _paint(size, values, (0.5, 0.5, 0.5), (1.0, 1.0, 1.0)), normal


def limestone():
    size = 256
    clouds, grain = textures.fractal(size, 4, 5, 61), textures.noise(size, 96, 62)
    return _paint(size, [0.8 * c + 0.2 * g for c, g in zip(clouds, grain)], (0.34, 0.28, 0.2), (0.56, 0.485, 0.37))


def wood():
    """Grain along v, in grey: the material gives the colour."""
    size = 256
    broad = textures.noise(size, 24, 71, 2)
    fine = textures.noise(size, 128, 72, 8)
    return _paint(size, [0.55 * b + 0.45 * f for b, f in zip(broad, fine)], (0.42, 0.4, 0.38), (1.0, 1.0, 1.0))


def clay():
    size = 128
    clouds, grain = textures.noise(size, 8, 81), textures.fractal(size, 16, 2, 82)
    return _paint(size, [0.65 * c + 0.35 * g for c, g in zip(clouds, grain)], (0.3, 0.105, 0.055), (0.66, 0.31, 0.18))


def materials(glb):
    """All materials by name; the numbers are linear albedos."""
    sky = glb.texture("occlusion", textures.gradient(), clamp=True)
    floor, floor_normal, floor_rough = (glb.texture(n, t) for n, t in zip(
        ("paving", "paving_normal", "paving_roughness"), paving()))
    wall, wall_normal = (glb.texture(n, t) for n, t in zip(("plaster", "plaster_normal"), plaster()))
    stone, grain, tile = (glb.texture(draw.__name__, draw()) for draw in (limestone, wood, clay))
    leaf = glb.texture("leaves", plants.leaf_texture(), clamp=True)
    vine = glb.texture("vine", plants.leaf_texture(23, 256, 13, ((0.06, 0.14, 0.02), (0.2, 0.28, 0.05))), clamp=True)
    dark = ((0.025, 0.06, 0.018), (0.06, 0.105, 0.03))
    needles = glb.texture("needles", plants.leaf_texture(29, 256, 64, dark, slender=0.5), clamp=True)
    white = (1.0, 1.0, 1.0)

    def make(name, color, roughness, **more):
        return glb.material(name, color, roughness, occlusion_texture=sky, **more)

    def rendered(name, color):
        return make(name, color, 0.92, color_texture=wall, normal_texture=wall_normal)

    return {
        "paving": make("paving", white, 1.0, color_texture=floor, normal_texture=floor_normal,
                       rough_texture=floor_rough),
        "ochre": rendered("ochre plaster", (0.72, 0.44, 0.2)),
        "clay plaster": rendered("clay plaster", (0.66, 0.33, 0.18)),
        "white plaster": rendered("white plaster", (0.8, 0.63, 0.42)),
        "stone": make("limestone", white, 0.8, color_texture=stone, normal_texture=wall_normal, normal_scale=0.5),
        "wood": make("wood", (0.36, 0.22, 0.12), 0.7, color_texture=grain),
        "dark wood": make("dark wood", (0.2, 0.115, 0.06), 0.65, color_texture=grain),
        "shutter": make("shutter", (0.13, 0.27, 0.27), 0.55, color_texture=grain),
        "clay": make("clay", white, 0.85, color_texture=tile),
        "iron": make("iron", (0.05, 0.048, 0.045), 0.5, metallic=0.6),
        "glass": make("glass", (0.035, 0.045, 0.05), 0.12),
        "lamp": glb.material("lamp", (0.85, 0.62, 0.3), 0.3, emissive=(1.0, 0.62, 0.25)),
        "water": make("water", (0.035, 0.075, 0.07), 0.06),
        "earth": make("earth", (0.12, 0.085, 0.055), 1.0),
        "ground": make("ground", (0.4, 0.33, 0.24), 1.0),
        "leaves": make("leaves", white, 0.6, color_texture=leaf, mask=0.5, double_sided=True),
        "cypress": make("cypress", white, 0.8, color_texture=needles, mask=0.5, double_sided=True),
        "needles": make("needles", (0.022, 0.042, 0.016), 0.9),
        "vine": make("vine", white, 0.6, color_texture=vine, mask=0.5, double_sided=True),
        "agave": make("agave", (0.2, 0.3, 0.19), 0.5, double_sided=True),
        "flowers": make("flowers", (0.62, 0.07, 0.25), 0.7, double_sided=True),
        "bark": make("bark", (0.2, 0.14, 0.095), 0.9),
    }
