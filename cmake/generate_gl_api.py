"""Writes api.h and api.cpp: one function pointer for each function of OpenGL 4.5 core, from GL/glcorearb.h."""

import argparse
import pathlib
import re

LAST_VERSION = (4, 5)

HEADER = """#pragma once

// Generated from GL/glcorearb.h by cmake/generate_gl_api.py: the functions of OpenGL {version} core, as pointers in a
// namespace of their own so that they do not clash with another loader in the same program.
#include <GL/glcorearb.h>

namespace penumbra::gl {{

{declarations}

}}  // namespace penumbra::gl
"""

SOURCE = """#include "api.h"

#include "gl/api_table.h"

namespace penumbra::gl {{

{definitions}

namespace {{
// Each entry stores a pointer of its own type: no pointer is written through another type.
constexpr ApiEntry table[] = {{
{entries}
}};
}}  // namespace

std::span<const ApiEntry> api_table() {{ return table; }}

}}  // namespace penumbra::gl
"""


def core_functions(header):
    """Function names of every GL_VERSION section up to LAST_VERSION, in order, without repeats."""
    names = {}
    for major, minor in re.findall(r"^#ifndef GL_VERSION_(\d)_(\d)$", header, re.MULTILINE):
        if (int(major), int(minor)) > LAST_VERSION:
            continue
        version = f"GL_VERSION_{major}_{minor}"
        section = header[header.index(f"#ifndef {version}\n") : header.index(f"#endif /* {version} */")]
        for name in re.findall(r"^GLAPI .*?\bAPIENTRY (gl\w+) \(", section, re.MULTILINE):
            names[name] = None
    return list(names)


def write_if_changed(path, text):
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("header", type=pathlib.Path, help="GL/glcorearb.h")
    parser.add_argument("out", type=pathlib.Path, help="folder for api.h and api.cpp")
    args = parser.parse_args()

    names = core_functions(args.header.read_text())
    if "glCreateTextures" not in names or "glClear" not in names:
        raise SystemExit(f"{args.header}: no OpenGL 4.5 core functions found")
    typed = [(name, f"PFN{name.upper()}PROC") for name in names]
    args.out.mkdir(parents=True, exist_ok=True)
    write_if_changed(
        args.out / "api.h",
        HEADER.format(
            version=".".join(map(str, LAST_VERSION)),
            declarations="\n".join(f"extern {kind} {name};" for name, kind in typed),
        ),
    )
    write_if_changed(
        args.out / "api.cpp",
        SOURCE.format(
            definitions="\n".join(f"{kind} {name} = nullptr;" for name, kind in typed),
            entries="\n".join(
                f'    {{"{name}", [](void* p) {{ {name} = reinterpret_cast<{kind}>(p); }}}},' for name, kind in typed
            ),
        ),
    )


if __name__ == "__main__":
    main()
