"""Folders under src and glsl are layers: includes go downwards only, and each library of others stays in its layer."""

import os
import re
import unittest

import support

BELOW = {
    "core": set(),
    "gl": {"core"},
    "scene": {"gl", "core"},
    "shadow": {"gl", "core"},
    "capi": {"shadow", "gl", "core"},
    "metrics": {"core"},
    "io": {"scene", "gl", "core"},
    "image": {"io", "scene", "gl", "core"},
    "report": {"io", "scene", "gl", "core"},
    "render": {"shadow", "scene", "gl", "core"},
    "truth": {"render", "shadow", "io", "scene", "gl", "core"},
    "cli": {"render", "shadow", "io", "scene", "gl", "core"},
    "session": {"cli", "truth", "render", "shadow", "io", "scene", "gl", "core"},
    "plan": {"session", "cli", "render", "shadow", "io", "scene", "gl", "core"},
    "bench": {"plan", "session", "cli", "report", "render", "shadow", "io", "scene", "gl", "core"},
    "viewer": {"session", "cli", "truth", "metrics", "image", "render", "shadow", "io", "scene", "gl", "core"},
}
BELOW["compare"] = BELOW["reproduce"] = BELOW["bench"] | {"bench", "truth", "image", "metrics"}
BELOW["app"] = set(BELOW)
INSTALLED = {"core", "gl", "shadow", "capi"}
GENERATED = "gl/api.h"

# Which layers may include a library's headers; a library that is not here is not used yet.
LIBRARIES = {
    "fmt/": BELOW.keys(),
    "glm/": BELOW.keys(),
    "GL/": {"gl"},
    "EGL/": {"gl"},
    "GLFW/": {"gl", "viewer"},
    "imgui.h": {"viewer"},
    "imgui_internal.h": {"viewer"},
    "imgui_stdlib.h": {"viewer"},
    "backends/imgui": {"viewer"},
    "tiny_gltf.h": {"scene"},
    "draco/": {"scene"},
    "meshoptimizer.h": {"scene"},
    "embree3/": {"truth"},
    "xxhash.h": {"io"},
    "OpenImageIO/": {"image"},
    "png.h": {"image"},
    "zlib.h": {"image"},
    "toml++/": {"core"},
    "nlohmann/": {"scene", "io", "report", "cli", "plan", "bench", "compare", "reproduce", "viewer", "app"},
    "CLI/": {"cli", "session", "bench", "compare", "reproduce", "viewer", "app"},
}

# The operating system's headers, which the portable layers core and shadow leave alone.
SYSTEM = re.compile(r"(sys/\w+|dlfcn|fcntl|poll|signal|spawn|termios|unistd)\.h")
USES_SYSTEM = {"gl", "scene", "io", "cli", "session", "viewer", "app"}

# Folders of glsl that the files of one may include.
GLSL_BELOW = {
    "shared": {"shared"},
    "lib": {"shared", "lib"},
    "shadow": {"shared", "lib", "shadow", "generated"},
    "scene": {"shared", "lib", "scene"},
    "render": {"shared", "lib", "scene", "shadow", "render", "generated"},
    "bench": {"shared", "lib", "shadow", "bench", "generated"},
    "viewer": {"shared", "lib", "viewer"},
}
# Those whose shaders the C++ of a layer may name.
GLSL_NAMED = {"gl": GLSL_BELOW["shared"], "shadow": GLSL_BELOW["shadow"], "scene": GLSL_BELOW["scene"]}

SHADER_NAME = re.compile(r'"(\w[\w/]*)\.(?:vert|frag|comp|glsl)"')
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]', re.MULTILINE)


def faults_of(path, text):
    """What is wrong with the includes of src/<path>, one line each."""
    layer = path.split("/")[0]
    for mark, name in INCLUDE.findall(text):
        if mark == "<":
            owners = [layers for prefix, layers in LIBRARIES.items() if name.startswith(prefix)]
            allowed = re.fullmatch(r"[a-z_0-9]+", name)  # <vector>, <cmath>
            allowed = allowed or (layer == "capi" and name in ("stddef.h", "stdint.h"))  # in C
            allowed = allowed or (SYSTEM.fullmatch(name) and layer in USES_SYSTEM)
            if not allowed and not any(layer in layers for layers in owners):
                yield f"src/{path}: <{name}> does not belong in the layer '{layer}'"
            continue
        beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
        relative = beside == GENERATED or (support.ROOT / "src" / beside).exists()
        if relative:
            target = beside
        elif name == GENERATED or (support.ROOT / "src" / name).exists():
            target = name
        elif (support.ROOT / "glsl" / name).exists() and name.startswith(("shared/", "lib/")):
            continue
        else:
            yield f"src/{path}: \"{name}\" is not a file of the project"
            continue
        if target.split("/")[0] not in BELOW[layer] | {layer}:
            yield f"src/{path}: \"{name}\" lies above the layer '{layer}'"
        if path.endswith(".h") and layer in INSTALLED and not relative:
            yield f"src/{path}: \"{name}\" is not relative to the file, which an installed header needs"


def shader_faults_of(path, text):
    """What is wrong with the shaders that src/<path> names, one line each."""
    layer = path.split("/")[0]
    for name in SHADER_NAME.findall(text) if layer in GLSL_NAMED else []:
        if "/" in name and name.split("/")[0] not in GLSL_NAMED[layer]:
            yield f"src/{path}: the shader \"{name}\" lies above the layer '{layer}'"


# What a light's kind and its map's projection decide, and the files that may know it.
PROJECTION = re.compile(r"\bshadow\.(layers|layer_count|light_extent|light_is_square|map_size|view_to_light|"
                        r"world_to_light|moved_depth|lamp|light_is_lamp|light_stretch)\b|\bshadow_depth\b|\bLayerBlock\b|\blight\.(map|extent)\b")
