"""`cmake --install` gives a program that runs where it lies and a library that another project builds against."""

import os
import pathlib
import subprocess
import unittest

import support


def command(*arguments, **options):
    """Runs a command that has to succeed; what it printed is in the failure otherwise."""
    result = subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=600, **options)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{result.stdout}{result.stderr}")
    return result.stdout


class Installed(support.TestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = support.temporary_folder()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix = pathlib.Path(folder.name)
        command("cmake", "--install", support.BUILD, "--prefix", cls.prefix)

    def test_consumer_project_gets_a_mask(self):
        """An engine with its own context, depth buffer and shadow maps; the mask's values are checked in its main()."""
        build = self.folder / "consumer"
        command("cmake", "-S", support.ROOT / "tests" / "consumer", "-B", build, "-G", "Ninja",
                f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release")
        command("cmake", "--build", build)
        command(build / "consumer", cwd=self.folder)

    def test_each_header_stands_alone(self):
        include = self.prefix / "include"
        headers = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h"))
        self.assertIn("penumbra/shadow/soft_shadows.h", headers)
        for header in headers:
            command("c++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", f"-I{include}",
                    "-include", header, "-x", "c++", "/dev/null")

    def test_no_path_of_the_building_machine(self):
        places = [str(support.ROOT).encode(), str(support.BUILD).encode()]
        for path in self.prefix.rglob("*"):
            if path.is_file():
                text = path.read_bytes()
                self.assertFalse(any(place in text for place in places), f"{path} names {support.ROOT}")

    def test_program_runs_with_its_own_data(self):
        program = self.prefix / "bin" / "penumbra"
        picture = self.folder / "steps.png"
        command(program, "render", self.prefix / "share" / "penumbra" / "scenes" / "steps.glb", "--size", "64x36", "-o",
                picture, cwd=self.folder, env={**os.environ, "HOME": str(self.folder)})
        self.assertTrue(picture.exists())


class LibraryAlone(unittest.TestCase):
    def test_builds_without_the_program_and_its_libraries(self):
        """The layers core, gl and shadow need fmt and GLM, and nothing of scenes or images."""
        build = support.BUILD.parent / "library"
        command("cmake", "-S", support.ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                "-DPENUMBRA_APP=OFF", "-DPENUMBRA_TESTS=OFF")
        command("cmake", "--build", build, "--parallel", "2")
        cache = (build / "CMakeCache.txt").read_text()
        for library in ("tinygltf", "draco", "meshoptimizer", "openimageio", "toml", "json", "cli11"):
            self.assertNotIn(f"PENUMBRA_{library}", cache)


if __name__ == "__main__":
    support.main()
