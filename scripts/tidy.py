"""Runs clang-tidy over every translation unit of the project and remembers what was clean.

    tidy.py BUILD [FILE...]     BUILD: a build folder, built; FILE: only these

A result is kept under the hash of all that it depends on: the file, the project's headers that it includes, the
command line, the configuration, this script, clang-tidy's version and those of Debian's packages, whose headers are
included too. Headers from elsewhere are not among it: once they have changed, empty the cache. So a second run checks only
what changed, also in another checkout: like a compiler's cache, this one is the user's (XDG_CACHE_HOME).

Most of the time goes into headers of other projects, which every file includes. So several files are checked as one
translation unit, one after the other. A unit with findings is halved until each finding is reported for one file.
"""

import argparse
import concurrent.futures
import contextlib
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

TIDY = "clang-tidy-16"  # findings differ from version to version; older ones fail on <ranges> of GCC 12
ROOT = pathlib.Path(__file__).resolve().parent.parent
LARGEST_UNIT = 24  # files: two units of 8 take 1.8 times as long as one of 16, but one finding costs more
LONGEST_UNUSED = 30 * 24 * 3600  # seconds

INCLUDE = re.compile(r'^#include (?:"([^"]+)"|<[^>]+>)', re.MULTILINE)
# Names that a file declares for the rest of its unit: using-declarations, and what begins in the first column, as
# functions, constants and types of unnamed namespaces do.
DECLARED = re.compile(r"^(?:using [\w:]+::(\w+);|using (\w+) =|(?:struct|class|enum class|enum) (\w+)"
                      r"|(?!namespace|using|struct|class|enum|template|return|#|//)\w[\w:<>,&*\s]*?[\s&*](\w+)(?=\(|\[|\{| =|;))",
                      re.MULTILINE)

COMPILER = re.compile(r"[cg]\+\+(-\d+)?$")  # c++, g++-12, clang++-16
NOT_CODE = re.compile(r'//.*|"(?:[^"\\\n]|\\.)*"|^#include.*', re.MULTILINE)
WORD = re.compile(r"(?<![.\w>:])[A-Za-z_]\w*|(?<=[^:]:)[A-Za-z_]\w*")  # not a member, nor a name of a named scope


@dataclasses.dataclass
class File:
    path: pathlib.Path
    arguments: list  # of the compiler
    key: str

    def __post_init__(self):
        self.text = self.path.read_text()
        self.names = {name for match in DECLARED.finditer(self.text) for name in match.groups() if name}
        self.words = set(WORD.findall(NOT_CODE.sub("", self.text)))

    def stands_alone(self):
        return re.search(r"^# *define|^\w+_MAIN\(", self.text, re.MULTILINE) is not None

    def defines(self):
        """The values of the macros that its command line defines."""
        return dict((word[2:].split("=", 1) + [""])[:2] for word in self.arguments if word.startswith("-D"))


class Unit:
    """Files that are checked as one translation unit."""

    def __init__(self, files):
        self.files = files
        self.arguments = union(file.arguments for file in files)

    def takes(self, file):
        """Whether no name and no macro would get two meanings, and one configuration holds for all. A name that one file
        declares must not occur in another one even as a local variable's: it would shadow the first."""
        first = self.files[0]
        return (not file.stands_alone() and not first.stands_alone()
                and configuration(first.path) == configuration(file.path)
                and not any(other.names & file.words or file.names & other.words for other in self.files)
                and not any(other.defines().get(name, value) != value for other in self.files
                            for name, value in file.defines().items()))

    def halves(self):
        half = len(self.files) // 2
        return Unit(self.files[:half]), Unit(self.files[half:])


def compiler_arguments(command):
    """Without the optimization, and without what names the file, its output and the precompiled header, which is GCC's
    and not Clang's."""
    arguments = shlex.split(command)
    arguments = arguments[next(i for i, word in enumerate(arguments) if COMPILER.search(word)) + 1:]
    with_value = ("-o", "-c", "-MT", "-MF", "-include")
    kept = [word for before, word in zip([""] + arguments, arguments) if before not in with_value]
    return [word for word in kept
            if word not in (*with_value, "-MD", "-Winvalid-pch") and not re.fullmatch(r"-O\w?", word)]


def union(lists):
    """Every argument once, in the order of the lists."""
    options = {}
    for arguments in lists:
        words = iter(arguments)
        for word in words:
            options[(word, next(words)) if word == "-isystem" else (word,)] = None
    return [word for option in options for word in option]


def files_of(command):
    """The file of a command, or those that it includes whole: see penumbra_join_command_lines() of cmake/Layers.cmake."""
    path = pathlib.Path(command["file"])
    if not path.name.startswith("penumbra_") or "_command_lines_" not in path.name:
        return [path]
    return [ROOT / "src" / name for name in INCLUDE.findall(path.read_text())]


