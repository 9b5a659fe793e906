"""Writes api.h and api.cpp: the functions of OpenGL 4.5 core, from GL/glcorearb.h, and a table of their entry points."""

import argparse
import pathlib
import re

LAST_VERSION = (4, 5)

HEADER = """#pragma once  // generated from GL/glcorearb.h by cmake/generate_gl_api.py
#if (defined(__gl_glext_h_) || defined(__glew_h__)) && !defined(__gl_glcorearb_h_)
#error "include Penumbra's headers before GL/gl.h and GLFW/glfw3.h, and not beside GL/glew.h; or penumbra.h alone, anywhere"
#endif
#include <GL/glcorearb.h>
// The functions of OpenGL {version} core, in a namespace of their own, beside those of another loader in the same program.
namespace penumbra::gl {{

// The entry points of one driver.
struct Api {{
{members}
  // Of the compatibility profile; null in a context of the core profile.
  void(APIENTRYP glPixelTransferf)(GLenum pname, GLfloat param) = nullptr;
  void(APIENTRYP glPixelTransferi)(GLenum pname, GLint param) = nullptr;

  bool operator==(const Api&) const = default;
}};

// Of thread-local variables, a library that is loaded at run time finds those at a fixed place the fastest. glibc keeps
// room for a few.
#if defined(__GLIBC__) && defined(__GNUC__)
#define PENUMBRA_FIXED_PLACE __attribute__((tls_model("initial-exec")))
#else
#define PENUMBRA_FIXED_PLACE
#endif

// What the calling thread's calls go to; null: load_api() was not called on it. Set by load_api() and by DeviceScope.
extern constinit thread_local Api* current_api PENUMBRA_FIXED_PLACE;

{functions}

}}  // namespace penumbra::gl
"""

SOURCE = """#include "api.h"

#include "gl/api_table.h"

namespace penumbra::gl {{

constinit thread_local Api* current_api = nullptr;

namespace {{
// Each entry stores a pointer of its own type: no pointer is written through another type.
constexpr ApiEntry table[] = {{
{entries}
}};
}}  // namespace

std::span<const ApiEntry> api_table() {{ return table; }}

}}  // namespace penumbra::gl
"""


class Function:
    """A prototype: what it returns, its name, and its parameters as text and as names."""

    def __init__(self, result, name, parameters):
        self.result, self.name = result.strip(), name
        self.parameters = "" if parameters.strip() == "void" else parameters
        self.arguments = [re.search(r"(\w+)$", one).group(1) for one in self.parameters.split(",") if one]

    def pointer(self):
        return f"PFN{self.name.upper()}PROC"

    def definition(self):
        call = f"current_api->{self.name}({', '.join(self.arguments)})"
        return f"inline {self.result} {self.name}({self.parameters}) {{ return {call}; }}"


def core_functions(header):
    """The functions of every GL_VERSION section up to LAST_VERSION, in order, without repeats."""
    functions = {}
    for major, minor in re.findall(r"^#ifndef GL_VERSION_(\d)_(\d)$", header, re.MULTILINE):
        if (int(major), int(minor)) > LAST_VERSION:
            continue
        version = f"GL_VERSION_{major}_{minor}"
        section = header[header.index(f"#ifndef {version}\n") : header.index(f"#endif /* {version} */")]
        for prototype in re.findall(r"^GLAPI (.*?)APIENTRY (gl\w+) \((.*)\);$", section, re.MULTILINE):
            functions[prototype[1]] = Function(*prototype)
    return functions


def write_if_changed(path, text):
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("header", type=pathlib.Path, help="GL/glcorearb.h")
    parser.add_argument("out", type=pathlib.Path, help="folder for api.h and api.cpp")
    args = parser.parse_args()

    functions = core_functions(args.header.read_text())
    if "glCreateTextures" not in functions or "glClear" not in functions:
        raise SystemExit(f"{args.header}: no OpenGL 4.5 core functions found")
    args.out.mkdir(parents=True, exist_ok=True)
    write_if_changed(
        args.out / "api.h",
        HEADER.format(
            version=".".join(map(str, LAST_VERSION)),
            members="\n".join(f"  {one.pointer()} {name} = nullptr;" for name, one in functions.items()),
            functions="\n".join(one.definition() for one in functions.values()),
        ),
    )
    write_if_changed(
        args.out / "api.cpp",
        SOURCE.format(
            entries="\n".join(
                f'    {{"{name}", [](Api& api, void* p) {{ api.{name} = reinterpret_cast<{one.pointer()}>(p); }}}},'
                for name, one in functions.items()
            ),
        ),
    )


if __name__ == "__main__":
    main()
