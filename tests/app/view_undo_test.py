"""penumbra view: undo and redo, by keys and by the menu."""

from desktop import LEFT
from support import main
from window import STEPS, WindowTest


class Undo(WindowTest):
    VIEW = ("--eye=0,5,12", "--target=0,1,0", "--sun=20,50")

    def command(self, viewer):
        """The command line without the name of the picture's file."""
        return [word for word in viewer.copied() if word.startswith("--")]

    def drag_picture(self, viewer, button=LEFT):
        """A drag in several frames, which moves the camera in each."""
        x, y = viewer.middle("picture")
        viewer.move(x, y)
        self.desktop.xdotool("mousedown", button)
        for step in range(1, 6):
            viewer.follow()
            viewer.move(x + 20 * step, y)
        viewer.follow()
        self.desktop.xdotool("mouseup", button)
        viewer.follow()

    def tap(self, viewer, keys):
        viewer.tap(keys)
        viewer.follow()

    def test_an_orbit_a_slider_and_a_technique_are_a_step_each(self):
        with self.view(STEPS, *self.VIEW) as viewer:
            first, states = viewer.rest(), [self.command(viewer)]
            self.drag_picture(viewer)
            states.append(self.command(viewer))
            viewer.find("sun.angle")
            left, top, right, bottom = viewer.box("sun.angle")
            viewer.move(left + 30, (top + bottom) // 2)
            self.desktop.xdotool("mousedown", LEFT)
            for step in range(1, 6):
                viewer.follow()
                viewer.move(left + 30 + 15 * step, (top + bottom) // 2)
            viewer.follow()
            self.desktop.xdotool("mouseup", LEFT)
            viewer.follow()
            states.append(self.command(viewer))
            viewer.choose("technique", "none")
            states.append(self.command(viewer))
            self.assertEqual(len({str(state) for state in states}), 4)
            for state in states[-2::-1]:
                self.tap(viewer, "ctrl+z")
                self.assertEqual(self.command(viewer), state)
            self.tap(viewer, "ctrl+z")
            self.assertEqual(self.command(viewer), states[0])
            viewer.wait_for(lambda: viewer.rest().crop(0, 0, first.width, 50) == first.crop(0, 0, first.width, 50),
                            "the first picture")
            for keys, state in zip(("ctrl+shift+z", "ctrl+y", "ctrl+shift+z"), states[1:]):
                self.tap(viewer, keys)
                self.assertEqual(self.command(viewer), state)

    def test_a_number_that_is_not_finite_changes_nothing(self):
        """Dear ImGui multiplies the old value by what follows a "*"."""
        with self.view(STEPS, *self.VIEW) as viewer:
            viewer.open_tab("Scene", "azimuth")
            first = self.command(viewer)
            viewer.fill_in("azimuth", "0", lambda: self.command(viewer) != first, "an azimuth of 0")
            zero = self.command(viewer)
            self.assertIn("--sun=0,", " ".join(zero))
            viewer.fill_in("azimuth", "*1e400", lambda: True, "nothing")
            viewer.follow()
            self.assertEqual(self.command(viewer), zero)
            self.tap(viewer, "ctrl+z")
            self.assertEqual(self.command(viewer), first)

    def test_the_menu_undoes_and_goes_back_to_the_scenes_camera(self):
        def take(item):
            viewer.click("menu Edit", lambda: viewer.has(item), "the menu")
            viewer.click(item, lambda: not viewer.has(item), "the menu to close")
            viewer.follow()
            return self.command(viewer)

        with self.view(STEPS) as viewer:
            own = self.command(viewer)
            self.drag_picture(viewer)
            turned = self.command(viewer)
            self.assertIn("--eye", " ".join(turned))
            self.assertEqual(take("menu=Back to the scene's camera"), own)
            self.assertEqual(take("menu=Undo"), turned)
            self.assertEqual(take("menu=Undo"), own)
            self.assertEqual(take("menu=Redo"), turned)

    def test_a_wheel_that_is_turned_on_is_one_step(self):
        with self.view(STEPS, *self.VIEW) as viewer:
            before = self.command(viewer)
            viewer.point_at("picture")
            self.desktop.xdotool("click", "--repeat", 5, "--delay", 20, 4)
            viewer.wait_for(lambda: self.command(viewer) != before, "another eye")
            self.tap(viewer, "ctrl+z")
            self.assertEqual(self.command(viewer), before)


if __name__ == "__main__":
    main()
