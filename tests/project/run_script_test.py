"""run.sh: builds when something changed, then is as good as the program itself. Tried on a project of one file."""

import os
import pathlib
import shutil
import subprocess

import support

CMAKE = """cmake_minimum_required(VERSION 3.25)
project(penumbra LANGUAGES CXX)
add_executable(penumbra main.cpp)
"""

PROGRAM = """#include <cstdio>
#include <filesystem>
int main(int argc, char** argv) {
  std::printf("%s\\n", std::filesystem::current_path().c_str());
  for (int i = 1; i < argc; ++i) std::printf("[%s]", argv[i]);
  return 7;
}
"""

PACKAGES = """# stage kind file package
run command cmake cmake
run header stdio.h libc6-dev
test command no-such no-such
"""


def living_of_session(session):
    """The names of its processes, without those that only wait to be counted by their parent."""
    names = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            name, _, rest = (process / "stat").read_text().rpartition(")")
        except OSError:
            continue  # it has just ended
        state, _, _, of = rest.split()[:4]
        if int(of) == session and state not in "ZX":
            names.append(name)
    return names


class RunScript(support.TestCase):
    def setUp(self):
        super().setUp()
        self.project = self.folder / "a project"
        (self.project / "scripts").mkdir(parents=True)
        for name in ("run.sh", "scripts/setup.sh", "CMakePresets.json"):
            shutil.copy(support.ROOT / name, self.project / name)
        (self.project / "scripts" / "packages.txt").write_text(PACKAGES)
        (self.project / "CMakeLists.txt").write_text(CMAKE)
        (self.project / "main.cpp").write_text(PROGRAM)

    def run_script(self, *arguments, **options):
        command = [self.project / "run.sh", *arguments]
        return subprocess.run(command, capture_output=True, text=True, timeout=300, **options)

    def test_arguments_folder_exit_code_and_output_are_the_programs(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        result = self.run_script("a b", "", "--c=*", cwd=elsewhere)
        self.assertEqual(result.returncode, 7, result.stderr)
        self.assertEqual(result.stdout, f"{elsewhere}\n[a b][][--c=*]")
        self.assertIn("Configuring", result.stderr)

        again = self.run_script("a", cwd=elsewhere)
        self.assertEqual((again.returncode, again.stderr), (7, ""), "nothing changed, so nothing is to do or to say")

        (self.project / "main.cpp").write_text(PROGRAM.replace("return 7", "return 9"))
        self.assertEqual(self.run_script("a").returncode, 9, "a changed source was not built")

    def test_leaves_no_process_behind(self):
        for source in (PROGRAM, "int main() { return nonsense; }"):
            (self.project / "main.cpp").write_text(source)
            script = subprocess.Popen([self.project / "run.sh"], start_new_session=True, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL)
            script.wait(timeout=300)
            self.assertEqual(living_of_session(script.pid), [])

    def test_works_through_a_symbolic_link(self):
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "penumbra").symlink_to("../a project/run.sh")
        result = subprocess.run([self.folder / "bin" / "penumbra", "a"], capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 7, result.stderr)

    def test_moved_checkout_is_configured_anew(self):
        self.run_script("a")
        moved = self.folder / "moved"
        self.project.rename(moved)
        self.project = moved
        self.assertEqual(self.run_script("a").returncode, 7)

    def test_build_error_is_shown(self):
        (self.project / "main.cpp").write_text("int main() { return nonsense; }")
        result = self.run_script("a")
        self.assertEqual(result.returncode, 1)
        self.assertIn("nonsense", result.stderr)
        self.assertIn("error: the build of 'release' failed", result.stderr)

        (self.project / "CMakeLists.txt").write_text("message(FATAL_ERROR \"no such compiler\")")
        result = self.run_script("a")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no such compiler", result.stderr)

    def test_without_apt_names_what_is_missing(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for name in ("bash", "dirname", "mkdir", "readlink"):
            (tools / name).symlink_to(shutil.which(name))
        with (self.project / "scripts" / "packages.txt").open("a") as file:
            file.write("run command no-such-compiler fine-compiler\nrun library libnone.so libnone1\n")
        result = self.run_script("a", env={**os.environ, "PATH": str(tools)})
        self.assertEqual(result.returncode, 1)
        for line in ("fine-compiler (no-such-compiler)", "libnone1 (libnone.so)", "cmake (cmake)"):
            self.assertIn(line, result.stderr)
        self.assertNotIn("libc6-dev", result.stderr)

    def test_a_module_that_apt_installs_for_another_python_is_named_with_its_command(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for name, text in {"apt-get": "exit 0", "sudo": '"$@"', "python3": "exit 1"}.items():
            (tools / name).write_text(f"#!/bin/sh\n{text}\n")
            (tools / name).chmod(0o755)
        (self.project / "scripts" / "packages.txt").write_text("run python no_such_module python3-no-such-module\n")
        result = self.run_script("a", env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"})
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"{tools}/python3 -m pip install no-such-module", result.stderr)


if __name__ == "__main__":
    support.main()
