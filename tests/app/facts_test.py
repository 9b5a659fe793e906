"""doctor, info and list: what the program tells of the machine, of scenes and of itself."""

import json
import os
import struct

from pictures import own_scenes, scene
from support import TestCase, main


class Doctor(TestCase):
    def test_offscreen_backends_work(self):
        report = json.loads(self.succeed("doctor", "--json").stdout)
        backends = {backend["name"]: backend for backend in report["backends"]}
        self.assertEqual(set(backends), {"egl", "osmesa", "window"})
        for name in ("egl", "osmesa"):
            self.assertTrue(backends[name]["works"], backends[name])
            device = backends[name]["device"]
            self.assertRegex(device["version"], r"^4\.[56]")
            self.assertIsInstance(device["software"], bool)
            self.assertGreater(device["limits"]["texture size"], 1023)

    def test_a_driver_that_osmesa_lacks_is_told(self):
        for name in ("zink", "d3d12", "llvmpip"):
            error = self.refuse("render", scene("steps"), "-o", self.folder / "x.png", "--size", "16x9", "--backend",
                                "osmesa", env={**os.environ, "GALLIUM_DRIVER": name})
            self.assertIn(f"GALLIUM_DRIVER is '{name}'", error)

    def test_text_names_each_backend_and_the_limits(self):
        text = self.succeed("doctor").stdout
        for word in ("egl", "osmesa", "window", "vendor", "renderer", "version", "limits", "software"):
            self.assertIn(word, text)

    def test_advice_when_nothing_works(self):
        # The loader searches an empty folder first, so it finds neither an EGL driver nor OSMesa. There is no display.
        nothing = self.folder / "empty"
        nothing.mkdir()
        for name in ("libEGL.so.1", "libEGL.so", "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"):
            (nothing / name).write_text("no library")
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment["LD_LIBRARY_PATH"] = str(nothing)
        environment["LIBGL_DRIVERS_PATH"] = str(nothing)
        environment["GALLIUM_DRIVER"] = "none"
        environment["__EGL_VENDOR_LIBRARY_DIRS"] = str(nothing)
        error = self.refuse("doctor", env=environment)
        self.assertIn("install", error)


