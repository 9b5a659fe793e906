"""The camera of scenes that have none."""

import json
import math
import struct

from pictures import SMALL, read_png
from support import TestCase, assets, main


def write_box_on_plane(path, half_plane):
    """A box of 1 m on a plane, metres."""
    box = [(x, y, z) for x in (-0.5, 0.5) for y in (0, 1) for z in (-0.5, 0.5)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    plane = [(-half_plane, 0, half_plane), (half_plane, 0, half_plane), (half_plane, 0, -half_plane), (-half_plane, 0, -half_plane)]
    points = [[box[face[i]] for face in faces for i in (0, 1, 2, 0, 2, 3)], [plane[i] for i in (0, 1, 2, 0, 2, 3)]]
    data = b"".join(struct.pack("<3f", *point) for mesh in points for point in mesh)
    accessors = [{"bufferView": 0, "byteOffset": offset, "componentType": 5126, "count": len(mesh), "type": "VEC3",
                  "min": list(map(min, zip(*mesh))), "max": list(map(max, zip(*mesh)))}
                 for mesh, offset in zip(points, (0, 12 * len(points[0])))]
    path.with_suffix(".bin").write_bytes(data)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 1}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": i}}]} for i in (0, 1)], "accessors": accessors,
        "buffers": [{"byteLength": len(data), "uri": path.with_suffix(".bin").name}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}]}))


class Framing(TestCase):
    def test_a_box_on_a_wide_plane_is_framed_with_its_shadow(self):
        path, stats = self.folder / "box.gltf", self.folder / "s.json"
        for half_plane in (5, 500):
            write_box_on_plane(path, half_plane)
            self.succeed("render", path, "-o", self.folder / "x.png", *SMALL, "--aov", "shadow", "--technique", "hard",
                         "--stats", stats, "--quiet")
            self.assertLess(math.hypot(*json.loads(stats.read_text())["camera"]["eye"]), 30)
            shadow = b"".join(read_png(self.folder / "x.shadow.png")[3])
            self.assertGreater(shadow.count(0) / len(shadow), 0.01)

    def test_a_palm_in_a_sea_is_framed_with_its_shadow(self):
        palm = assets("scenes") / "palm_tree" / "PalmTree.gltf"
        stats = self.folder / "s.json"
        self.succeed("render", palm, "-o", self.folder / "x.png", *SMALL, "--aov", "shadow", "--technique", "hard",
                     "--stats", stats, "--quiet")
        # The palm is 4 m high and near the origin; the sea is 390 m wide.
        self.assertLess(math.hypot(*json.loads(stats.read_text())["camera"]["eye"]), 30)
        shadow = b"".join(read_png(self.folder / "x.shadow.png")[3])
        self.assertGreater(shadow.count(0) / len(shadow), 0.01)


if __name__ == "__main__":
    main()
