"""Lamps: lights of KHR_lights_punctual with a size and a body, and their colours."""

import math

from . import vec
from .building import Part
from .shapes import box, cylinder, lathe, rod


def linear_srgb(kelvin):
    """A black body of luminance 1, 1667 K to 25000 K. Kim et al. 2002, "Design of advanced color temperature control
    system for HDTV applications"."""
    k = 1000.0 / kelvin
    if kelvin < 4000.0:
        x = ((-0.2661239 * k - 0.2343589) * k + 0.8776956) * k + 0.17991
    else:
        x = ((-3.0258469 * k + 2.1070379) * k + 0.2226347) * k + 0.24039
    if kelvin < 2222.0:
        y = ((-1.1063814 * x - 1.3481102) * x + 2.18555832) * x - 0.20219683
    elif kelvin < 4000.0:
        y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
    else:
        y = ((3.081758 * x - 5.8733867) * x + 3.75112997) * x - 0.37001483
    big_x, big_z = x / y, (1 - x - y) / y
    return (3.2404542 * big_x - 1.5371385 - 0.4985314 * big_z, -0.969266 * big_x + 1.8760108 + 0.041556 * big_z,
            0.0556434 * big_x - 0.2040259 + 1.0572252 * big_z)


def black_body(kelvin, white=4000.0):
    """Linear sRGB of a black body for an eye adapted to another one; the largest component is 1."""
    color = [a / b for a, b in zip(linear_srgb(kelvin), linear_srgb(white))]
    return [round(c / max(color), 3) for c in color]


def _lamp(glb, name, kind, at, candela, kelvin, radius, **more):
    """A light of KHR_lights_punctual at a point; its radius, in metres, is among its extras."""
    lights = glb.root["extensions"]["KHR_lights_punctual"]["lights"]
    light = {"name": name, "type": kind, "color": black_body(kelvin), "intensity": candela, "range": 50,
             "extras": {"radius": radius}}
    rotation = None
    if kind == "spot":
        light["spot"] = {"innerConeAngle": round(math.radians(more["inner"]), 6),
                         "outerConeAngle": round(math.radians(more["outer"]), 6)}
        rotation = vec.look_at(at, more["target"])
    lights.append(light)
    link = {"KHR_lights_punctual": {"light": len(lights) - 1}}
    glb.node(name, translation=at, rotation=rotation, extensions=link)


def spot(glb, name, place, target, candela, inner, outer):
    """A lamp below a track whose lower side is at place. Its light is 1 cm before the mouth of its housing, so that the
    housing hides none of it."""
    p = Part(name + " housing")
    x, y, z = place
    joint = (x, y - 0.09, z)
    axis = vec.normalize(vec.sub(target, joint))
    at = vec.along(joint, target)
    length, radius = 0.17, 0.05
    body = lathe([(0.0, -0.05), (0.04, -0.05), (radius, -0.035), None, (radius, length - 0.05), None,
                  (radius - 0.006, length - 0.05), None, (radius - 0.01, length - 0.065), (0.0, length - 0.065)], 28)
    p.put("black paint", body, at)
    p.put("lamp", cylinder(0.039, length - 0.064, length - 0.062, 24), at)
    p.put("black paint", rod((x, y + 0.02, z), joint, 0.011, 10))
    p.put("black paint", box(x - 0.07, y - 0.012, z - 0.018, x + 0.07, y + 0.002, z + 0.018))
    _lamp(glb, name, "spot", vec.add(joint, vec.scale(axis, length - 0.04)), candela, 3200.0, 0.04, target=target,
          inner=inner, outer=outer)
    return p


def shade():
    """The outside of the pendant's shade and its lining, which together are closed; the light is at the origin."""
    inside = [(0.205, -0.07), (0.17, 0.0), (0.12, 0.075), (0.06, 0.125)]
    outside = [(r + 0.006, h + 0.004) for r, h in inside]
    return lathe([*outside, None, inside[-1]], 40), lathe([*inside[::-1], None, outside[0]], 40)


def pendant(glb, place, ceiling, candela):
    """A lamp in an open shade. It hangs from the ceiling; its bulb is left out."""
    p = Part("pendant")
    x, y, z = place
    at = vec.translate(x, y, z)
    outside, lining = shade()
    p.put("yellow paint", outside, at)
    p.put("white paint", lining, at)
    # Three spokes hold the shade; the cord ends above the light.
    for k in range(3):
        a = 2 * math.pi * k / 3
        end = (0.066 * math.cos(a), 0.127, 0.066 * math.sin(a))
        p.put("copper", rod((0.0, 0.15, 0.0), end, 0.004, 6), at)
    p.put("copper", lathe([(0.0, 0.13), (0.022, 0.135), None, (0.022, 0.2), (0.012, 0.215), (0.0, 0.218)], 20), at)
    p.put("black paint", rod((x, y + 0.21, z), (x, ceiling - 0.02, z), 0.005, 8))
    p.put("copper", cylinder(0.06, ceiling - 0.025, ceiling, 24), vec.translate(x, 0.0, z))
    _lamp(glb, "pendant", "point", place, candela, 2700.0, 0.08)
    return p
