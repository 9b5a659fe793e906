"""The C interface: what the shared library exports, how its structs lie in memory, and which compilers and other headers
its headers go with.

With PENUMBRA_RECORD=1 the lists in tests/project/abi are written anew: only to add a function, or a field at the end of a
struct. Programs that are compiled already rely on all that is there.
"""

import itertools
import os
import re
import shutil
import subprocess
import unittest

import support

LISTS = support.ROOT / "tests" / "project" / "abi"
HEADERS = support.ROOT / "src" / "capi"
STRUCT = re.compile(r"^typedef struct (\w+) \{\n(.*?)^\} \1;", re.MULTILINE | re.DOTALL)
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]
C = [("gcc", "c11"), ("clang-16", "c11")]
CXX = [(compiler, standard) for compiler in ("g++", "clang++-16") for standard in ("c++20", "c++2b")]
CXX20 = [each for each in CXX if each[1] == "c++20"]
# Headers that engines have beside Penumbra's.
OTHERS = ["GL/glew.h", "epoxy/gl.h", "GL/gl.h", "GLFW/glfw3.h", "GL/glcorearb.h"]


def command(*arguments, **options):
    """What a command that has to succeed prints; else the failure shows it."""
    result = subprocess.run([*map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300,
                            **options)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{result.stdout}")
    return result.stdout


def fields_of(body):
    """Names of a struct's fields; `float a, b[3];` has two."""
    code = re.sub(r"/\*.*?\*/", "", body, flags=re.DOTALL)
    for declaration in code.split(";"):
        for declarator in declaration.split(","):
            name = re.search(r"(\w+)\s*(\[[^]]*\]\s*)*$", declarator.strip())
            if name:
                yield name[1]


class Abi(support.TestCase):
    def check_list(self, name, text):
        path = LISTS / name
        if os.environ.get("PENUMBRA_RECORD"):
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        self.assertEqual(path.read_text(), text, f"{path} has another list")

    def test_the_shared_library_exports_the_c_interface_alone(self):
        exported = command("nm", "--dynamic", "--defined-only", "--format=posix", support.BUILD / "libpenumbra.so")
        names = sorted(line.split()[0].split("@")[0] for line in exported.splitlines())
        self.check_list("symbols.txt", "".join(f"{name}\n" for name in names))
        declared = re.findall(r"^PENUMBRA_API [^(]*?\b(\w+)\(", (HEADERS / "penumbra.h").read_text(), re.MULTILINE)
        self.assertEqual(sorted(declared), [name for name in names if name.startswith("penumbra_")])

    def test_it_has_a_soname(self):
        self.assertRegex(command("readelf", "--dynamic", support.BUILD / "libpenumbra.so"), r"soname: \[libpenumbra\.so\.0\]")

    def test_structs_lie_in_memory_as_recorded(self):
        lines = []
        structs = STRUCT.findall((HEADERS / "penumbra.h").read_text())
        self.assertGreater(len(structs), 8)
        for name, body in structs:
            lines.append(f'  printf("{name} %zu\\n", sizeof({name}));')
            for field in fields_of(body):
                lines.append(f'  printf("  {field} %zu %zu\\n", offsetof({name}, {field}), sizeof((({name}*)0)->{field}));')
        source = self.folder / "sizes.c"
        source.write_text("#include <penumbra.h>\n#include <stdio.h>\nint main(void) {\n" + "\n".join(lines)
                          + "\n  return 0;\n}\n")
        command("gcc", "-std=c11", f"-I{HEADERS}", source, "-o", self.folder / "sizes")
        self.check_list("structs.txt", command(self.folder / "sizes"))

    def test_structs_have_no_holes(self):
        """A field that is added to a hole would not grow the struct."""
        end, struct = 0, None
        for line in (LISTS / "structs.txt").read_text().splitlines():
            name, *numbers = line.split()
            if len(numbers) == 1:
                self.assertTrue(struct is None or end == struct[1], f"{struct} ends with a hole")
                struct, end = (name, int(numbers[0])), 0
                continue
            self.assertEqual(int(numbers[0]), end, f"a hole before {struct[0]}.{name}")
            end += int(numbers[1])
        self.assertEqual(end, struct[1])

    def test_the_versions_agree(self):
        project = re.search(r"^project\(penumbra VERSION (\d+)\.(\d+)\.(\d+)", (support.ROOT / "CMakeLists.txt").read_text(),
                            re.MULTILINE)
        header = (HEADERS / "penumbra.h").read_text()
        for part, number in zip(("MAJOR", "MINOR", "PATCH"), project.groups()):
            self.assertRegex(header, rf"#define PENUMBRA_VERSION_{part} {number}\b")


class Headers(support.TestCase):
    def compile(self, compiler, standard, text, *options):
        source = self.folder / ("source.c" if standard.startswith("c1") else "source.cpp")
        source.write_text(text)
        command(compiler, f"-std={standard}", "-fsyntax-only", *WARNINGS, f"-I{HEADERS}", *options, source)

    def test_the_c_header_needs_only_the_headers_of_integers(self):
        for compiler, standard in C + CXX:
            with self.subTest(f"{compiler} {standard}"):
                self.compile(compiler, standard, "#include <penumbra.h>\n")
        system = re.findall(r"#include <([^>]*)>", (HEADERS / "penumbra.h").read_text())
        self.assertEqual(system, ["stddef.h", "stdint.h"])

    def test_beside_other_headers_in_either_order(self):
        text = "#include <{}>\n#include <{}>\nint main(void) {{ return penumbra_version() == 0; }}\n"
        for (compiler, standard), other in itertools.product(C + CXX20, OTHERS):
            own = "penumbra.h" if standard.startswith("c1") else "penumbra.hpp"
            for first, second in ((own, other), (other, own)):
                with self.subTest(f"{compiler} {standard} {first} {second}"):
                    self.compile(compiler, standard, text.format(first, second))

    def test_the_snippet_of_the_readme(self):
        snippet = re.search(r"^```cpp\n(.*?)^```", (support.ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL)[1]
        text = ("#include <array>\n#include <penumbra.hpp>\n#include <penumbra_glm.hpp>\n"
                "void draw_casters(const float (&world_to_clip)[16]);\n"
                "uint32_t use(penumbra::api::Device::GetProc get_proc, const glm::mat4& view, const glm::mat4& last_view,\n"
                "             const glm::mat4& projection, uint32_t depth_texture, uint32_t normal_texture, int width, int height,\n"
                "             const glm::vec3& scene_min, const glm::vec3& scene_max, const glm::vec3& to_light);\n"
                "uint32_t use(penumbra::api::Device::GetProc get_proc, const glm::mat4& view, const glm::mat4& last_view,\n"
                "             const glm::mat4& projection, uint32_t depth_texture, uint32_t normal_texture, int width, int height,\n"
                "             const glm::vec3& scene_min, const glm::vec3& scene_max, const glm::vec3& to_light) {\n"
                + snippet + "return mask.texture;\n}\n")
        for compiler, standard in CXX:
            self.compile(compiler, standard, text)

    def test_the_snippets_of_the_page_about_the_library(self):
        """Maps that an engine has, in C and in C++; and a technique of its own."""
        page = (support.ROOT / "docs" / "library.md").read_text()
        c, = re.findall(r"^```c\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        cxx, extending = re.findall(r"^```cpp\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        own = "int use(uint32_t depth_array, int32_t size, const float* {0});\nint use(uint32_t depth_array, int32_t size, " \
              "const float* {0}) {{\n"
        for compiler, standard in C:
            self.compile(compiler, standard, "#include <penumbra.h>\n" + own.format("matrices")
                         + "penumbra_light light;\npenumbra_light_init(&light, sizeof light);\n" + c
                         + "return light.maps_count;\n}\n")
        for compiler, standard in CXX:
            self.compile(compiler, standard, "#include <array>\n#include <penumbra.hpp>\n#include <penumbra_glm.hpp>\n"
                         + own.format("to_light") + cxx + "return light.maps_count;\n}\n")
        for compiler, standard in CXX20:
            self.compile(compiler, standard, "#include <penumbra/shadow/registry.h>\n#include <penumbra/shadow/soft_shadows.h>\n"
                         "void draw(const char* pale_text);\nvoid draw(const char* pale_text) {\n" + extending + "}\n",
                         f"-I{support.BUILD / 'include'}")

    def test_headers_for_extending_say_what_must_not_come_before_them(self):
        text, include = "#include <{}>\n#include <{}>\n", f"-I{support.BUILD / 'include'}"
        own = "penumbra/gl/api.h"  # which all of them include
        for compiler, standard in CXX20:
            for other in ("GL/gl.h", "GLFW/glfw3.h", "GL/glew.h"):
                with self.subTest(f"{compiler} {other} {own}"), self.assertRaises(AssertionError) as failed:
                    self.compile(compiler, standard, text.format(other, own), include, "-Wfatal-errors")
                self.assertIn("include Penumbra's headers before GL/gl.h", str(failed.exception))
            for first, second in (("epoxy/gl.h", own), ("GL/glcorearb.h", own), (own, "GL/gl.h"), (own, "GLFW/glfw3.h"),
                                  (own, "GL/glcorearb.h")):
                with self.subTest(f"{compiler} {first} {second}"):
                    self.compile(compiler, standard, text.format(first, second), include)
            self.compile(compiler, standard, "#define GLFW_INCLUDE_NONE\n" + text.format("GLFW/glfw3.h", own), include)

    def test_a_wrong_name_of_a_parameter_does_not_compile(self):
        text = ("#include <penumbra/penumbra_settings.hpp>\nint main() {{\n  penumbra::api::TypedSettings typed;\n"
                "  typed.sun.{} = 2;\n  return typed.{} == penumbra::api::TypedSettings::Technique::{};\n}}\n")
        include = f"-I{support.BUILD / 'include'}"
        for compiler, standard in CXX20:
            self.compile(compiler, standard, text.format("angle", "technique", "pcss"), include)
            for names in (("angel", "technique", "pcss"), ("angle", "technic", "pcss"), ("angle", "technique", "pccs")):
                with self.assertRaisesRegex(AssertionError, "angel|technic|pccs"):
                    self.compile(compiler, standard, text.format(*names), include)

    def test_the_headers_for_cxx(self):
        """penumbra_glm.hpp with switches that change how GLM's types lie in memory."""
        text = '#include <penumbra.hpp>\n#include <penumbra_glm.hpp>\nint main() { return 0; }\n'
        for compiler, standard in CXX:
            for switches in ((), ("-DGLM_FORCE_DEFAULT_ALIGNED_GENTYPES", "-DGLM_FORCE_INTRINSICS")):
                with self.subTest(f"{compiler} {standard} {switches}"):
                    self.compile(compiler, standard, text, *switches)


class Reference(support.TestCase):
    def test_it_is_written_without_a_warning(self):
        """Each function, field, class and constant is described, of C and of C++, also in a folder whose name has a space."""
        build = self.folder / "a build"
        html = build / "reference" / "html"
        html.parent.mkdir(parents=True)
        (build / "include").symlink_to(support.BUILD / "include")
        shutil.copy(support.ROOT / "docs" / "reference.md", html.parent)
        printed = command("doxygen", support.ROOT / "docs" / "Doxyfile", cwd=build)
        self.assertEqual(printed, "")
        pages = "".join(path.read_text() for path in html.glob("*.html"))
        for name in (LISTS / "symbols.txt").read_text().split():
            self.assertTrue(f">{name}<" in pages or not name.startswith("penumbra_"), name)
        for name in ("Device", "Settings", "Frame", "Error", "TypedSettings"):
            self.assertTrue(list(html.glob(f"*penumbra_1_1api_1_1{name}.html")), name)
        for name in ("check", "sun", "lamp", "copy", "matrix", "box"):  # functions of the namespace
            self.assertTrue(f"<b>{name}</b>" in pages, name)

    def test_the_build_has_written_it(self):
        self.assertIn("penumbra_render", (support.BUILD / "reference" / "html" / "penumbra_8h.html").read_text())


if __name__ == "__main__":
    support.main()
