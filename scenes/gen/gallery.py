"""An exhibition room that four lights of different kinds share: two spots, a pendant lamp and the evening sun."""

import random

from . import exhibits, furniture, lamps, occlusion, plants, surfaces, textures, vec
from .building import Part
from .glb import Glb
from .shapes import Shape, beveled_box, box, patch, rod

WEST, EAST, NORTH, SOUTH, TOP = -4.5, 4.5, -3.0, 3.0, 3.6
WALL = 0.3
WINDOW = (-1.35, 0.75, 2.1, 3.05)  # z and y in the west wall
TRACK = 3.42  # the lower side of the lamps' tracks
SCULPTURE = (-1.55, -1.25)
PENDANT = (1.85, 2.0, -0.45)
DAYLIGHT = 0.3  # part of the sky's light that comes in by the window and by way of the walls


def gallery(azimuth=-96.0, elevation=27.0, lux=1000.0, seed=5):
    """An exhibition room, 9 × 6 × 3.6 m, with two spots, a pendant lamp, and the evening sun through a window.

    azimuth, elevation: of the sun, degrees; lux: of the sun; seed: of the plant's shape
    """
    glb = Glb()
    glb.camera("main", (4.15, 1.6, 2.7), (-0.75, 1.2, -1.25), 48.0)
    glb.camera("sculpture", (0.9, 1.6, 0.6), (-2.0, 1.0, -1.7), 45.0)
    glb.camera("pictures", (0.3, 1.6, 2.0), (0.55, 1.35, -3.0), 48.0)
    glb.sun(azimuth, elevation, lux, lamps.black_body(4200.0))
    parts = [_floor(), _walls(), _window(), *_things(seed)]
    x, z = SCULPTURE
    parts.append(lamps.spot(glb, "sculpture spot", (-0.1, TRACK, 0.75), (x, 1.3, z), 3000.0, 11.0, 21.0))
    parts.append(lamps.spot(glb, "picture spot", (2.1, TRACK, -0.75), (0.45, 1.4, NORTH), 3500.0, 20.0, 40.0))
    parts.append(lamps.pendant(glb, PENDANT, TOP, 150.0))
    materials = _materials(glb)
    boxes = [b for part in parts for b in part.boxes]
    cache = {}
    for part in parts:
        primitives = []
        for material, shape in part.shapes.items():
            _bake(shape, boxes, cache)
            primitives.append(glb.primitive(shape, materials[material]))
        glb.node(part.name, mesh=glb.mesh(part.name, primitives))
    return glb


def _bake(shape, boxes, cache):
    """Occlusion as seen from within the room: a vertex in the plane of another wall would be taken for a part of it."""
    seen, inset = Shape(), 0.05
    low, high = (WEST, 0.0, NORTH), (EAST, TOP, SOUTH)
    for p in shape.positions:
        seen.positions.append(tuple(min(max(c, a + inset), b - inset) for c, a, b in zip(p, low, high)))
    seen.normals = shape.normals
    occlusion.bake(seen, boxes, cache)
    shape.uvs2 = [(DAYLIGHT * u, v) for u, v in seen.uvs2]


def _floor():
    """Oak boards, laid along x, over a slab that reaches below the walls. Boards overlap by half a millimetre."""
    p = Part("floor")
    draw = random.Random(2)
    width, rows = (SOUTH - NORTH) / 44, 44
    for row in range(rows):
        z = NORTH + row * width
        x = WEST - draw.uniform(0.0, 1.6)
        while x < EAST:
            end = x + draw.uniform(1.2, 2.2)
            a, b = max(x, WEST), min(end, EAST)
            x = end
            tone, u, v = draw.choice(("oak", "oak", "oak light", "oak dark")), draw.random(), draw.random()
            long, broad = (b - a + 0.0005, 0.0, 0.0), (0.0, 0.0, -width - 0.0005)
            board = patch((a, 0.0, z + width), long, broad, max(1, round((b - a) / 0.6)), 1)
            board.uvs = [(u + q[2] / 0.6, v + q[0] / 1.8) for q in board.positions]
            p.put(tone, board)
    p.put("dark paint", box(WEST - WALL, -0.25, NORTH - WALL, EAST + WALL, -0.01, SOUTH + WALL))
    p.blocker(WEST, -0.25, NORTH, EAST, -0.01, SOUTH)
    return p


