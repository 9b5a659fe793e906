"""Validates every shader variant that the program can build.

`penumbra-variants FOLDER` writes the stages of each variant and compiles each program with the driver, as one process for
each core; the reference compiler, glslangValidator, then reads every file. Names that `#if` tests must be defined.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def validate(files):
    """Messages of the reference compiler for files that it refuses."""
    result = subprocess.run(["glslangValidator", *map(str, files)], capture_output=True, text=True)
    return result.stdout + result.stderr if result.returncode else ""


def undefined_names(file):
    """Messages for names that a stage tests with #if and never defines, which strict compilers refuse."""
    text = file.read_text()
    defined = set(re.findall(r"#\s*define\s+(\w+)", text))
    tested = {name for line in re.findall(r"#\s*(?:el)?if\s+(.*)", text) for name in re.findall(r"[A-Za-z_]\w*", line)}
    return "".join(f"{file.name}: #if {name}, which is not defined\n" for name in sorted(tested - defined - {"defined"}))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path, help="the executable penumbra-variants")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        parts = os.cpu_count()
        # Mesa's software rasterizer then generates code that is not optimized, in two thirds of the time.
        environment = os.environ | {"GALLIVM_PERF": "nopt"}
        drivers = [subprocess.Popen([arguments.program.resolve(), folder, f"{part}/{parts}"], env=environment)
                   for part in range(1, parts + 1)]
        compiled = [driver.wait() for driver in drivers] == [0] * parts
        files = sorted(path for path in pathlib.Path(folder).rglob("*")
                       if path.suffix in (".vert", ".geom", ".frag", ".comp"))
        batches = [files[i : i + 64] for i in range(0, len(files), 64)]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            messages = [text for text in (*pool.map(validate, batches), *map(undefined_names, files)) if text]
    for text in messages:
        print(text, end="")
    print(f"shader variants: {len(files)} stages, driver {'accepts' if compiled else 'REFUSES some'}, "
          f"reference compiler {'refuses some' if messages else 'accepts'}")
    return 0 if compiled and files and not messages else 1


if __name__ == "__main__":
    sys.exit(main())
