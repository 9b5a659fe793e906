"""The camera of scenes that have none."""

import json
import math

from pictures import SMALL, read_png
from support import TestCase, assets, main


class Framing(TestCase):
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
