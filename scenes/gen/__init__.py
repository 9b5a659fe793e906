"""The generator of Penumbra's own scenes: a glTF writer, shapes, textures, and the scenes by name."""

from . import measure

SCENES = {
    "knife_edge": measure.knife_edge,
    "posts": measure.posts,
    "steps": measure.steps,
    "fence": measure.fence,
}