def _block(p, material, x0, y0, z0, x1, y1, z1, inner):
    """A part of a wall: a box whose face towards the room has vertices every 0.5 m, for its occlusion."""
    sizes = [x1 - x0, y1 - y0, z1 - z0]
    corner, u, v = {
        "+x": ((x1, y0, z1), (0.0, 0.0, -sizes[2]), (0.0, sizes[1], 0.0)),
        "-x": ((x0, y0, z0), (0.0, 0.0, sizes[2]), (0.0, sizes[1], 0.0)),
        "+z": ((x0, y0, z1), (sizes[0], 0.0, 0.0), (0.0, sizes[1], 0.0)),
        "-z": ((x1, y0, z0), (-sizes[0], 0.0, 0.0), (0.0, sizes[1], 0.0)),
        "-y": ((x0, y0, z0), (sizes[0], 0.0, 0.0), (0.0, 0.0, sizes[2])),
    }[inner]
    steps = [max(1, round(vec.length(side) / 0.45)) for side in (u, v)]
    p.put(material, patch(corner, u, v, *steps), uv=surfaces.PLASTER_SIZE)
    p.put(material, box(x0, y0, z0, x1, y1, z1, inner), uv=surfaces.PLASTER_SIZE)
    p.blocker(x0, y0, z0, x1, y1, z1)


def _walls():
    p = Part("walls")
    low, high = -0.05, TOP + 0.05
    _block(p, "accent plaster", WEST - WALL, low, NORTH - WALL, EAST + WALL, high, NORTH, "+z")
    _block(p, "plaster", WEST - WALL, low, SOUTH, EAST + WALL, high, SOUTH + WALL, "-z")
    _block(p, "plaster", EAST, low, NORTH, EAST + WALL, high, SOUTH, "-x")
    z0, z1, y0, y1 = WINDOW
    lap = 0.02  # what is below and above the window reaches into what is beside it, so that no seam lets light through
    for b in ((low, NORTH, high, z0), (low, z1, high, SOUTH), (low, z0 - lap, y0, z1 + lap),
              (y1, z0 - lap, high, z1 + lap)):
        _block(p, "plaster", WEST - WALL, b[0], b[1], WEST, b[2], b[3], "+x")
    _block(p, "ceiling", WEST - WALL, TOP, NORTH - WALL, EAST + WALL, TOP + WALL, SOUTH + WALL, "-y")
    board, deep = 0.12, 0.018
    for b in ((WEST, NORTH, EAST, NORTH + deep), (WEST, SOUTH - deep, EAST, SOUTH),
              (WEST, NORTH + deep, WEST + deep, SOUTH - deep), (EAST - deep, NORTH + deep, EAST, SOUTH - deep)):
        p.put("white paint", box(b[0], 0.0, b[1], b[2], board, b[3]))
    return p


def _door():
    """A closed double door with panels in the west wall; its foot is at the origin, and it faces +z."""
    p = Part("door")
    half, height = 0.72, 2.15
    for x0, x1, y0, y1 in ((-half - 0.11, -half, 0.0, height + 0.11), (half, half + 0.11, 0.0, height + 0.11),
                           (-half, half, height, height + 0.11)):
        p.put("dark paint", beveled_box(x0, y0, -0.01, x1, y1, 0.045, 0.008))
    for side in (-1, 1):
        x0, x1 = sorted((0.0, side * half))
        p.put("oak dark", _upright(box(x0, 0.005, -0.01, x1, height, 0.02)))
        for y0, y1 in ((0.16, 0.92), (1.08, 2.0)):
            p.put("oak", _upright(beveled_box(x0 + 0.11, y0, 0.01, x1 - 0.11, y1, 0.034, 0.012)))
        p.put("brass", rod((side * 0.05, 1.0, 0.055), (side * 0.16, 1.0, 0.055), 0.009, 10))
        p.put("brass", rod((side * 0.05, 1.0, 0.015), (side * 0.05, 1.0, 0.06), 0.009, 10))
    p.blocker(-half - 0.1, 0.0, -0.01, half + 0.1, height + 0.1, 0.02)
    return p