def own_commands(build):
    """The file and the command of each of the project's sources; of one that several targets compile, one command."""
    commands = json.loads((build / "compile_commands.json").read_text())
    own = [ROOT / "src", ROOT / "tests", ROOT / "tools", ROOT / "bench", ROOT / "python"]
    found = {path: command["command"] for command in commands for path in files_of(command)}
    return {path: command for path, command in found.items() if any(folder in path.parents for folder in own)}


def dependencies(build):
    """The files that each object was made from, as ninja recorded them at the last build."""
    text = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, capture_output=True, text=True).stdout
    table = {}
    for line in text.splitlines():
        if line.startswith("    "):
            table[output].append((build / line.strip()).resolve())
        elif ": #deps" in line:
            output = line.split(": #deps")[0]
            table[output] = []
    return table


def configuration(file):
    """Every .clang-tidy that applies to the file."""
    return [folder / ".clang-tidy" for folder in file.parents if (folder / ".clang-tidy").exists()]


def versions():
    """Of clang-tidy, of this script and, on Debian, of all packages."""
    listed = [TIDY, "--version"], ["dpkg-query", "--show"]
    return pathlib.Path(__file__).read_text() + "".join(
        subprocess.run(command, check=True, capture_output=True, text=True).stdout
        for command in listed if shutil.which(command[0]))


def in_any_checkout(text):
    return text.replace(str(ROOT), ".")


def key_of(arguments, inputs, version, contents):
    digest = hashlib.sha256()
    for part in (version, *arguments, *sorted(str(path) for path in inputs)):
        digest.update(in_any_checkout(part).encode() + b"\0")
    for path in sorted(inputs):
        if path not in contents:
            contents[path] = hashlib.sha256(path.read_bytes()).digest() if path.exists() else b""
        digest.update(contents[path])
    return digest.hexdigest()


def files_to_check(build, only, cache):
    """All files that were asked for, and those of them whose result is not known."""
    version, deps, contents, count, todo = versions(), dependencies(build), {}, 0, []
    for path, command in own_commands(build).items():
        if only and path not in only:
            continue
        count += 1
        output = command.split(" -o ")[1].split(" ")[0]
        own = {file for file in deps.get(output, []) if ROOT in file.parents and file.suffix != ".gch"}
        arguments = compiler_arguments(command)
        key = key_of(arguments, own | {path, *configuration(path)}, version, contents)
        if (cache / key).exists():
            (cache / key).touch()
        else:
            todo.append(File(path, arguments, key))
    return count, todo


def units_of(files, largest):
    """Units of so many files at most."""
    units = []
    for file in files:
        unit = next((unit for unit in units if len(unit.files) < largest and unit.takes(file)), None)
        if unit is None:
            units.append(Unit([file]))
        else:
            units[units.index(unit)] = Unit([*unit.files, file])
    return units


def joined(files):
    """The files as one text. What an earlier file includes is left out of later ones, for it would be a duplicate."""
    seen, texts = set(), []
    for file in files:
        here = set()

        def included(match):
            beside = file.path.parent / match[1] if match[1] else None
            line = f'#include "{beside.resolve()}"' if beside and beside.exists() else match[0]
            here.add(line)
            return "" if line in seen else line
        texts.append(INCLUDE.sub(included, file.text))
        seen |= here
    return "\n".join(texts)


def run_tidy(build, path, config, arguments):
    command = [TIDY, "--quiet", f"--config-file={config}", str(path), "--", *arguments, "-Wno-unknown-warning-option"]
    result = subprocess.run(command, cwd=build, capture_output=True, text=True)
    return result.returncode == 0, result.stdout + (result.stderr if result.returncode else "")


def check(build, unit):
    """(file, is it clean, findings) of each file."""
    first = unit.files[0]
    config = configuration(first.path)[0]
    if len(unit.files) == 1:
        return [(first, *run_tidy(build, first.path, config, first.arguments))]
    with tempfile.NamedTemporaryFile("w", suffix=".cpp", dir=build) as source:
        source.write(joined(unit.files))
        source.flush()
        clean, _ = run_tidy(build, source.name, config, unit.arguments)
    if clean:
        return [(file, True, "") for file in unit.files]
    return [result for half in unit.halves() for result in check(build, half)]


def kept_results():
    """The folder of the results, without those that no run has used for long."""
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "penumbra" / "tidy"
    cache.mkdir(parents=True, exist_ok=True)
    for result in cache.iterdir():
        with contextlib.suppress(FileNotFoundError):  # another run may remove it
            if time.time() - result.stat().st_mtime > LONGEST_UNUSED:
                result.unlink()
    return cache


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="a build folder, built")
    parser.add_argument("files", type=pathlib.Path, nargs="*", help="only these")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    cache = kept_results()

    count, todo = files_to_check(build, {file.resolve() for file in arguments.files}, cache)
    units = units_of(todo, max(1, min(LARGEST_UNIT, len(todo) // arguments.jobs)))
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for results in pool.map(lambda unit: check(build, unit), units):
            for file, clean, text in results:
                if clean:
                    (cache / file.key).touch()
                else:
                    failed += 1
                    print(text, end="", flush=True)
    print(f"clang-tidy: {count} files, {len(todo)} of them checked anew, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
