"""Runs clang-tidy over every translation unit of the project and remembers what was clean.

    tidy.py BUILD [FILE...]     BUILD: a build folder, built; FILE: only these

A result is kept under the hash of all that it depends on: the file, the project's headers that it includes, the
command line, the configuration and clang-tidy's version. So a second run checks only what changed.

Most of the time goes into headers of other projects, which every file includes. So several files are checked as one
translation unit, one after the other. The files of a unit with findings are then
checked one by one, so that each finding is reported for one file.
"""

import argparse
import concurrent.futures
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

TIDY = "clang-tidy-16"  # findings differ from version to version; older ones fail on <ranges> of GCC 12
ROOT = pathlib.Path(__file__).resolve().parent.parent
LARGEST_UNIT = 8  # files: the gain of more is small, and one finding costs more

INCLUDE = re.compile(r'^#include (?:"([^"]+)"|<[^>]+>)', re.MULTILINE)
# Names that two files of one unit can't both declare: using-declarations, and what begins in the first column, as
# functions, constants and types of unnamed namespaces do.
DECLARED = re.compile(r"^(?:using [\w:]+::(\w+);|using (\w+) =|(?:struct|class|enum class|enum) (\w+)"
                      r"|(?!namespace|using|struct|class|enum|template|return|#|//)\w[\w:<>,&*\s]*?[\s&*](\w+)(?=\(|\[|\{| =|;))",
                      re.MULTILINE)


@dataclasses.dataclass
class File:
    path: pathlib.Path
    arguments: list  # of the compiler
    key: str

    def __post_init__(self):
        self.text = self.path.read_text()
        self.names = {name for match in DECLARED.finditer(self.text) for name in match.groups() if name}

    def stands_alone(self):
        return re.search(r"^# *define", self.text, re.MULTILINE) is not None


def compiler_arguments(command):
    """Without what names the file, its output and the precompiled header, which is GCC's and not Clang's."""
    arguments = shlex.split(command)
    arguments = arguments[next(i for i, word in enumerate(arguments) if word.endswith("c++")) + 1:]
    with_value = ("-o", "-c", "-MT", "-MF", "-include")
    kept = [word for before, word in zip([""] + arguments, arguments) if before not in with_value]
    return [word for word in kept if word not in (*with_value, "-MD", "-Winvalid-pch")]


def own_commands(build):
    commands = json.loads((build / "compile_commands.json").read_text())
    own = [ROOT / "src", ROOT / "tests", ROOT / "tools", ROOT / "bench"]
    return [c for c in commands if any(folder in pathlib.Path(c["file"]).parents for folder in own)]


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


def key_of(arguments, inputs, version, contents):
    digest = hashlib.sha256()
    for part in (version, *arguments, *sorted(str(path) for path in inputs)):
        digest.update(part.encode() + b"\0")
    for path in sorted(inputs):
        if path not in contents:
            contents[path] = hashlib.sha256(path.read_bytes()).digest() if path.exists() else b""
        digest.update(contents[path])
    return digest.hexdigest()


def files_to_check(build, only, cache):
    """All files that were asked for, and those of them whose result is not known."""
    version = subprocess.run([TIDY, "--version"], check=True, capture_output=True, text=True).stdout
    deps, contents, count, todo = dependencies(build), {}, 0, []
    for command in own_commands(build):
        path = pathlib.Path(command["file"])
        if only and path not in only:
            continue
        count += 1
        output = command["command"].split(" -o ")[1].split(" ")[0]
        own = {file for file in deps.get(output, []) if ROOT in file.parents and file.suffix != ".gch"}
        arguments = compiler_arguments(command["command"])
        key = key_of(arguments, own | {path, *configuration(path)}, version, contents)
        if not (cache / key).exists():
            todo.append(File(path, arguments, key))
    return count, todo


def units_of(files, largest):
    """Files of one command line and configuration that declare nothing twice, so many at most."""
    units = []
    for file in files:
        def takes(unit):
            first = unit[0]
            return (len(unit) < largest and not file.stands_alone() and not first.stands_alone()
                    and first.arguments == file.arguments and configuration(first.path) == configuration(file.path)
                    and not any(other.names & file.names for other in unit))
        unit = next((unit for unit in units if takes(unit)), None)
        if unit is None:
            units.append([file])
        else:
            unit.append(file)
    return units


def joined(unit):
    """The files as one text. What an earlier file includes is left out of later ones, for it would be a duplicate."""
    seen, texts = set(), []
    for file in unit:
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
    config, arguments = configuration(unit[0].path)[0], unit[0].arguments
    if len(unit) == 1:
        return [(unit[0], *run_tidy(build, unit[0].path, config, arguments))]
    with tempfile.NamedTemporaryFile("w", suffix=".cpp", dir=build) as source:
        source.write(joined(unit))
        source.flush()
        clean, _ = run_tidy(build, source.name, config, arguments)
    if clean:
        return [(file, True, "") for file in unit]
    half = len(unit) // 2
    return check(build, unit[:half]) + check(build, unit[half:])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="a build folder, built")
    parser.add_argument("files", type=pathlib.Path, nargs="*", help="only these")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    cache = ROOT / "build" / "tidy-cache"
    cache.mkdir(parents=True, exist_ok=True)

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
