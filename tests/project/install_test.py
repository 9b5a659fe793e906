"""`cmake --install` gives a program that runs where it lies and a library that another project builds against."""

import itertools
import json
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

import support


def command(*arguments, **options):
    """Runs a command that has to succeed; what it printed is in the failure otherwise."""
    result = subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=600, **options)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{result.stdout}{result.stderr}")
    return result.stdout


def grey_jpeg():
    """8 x 8 pixels: tables of one code each, and a scan of one flat block."""
    def segment(marker, body):
        return struct.pack(">BBH", 0xff, marker, len(body) + 2) + body

    codes = bytes([1]) + bytes(16)
    return (b"\xff\xd8" + segment(0xdb, b"\0" + b"\1" * 64) + segment(0xc0, b"\x08\0\x08\0\x08\1\1\x11\0")
            + segment(0xc4, b"\0" + codes) + segment(0xc4, b"\x10" + codes) + segment(0xda, b"\1\1\0\0\x3f\0")
            + b"\x3f\xff\xd9")


# The compiler's cache knows the files of the last run where they lie in the same folder again.
CACHED = {**os.environ, **({"CMAKE_CXX_COMPILER_LAUNCHER": "ccache"} if shutil.which("ccache") else {})}


class Installed(support.TestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.installed = support.BUILD / "installed"
        shutil.rmtree(cls.installed, ignore_errors=True)
        cls.addClassCleanup(shutil.rmtree, cls.installed)
        cls.prefix = cls.installed / "prefix"
        command("cmake", "--install", support.BUILD, "--prefix", cls.prefix)

    def test_consumer_project_gets_a_mask(self):
        """An engine with its own context, depth buffer and shadow maps; the mask's values are checked in its main(). With
        each compiler, as the standard that Penumbra's targets ask for and as C++23, without a warning."""
        for compiler, standard in itertools.product(("g++", "clang++-16"), (20, 23)):
            with self.subTest(f"{compiler} C++{standard}"):
                build = self.installed / f"{compiler}_{standard}"
                # Both compilers' own default is C++17.
                chosen = [] if standard == 20 else [f"-DCMAKE_CXX_STANDARD={standard}"]
                command("cmake", "-S", support.ROOT / "tests" / "consumer", "-B", build, "-G", "Ninja",
                        f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release",
                        f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON", *chosen, env=CACHED)
                command("cmake", "--build", build)
                for program in ("consumer", "wrapper_penumbra", "wrapper_static"):
                    command(build / program, cwd=self.folder)

    def test_c_example_draws_its_shadow(self):
        """As it is installed, from C11, without fmt, GLM and a compiler of C++; and by pkg-config, with either library."""
        sources = self.prefix / "share" / "penumbra" / "examples" / "c_minimal"
        build = self.folder / "c_minimal"
        command("cmake", "-S", sources, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                "-DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON", "-DCMAKE_DISABLE_FIND_PACKAGE_glm=ON",
                env={**os.environ, "CXX": "there-is-no-compiler-of-this-name"})
        command("cmake", "--build", build)
        expected = command(build / "c_minimal", cwd=self.folder)
        self.assertIn("1.00 0.00", expected)
        package = {**os.environ, "PKG_CONFIG_PATH": str(next(self.prefix.rglob("pkgconfig")))}
        library = next(self.prefix.rglob("libpenumbra.so")).parent
        for option in ((), ("--static",)):
            flags = command("pkg-config", "--cflags", "--libs", *option, "penumbra", env=package).split()
            if option:
                flags = ["-l:libpenumbra.a" if flag == "-lpenumbra" else flag for flag in flags]
            program = self.folder / "by_pkg_config"
            command("gcc", "-std=c11", *sources.glob("*.c"), "-o", program, *flags, "-lEGL", "-lm")
            found = command(program, cwd=self.folder, env={**os.environ, "LD_LIBRARY_PATH": str(library)})
            self.assertEqual(found, expected, option)

    def test_pkg_config_gives_what_a_compiler_needs(self):
        flags = command("pkg-config", "--cflags", "--libs", "penumbra-shadow", env={
            **os.environ, "PKG_CONFIG_PATH": str(next(self.prefix.rglob("pkgconfig")))}).split()
        consumer = support.ROOT / "tests" / "consumer"
        command("c++", "-std=c++20", "-O1", consumer / "main.cpp", consumer / "engine.cpp", "-o", self.folder / "consumer",
                *flags, "-lEGL")
        command(self.folder / "consumer", cwd=self.folder)

    def test_each_header_stands_alone(self):
        include, source, cache = self.prefix / "include", self.installed / "alone.cpp", shutil.which("ccache")
        headers = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h*"))
        self.assertIn("penumbra/shadow/soft_shadows.h", headers)
        self.assertIn("penumbra/penumbra.hpp", headers)
        for header in headers:
            source.write_text(f"#include <{header}>\n")
            command(*([cache] if cache else []), "c++", "-std=c++20", "-c", "-Wall", "-Wextra", "-Werror",
                    "-Iprefix/include", source.name, "-o", "alone.o", cwd=self.installed)

    def test_no_path_of_the_building_machine(self):
        places = [str(support.ROOT).encode(), str(support.BUILD).encode()]
        for path in self.prefix.rglob("*"):
            if path.is_file():
                text = path.read_bytes()
                self.assertFalse(any(place in text for place in places), f"{path} names {support.ROOT}")

    def test_manual_and_completion_are_where_shells_look(self):
        for file in ("man/man1/penumbra.1", "bash-completion/completions/penumbra", "zsh/site-functions/_penumbra"):
            self.assertIn("penumbra", (self.prefix / "share" / file).read_text(), file)

    def elsewhere(self):
        """The environment with an empty home folder, but with the shaders that this user's programs have compiled."""
        return {**os.environ, "HOME": str(self.folder), "MESA_SHADER_CACHE_DIR": support.shader_cache()}

    def test_program_runs_with_its_own_data(self):
        program = self.prefix / "bin" / "penumbra"
        picture = self.folder / "steps.png"
        command(program, "render", self.prefix / "share" / "penumbra" / "scenes" / "steps.glb", "--size", "64x36", "-o",
                picture, cwd=self.folder, env=self.elsewhere())
        self.assertTrue(picture.exists())
        installed = list((self.prefix / "share" / "penumbra" / "scenes").iterdir())
        self.assertEqual([path for path in installed if path.suffix not in (".glb", ".gltf")], [])

    def write_scene(self):
        """A triangle with a JPEG on it."""
        (self.folder / "grey.jpg").write_bytes(grey_jpeg())
        (self.folder / "data.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        scene = self.folder / "scene.gltf"
        scene.write_text(json.dumps({
            "asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "data.bin"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "images": [{"uri": "grey.jpg"}], "textures": [{"source": 0}],
            "materials": [{"emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "nodes": [{"mesh": 0}]}))
        return scene

    def draw(self, program, scene, name):
        """As a shell would in the test's folder; the result has returncode and stderr."""
        arguments = [program, "render", scene, "--size", "64x36", "-o", self.folder / name, "--quiet"]
        return subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=600, cwd=self.folder,
                              env=self.elsewhere())

    def test_program_reads_jpegs_and_writes_exrs_by_its_own_module(self):
        result = self.draw(self.prefix / "bin" / "penumbra", self.write_scene(), "x.exr")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "x.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")

    def test_program_without_its_module_says_so_and_does_all_else(self):
        program, steps = self.folder / "penumbra", self.prefix / "share" / "penumbra" / "scenes" / "steps.glb"
        shutil.copy(self.prefix / "bin" / "penumbra", program)
        self.assertEqual(self.draw(program, steps, "x.png").returncode, 0)
        for scene, name in ((steps, "y.exr"), (self.write_scene(), "y.png")):
            with self.subTest(name):
                result = self.draw(program, scene, name)
                self.assertEqual(result.returncode, 1)
                self.assertRegex(result.stderr, r"^error: [^\n]*penumbra_openimageio\.so, which is missing from [^\n]+\n$")
                self.assertFalse((self.folder / name).exists())


class LibraryAlone(support.TestCase):
    def test_is_a_folder_of_another_project(self):
        """By FetchContent: the library alone is built, and nothing of it is installed with the project."""
        build = support.BUILD.parent / "consumer"  # where the compiler's cache knows the files of the last run
        shutil.rmtree(build, ignore_errors=True)
        cached = [f"-DCMAKE_CXX_COMPILER_LAUNCHER=sh;{support.ROOT / 'cmake' / 'compile_cached.sh'};{support.ROOT};ccache"]
        command("cmake", "-S", support.ROOT / "tests" / "consumer", "-B", build, "-G", "Ninja",
                f"-DPENUMBRA_SOURCE={support.ROOT}", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0",
                *(cached if shutil.which("ccache") else []))
        command("cmake", "--build", build, "--parallel", "2")
        for program in ("consumer", "wrapper_penumbra", "wrapper_static"):
            command(build / program, cwd=self.folder)
        command("cmake", "--install", build, "--prefix", self.folder / "prefix")
        self.assertFalse((self.folder / "prefix").exists())
        cache = (build / "CMakeCache.txt").read_text()
        self.assertNotIn("PENUMBRA_tinygltf", cache)

    def test_builds_without_the_program_and_its_libraries(self):
        """The library needs fmt, GLM and the header of toml++, and nothing of scenes, images or windows."""
        build = support.BUILD.parent / "library"
        command("cmake", "-S", support.ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                "-DPENUMBRA_APP=OFF", "-DPENUMBRA_TESTS=OFF", "-DPENUMBRA_BACKENDS=")
        command("cmake", "--build", build, "--parallel", "2")
        cache = (build / "CMakeCache.txt").read_text()
        for library in ("tinygltf", "draco", "meshoptimizer", "openimageio", "json", "cli11"):
            self.assertNotIn(f"PENUMBRA_{library}", cache)


if __name__ == "__main__":
    support.main()
