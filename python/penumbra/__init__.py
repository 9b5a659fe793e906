"""Soft shadows of glTF scenes, and their ray-traced truth, as NumPy arrays.

    import penumbra

    scene = penumbra.open("scenes/courtyard.glb", size=(640, 360), sun_angle=2)
    scene.select("pcss")
    scene["pcss.filter_taps"] = 32
    shadow = scene.render("shadow")
    truth = scene.truth(samples=64)
    print(penumbra.difference(shadow, truth["shadow"], truth["receiver"])["psnr"])

Rows of all arrays go from top to bottom. A scene draws without a display, and belongs to the thread that opened it.
"""

import os

from ._penumbra import (Error, Scene, UsageError, __version__, aovs, difference, find_image_module, params, read,
                        techniques)

__all__ = ["Error", "Scene", "UsageError", "aovs", "difference", "open", "params", "read", "techniques"]

find_image_module(os.path.dirname(os.path.abspath(__file__)))


def _text(name, value):
    """A value as the option --name takes it: (640, 360) is "640x360", and other tuples have commas."""
    if isinstance(value, (tuple, list)):
        return ("x" if name == "size" else ",").join(_text(name, part) for part in value)
    return str(value)


def _arguments(options):
    """Keyword arguments as the options of `penumbra render`: True is a flag, and a list repeats an option."""
    arguments = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            arguments.append(option)
            continue
        for one in value if isinstance(value, list) else [value]:
            arguments.append(f"{option}={_text(name, one)}")
    return arguments


def open(path, **options):
    """Reads a glTF scene, .gltf or .glb, and returns a Scene.

    The options are those of `penumbra render` that choose the picture, by name: size, camera, eye, target, fov, sun,
    no_sun, lights, lamp_radius, lamp, ground, time, fps, technique, preset, set, sun_angle, exposure, backend,
    egl_device, threads, glsl, cache, no_cache and others. A tuple is a value of several numbers, such as size=(640, 360)
    or eye=(1, 2, 3); a list repeats an option.

    Raises UsageError for an option that is wrong, and Error for a scene that can't be read or drawn.
    """
    return Scene(str(path), _arguments(options))
