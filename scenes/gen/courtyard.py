"""The default scene: an arcaded courtyard in low, warm sun."""

import random

from . import building, furniture, occlusion, plants, surfaces, vec
from .building import Part
from .glb import Glb
from .shapes import Shape, beveled_box, box, patch, plane

# The yard is WEST < x < EAST, NORTH < z < SOUTH. The house stands at the north, a lower wing at the west; both open on
# the yard through arcades in front of a gallery, whose floor is a step higher.
WEST, EAST, NORTH, SOUTH = -4.4, 6.6, -4.0, 7.0
BAYS, BAY, ARCH, SPRING, THICK = 5, 2.2, 0.87, 2.25, 0.44
STEP, GALLERY, CEILING = 0.16, 2.4, 3.4
WING_TOP, WING_RISE = 3.95, 0.95
HOUSE_TOP, HOUSE_RISE = 5.9, 1.1


def courtyard(azimuth=62.0, elevation=40.0, lux=100000.0, seed=4):
    """An arcaded courtyard with fountain, pergola, tree and pots: the default scene.

    azimuth, elevation: of the sun, degrees; lux: of the sun; seed: of the plants' shapes
    """
    glb = Glb()
    glb.camera("main", (2.0, 1.65, 6.4), (-0.95, 1.8, -2.4), 50.0)
    glb.camera("gallery", (-5.6, 1.75, 5.6), (-4.7, 1.45, -3.0), 50.0)
    glb.camera("fountain", (1.1, 1.25, 1.9), (-1.6, 0.75, -1.3), 45.0)
    glb.camera("above", (-0.5, 12.5, 16.5), (0.6, 0.4, -0.4), 40.0)
    glb.sun(azimuth, elevation, lux, (1.0, 0.93, 0.82))
    materials = surfaces.materials(glb)
    parts = [_ground(), _house(), _wing(), _walls(), *_things(seed)]
    boxes = [b for part in parts for b in part.boxes]
    cache = {}
    for part in parts:
        primitives = []
        for material, shape in part.shapes.items():
            if not shape.uvs2:
                occlusion.bake(shape, boxes, cache)
            primitives.append(glb.primitive(shape, materials[material]))
        glb.node(part.name, mesh=glb.mesh(part.name, primitives))
    return glb


def _ground():
    p = Part("ground")
    p.put("paving", patch((WEST, 0.0, SOUTH), (EAST - WEST, 0.0, 0.0), (0.0, 0.0, NORTH - SOUTH), 30, 30),
          uv=surfaces.PAVING_SIZE)
    # Outside the walls.
    out, low = 40.0, -0.02
    for x0, z0, x1, z1 in ((-out, -out, out, -8.0), (-out, 7.0, out, out), (-out, -8.0, -7.0, 7.0),
                           (6.6, -8.0, out, 7.0)):
        p.put("ground", plane(x0, z0, x1, z1, low))
    return p


def _arcade(p, material, top, at):
    """Wall over arches with its columns, from bay line to bay line."""
    spring, length = SPRING + STEP, BAYS * BAY
    face = building.arched_wall(BAYS, BAY, ARCH, spring, top)
    p.put(material, face, at, uv=surfaces.PLASTER_SIZE)
    back = building.arched_wall(BAYS, BAY, ARCH, spring, CEILING)
    p.put(material, back, at @ vec.translate(length, 0.0, -THICK) @ vec.rotate((0, 1, 0), 180.0),
          uv=surfaces.PLASTER_SIZE)
    p.put(material, building.soffit(BAYS, BAY, ARCH, spring, THICK), at, uv=surfaces.PLASTER_SIZE)
    for k in range(BAYS):
        ring = building.archivolt((k + 0.5) * BAY, ARCH, spring)
        p.put("stone", ring, at, uv=surfaces.STONE_SIZE)
    pillar = building.column(SPRING)
    for k in range(1, BAYS):
        p.put("stone", pillar, at @ vec.translate(k * BAY, STEP, -THICK / 2))
    half = BAY / 2 - ARCH
    for k in range(BAYS):
        x = k * BAY
        _block(p, at, x, spring + 0.15, -THICK + 0.02, x + 0.23, top, -0.02)
        _block(p, at, x + BAY - 0.23, spring + 0.15, -THICK + 0.02, x + BAY, top, -0.02)
        _block(p, at, x + 0.22, spring + ARCH, -THICK + 0.02, x + BAY - 0.22, top, -0.02)
        if k:
            _block(p, at, x - 0.12, STEP, -THICK / 2 - 0.12, x + 0.12, spring, -THICK / 2 + 0.12)
    # The wall's ends, which show inside the galleries.
    ends = Shape()
    ends.quad((0.0, spring, -THICK), (0.0, spring, 0.0), (0.0, CEILING, 0.0), (0.0, CEILING, -THICK))
    ends.quad((length, spring, 0.0), (length, spring, -THICK), (length, CEILING, -THICK), (length, CEILING, 0.0))
    p.put(material, ends, at, uv=surfaces.PLASTER_SIZE)
    # A pilaster where the row of columns ends at a wall.
    for x0, x1 in ((0.0, half), (length - half, length)):
        p.put("stone", beveled_box(x0, STEP, -THICK - 0.01, x1, spring - 0.1, 0.0, 0.012), at, uv=surfaces.STONE_SIZE)
        p.put("stone", beveled_box(x0, spring - 0.1, -THICK - 0.04, x1 + 0.03, spring, 0.03, 0.012), at,
              uv=surfaces.STONE_SIZE)


