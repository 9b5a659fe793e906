"""doctor, info and list: what the program tells of the machine, of scenes and of itself."""

import json
import os

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
                lines = self.succeed("list", what).stdout.splitlines()
                self.assertEqual([line.split()[0] for line in lines], [row["name"] for row in rows])

    def test_without_a_name_the_choices_are_listed(self):
        rows = self.listed()
        lines = self.succeed("list").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], [row["name"] for row in rows])
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