class Info(TestCase):
    def test_every_scene_of_ours(self):
        self.assertGreater(len(own_scenes()), 5)
        for path in own_scenes():
            with self.subTest(path.name):
                facts = json.loads(self.succeed("info", path, "--json").stdout)
                self.assertGreater(facts["triangles"], 0)
                self.assertEqual(len(facts["bounds"]["min"]), 3)
                self.assertIn("directional", [light["kind"] for light in facts["lights"]])
                text = self.succeed("info", path).stdout
                for word in ("nodes", "meshes", "triangles", "bounds", "materials", "lights", "cameras", "animations",
                             "extensions"):
                    self.assertIn(word, text)

    def test_moving_parts(self):
        facts = json.loads(self.succeed("info", scene("moving"), "--json").stdout)
        self.assertGreater(facts["skins"], 0)
        self.assertGreater(facts["morph_targets"], 0)
        self.assertGreater(facts["animations"][0]["seconds"], 0)

        low, high = facts["animated_bounds"]["min"], facts["animated_bounds"]["max"]
        for axis in range(3):
            self.assertLessEqual(low[axis], facts["bounds"]["min"][axis])
            self.assertGreaterEqual(high[axis], facts["bounds"]["max"][axis])
        still = json.loads(self.succeed("info", scene("steps"), "--json").stdout)
        self.assertNotIn("animated_bounds", still)

    def write_moving_triangle(self):
        """A triangle of one metre that moves by 5 m along x in a second, and back, with a texture of 4 x 2 pixels."""
        data = struct.pack("<9f3f9f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 0, 5, 0, 0, 0, 0, 0)
        (self.folder / "data.bin").write_bytes(data)
        self.succeed("bake", "noise", "--kind", "white", "--size", "16", "-o", self.folder / "noise.png")
        path = self.folder / "moving.gltf"
        path.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "extensionsUsed": ["KHR_materials_unlit", "KHR_materials_sheen"],
            "buffers": [{"byteLength": len(data), "uri": "data.bin"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12},
                            {"buffer": 0, "byteOffset": 48, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [2]},
                          {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "images": [{"uri": "noise.png"}], "textures": [{"source": 0}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "animations": [{"samplers": [{"input": 1, "output": 2}],
                            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]}))
        return path

    def test_what_an_animation_covers_what_the_gpu_holds_and_what_is_not_supported(self):
        path = self.write_moving_triangle()
        facts = json.loads(self.succeed("info", path, "--json").stdout)
        self.assertEqual(facts["bounds"]["max"], [1, 1, 0])
        self.assertEqual(facts["animated_bounds"], {"min": [0, 0, 0], "max": [6, 1, 0]})
        # Three vertices of 52 bytes, three indices, a normal; 16 x 16 texels with their mip levels, as colour and as data.
        self.assertEqual(facts["gpu_vertex_bytes"], 3 * 52 + 3 * 4 + 12)
        self.assertEqual(facts["gpu_texture_bytes"], 2 * 4 * (256 + 64 + 16 + 4 + 1))
        self.assertEqual(facts["unsupported_extensions"], ["KHR_materials_sheen"])
        text = self.succeed("info", path).stdout
        self.assertIn("KHR_materials_sheen, not supported", text)
        self.assertIn("  KHR_materials_unlit\n", text)
        self.assertRegex(text, r"animated +0 0 0 to 6 1 0 m")
        self.assertRegex(text, r"on the GPU +180 B of vertices, 2.7 KiB of textures")

    def test_what_is_no_scene(self):
        junk = self.folder / "two\nlines.glb"
        junk.write_bytes(b"glTF" + bytes(64))
        for path in (junk, self.folder, self.folder / "none.gltf", "/dev/zero", "/bin/sh", ""):
            with self.subTest(path):
                self.refuse("info", path, timeout=20)

    def test_names_cannot_steer_the_terminal(self):
        document = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": [{}],
                    "materials": [{"name": "a\x1b[31m\nb"}]}
        path = self.folder / "x.gltf"
        path.write_text(json.dumps(document))
        text = self.succeed("info", path).stdout
        self.assertNotIn("\x1b", text)
        self.assertIn("  a [31m b\n", text)


class Lists(TestCase):
    def test_each_list_has_names_and_sentences(self):
        for what, name in (("techniques", "pcss"), ("params", "sun.angle"), ("aovs", "shadow"),
                           ("denoisers", "history_and_filters"), ("products", "least_depth_pyramid"), ("backends", "osmesa")):
            with self.subTest(what):
                rows = self.listed(what)
                self.assertIn(name, [row["name"] for row in rows])
                self.assertTrue(all(row["help"] for row in rows))
                self.assertEqual(self.first_words(what), [row["name"] for row in rows])

    def first_words(self, *what):
        lines = self.succeed("list", *what).stdout.splitlines()
        self.assertLessEqual(max(map(len, lines)), 100)
        return [line.split()[0] for line in lines if not line.startswith(" ")]

    def test_without_a_name_the_choices_are_listed(self):
        rows = self.listed()
        self.assertEqual(self.first_words(), [row["name"] for row in rows])
        for row in rows:
            self.succeed("list", row["name"])
        self.assertIn("penumbra list", self.succeed("help").stdout)

    def test_a_techniques_parameters_and_source(self):
        rows = {row["name"]: row for row in self.listed("techniques")}
        self.assertIn("pcss.filter_taps", rows["pcss"]["params"])
        self.assertIn("Fernando", rows["pcss"]["source"])
        self.assertEqual(rows["pcss_compute"]["technique"], "pcss")


if __name__ == "__main__":
    main()