def _upright(shape):
    """Wood whose grain runs along y."""
    shape.uvs = [((q[0] + 0.3 * q[2]) / 0.6, q[1] / 1.8) for q in shape.positions]
    return shape


def _window():
    """Frame and glazing bars, without panes: four lights in width, two in height."""
    p = Part("window")
    z0, z1, y0, y1 = WINDOW
    x0, x1 = WEST - 0.2, WEST - 0.14
    bars = Shape()
    for z in (z0, z1 - 0.06):
        bars.add(beveled_box(x0, y0, z, x1, y1, z + 0.06, 0.006))
    for y in (y0, y1 - 0.06):
        bars.add(beveled_box(x0, y, z0 + 0.06, x1, y + 0.06, z1 - 0.06, 0.006))
    for k in (1, 2, 3):
        z = z0 + (z1 - z0) * k / 4
        bars.add(beveled_box(x0 + 0.01, y0 + 0.06, z - 0.0175, x1 - 0.01, y1 - 0.06, z + 0.0175, 0.004))
    y = y0 + 0.62 * (y1 - y0)
    bars.add(beveled_box(x0 + 0.012, y - 0.0175, z0 + 0.06, x1 - 0.012, y + 0.0175, z1 - 0.06, 0.004))
    p.put("dark paint", bars)
    p.put("white paint", beveled_box(WEST - 0.14, y0 - 0.03, z0 - 0.04, WEST + 0.05, y0 + 0.012, z1 + 0.04, 0.006))
    return p


def _things(seed):
    def placed(part, at):
        p = Part(part.name)
        p.add(part, at)
        return p

    north = vec.translate(0.0, 1.55, NORTH)
    tracks = Part("tracks")
    for z in (-0.75, 0.75):
        tracks.put("black paint", box(-2.6, TRACK, z - 0.018, 2.6, TRACK + 0.03, z + 0.018))
        for x in (-2.3, 0.0, 2.3):
            tracks.put("black paint", rod((x, TRACK + 0.025, z), (x, TOP, z), 0.006, 8))
    pot = furniture.pot(0.42, 0.25, "", 1)
    plant = placed(pot, vec.translate(2.8, 0.0, -2.4))
    plant.name = "plant"
    wood, crown = plants.tree(seed, height=1.75, radius=0.022, crown=0.52, branches=9, cards=16, card_size=0.26)
    plant.put("bark", wood, vec.translate(2.8, 0.33, -2.4))
    plant.put("leaves", crown, vec.translate(2.8, 0.33, -2.4))
    return [
        placed(exhibits.sculpture(), vec.translate(SCULPTURE[0], 0.0, SCULPTURE[1])),
        placed(exhibits.mobile(0.9), vec.translate(-3.0, TOP, -0.55)),
        placed(exhibits.bench(), vec.translate(1.75, 0.0, -0.7) @ vec.rotate((0, 1, 0), 4.0)),
        exhibits.barrier([(-0.95, -2.25), (0.4, -2.3), (1.75, -2.25)]),
        placed(exhibits.relief(1.0, 0.75), north @ vec.translate(-0.92, 0.0, 0.0)),
        placed(exhibits.picture("canvas red", "gilt", 0.95, 1.15), north @ vec.translate(0.4, 0.05, 0.0)),
        placed(exhibits.picture("canvas blue", "black paint", 0.7, 0.7, 0.05), north @ vec.translate(1.55, 0.0, 0.0)),
        placed(exhibits.screen(panels=2, height=1.5), vec.translate(-1.45, 0.0, 1.15) @ vec.rotate((0, 1, 0), 90.0)),
        placed(_door(), vec.translate(WEST, 0.0, 1.85) @ vec.rotate((0, 1, 0), 90.0)),
        tracks,
        plant,
    ]


