"""The bundle for bare servers: small, whole, and in need of nothing but the C library and an EGL driver."""

import json
import os
import subprocess
import tarfile

from support import BUILD, ROOT, TestCase, main, shader_cache

BUNDLE = BUILD / "penumbra-bench-bundle"


class BenchBundle(TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run(["cmake", "--build", BUILD, "--target", "bench-bundle"], check=True, capture_output=True)

    def unpacked(self):
        with tarfile.open(f"{BUNDLE}.tar.gz") as tar:
            tar.extractall(self.folder)
        return self.folder / BUNDLE.name

    def bench(self, bundle, *arguments, **options):
        # No variable of this machine's helps it along, but for where Mesa keeps compiled shaders.
        return subprocess.run([bundle / "penumbra-bench", *arguments], capture_output=True, text=True, timeout=300,
                              cwd=bundle, env={"MESA_SHADER_CACHE_DIR": shader_cache()}, **options)

    def test_is_small_and_holds_what_its_readme_names(self):
        bundle = self.unpacked()
        size = sum(path.stat().st_size for path in bundle.rglob("*") if path.is_file())
        self.assertLess(size, 20e6)
        self.assertLess(os.stat(f"{BUNDLE}.tar.gz").st_size, 8e6)
        scenes = {path.name for path in (bundle / "scenes").iterdir()}
        self.assertEqual(scenes, {path.name for path in (ROOT / "scenes").glob("*.glb")})
        text = (bundle / "README.txt").read_text()
        commands = [line.split() for line in text.replace("\\\n", " ").splitlines()
                    if line.startswith("    ./penumbra-bench")]
        self.assertEqual(len(commands), 3)
        for words, kept in zip(commands, ("techniques.csv", "taps.csv")):  # as bench/results/README.md asks for
            self.assertIn(kept, words)
        for words in commands:
            for word in words:
                if word.startswith("scenes/"):
                    self.assertTrue((bundle / word).exists(), word)
            # Their options exist: the command line is read before the scene.
            run = self.bench(bundle, *words[1:], "--egl-device", "200")
            self.assertEqual(run.returncode, 1, run.stderr)  # there is no such device

    def test_needs_the_c_library_alone(self):
        lines = subprocess.run(["ldd", self.unpacked() / "penumbra-bench"], capture_output=True, text=True,
                               check=True).stdout.splitlines()
        names = {line.split()[0].rsplit("/", 1)[-1].split(".so")[0] for line in lines}
        self.assertLessEqual(names, {"linux-vdso", "libc", "libm", "ld-linux-x86-64", "libdl", "libpthread"})

    def test_measures_textured_scenes_from_its_own_folder(self):
        bundle = self.unpacked()
        run = self.bench(bundle, "scenes/foliage.glb", "--technique", "pcss,thesis_8x8", "--floor", "--frames", "1",
                         "--warmup", "1", "--size", "64x36", "-o", "bench.json", "-o", "bench.html", "-o", "bench.csv")
        self.assertEqual(run.returncode, 0, run.stderr)
        data = json.loads((bundle / "bench.json").read_text())
        self.assertEqual(data["scene"], "foliage.glb")
        self.assertGreater(data["points"][0]["costs"][1]["frame"]["median_ms"], 0)
        for word in (str(BUILD), str(ROOT), str(self.folder)):
            self.assertNotIn(word, (bundle / "bench.json").read_text())

    def test_knows_no_path_of_the_building_machine(self):
        program = (self.unpacked() / "penumbra-bench").read_bytes()
        self.assertNotIn(str(ROOT).encode(), program)

    def test_says_what_it_lacks(self):
        bundle = self.unpacked()
        run = self.bench(bundle, "scenes/nothing.glb")
        self.assertEqual(run.returncode, 1)
        self.assertIn("nothing.glb", run.stderr)
        self.assertEqual(self.bench(bundle, "--version").returncode, 0)


if __name__ == "__main__":
    main()
