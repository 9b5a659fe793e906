"""The generator of Penumbra's own scenes: a glTF writer, shapes, textures, and the scenes by name."""

from . import contact, courtyard, gallery, measure, story

SCENES = {
    "courtyard": courtyard.courtyard,
    "gallery": gallery.gallery,
    "knife_edge": measure.knife_edge,
    "posts": measure.posts,
    "steps": measure.steps,
    "thesis": story.thesis,
    "moving": story.moving,
    "fence": measure.fence,
    "failures": measure.failures,
    "foliage": story.foliage,
    "coincident": contact.coincident,
    "tent": contact.tent,
    "curtain": contact.curtain,
}