def _materials(glb):
    """All materials by name; the numbers are linear albedos."""
    sky = glb.texture("occlusion", textures.gradient(), clamp=True)
    rough_wall = glb.texture("plaster_normal", surfaces.plaster()[1])
    grain = glb.texture("wood", surfaces.wood())
    leaf = glb.texture("leaves", plants.leaf_texture(size=128), clamp=True)
    red = glb.texture("canvas_red", exhibits.canvas(3, ((0.30, 0.05, 0.03), (0.62, 0.16, 0.04), (0.12, 0.02, 0.03),
                                                        (0.70, 0.38, 0.08))), clamp=True)
    blue = glb.texture("canvas_blue", exhibits.canvas(8, ((0.62, 0.58, 0.48), (0.05, 0.12, 0.30), (0.25, 0.42, 0.5))),
                       clamp=True)
    white = (1.0, 1.0, 1.0)

    def make(name, color, roughness, **more):
        return glb.material(name, color, roughness, occlusion_texture=sky, **more)

    def plaster(name, color):
        return make(name, color, 0.92, normal_texture=rough_wall, normal_scale=0.25)

    def oak(name, color):
        return make(name, color, 0.42, color_texture=grain)

    return {
        "plaster": plaster("plaster", (0.78, 0.72, 0.62)),
        "accent plaster": plaster("accent plaster", (0.33, 0.4, 0.4)),
        "ceiling": make("ceiling", (0.82, 0.78, 0.7), 0.95),
        "oak": oak("oak", (0.44, 0.26, 0.13)),
        "oak light": oak("oak light", (0.5, 0.31, 0.165)),
        "oak dark": oak("oak dark", (0.36, 0.2, 0.095)),
        "white paint": make("white paint", (0.78, 0.76, 0.72), 0.6),
        "dark paint": make("dark paint", (0.035, 0.035, 0.04), 0.5),
        "black paint": make("black paint", (0.02, 0.02, 0.02), 0.45),
        "red paint": make("red paint", (0.52, 0.045, 0.03), 0.5),
        "yellow paint": make("yellow paint", (0.72, 0.43, 0.04), 0.5),
        "blue paint": make("blue paint", (0.04, 0.13, 0.4), 0.5),
        "bronze": make("bronze", (0.55, 0.34, 0.17), 0.34, metallic=0.9),
        "brass": make("brass", (0.72, 0.5, 0.2), 0.3, metallic=0.9),
        "copper": make("copper", (0.75, 0.38, 0.24), 0.35, metallic=0.9),
        "gilt": make("gilt", (0.68, 0.47, 0.16), 0.4, metallic=0.7),
        "steel": make("steel", (0.12, 0.12, 0.125), 0.4, metallic=0.5),
        "wire": make("wire", (0.05, 0.05, 0.05), 0.4),
        "gypsum": make("gypsum", (0.78, 0.75, 0.7), 0.85),
        "canvas red": make("canvas red", white, 0.8, color_texture=red),
        "canvas blue": make("canvas blue", white, 0.8, color_texture=blue),
        "lamp": glb.material("lamp", (0.9, 0.8, 0.6), 0.3, emissive=(1.0, 0.85, 0.62)),
        "clay": make("clay", (0.32, 0.3, 0.28), 0.8),
        "earth": make("earth", (0.06, 0.045, 0.03), 1.0),
        "bark": make("bark", (0.2, 0.14, 0.095), 0.9),
        "leaves": make("leaves", white, 0.6, color_texture=leaf, mask=0.5, double_sided=True),
    }