def _block(p, at, *b):
    ends = [at.point(b[:3]), at.point(b[3:])]
    p.blocker(*(min(e[a] for e in ends) for a in range(3)), *(max(e[a] for e in ends) for a in range(3)))


def _gallery(p, at, start, length, wall_material, beams_from=0.0):
    """Floor, kerb, back wall, ceiling and beams of the walk behind an arcade, from x = start."""
    inner = -THICK - GALLERY
    steps_x = round(length / 0.55)
    p.put("paving", patch((start, STEP, -0.1), (length, 0.0, 0.0), (0.0, 0.0, inner + 0.1), steps_x, 5), at, uv=2.4)
    p.put(wall_material, patch((start, STEP, inner), (length, 0.0, 0.0), (0.0, CEILING - STEP, 0.0), steps_x, 7), at,
          uv=surfaces.PLASTER_SIZE)
    skirting = beveled_box(start, STEP, inner - 0.02, start + length, STEP + 0.14, inner + 0.025, 0.01)
    p.put("stone", skirting, at, uv=surfaces.STONE_SIZE)
    ceiling = patch((start, CEILING, inner), (length, 0.0, 0.0), (0.0, 0.0, -inner - THICK), steps_x, 4)
    p.put("wood", ceiling, at, uv=1.0)
    beams = Shape()
    count = round((length - beams_from) / 0.73)
    for k in range(count):
        x = start + beams_from + (k + 0.5) * (length - beams_from) / count
        beams.add(box(x - 0.06, CEILING - 0.17, inner, x + 0.06, CEILING, -THICK, "+y-z+z"))
    p.put("dark wood", beams, at, uv=1.0)
    _block(p, at, start, -0.2, inner, start + length, STEP - 0.01, -0.05)
    _block(p, at, start, 0.0, inner - 0.3, start + length, CEILING, inner - 0.01)
    _block(p, at, start, CEILING + 0.02, inner, start + length, CEILING + 0.3, -THICK)


def _kerb(p, at, length):
    stones = Shape()
    count = round(length / 0.9)
    for k in range(count):
        x0, x1 = length * k / count, length * (k + 1) / count
        stones.add(beveled_box(x0 + 0.003, -0.05, -0.5, x1 - 0.003, STEP + 0.005, 0.08, 0.014))
    p.put("stone", stones, at, uv=surfaces.STONE_SIZE)


