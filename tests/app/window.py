"""What the tests of penumbra view share: scenes, a desktop for each file, and viewers on it."""

import unittest

import pictures  # sets PENUMBRA_DEBUG: an OpenGL error ends the program
from desktop import Desktop, Picture
from support import TestCase
from viewer import Viewer

STEPS, KNIFE_EDGE = pictures.scene("steps"), pictures.scene("knife_edge")
# What the maps cost is a third of a frame, and how sharp they are is no matter of these tests; nor are edges, for which a
# picture at rest is drawn eight times.
SMALL_MAPS, NO_SMOOTH_EDGES = pictures.SMALL_MAPS, ("--samples", 1)


class WindowTest(TestCase):
    """A test with a desktop, which the tests of its file share."""

    _shared = None

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if WindowTest._shared is None:
            WindowTest._shared = unittest.enterModuleContext(Desktop())
            unittest.addModuleCleanup(setattr, WindowTest, "_shared", None)
        cls.desktop = WindowTest._shared

    def view(self, *arguments, maps=SMALL_MAPS, edges=NO_SMOOTH_EDGES, **options):
        """A viewer that is started in the test's folder."""
        return Viewer(self.desktop, *arguments, *maps, *edges, folder=self.folder, **options)

    def picture_of(self, *arguments, **options):
        """The finished picture of a viewer of its own."""
        with self.view(*arguments, **options) as viewer:
            return viewer.rest()


def read(path):
    """A picture that the program has written."""
    width, height, channels, rows = pictures.read_png(path)
    assert channels == 3, f"{path} has {channels} channels"
    return Picture(width, height, rows)
