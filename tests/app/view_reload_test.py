"""penumbra view: shaders and scenes that are saved while the window is open."""

import itertools
import os
import random
import time

from desktop import LEFT
from pictures import scene
from support import ROOT, main
from window import KNIFE_EDGE, STEPS, WindowTest

INCLUDE = "lib/tone_map.glsl"
FILES = (INCLUDE, "render/sky.glsl", "render/tone_map.frag", "shadow/techniques/pcss.glsl", "shadow/search.glsl")
MOST_GROWTH = 4  # MiB, with fifty saves


def in_place(path, text):
    path.write_text(text)


def by_rename(path, text):
    path.with_suffix(".new").write_text(text)
    os.replace(path.with_suffix(".new"), path)


class Reload(WindowTest):
    def setUp(self):
        super().setUp()
        self.texts = {name: (ROOT / "glsl" / name).read_text() for name in FILES}
        self.glsl = self.folder / "glsl"
        for name, text in self.texts.items():
            (self.glsl / name).parent.mkdir(parents=True, exist_ok=True)
            (self.glsl / name).write_text(text)

    def view(self, **options):
        return super().view(STEPS, "--glsl", self.glsl, **options)

    def redder(self):
        old = "return clamp(d, 0.0f, 1.0f);"
        self.assertIn(old, self.texts[INCLUDE])
        return self.texts[INCLUDE].replace(old, "return clamp(vec3(1.0f, d.y, d.z), 0.0f, 1.0f);")

    def test_an_include_changes_the_picture_however_it_is_saved(self):
        with self.view() as viewer:
            before = viewer.rest()
            for save in (in_place, by_rename):
                with self.subTest(save=save.__name__):
                    self.check_include(viewer, before, save)

    def check_include(self, viewer, before, save):
        """There and back."""
        save(self.glsl / INCLUDE, self.redder())
        red = viewer.changed(before)
        self.assertEqual({pixel[0] for pixel in red.colors()}, {255})
        save(self.glsl / INCLUDE, self.texts[INCLUDE])
        self.assertEqual(viewer.changed(red), before)

    def test_a_fault_is_told_and_the_last_picture_stays_until_the_fix(self):
        with self.view() as viewer:
            before = viewer.rest()
            for save in (in_place, by_rename):
                with self.subTest(save=save.__name__):
                    save(self.glsl / INCLUDE, self.texts[INCLUDE].replace("vec3 c =", "vec3 c = =", 1))
                    viewer.wait_for(lambda: viewer.has("shader errors"), "the faults")
                    left, top, right, bottom = viewer.box("shader errors")
                    self.assertGreater(min(right - left, bottom - top), 20)
                    self.assertEqual(self.below(viewer.rest(), viewer), self.below(before, viewer))
                    save(self.glsl / INCLUDE, self.texts[INCLUDE])
                    viewer.wait_for(lambda: not viewer.has("shader errors"), "no faults")
                    viewer.wait_for(lambda: viewer.rest() == before, "the picture as it was")

    def below(self, picture, viewer):
        """What the list of faults does not cover."""
        top = viewer.box("picture")[3] // 3
        covered = viewer.box("shader errors")[3] - top if viewer.has("shader errors") else 0
        self.assertLess(covered, picture.height - 20)
        return picture.crop(0, covered, picture.width, picture.height)

    def test_a_scene_is_opened_while_a_shader_is_broken(self):
        with self.view() as viewer:
            wanted = viewer.rest()
        in_place(self.glsl / INCLUDE, "broken")
        with self.view(rests=False) as viewer:
            viewer.wait_for(lambda: viewer.has("shader errors") or viewer.has("messages"), "the fault")
            in_place(self.glsl / INCLUDE, self.texts[INCLUDE])
            viewer.wait_for(lambda: viewer.rest() == wanted, "the scene")

    def test_a_camera_moves_though_less_detail_was_never_compiled(self):
        with self.view() as viewer:
            before = viewer.rest()
            in_place(self.glsl / "shadow/search.glsl", self.texts["shadow/search.glsl"] + "float broken( { ;\n")
            viewer.wait_for(lambda: viewer.has("shader errors"), "the fault")
            seen = self.below(before, viewer)
            viewer.drag(*viewer.middle("picture"), LEFT, lambda: self.below(viewer.picture(), viewer) != seen, "another picture")
            self.assertGreater(self.below(viewer.rest(), viewer).differing(seen, by=8), 0.005)

    def test_what_cannot_be_drawn_at_all_is_not_tried_again_and_again(self):
        with self.view() as viewer:
            before = viewer.rest()
            in_place(self.glsl / "shadow/search.glsl", self.texts["shadow/search.glsl"] + "float broken( { ;\n")
            viewer.wait_for(lambda: viewer.has("shader errors"), "the fault")
            viewer.choose("technique", "slices")
            viewer.wait_for(lambda: viewer.has("not drawn"), "no further try")
            in_place(self.glsl / "shadow/search.glsl", self.texts["shadow/search.glsl"])
            viewer.wait_for(lambda: not viewer.has("shader errors"), "no faults")
            self.assertNotEqual(viewer.rest(), before)

    def test_three_hundred_saves(self):
        seed = int(os.environ.get("PENUMBRA_SEED", 7))
        dice = random.Random(seed)
        with self.subTest(seed=seed), self.view() as viewer:
            before = viewer.rest()
            memory = []
            for count in range(301):
                if count % 50 == 0:
                    viewer.follow()
                    memory.append(viewer.memory())
                self.save_something(dice)
                pause = dice.choice((0, 0, 0.02, 0.1, None, None))
                if pause is None:
                    viewer.follow()
                else:
                    time.sleep(pause)
                self.assertIsNone(viewer.process.poll(), viewer.stderr())
            for name, text in self.texts.items():
                in_place(self.glsl / name, text)
            viewer.wait_for(lambda: not viewer.has("shader errors"), "no faults")
            viewer.wait_for(lambda: viewer.rest() == before, "the picture as it was")
            self.check_include(viewer, before, in_place)
            # The compiler's memory grows now and then, by the hardest shader that it met; a leak grows all the time.
            growth = [after - before for before, after in itertools.pairwise(memory[1:])]
            self.assertLess(min(growth), MOST_GROWTH, memory)

    def save_something(self, dice):
        name = dice.choice(FILES)
        text = self.texts[name]
        kind = dice.choice(("same", "comment", "comment", "fault", "cut", "delete", "red"))
        if kind == "comment":
            text += f"// {dice.random()}\n"
        elif kind == "fault":
            text += "no shader = at all;\n"
        elif kind == "cut":
            text = text[:dice.randrange(len(text))]
        elif kind == "red":
            name, text = INCLUDE, self.redder()
        if kind == "delete":
            (self.glsl / name).unlink(missing_ok=True)
        else:
            dice.choice((in_place, by_rename))(self.glsl / name, text)


