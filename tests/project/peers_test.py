"""bench/peers: draws a scene with other renderers in a real Chromium, beside Penumbra, and leaves nothing behind."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

import jsonschema
import support

PEERS = support.ROOT / "bench" / "peers"
PACKAGES = pathlib.Path(os.environ.get("PENUMBRA_PEERS") or support.ROOT / "build" / "peers")
SCENE = support.ROOT / "scenes" / "steps.glb"
SMALL = ("--size", "160x90", "--frames", "1", "--rounds", "1", "--map-size", "512", "--spp", "16")


def skip_without_what_it_needs():
    for program in ("node", "chromium"):
        if not shutil.which(program):
            raise unittest.SkipTest(f"there is no {program}: scripts/packages.txt names its package")
    installed = PACKAGES / "installed.json"
    if not installed.exists() or installed.read_bytes() != (PEERS / "package-lock.json").read_bytes():
        raise unittest.SkipTest("the renderers of bench/peers are not installed: bench/peers/run.sh installs them")


def checked(results):
    """The report, which must be as its schema says."""
    report = json.loads(results.read_text())
    jsonschema.validate(report, json.loads((support.ROOT / "docs" / "schemas" / "peers.json").read_text()))
    return report


class Peers(support.TestCase):
    @classmethod
    def setUpClass(cls):
        skip_without_what_it_needs()

    def start(self, *arguments, **environment):
        # A folder for temporary files of its own shows what it leaves there.
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir(exist_ok=True)
        command = [shutil.which("node"), PEERS / "main.mjs", *map(str, arguments)]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                start_new_session=True,
                                env={**os.environ, "PENUMBRA_PROGRAM": support.PROGRAM, "PENUMBRA_PEERS": str(PACKAGES),
                                     "TMPDIR": str(self.temporary), **environment})

    def peers(self, *arguments, **environment):
        process = self.start(*arguments, **environment)
        out, errors = process.communicate(timeout=800)
        self.assert_nothing_is_left()
        return process.returncode, out, errors

    def processes(self, naming=""):
        """The processes whose command line has this test's temporary folder after the text."""
        found = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if f"{naming}{self.temporary}".encode() in (process / "cmdline").read_bytes():
                    found.append(process.name)
            except OSError:
                continue  # it has just ended
        return found

    def assert_nothing_is_left(self):
        end = time.monotonic() + 20
        while self.processes() and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(self.processes(), [])
        self.assertEqual([path for path in self.temporary.iterdir() if path.name.startswith("penumbra")], [])

    def test_every_renderer_draws_the_same_view_and_shadows(self):
        results, tables, pictures = (self.folder / name for name in ("peers.json", "peers.md", "pictures"))
        code, out, errors = self.peers(SCENE, *SMALL, "--materials", "white", "--json", results, "--markdown", tables,
                                       "--pictures", pictures)
        self.assertEqual(code, 0, out + errors)
        report = checked(results)
        scene = report["scenes"][0]
        rows = {(row["renderer"], row["maps"]): row for row in scene["rows"]}
        self.assertEqual(set(rows), {("Penumbra", 4), ("Penumbra", 1), ("three.js", 1), ("Babylon.js", 4),
                                     ("Babylon.js", 1), ("PlayCanvas", 4), ("PlayCanvas", 1)})
        self.assertGreater(scene["pixels"]["compared"], 0.9 * scene["pixels"]["receivers"])
        for name, row in rows.items():
            with self.subTest(row=name):
                self.assertGreater(row["shadowed_ms"]["median"], 0)
                self.assertGreater(row["unshadowed_ms"]["median"], 0)
                # With the shadows of another sun it is less than 18 dB, and another camera sees other receivers.
                self.assertGreater(row["figures"]["psnr"], 20)
                self.assertIn(f"{row['renderer']} {row['version']}", tables.read_text())
        self.assertEqual({(each["peer"], each["maps"]) for each in scene["ratios"]},
                         {name for name in rows if name[0] != "Penumbra"})
        for name in ("steps_three_1", "steps_babylon_4", "steps_playcanvas_4_shadow", "steps_penumbra_pcss_4"):
            rows = support.read_png(pictures / f"{name}.png")
            self.assertEqual((len(rows[0]), len(rows)), (160, 90))

    def test_a_scene_that_fails_costs_no_other_its_results(self):
        results, tables = self.folder / "peers.json", self.folder / "peers.md"
        lamps = support.ROOT / "scenes" / "gallery.glb"
        code, out, errors = self.peers(lamps, SCENE, *SMALL, "--peers", "", "--cascades", "1", "--no-truth",
                                       "--camera", "0", "--json", results, "--markdown", tables)
        self.assertEqual(code, 1, out + errors)
        self.assertIn(f"error: {lamps}: it has ", errors)
        self.assertEqual([scene["scene"] for scene in checked(results)["scenes"]], ["steps"])
        self.assertIn("### steps", tables.read_text())

    def test_a_browser_that_hangs_is_ended_and_reported(self):
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "chromium").write_text("#!/bin/sh\nsleep 600\n")
        (programs / "chromium").chmod(0o755)
        path = f"{programs}:{os.environ['PATH']}"
        results = self.folder / "peers.json"
        code, out, errors = self.peers(SCENE, *SMALL, "--peers", "three", "--cascades", "1", "--timeout", "3", "--json",
                                       results, PATH=path)
        self.assertEqual(code, 1, errors)
        self.assertIn("failed: three.js: the start of Chromium took longer than 3 s\n", out)
        self.assertIn("Penumbra", out)  # the others are measured all the same
        failed = checked(results)["scenes"][0]["rows"][1]
        self.assertEqual((failed["renderer"], failed["version"], failed["figures"]), ("three.js", None, None))
        self.assertIn("took longer than 3 s", failed["failed"])

    def test_ctrl_c_leaves_nothing(self):
        process = self.start(SCENE, *SMALL, "--frames", "10000", "--peers", "babylon", "--cascades", "1", "--no-truth")
        while process.poll() is None and not self.processes("--user-data-dir="):
            time.sleep(0.05)
        self.assertIsNone(process.poll(), "it has ended before its browser ran")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGINT)
        self.assert_nothing_is_left()

    def test_what_is_missing_is_named(self):
        for environment, said in (({"PATH": str(self.folder)}, "error: there is no Chromium on the PATH"),
                                  ({"PENUMBRA_PEERS": str(self.folder)}, "error: puppeteer-core is not in")):
            with self.subTest(environment=environment):
                code, out, errors = self.peers(SCENE, **environment)
                self.assertEqual((code, out, errors.count("\n")), (1, "", 1), errors)
                self.assertTrue(errors.startswith(said), errors)

    def test_errors_are_one_line(self):
        copy, link, both, referring, image = (
            self.folder / name for name in ("scene.glb", "link.json", "both", "scene.gltf", "an image.png"))
        shutil.copy(SCENE, copy)
        image.write_bytes(b"an image")
        referring.write_text(json.dumps({"asset": {"version": "2.0"}, "images": [{"uri": "an%20image.png"}]}))
        link.symlink_to(copy)
        for arguments, said, expected in (
            (["nothing.glb"], "error: nothing.glb: no such file\n", 1),
            ([SCENE, "--size", "0x9"], "error: --size: '0' is no whole number from 1 to 16384\n", 2),
            ([SCENE, "--peers", "four"], "error: --peers: 'four' is none of three, babylon, playcanvas\n", 2),
            ([SCENE, "--techniques", "pcss,none"], "error: --techniques: 'none' is measured beside all others\n", 2),
            ([SCENE, "--techniques", "pcss,a/pcss.toml"], "error: --techniques has 'pcss' twice\n", 2),
            ([SCENE, "--techniques", "a/mine.toml"], "error: a/mine.toml: no such file\n", 1),
            ([SCENE, "--nonsense"], "error: Unknown option '--nonsense'\n", 2),
            ([], "error: name a scene; --help lists the options\n", 2),
            ([SCENE, "--program", "/nowhere"], "error: /nowhere: no such file", 1),
            ([SCENE, "--json", SCENE / "x.json"], f"error: {SCENE / 'x.json'}: can't be written", 1),
            ([copy, "--json", link], f"error: --json {link}: this would overwrite the scene\n", 1),
            ([referring, "--markdown", image], f"error: --markdown {image}: this would overwrite a file of the scene\n", 1),
            ([copy, "--json", both, "--markdown", both],
             f"error: --markdown {both}: this would overwrite the file of --json\n", 1),
            ([SCENE, "--maps", "never"], "error: --maps: 'never' is none of anew, kept\n", 2),
        ):
            with self.subTest(arguments=arguments):
                code, out, errors = self.peers(*arguments)
                self.assertEqual((code, out), (expected, ""))
                self.assertTrue(errors.startswith(said), errors)
                self.assertEqual(errors.count("\n"), 1, errors)
        self.assertEqual(copy.read_bytes(), SCENE.read_bytes())
        self.assertEqual(image.read_bytes(), b"an image")


if __name__ == "__main__":
    support.main()