def _house():
    p = Part("house")
    at = vec.translate(WEST, 0.0, NORTH)
    length = BAYS * BAY
    reach = THICK + GALLERY
    top = HOUSE_TOP + 0.13
    _arcade(p, "ochre", top, at)
    _gallery(p, at, -reach, length + reach, "white plaster")
    _kerb(p, at, length)
    # Where the galleries meet, in the line of the house's front.
    p.put("paving", patch((-reach, STEP, 0.0), (reach, 0.0, 0.0), (0.0, 0.0, -0.1), 5, 1), at, uv=2.4)
    p.put("wood", patch((-reach, CEILING, -THICK), (reach, 0.0, 0.0), (0.0, 0.0, THICK), 5, 1), at, uv=1.0)
    # The upper storey over the corner of the two galleries, above the wing's roof.
    p.put("ochre", patch((-reach, CEILING, 0.0), (reach, 0.0, 0.0), (0.0, top - CEILING, 0.0), 4, 5), at, uv=2.6)
    _block(p, at, -reach, CEILING, -THICK, 0.0, top, -0.02)
    # Outer walls, which close the block towards the outside.
    far = NORTH - reach - 0.25
    x0, x1 = WEST - reach - 0.25, WEST + length
    ridge = HOUSE_TOP + 0.13 + HOUSE_RISE
    outside = patch((x1, 0.0, far), (x0 - x1, 0.0, 0.0), (0.0, ridge, 0.0), 2, 2)
    outside.quad((x0, 0.0, far), (x0, 0.0, NORTH), (x0, top, NORTH), (x0, ridge, far))
    outside.quad((x1, 0.0, NORTH), (x1, 0.0, far), (x1, ridge, far), (x1, top, NORTH))
    p.put("ochre", outside, uv=surfaces.PLASTER_SIZE)
    roof = building.eaves(length + reach + 0.75, reach + 0.25, HOUSE_RISE, 0.5, 5)
    p.add(roof, vec.translate(x0 - 0.25, HOUSE_TOP, NORTH))
    band = beveled_box(-reach, 4.02, -0.02, length, 4.14, 0.05, 0.012)
    p.put("stone", band, at, uv=surfaces.STONE_SIZE)
    for k in range(BAYS):
        p.add(building.window(0.74, 1.1), at @ vec.translate((k + 0.5) * BAY, 4.36, 0.0))
    east = patch((x1 - 0.15, STEP, NORTH - reach), (0.0, 0.0, reach), (0.0, CEILING - STEP, 0.0), 4, 6)
    p.put("white plaster", east, uv=2.6)
    p.blocker(x1 - 0.14, 0.0, far, x1, CEILING, NORTH)
    p.add(building.door(1.05, 2.15), at @ vec.translate(5.5, STEP, -reach))
    return p


