"""The example for OpenSceneGraph."""

import unittest

import support
from engine_example import EngineExample


@unittest.skipUnless(support.has_openscenegraph(), "skipped: there is no OpenSceneGraph (libopenscenegraph-dev)")
class OpenSceneGraph(EngineExample, support.TestCase):
    name = "openscenegraph"
    title = "OpenSceneGraph"
    floor = slice(62, 76)  # before the carousel


if __name__ == "__main__":
    support.main()
