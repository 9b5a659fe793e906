"""A writer of binary glTF: numbers are snapped to a binary grid, so that one unit in the last place of a platform's
sine does not reach the file."""

import json
import math
import struct

from . import vec

FLOAT, U8, U16, U32 = 5126, 5121, 5123, 5125
FORMATS = {FLOAT: "f", U8: "B", U16: "H", U32: "I"}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


def snap(value, grid=65536.0):
    return math.floor(value * grid + 0.5) / grid + 0.0  # + 0.0: no negative zero


def plain(value):
    """A number for the JSON: at most 6 decimals, integers without a point."""
    value = round(value, 6) + 0.0
    return int(value) if value == int(value) else value


def plain_list(values):
    return [plain(v) for v in values]


class Glb:
    def __init__(self, generator="Penumbra scenes/generate.py"):
        self.root = {"asset": {"version": "2.0", "generator": generator}, "scene": 0, "scenes": [{"nodes": []}]}
        self.blob = bytearray()

    def _append(self, kind, item):
        items = self.root.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def _extension(self, name):
        used = self.root.setdefault("extensionsUsed", [])
        if name not in used:
            used.append(name)
        return self.root.setdefault("extensions", {})

    def _view(self, data, target=None):
        while len(self.blob) % 4:
            self.blob.append(0)
        view = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.blob += data
        return self._append("bufferViews", view)

    def accessor(self, rows, width, component=FLOAT, target=None, bounds=False):
        """rows: numbers (width 1) or tuples; bytes and shorts must be four-byte rows."""
        flat = [v for row in rows for v in row] if width > 1 else list(rows)
        if component == FLOAT:
            flat = [snap(v) for v in flat]
        data = struct.pack("<%d%s" % (len(flat), FORMATS[component]), *flat)
        item = {
            "bufferView": self._view(data, target),
            "componentType": component,
            "count": len(flat) // width,
            "type": KINDS[width],
        }
        if bounds:
            stored = struct.unpack("<%d%s" % (len(flat), FORMATS[component]), data)
            item["min"] = [min(stored[i::width]) for i in range(width)]
            item["max"] = [max(stored[i::width]) for i in range(width)]
        return self._append("accessors", item)

    def texture(self, name, png, clamp=False):
        image = self._append("images", {"name": name, "mimeType": "image/png", "bufferView": self._view(png)})
        wrap = 33071 if clamp else 10497
        sampler = {"magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap}
        samplers = self.root.setdefault("samplers", [])
        if sampler not in samplers:
            samplers.append(sampler)
        return self._append("textures", {"name": name, "sampler": samplers.index(sampler), "source": image})

    def material(self, name, color=(0.5, 0.5, 0.5), roughness=1.0, metallic=0.0, alpha=1.0, **options):
        """Options: color_texture, normal_texture, rough_texture, occlusion_texture (the second UV set), normal_scale,
        mask (cut-off), blend, double_sided, emissive. Colours are linear."""
        pbr = {"baseColorFactor": plain_list([*color, alpha]), "metallicFactor": plain(metallic)}
        pbr["roughnessFactor"] = plain(roughness)
        item = {"name": name, "pbrMetallicRoughness": pbr}
        if "color_texture" in options:
            pbr["baseColorTexture"] = {"index": options["color_texture"]}
        if "rough_texture" in options:
            pbr["metallicRoughnessTexture"] = {"index": options["rough_texture"]}
        if "normal_texture" in options:
            item["normalTexture"] = {"index": options["normal_texture"]}
            if "normal_scale" in options:
                item["normalTexture"]["scale"] = plain(options["normal_scale"])
        if "occlusion_texture" in options:
            item["occlusionTexture"] = {"index": options["occlusion_texture"], "texCoord": 1}
        if "emissive" in options:
            item["emissiveFactor"] = plain_list(options["emissive"])
        if "mask" in options:
            item["alphaMode"], item["alphaCutoff"] = "MASK", plain(options["mask"])
        if options.get("blend"):
            item["alphaMode"] = "BLEND"
        if options.get("double_sided"):
            item["doubleSided"] = True
        return self._append("materials", item)

    def primitive(self, shape, material=None, targets=()):
        """targets: for morphing, pairs of position and normal deltas."""
        attributes = {
            "POSITION": self.accessor(shape.positions, 3, FLOAT, 34962, True),
            "NORMAL": self.accessor(shape.normals, 3, FLOAT, 34962),
        }
        if shape.uvs:
            attributes["TEXCOORD_0"] = self.accessor(shape.uvs, 2, FLOAT, 34962)
        if shape.uvs2:
            attributes["TEXCOORD_1"] = self.accessor(shape.uvs2, 2, FLOAT, 34962)
        if shape.joints:
            attributes["JOINTS_0"] = self.accessor(shape.joints, 4, U8, 34962)
            attributes["WEIGHTS_0"] = self.accessor(shape.weights, 4, FLOAT, 34962)
        width = U16 if len(shape.positions) < 65536 else U32
        item = {"attributes": attributes, "indices": self.accessor(shape.indices, 1, width, 34963)}
        if material is not None:
            item["material"] = material
        if targets:
            item["targets"] = [
                {"POSITION": self.accessor(p, 3, FLOAT, 34962, True), "NORMAL": self.accessor(n, 3, FLOAT, 34962)}
                for p, n in targets
            ]
        return item

    def mesh(self, name, primitives, weights=None):
        item = {"name": name, "primitives": primitives}
        if weights:
            item["weights"] = plain_list(weights)
        return self._append("meshes", item)

    def node(self, name, parent=None, translation=None, rotation=None, scale=None, **links):
        """Links: mesh, camera, skin, extensions. Returns the node's index."""
        item = {"name": name}
        if translation and any(translation):
            item["translation"] = [snap(v) for v in translation]
        if rotation:
            item["rotation"] = [round(v, 9) + 0.0 for v in rotation]
        if scale:
            item["scale"] = [snap(v) for v in scale]
        item.update(links)
        index = self._append("nodes", item)
        if parent is None:
            self.root["scenes"][0]["nodes"].append(index)
        else:
            self.root["nodes"][parent].setdefault("children", []).append(index)
        return index

    def add(self, name, shape, material=None, **placement):
        """A mesh of one primitive with its node."""
        return self.node(name, mesh=self.mesh(name, [self.primitive(shape, material)]), **placement)

    def camera(self, name, eye, target, fov=45.0, near=0.05, aspect=16 / 9):
        lens = {"yfov": round(math.radians(fov), 9), "znear": plain(near), "aspectRatio": round(aspect, 6)}
        camera = self._append("cameras", {"name": name, "type": "perspective", "perspective": lens})
        return self.node(name, translation=eye, rotation=vec.look_at(eye, target), camera=camera)

    def orthographic(self, name, eye, target, width, near, far, aspect=16 / 9):
        lens = {"xmag": round(width / 2, 9), "ymag": round(width / 2 / aspect, 9), "znear": near, "zfar": far}
        camera = self._append("cameras", {"name": name, "type": "orthographic", "orthographic": lens})
        return self.node(name, translation=eye, rotation=vec.look_at(eye, target), camera=camera)

    def sun(self, azimuth, elevation, lux=100000.0, color=(1.0, 1.0, 1.0)):
        """A directional light; degrees, azimuth from +Z towards +X, of the direction to the sun."""
        lights = self._extension("KHR_lights_punctual").setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"name": "sun", "type": "directional", "color": plain_list(color), "intensity": plain(lux)})
        turn = vec.quat_mul(vec.axis_angle((0, 1, 0), azimuth), vec.axis_angle((1, 0, 0), -elevation))
        link = {"KHR_lights_punctual": {"light": len(lights) - 1}}
        return self.node("sun", rotation=turn, extensions=link)

    def skin(self, name, joints, inverse_binds):
        item = {"name": name, "joints": joints, "skeleton": joints[0]}
        item["inverseBindMatrices"] = self.accessor(inverse_binds, 16)
        return self._append("skins", item)

    def animation(self, name, channels):
        """channels: (node, path, interpolation, times, values); values are flat for weights."""
        item = {"name": name, "channels": [], "samplers": []}
        for node, path, interpolation, times, values in channels:
            width = {"translation": 3, "scale": 3, "rotation": 4, "weights": 1}[path]
            sampler = {
                "input": self.accessor(times, 1, bounds=True),
                "output": self.accessor(values, width),
                "interpolation": interpolation,
            }
            item["channels"].append({"sampler": len(item["samplers"]), "target": {"node": node, "path": path}})
            item["samplers"].append(sampler)
        return self._append("animations", item)

    def bytes(self):
        while len(self.blob) % 4:
            self.blob.append(0)
        root = {**self.root, "buffers": [{"byteLength": len(self.blob)}]}
        text = json.dumps(root, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + len(self.blob)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(self.blob), 0x004E4942) + bytes(self.blob)
        return struct.pack("<III", 0x46546C67, 2, total) + chunks