PROJECTION_FOLDER = "shadow/projection/"
CASCADES = re.compile(r"\b(Cascades?|LampMaps|fit_cascades|fit_lamp|get(_if)?<(Sun|Lamp)>)(?!\w)")
# light_projection.cpp alone uses the other files: they are its parts for suns and for lamps. light_matrices.cpp makes its
# cascades of an engine's matrices.
CASCADES_FILES = {"shadow/cascades.h", "shadow/cascades.cpp", "shadow/visible_cascades.h", "shadow/visible_cascades.cpp",
                  "shadow/receiver_region.h", "shadow/receiver_region.cpp",
                  "shadow/lamp_maps.h", "shadow/lamp_maps.cpp", "shadow/light_projection.h",
                  "shadow/light_projection.cpp", "shadow/light_matrices.h", "shadow/light_matrices.cpp"}


def code_of(text):
    """The text without comments and strings."""
    return re.sub(r'//[^\n]*|"(\\.|[^"\\\n])*"', "", text)


def projection_faults_of(path, text):
    """Where glsl/<path> or src/<path> knows of a light what only its projection may, one line each."""
    if path.endswith((".h", ".cpp")):
        pattern = CASCADES if path.startswith("shadow/") and path not in CASCADES_FILES else None
    else:
        pattern = PROJECTION if not path.startswith(PROJECTION_FOLDER) else None
    for match in pattern.finditer(code_of(text)) if pattern else []:
        yield f"{path}: '{match.group()}' is for glsl/{PROJECTION_FOLDER} and src/shadow/light_projection.cpp alone"


def glsl_faults_of(path, text):
    """What is wrong with the includes of glsl/<path>, one line each."""
    folder = path.split("/")[0]
    for mark, name in INCLUDE.findall(text):
        if mark == '"' and name.split("/")[0] not in GLSL_BELOW[folder]:
            yield f"glsl/{path}: \"{name}\" lies above the layer '{folder}'"


class Layers(unittest.TestCase):
    def test_shaders_go_downwards(self):
        faults = []
        files = [path for path in (support.ROOT / "glsl").rglob("*.*") if path.is_file()]
        self.assertGreater(len(files), 20)
        for path in files:
            faults += glsl_faults_of(path.relative_to(support.ROOT / "glsl").as_posix(), path.read_text())
        for path in (support.ROOT / "src").rglob("*.cpp"):
            faults += shader_faults_of(path.relative_to(support.ROOT / "src").as_posix(), path.read_text())
        self.assertFalse(faults, "\n" + "\n".join(faults))

    def test_only_the_projection_knows_what_kind_of_light_there_is(self):
        faults = []
        for folder in ("glsl", "src"):
            for path in (path for path in (support.ROOT / folder).rglob("*.*") if path.is_file()):
                if path.suffix in (".h", ".cpp", ".glsl", ".frag", ".vert", ".comp"):
                    faults += projection_faults_of(path.relative_to(support.ROOT / folder).as_posix(), path.read_text())
        self.assertFalse(faults, "\n" + "\n".join(faults))

    def test_knowledge_of_the_projection_is_found(self):
        for path, text in {"shadow/techniques/a.glsl": "float x = shadow.layers[0].texel;",
                           "shadow/drivers/a.frag": "texelFetch(shadow_depth, at, 0)",
                           "shadow/b.glsl": "float x = shadow.lamp.x;",
                           "shadow/a.cpp": "const Cascades& cascades = light.cascades();",
                           "shadow/b.cpp": "if (std::get_if<Lamp>(&source)) return;"}.items():
            self.assertEqual(len(list(projection_faults_of(path, text))), 1, path)
            self.assertEqual(list(projection_faults_of(path, "// " + text)), [], path)

    def test_forbidden_shaders_are_found(self):
        for path, name in {"shadow/a.glsl": "render/sky.glsl", "lib/a.glsl": "shadow/light.glsl",
                           "scene/a.vert": "shadow/light.glsl"}.items():
            self.assertEqual(len(list(glsl_faults_of(path, f'#include "{name}"'))), 1, path)
        self.assertEqual(len(list(shader_faults_of("shadow/a.cpp", '.vertex = "render/full_screen.vert"'))), 1)
        self.assertEqual(list(shader_faults_of("shadow/a.cpp", '.vertex = "shared/full_screen.vert"')), [])

    def test_includes_go_downwards(self):
        files = [path for ending in ("*.h", "*.cpp") for path in (support.ROOT / "src").rglob(ending)]
        self.assertGreater(len(files), 20)
        faults = []
        for path in files:
            faults += faults_of(path.relative_to(support.ROOT / "src").as_posix(), path.read_text())
        self.assertFalse(faults, "\n" + "\n".join(faults))

    def test_forbidden_includes_are_found(self):
        forbidden = {
            "shadow/a.cpp": ['#include "scene/scene.h"', "#include <OpenImageIO/imageio.h>", "#include <tiny_gltf.h>"],
            "core/a.h": ['#include "../gl/buffer.h"'],
            "gl/a.h": ['#include "core/error.h"'],
            "render/a.cpp": ["#include <OpenImageIO/imageio.h>", '#include "app/nothing.h"'],
        }
        for path, lines in forbidden.items():
            for line in lines:
                self.assertEqual(len(list(faults_of(path, line))), 1, f"{path}: {line}")

    def test_usual_includes_are_allowed(self):
        text = '#include "params.h"\n#include <cmath>\n#include <fmt/format.h>\n#include "error.h"\n'
        self.assertEqual(list(faults_of("core/a.h", text)), [])


if __name__ == "__main__":
    support.main()
