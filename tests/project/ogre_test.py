"""The example for OGRE."""

import unittest

import support
from engine_example import EngineExample


@unittest.skipUnless(support.has_ogre(), "skipped: there is no OGRE (libogre-1.12-dev)")
class Ogre(EngineExample, support.TestCase):
    name = "ogre"
    title = "OGRE"
    floor = slice(66, 72)  # before the windmill


if __name__ == "__main__":
    support.main()
