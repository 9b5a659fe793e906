"""Options for scene files: limits, links, and which materials cast."""

import json
import os
import struct
import zlib

from pictures import SMALL, SMALL_MAPS, scene
from support import TestCase, main

TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def large_png(side):
    """A PNG of one colour: its file is small, what it decodes to is not."""
    rows = zlib.compress(b"".join(b"\0" + bytes(side * 3) for _ in range(side)), 9)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", rows) + chunk(b"IEND", b""))


class SceneReading(TestCase):
    def write_scene(self, **members):
        document = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "data.bin"}],
                    "bufferViews": [{"buffer": 0, "byteLength": 36}],
                    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
                    "materials": [{"name": "paint = red"}],
                    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                    "nodes": [{"mesh": 0}], **members}
        path = self.folder / "scene" / "scene.gltf"
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps(document))
        if not os.path.lexists(path.parent / "data.bin"):
            (path.parent / "data.bin").write_bytes(TRIANGLE)
        return path

    def test_images_over_the_limit_are_refused_before_they_are_decoded(self):
        count, side = 8, 2048
        path = self.write_scene(
            images=[{"uri": f"{i}.png"} for i in range(count)], textures=[{"source": i} for i in range(count)],
            materials=[{"emissiveTexture": {"index": i}} for i in range(count)],
            meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": i} for i in range(count)]}])
        for i in range(count):
            (path.parent / f"{i}.png").write_bytes(large_png(side) if i < 7 else large_png(side)[:-40])
        error = self.refuse("info", path, "--limit", "images=100MiB")
        self.assertIn(f"{path}: 8 images take 128 MiB when decoded, over the limit of 100 MiB; --limit images=SIZE", error)
        self.assertIn("images[7]", self.refuse("info", path, "--limit", "images=128MiB"))  # damaged: it was decoded
        self.assertIn("2048 x 2048 pixels", self.refuse("info", path, "--limit", "image-pixels=1000000"))

    def test_bench_decodes_images_as_large_as_the_limit_allows(self):
        path = self.write_scene(images=[{"uri": "0.png"}], textures=[{"source": 0}],
                                materials=[{"emissiveTexture": {"index": 0}}])
        side = 8200
        # Without its rows, so that decoding it begins and ends at once.
        header = chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 1, 0, 0, 0, 0))
        (path.parent / "0.png").write_bytes(b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", zlib.compress(b""))
                                            + chunk(b"IEND", b""))
        self.assertIn("over the limit", self.refuse("bench", path, *SMALL))
        error = self.refuse("bench", path, *SMALL, "--limit", "image-pixels=100000000", "--limit", "images=1GiB")
        self.assertIn("images[0]", error)
        self.assertNotIn("over the limit", error)

    def test_names_of_all_languages_are_quoted(self):
        path = self.write_scene(images=[{"uri": "größe.png"}], textures=[{"source": 0}],
                                materials=[{"emissiveTexture": {"index": 0}}])
        self.assertIn("'größe.png' not found", self.refuse("info", path))

    def test_limits_have_names_and_numbers(self):
        path = self.write_scene()
        self.succeed("info", path, "--limit", "vertices=6", "--limit", "data=1MiB")  # 3, and 3 split for flat normals
        self.assertIn("over the limit of 2", self.refuse("info", path, "--limit", "vertices=2"))
        self.assertIn("'vertices'", self.refuse("info", path, "--limit", "vertexes=2", code=2))
        self.assertIn("'many'", self.refuse("info", path, "--limit", "images=many", code=2))

    def test_links_out_of_the_folder_are_followed_if_asked(self):
        path = self.write_scene()
        (path.parent / "data.bin").rename(self.folder / "elsewhere.bin")
        (path.parent / "data.bin").symlink_to(self.folder / "elsewhere.bin")
        self.assertIn("--follow-links allows it", self.refuse("info", path))
        self.succeed("info", path, "--follow-links")

    def test_materials_that_cast_are_known(self):
        path = self.write_scene()
        picture = self.folder / "x.png"
        self.succeed("render", path, "-o", picture, *SMALL, *SMALL_MAPS, "--casters", "paint = red=off")
        self.assertIn("did you mean 'paint = red'",
                      self.refuse("render", path, "-o", picture, *SMALL, "--casters", "paint red=off"))
        self.assertIn("--casters); it has 'paint = red'",
                      self.refuse("render", path, "-o", picture, *SMALL, "--casters", "wood=off"))
        self.assertIn("'front'", self.refuse("render", path, "-o", picture, "--casters", "paint = red=frnt", code=2))
        self.assertIn("MATERIAL=HOW", self.refuse("render", path, "-o", picture, "--casters", "paint", code=2))

    def test_a_sky_is_named_only_if_the_user_has_not_decided_about_it(self):
        # A large unlit tetrahedron around a small triangle. The small one is the large one's face, scaled.
        corners = [(0, 90, 0), (-150, -30, 90), (150, -30, 90), (0, -30, -180)]
        faces = [(0, 1, 2), (0, 2, 3), (0, 3, 1)]
        data = b"".join(struct.pack("<3f", *corners[i]) for face in faces for i in face)
        document = {"buffers": [{"byteLength": len(data), "uri": "sky.bin"}],
                    "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
                    "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"}
                                  for count in (9, 3)],
                    "materials": [{"name": "sky", "doubleSided": True}, {"name": "thing"}],
                    "meshes": [{"primitives": [{"attributes": {"POSITION": i}, "material": i}]} for i in (0, 1)],
                    "nodes": [{"mesh": 0}, {"mesh": 1, "scale": [0.01, 0.01, 0.01]}]}
        path = self.write_scene(**document)
        (path.parent / "sky.bin").write_bytes(data)
        preset = self.folder / "p.toml"
        preset.write_text("[casters]\nskies = true\n")
        picture = self.folder / "x.png"
        for arguments, warns in (([], True), (["--casters", "thing=off"], True), (["--casters", "sky=off"], False),
                                 (["--casters", "sky=on"], False), (["--set", "casters.skies=on"], False),
                                 (["--set", "casters.skies=off"], False), (["--preset", preset], False)):
            with self.subTest(arguments):
                result = self.succeed("render", path, "-o", picture, *SMALL, *SMALL_MAPS, *arguments)
                self.assertEqual("encloses the scene as a sky does" in result.stderr, warns, result.stderr)

    def test_casters_change_the_picture(self):
        def mask(*arguments):
            path = self.folder / "mask.png"
            self.succeed("render", scene("steps"), "-o", path, *SMALL, *SMALL_MAPS, "--aov", "shadow", *arguments)
            return {file.name: file.read_bytes() for file in self.folder.glob("*.png")}

        usual = mask()
        self.assertEqual(usual, mask("--set", "casters.faces=both"))
        self.assertNotEqual(usual, mask("--set", "casters.faces=back"))


if __name__ == "__main__":
    main()
