"""Runs clang-tidy over every translation unit of the project and remembers what was clean.

A result is kept under the hash of all that it depends on: the file, the project's headers that it includes, the
command line, the configuration and clang-tidy's version. So a second run checks only what changed.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys

TIDY = "clang-tidy-16"  # findings differ from version to version; older ones fail on <ranges> of GCC 12
ROOT = pathlib.Path(__file__).resolve().parent.parent


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


def key_of(command, inputs, version, contents):
    digest = hashlib.sha256()
    for part in (version, command["command"], *sorted(str(path) for path in inputs)):
        digest.update(part.encode() + b"\0")
    for path in sorted(inputs):
        if path not in contents:
            contents[path] = hashlib.sha256(path.read_bytes()).digest() if path.exists() else b""
        digest.update(contents[path])
    return digest.hexdigest()


def check(build, file):
    command = [TIDY, "--quiet", "-p", str(build), "--extra-arg=-Wno-unknown-warning-option", str(file)]
    result = subprocess.run(command, capture_output=True, text=True)
    return result.returncode == 0, result.stdout + (result.stderr if result.returncode else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="a build folder, built")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    cache = ROOT / "build" / "tidy-cache"
    cache.mkdir(parents=True, exist_ok=True)

    version = subprocess.run([TIDY, "--version"], check=True, capture_output=True, text=True).stdout
    deps, contents = dependencies(build), {}
    todo = []
    commands = own_commands(build)
    for command in commands:
        file = pathlib.Path(command["file"])
        output = command["command"].split(" -o ")[1].split(" ")[0]
        inputs = {path for path in deps.get(output, []) if ROOT in path.parents} | {file, *configuration(file)}
        key = key_of(command, inputs, version, contents)
        if not (cache / key).exists():
            todo.append((file, key))

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for (file, key), (clean, text) in zip(todo, pool.map(lambda item: check(build, item[0]), todo)):
            if clean:
                (cache / key).touch()
            else:
                failed += 1
                print(text, end="")
    print(f"clang-tidy: {len(commands)} files, {len(todo)} of them checked anew, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
