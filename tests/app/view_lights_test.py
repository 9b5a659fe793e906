"""The viewer's lights: those of the file, and lamps that the user adds and drags."""

import json
import re
import struct

from desktop import LEFT, WHEEL_UP
from pictures import scene
from support import main
from window import STEPS, WindowTest


def edited(glb, edit):
    """The .glb file with its JSON as `edit` leaves it."""
    size = struct.unpack_from("<I", glb, 12)[0]
    document = json.loads(glb[20:20 + size])
    edit(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = glb[20 + size:]
    head = struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON")
    return head + text + rest


def remove_lights(document):
    document["extensions"].pop("KHR_lights_punctual")
    for node in document["nodes"]:
        node.get("extensions", {}).pop("KHR_lights_punctual", None)


def share_a_light(document):
    """The spots and the point lamp become one lamp at three places."""
    for node in document["nodes"]:
        light = node.get("extensions", {}).get("KHR_lights_punctual")
        if light and light["light"] > 0:
            light["light"] = 3


class Lights(WindowTest):
    def lamps(self, viewer):
        """The places of the lamps in the command line that is copied."""
        words = [word.split("=", 1)[1] for word in viewer.copied() if word.startswith("--lamp=")]
        return [tuple(map(float, word.split(":")[0].split(","))) for word in words]

    def test_a_lamp_is_added_dragged_and_removed(self):
        with self.view(STEPS, "--sun", "20,50") as viewer:
            viewer.open_tab("Scene", "eye")
            dark = viewer.rest()
            viewer.click("add lamp", lambda: viewer.has("ring of lamp 0"), "its ring")
            lit = viewer.changed(dark)
            self.assertGreater(lit.differing(dark, by=16), 0.005)
            (before,) = self.lamps(viewer)
            box = viewer.box("ring of lamp 0")
            viewer.drag(*viewer.middle("ring of lamp 0"), LEFT, lambda: viewer.box("ring of lamp 0") != box, "the ring elsewhere")
            moved = viewer.changed(lit)
            self.assertGreater(moved.differing(lit, by=4), 0.005)
            (after,) = self.lamps(viewer)
            self.assertNotEqual(before, after)
            words = viewer.copied()
            self.assertIn("--sun=20,50", words)
            viewer.click("remove lamp", lambda: not viewer.has("ring of lamp 0"), "no ring")
            # Above the message that says what was copied.
            again = viewer.changed(moved)
            upper = (0, 0, dark.width, dark.height // 3)
            self.assertEqual(again.crop(*upper), dark.crop(*upper))
            self.assertGreater(len(dark.crop(*upper).colors()), 30)
            self.assertEqual(self.lamps(viewer), [])

    def test_a_lamp_of_the_file_is_dragged_and_changed(self):
        with self.view(scene("gallery"), "--technique", "hard") as viewer:
            viewer.open_tab("Scene", "eye")
            before = viewer.rest()
            ring = "ring of light 3"
            self.assertTrue(viewer.has(ring))
            self.assertFalse(viewer.has("ring of light 0"))  # the sun has none
            # A click on a ring only opens the lamp's properties.
            viewer.click(ring, lambda: viewer.has("lamp radius"), "the lamp's properties")
            self.assertEqual(self.lamps(viewer), [])
            x, y = viewer.middle(ring)
            far = lambda: viewer.has("ring of lamp 0") and viewer.middle("ring of lamp 0")[0] > x + 60
            viewer.drag(x, y, LEFT, far, "a lamp of the user's, 60 pixels to the right")
            self.assertFalse(viewer.has(ring))
            # Its light is weak beside that of the others, but reaches a large part of the room.
            self.assertGreater(viewer.changed(before).differing(before, by=1), 0.1)
            words = viewer.copied()
            self.assertIn("--lights=0,1,2", words)
            (lamp,) = [word for word in words if word.startswith("--lamp=")]
            self.assertIn("radius=0.08", lamp)
            self.assertIn("range=50", lamp)

    def point_at_x(self, viewer, field):
        """Points at the first of the three numbers of a field."""
        left, top, right, bottom = viewer.box(field)
        viewer.move(left + (right - left) // 6, (top + bottom) // 2)
        viewer.follow()

    def test_a_colour_that_is_dragged_leaves_the_intensity(self):
        with self.view(STEPS, "--lamp=0,3,0:cd=1000:rgb=1,0.5,0", size=(800, 700)) as viewer:
            viewer.open_tab("Scene", "eye")
            viewer.click("entry of lamp 0", lambda: viewer.has("lamp colour"), "its colour")
            left, top, right, bottom = viewer.box("lamp colour")
            lamp = [word for word in viewer.copied() if word.startswith("--lamp=")]
            for x in (left + 20, left + (right - left) // 3 + 20):  # red, the strongest, and green
                viewer.move(x, (top + bottom) // 2)
                self.desktop.xdotool("mousedown", LEFT)
                for step in range(1, 12):
                    viewer.follow()
                    viewer.move(x - 4 * step, (top + bottom) // 2)
                viewer.follow()
                self.desktop.xdotool("mouseup", LEFT)
                viewer.follow()
            (changed,) = [word for word in viewer.copied() if word.startswith("--lamp=")]
            self.assertNotEqual([changed], lamp)
            colour = [float(number) for number in re.search(r"rgb=([^:]+)", changed)[1].split(",")]
            candela = float(re.search(r"cd=([^:]+)", changed)[1]) if "cd=" in changed else 100.0
            self.assertAlmostEqual(candela * max(colour), 1000, delta=0.1)
            self.assertLess(candela * colour[1], 499)

    def test_a_place_is_dragged_slowly_and_typed_exactly(self):
        with self.view(STEPS, "--technique", "none", "--lamp=1,2.34567,0.5", size=(800, 700)) as viewer:
            viewer.open_tab("Scene", "eye")
            viewer.click("entry of lamp 0", lambda: viewer.has("lamp place"), "the lamp's properties")
            left, top, right, bottom = viewer.box("lamp place")
            x, y = left + (right - left) // 6, (top + bottom) // 2
            self.point_at_x(viewer, "lamp place")
            self.desktop.xdotool("mousedown", LEFT)
            viewer.follow()
            self.desktop.xdotool("keydown", "alt")  # 0.0001 m each pixel
            for way in range(10, 401, 10):
                viewer.move(x + way, y)
                viewer.follow()
            self.desktop.xdotool("keyup", "alt", "mouseup", LEFT)
            viewer.follow()
            ((moved, *others),) = self.lamps(viewer)
            self.assertTrue(1.02 <= moved <= 1.04, moved)
            self.assertEqual(moved, round(moved, 2))
            self.assertEqual(others, [2.34567, 0.5])
            self.point_at_x(viewer, "lamp place")
            self.desktop.xdotool("keydown", "ctrl", "click", LEFT)
            viewer.follow()
            self.desktop.xdotool("keyup", "ctrl")
            viewer.type("0.005")
            viewer.tap("Return")
            viewer.follow()
            self.assertEqual(self.lamps(viewer), [(0.005, 2.34567, 0.5)])

    def test_lights_of_the_file_are_turned_off_and_on(self):
        with self.view(scene("gallery"), "--technique", "hard") as viewer:
            viewer.open_tab("Scene", "eye")
            all_on = viewer.rest()
            viewer.click("light=2", lambda: True, "a light turned off")
            without = viewer.changed(all_on)
            self.assertGreater(without.differing(all_on, by=16), 0.01)
            self.assertIn("--lights=0,1,3", viewer.copied())
            viewer.click("light=2", lambda: True, "the light turned on")
            self.assertEqual(viewer.changed(without), all_on)
            self.assertFalse(viewer.has("no sun"))  # the file's sun has its own box
            viewer.click("light=0", lambda: True, "the sun turned off")
            self.assertGreater(viewer.changed(all_on).differing(all_on, by=16), 0.001)
            self.assertIn("--lights=1,2,3", viewer.copied())

    def test_a_sun_that_the_file_does_not_have_is_turned_off(self):
        with self.view(STEPS, "--technique", "hard", "--lights", "none", "--sun", "20,50", "--lamp", "0,2,0") as viewer:
            viewer.open_tab("Scene", "eye")
            lit = viewer.rest()
            viewer.click("no sun", lambda: True, "no sun")
            self.assertGreater(viewer.changed(lit).differing(lit, by=16), 0.001)
            words = viewer.copied()
            self.assertIn("--no-sun", words)
            self.assertFalse(any(word.startswith("--sun=") for word in words))

    def test_maps_in_the_list_of_textures_have_their_lights_names(self):
        with self.view(scene("gallery"), "--technique", "hard", size=(1000, 700)) as viewer:
            viewer.open_tab("Inspect", "show=picture")
            viewer.look_at("target shadow 1/view 0/light 0/shadow map")
            viewer.wait_for(lambda: viewer.has("legend=sun/shadow map"), "the title of the legend")
        shared = self.folder / "shared.glb"
        shared.write_bytes(edited(scene("gallery").read_bytes(), share_a_light))
        with self.view(shared, "--technique", "hard", size=(1000, 700)) as viewer:
            viewer.open_tab("Inspect", "show=picture")
            maps = [name for name in viewer.layout() if re.fullmatch(r"show=target .*/light \d+/shadow map", name)]
            self.assertEqual(len(maps), 4)
            number = max(int(re.search(r"light (\d+)", name)[1]) for name in maps)
            viewer.look_at(f"target shadow 1/view 0/light {number}/shadow map")
            viewer.wait_for(lambda: viewer.has(f"legend=pendant ({number})/shadow map"), "the title of the legend")

    def test_the_sliders_of_a_sun_that_is_off_do_nothing(self):
        with self.view(scene("gallery"), "--technique", "hard", "--no-sun") as viewer:
            viewer.open_tab("Scene", "eye")
            before = viewer.copied()
            self.assertIn("--no-sun", before)
            viewer.point_at("azimuth")
            viewer.wait_for(lambda: viewer.has("tooltip"), "the tooltip, which says why")
            self.desktop.xdotool("click", LEFT)
            viewer.follow()
            self.assertEqual(viewer.copied(), before)
            viewer.click("light=0", lambda: True, "a sun that is put out")
            viewer.follow()
            self.assertEqual(viewer.copied(), before)
            viewer.click("no sun", lambda: True, "the sun")
            viewer.follow()
            self.desktop.xdotool("mousemove", "--window", viewer.window, *viewer.middle("azimuth"), "click", LEFT)
            viewer.wait_for(lambda: any(word.startswith("--sun=") for word in viewer.copied()), "another sun")

    def test_a_texture_that_is_shown_alone_has_no_rings_and_no_camera(self):
        with self.view(scene("gallery"), "--technique", "hard", size=(1000, 700)) as viewer:
            viewer.open_tab("Inspect", "show=picture")
            self.assertTrue(viewer.has("ring of light 3"))
            ring, before = viewer.middle("ring of light 3"), viewer.copied()
            viewer.look_at("target shadow 1/view 0/light 0/shadow map")
            self.assertFalse(viewer.has("ring of light 3"))
            for place in (ring, viewer.middle("picture")):
                self.desktop.xdotool("mousemove", "--window", viewer.window, *place, "mousedown", LEFT)
                for step in range(10, 61, 10):
                    viewer.follow()
                    viewer.move(place[0] + step, place[1])
                viewer.follow()
                self.desktop.xdotool("mouseup", LEFT)
                viewer.follow()
            viewer.point_at("picture")
            self.desktop.xdotool("click", WHEEL_UP)
            viewer.follow()
            self.assertEqual(viewer.copied(), before)

    def test_a_lamp_does_not_put_out_the_sun_of_a_scene_without_lights(self):
        unlit = self.folder / "unlit.glb"
        unlit.write_bytes(edited(STEPS.read_bytes(), remove_lights))
        with self.view(unlit, "--technique", "hard") as viewer:
            viewer.open_tab("Scene", "eye")
            viewer.click("add lamp", lambda: viewer.has("ring of lamp 0"), "its ring")
            viewer.rest()
            self.assertTrue(any(word.startswith("--sun=") for word in viewer.copied()))

    def test_the_last_light_stays_on(self):
        with self.view(scene("gallery"), "--technique", "hard") as viewer:
            viewer.open_tab("Scene", "eye")
            count = sum(name.startswith("light=") for name in viewer.layout())
            for light in range(count - 1):
                viewer.click(f"light={light}", lambda: True, "a light turned off")
                viewer.follow()
            alone = [word for word in viewer.copied() if word.startswith("--")]
            self.assertIn(f"--lights={count - 1}", alone)
            viewer.click(f"light={count - 1}", lambda: True, "the last light")
            viewer.follow()
            self.assertEqual([word for word in viewer.copied() if word.startswith("--")], alone)


if __name__ == "__main__":
    main()
