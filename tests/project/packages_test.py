"""cpack makes packages for Debian: they are as Debian's policy asks, and work in a system that has nothing else."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

import bare_root
import support

NAMES = ("libpenumbra-dev", "libpenumbra0", "penumbra")


def command(*arguments, **options):
    result = subprocess.run([*map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600,
                            **options)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{result.stdout}")
    return result.stdout


def skip_without(*tools):
    missing = [tool for tool in tools if not shutil.which(tool)]
    if missing:
        raise unittest.SkipTest(f"skipped: {', '.join(missing)} not installed")


class Packages(support.TestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        skip_without("cpack", "dpkg-deb", "dpkg-shlibdeps", "gzip")
        folder = support.temporary_folder()
        cls.addClassCleanup(folder.cleanup)
        cls.place = pathlib.Path(folder.name)
        command("cpack", "-G", "DEB", "--config", support.BUILD / "CPackConfig.cmake", "-B", cls.place)
        cls.packages = {path.name.split("_")[0]: path for path in cls.place.glob("*.deb")}

    def field(self, name, field):
        return command("dpkg-deb", "-f", self.packages[name], field).strip()

    def test_one_for_each_component(self):
        self.assertEqual(sorted(name for name in self.packages if not name.startswith("python3-")), list(NAMES))
        depends = self.field("penumbra", "Depends")
        for library in ("libc6", "libembree3", "libopenimageio", "libglfw3", "libpng16", "libegl1"):
            self.assertIn(library, depends)
        self.assertNotIn("libpenumbra0", depends)
        self.assertRegex(command("dpkg-deb", "-I", self.packages["libpenumbra0"], "shlibs"), r"^libpenumbra 0 libpenumbra0 ")
        self.assertRegex(self.field("libpenumbra0", "Depends"), r"libc6 \(>= .*libfmt")
        version = self.field("libpenumbra0", "Version")
        self.assertIn(f"libpenumbra0 (= {version})", self.field("libpenumbra-dev", "Depends"))

    def test_development_has_the_reference(self):
        files = command("dpkg-deb", "--contents", self.packages["libpenumbra-dev"])
        for page in ("index", "penumbra_8h", "penumbra_8hpp", "penumbra__glm_8hpp", "penumbra__settings_8hpp"):
            self.assertIn(f" ./usr/share/doc/libpenumbra-dev/html/{page}.html\n", files)

    def test_lintian_finds_no_error(self):
        skip_without("lintian")
        user = ["--allow-root"] if os.geteuid() == 0 else []
        found = command("lintian", *user, "--fail-on", "error", *self.packages.values())
        self.assertNotRegex(found, r"(?m)^E:")

    def install(self, *names, also=""):
        """A bare root with these packages. It has nothing but these, their dependencies, those of `also` and what every
        Debian has."""
        if os.geteuid() != 0:
            self.skipTest("skipped: only root can use a bare root")
        skip_without("chroot", "ldconfig", "dpkg-query")
        root = self.folder / "root"
        root.mkdir()
        own = re.compile(r"libpenumbra0 \(.*?\)(, )?")
        relations = ", ".join(own.sub("", self.field(name, "Depends")) for name in names)
        bare_root.make(root, f"{relations}, {also}")
        for name in names:
            shutil.copy(self.packages[name], root / "tmp")
        result = bare_root.run(root, "dpkg", "-i", *[f"/tmp/{self.packages[name].name}" for name in names])
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return root

    def succeed_in(self, root, *arguments):
        result = bare_root.run(root, *arguments)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def test_program_draws_in_a_bare_root(self):
        root = self.install("penumbra")
        self.assertRegex(self.succeed_in(root, "penumbra", "--version"), r"^Penumbra \d")
        scene = "/usr/share/penumbra/scenes/steps.glb"
        for picture in ("/tmp/steps.png", "/tmp/steps.exr"):
            self.succeed_in(root, "penumbra", "render", scene, "-o", picture, "--size", "64x36", "--backend", "egl")
            self.assertGreater((root / picture[1:]).stat().st_size, 500)
        for file in ("man/man1/penumbra.1.gz", "bash-completion/completions/penumbra", "zsh/site-functions/_penumbra"):
            self.assertTrue((root / "usr/share" / file).exists(), file)
        self.succeed_in(root, "dpkg", "--purge", "penumbra")
        left = [path for path in root.rglob("*penumbra*") if path.parent != root / "tmp"]
        self.assertEqual(left, [])

    def test_python_module_draws_in_a_bare_root(self):
        if "python3-penumbra" not in self.packages:
            self.skipTest("skipped: built without the Python module")
        root = self.install("python3-penumbra")
        shutil.copy(support.ROOT / "scenes" / "steps.glb", root / "tmp")
        code = ("import penumbra, importlib.metadata; scene = penumbra.open('/tmp/steps.glb', size='64x36', "
                "no_cache=True); print(importlib.metadata.version('penumbra'), scene.render('shadow').shape, "
                "scene.truth(samples=8)['shadow'].shape)")
        version = self.field("python3-penumbra", "Version").split("-")[0]
        self.assertEqual(self.succeed_in(root, "python3", "-c", code), f"{version} (36, 64) (36, 64)\n")

    def test_engine_is_built_and_runs_in_a_bare_root(self):
        root = self.install("libpenumbra0", "libpenumbra-dev", also="libegl1, libgl1-mesa-dri")
        self.assertIn("libpenumbra.so.0", self.succeed_in(root, "ldconfig", "-p"))
        sources, build = root / "usr/share/penumbra/examples/c_minimal", self.folder / "build"
        command("cmake", "-S", sources, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={root}/usr")
        command("cmake", "--build", build)
        self.assertIn("libpenumbra.so.0", command("readelf", "-d", build / "c_minimal"))
        shutil.copy(build / "c_minimal", root / "tmp")
        self.assertIn("1.00 0.00", self.succeed_in(root, "/tmp/c_minimal"))


if __name__ == "__main__":
    support.main()