def _wing():
    p = Part("wing")
    # Local +x runs towards the north (-Z), local +z to the yard (+X).
    at = vec.Transform((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (WEST, 0.0, SOUTH))
    length, reach, top = BAYS * BAY, THICK + GALLERY, WING_TOP + 0.13
    _arcade(p, "clay plaster", top, at)
    _gallery(p, at, 0.0, length, "white plaster")
    _kerb(p, at, length)
    x0 = WEST - reach - 0.25
    ridge = WING_TOP + 0.13 + WING_RISE
    outside = patch((x0, 0.0, NORTH), (0.0, 0.0, SOUTH - NORTH), (0.0, ridge, 0.0), 2, 2)
    outside.quad((x0, 0.0, SOUTH), (WEST, 0.0, SOUTH), (WEST, top, SOUTH), (x0, ridge, SOUTH))
    p.put("clay plaster", outside, uv=surfaces.PLASTER_SIZE)
    p.add(building.eaves(length + 0.25, reach + 0.25, WING_RISE, 0.42, 6), at @ vec.translate(-0.25, WING_TOP, 0.0))
    # The gallery's end walls, towards the south and the west end of the house's gallery.
    end = patch((WEST, STEP, SOUTH - 0.15), (-reach, 0.0, 0.0), (0.0, CEILING - STEP, 0.0), 4, 6)
    p.put("white plaster", end, uv=2.6)
    west = patch((WEST - reach, STEP, NORTH), (0.0, 0.0, -reach), (0.0, CEILING - STEP, 0.0), 4, 6)
    p.put("white plaster", west, uv=2.6)
    p.blocker(WEST - reach, 0.0, SOUTH - 0.14, WEST, CEILING, SOUTH - 0.01)
    p.add(building.door(1.0, 2.1), at @ vec.translate(7.7, STEP, -reach))
    return p


def _walls():
    p = Part("walls")
    east = vec.Transform((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (EAST - 0.5, 0.0, NORTH + 0.08))
    p.add(building.coping_wall(SOUTH - NORTH + 0.22, 2.2), east)
    south = vec.Transform((-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0), (EAST - 0.2, 0.0, SOUTH))
    p.add(building.coping_wall(EAST - 0.2 - WEST, 2.2), south)
    return p


def _things(seed):
    draw = random.Random(seed)
    fountain, pergola, tree, pots, light = (Part(n) for n in ("fountain", "pergola", "tree", "pots", "lights"))
    fountain.add(furniture.fountain(), vec.translate(-1.5, 0.0, -0.7))
    pergola.add(furniture.pergola(2.5, 5.4), vec.translate(3.05, 0.0, -2.5))
    pergola.add(furniture.bench(), vec.translate(5.55, 0.0, -0.4) @ vec.rotate((0, 1, 0), -90.0))
    tree.add(furniture.planter(1.2, 0.42), vec.translate(-3.3, 0.0, 1.3))
    wood, crown = plants.tree(seed, height=3.5, radius=0.085, crown=1.15, branches=13, cards=58, card_size=0.3)
    _shade(crown, (0.0, 2.35, 0.0), 1.25)
    place = vec.translate(-3.3, 0.35, 1.3)
    tree.put("bark", wood, place)
    tree.put("leaves", crown, place)
    for x, z, y, height, radius, plant in (
        (-3.75, -3.35, 0.0, 0.55, 0.32, "agave"),
        (-1.75, -3.6, 0.0, 0.42, 0.24, "flowers"),
        (-1.2, -3.45, 0.0, 0.3, 0.17, "shrub"),
        (2.75, -3.4, 0.0, 0.5, 0.28, "shrub"),
        (-3.95, -0.75, 0.0, 0.4, 0.24, "flowers"),
        (0.6, -3.6, 0.0, 0.4, 0.23, "flowers"),
    ):
        pots.add(furniture.pot(height, radius, plant, draw.randrange(1000)), vec.translate(x, y, z))
    pots.add(furniture.jar(0.85), vec.translate(2.2, 0.0, -3.5))
    light.add(furniture.lantern(0.5), vec.translate(WEST - THICK / 2, SPRING + STEP + ARCH, 1.5 - BAY))
    light.add(furniture.lantern(0.5), vec.translate(1.1, SPRING + STEP + ARCH, NORTH - THICK / 2))
    light.add(furniture.festoon((3.05, 2.75, 0.2), (WEST + 0.03, 3.65, -0.7), 0.55, 9), vec.Transform())
    return [fountain, pergola, tree, pots, light, _climber(seed), _cypresses(seed)]


def _climber(seed):
    """A flowering climber in the corner of the two arcades, under the eaves of the wing and along the house."""
    p = Part("climber")

    def fill(a, b):
        foot, spread = 0.16 - a, (b - 0.62) / 0.2
        return 1.0 if foot > 0 else max(0.0, min(1.0, spread) * (1.0 - a) ** 1.5)

    sides = (((3.4, 0.0, 0.0), (0.0, 0.0, 1.0), 4.6), ((0.0, 0.0, 3.0), (1.0, 0.0, 0.0), 3.7))
    for k, (u, normal, tall) in enumerate(sides):
        corner = vec.add((WEST, 0.1, NORTH), vec.scale(normal, 0.02))
        leaves = plants.ivy(seed + k, corner, u, (0.0, tall, 0.0), normal, 230, 0.32, fill)
        p.put("vine", leaves)
        draw = random.Random(seed + 10 + k)
        places = []
        for i in range(0, len(leaves.positions), 4):
            if leaves.positions[i][1] > 2.0 and draw.random() < 0.75:
                at = vec.add(vec.lerp(leaves.positions[i], leaves.positions[i + 2], draw.random()),
                             vec.scale(normal, draw.uniform(0.02, 0.08)))
                out = vec.normalize(vec.add(normal, vec.scale(plants.random_direction(draw), 0.5)))
                places.append((at, out))
        p.put("flowers", plants.blossoms(places, seed + k))
    stem = [(0.12, 0.0, 0.12), (0.1, 0.9, 0.07), (0.13, 1.9, 0.1), (0.08, 2.8, 0.06), (0.12, 3.5, 0.08)]
    stem = [vec.add(q, (WEST, 0.0, NORTH)) for q in stem]
    p.put("bark", plants.tube(stem, [0.05, 0.042, 0.035, 0.028, 0.02], 7))
    return p


def _cypresses(seed):
    """Beyond the walls: two over the wing's roof, and one in the south-east whose soft shadow falls into the yard."""
    p = Part("cypresses")
    for k, (x, z, height, radius, cards) in enumerate(((-10.5, -3.2, 9.5, 0.95, 340), (-10.0, -0.4, 8.0, 0.85, 320),
                                                       (8.3, 8.0, 10.6, 1.0, 380))):
        core, leaves = plants.cypress(seed + k, height, radius, cards)
        at = vec.translate(x, 0.0, z)
        p.put("needles", occlusion.open_sky(core), at)
        p.put("cypress", occlusion.open_sky(leaves), at)
    return p


def _shade(crown, center, radius):
    """Leaves deep in a crown see less sky."""
    crown.uvs2 = []
    for q in crown.positions:
        depth = vec.length(vec.sub(q, center)) / radius
        crown.uvs2.append((min(1.0, 0.25 + 0.75 * depth * depth), 0.5))
