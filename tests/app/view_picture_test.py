"""penumbra view as the README shows it: PENUMBRA_PICTURES=docs has this test write docs/viewer.png anew."""

import os
import pathlib

import pictures
from support import main
from window import WindowTest

SIZE = (1280, 720)


class ReadmePicture(WindowTest):
    def test_a_technique_stands_beside_the_truth(self):
        folder = os.environ.get("PENUMBRA_PICTURES")
        look = ("--set", f"truth.samples={64 if folder else 8}", "--set", "sun.angle=2")
        with self.view(pictures.scene("courtyard"), *look, maps=(), size=SIZE) as viewer:
            viewer.open_tab("Compare", "compare")
            viewer.click("compare", lambda: viewer.has("b"), "the choice of B")
            viewer.choose("b", "truth")
            viewer.wait_for(lambda: viewer.has("distance"), "the figures")
            self.assertGreater(len(viewer.rest().colors()), 1000)
            for name, (left, top, right, bottom) in viewer.layout().items():
                with self.subTest(name):
                    self.assertTrue(0 <= left <= right <= SIZE[0] and 0 <= top <= bottom <= SIZE[1])
            if folder:
                self.desktop.screenshot().save_png(pathlib.Path(folder, "viewer.png"))


if __name__ == "__main__":
    main()