class Scene(WindowTest):
    def test_a_scene_that_could_not_be_read_is_shown_once_it_is_mended(self):
        file = self.folder / "scene.glb"
        file.write_bytes(STEPS.read_bytes()[:1000])
        wanted = self.picture_of(STEPS)
        with self.view(file, rests=False) as viewer:
            viewer.wait_for(lambda: viewer.has("no scene"), "why there is none")
            file.write_bytes(STEPS.read_bytes())
            viewer.wait_for(lambda: viewer.rest() == wanted, "the scene")
            self.assertFalse(viewer.has("no scene"))

    def test_a_scene_that_could_not_take_the_place_of_the_last_does_so_once_it_is_mended(self):
        file = self.folder / "scene.glb"
        file.write_bytes(KNIFE_EDGE.read_bytes()[:1000])
        wanted = self.picture_of(KNIFE_EDGE)
        with self.view(STEPS) as viewer:
            before = viewer.rest()
            self.desktop.client.drop(viewer.window, *viewer.middle("picture"), file)
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            file.write_bytes(KNIFE_EDGE.read_bytes())
            self.assertEqual(viewer.changed(before), wanted)

    def test_a_scene_that_is_saved_again_with_fewer_lights_is_shown(self):
        file = self.folder / "scene.glb"
        file.write_bytes(scene("gallery").read_bytes())
        wanted = self.picture_of(STEPS)
        with self.view(file) as viewer:
            viewer.open_tab("Scene", "eye")
            gallery = viewer.rest()
            viewer.click("light=1", lambda: any(word.startswith("--lights=") for word in viewer.copied()), "other lights")
            file.write_bytes(STEPS.read_bytes())
            viewer.wait_for(lambda: viewer.rest() == wanted, "the scene")
            self.assertNotEqual(gallery, wanted)
            viewer.tap("ctrl+z")  # leads to before the lights were chosen, and not back again and again
            viewer.follow()
            viewer.tap("ctrl+z")
            viewer.follow()
            self.assertEqual([word for word in viewer.copied() if word.startswith("--lights")], [])

    def test_a_scene_that_is_saved_again_is_shown(self):
        file = self.folder / "scene.glb"
        file.write_bytes(STEPS.read_bytes())
        wanted = self.picture_of(KNIFE_EDGE)
        with self.view(file) as viewer:
            steps = viewer.rest()
            file.write_bytes(STEPS.read_bytes()[:1000])
            viewer.wait_for(lambda: viewer.has("messages"), "a message")
            self.assertEqual(viewer.rest(), steps)
            first = viewer.box("messages")
            file.write_bytes(b"")
            viewer.wait_for(lambda: viewer.box("messages") != first, "another message")
            file.write_bytes(KNIFE_EDGE.read_bytes())
            self.assertEqual(viewer.changed(steps), wanted)
            self.assertFalse(viewer.has("messages"), "why the file could not be read before")


if __name__ == "__main__":
    main()
