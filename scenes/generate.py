#!/usr/bin/env python3
"""Makes Penumbra's own scenes: all of them, or a variant of one.

generate.py                                   writes every scene beside this file
generate.py --check                           exits 1 if a file differs from what would be written
generate.py --list                            the scenes, their parameters and defaults
generate.py NAME [--set key=value]... -o FILE a variant (vectors as x,y,z)
"""

import argparse
import inspect
import json
import struct
import sys
import zlib
from pathlib import Path

from gen import SCENES

HERE = Path(__file__).resolve().parent


def parse(text, default):
    """The value in the default's type; a parameter whose default is None is a number or a vector."""
    if isinstance(default, int) and not isinstance(default, bool):
        return int(text)
    if isinstance(default, float):
        return float(text)
    parts = tuple(float(part) for part in text.split(","))
    return parts if len(parts) > 1 or isinstance(default, tuple) else parts[0]


def overrides(name, settings):
    known = {p.name: p.default for p in inspect.signature(SCENES[name]).parameters.values()}
    values = {}
    for setting in settings:
        key, _, text = setting.partition("=")
        if key not in known:
            sys.exit("error: %s has no parameter '%s'; it has: %s" % (name, key, ", ".join(known) or "none"))
        try:
            values[key] = parse(text, known[key])
        except ValueError:
            sys.exit("error: %s: '%s' is no value for %s" % (name, text, key))
    return values


def comparable(data):
    """A file's meaning: its JSON without byte positions and its views with images inflated, because another zlib may
    pack the same pixels differently."""
    length = struct.unpack_from("<I", data, 12)[0]
    root = json.loads(data[20 : 20 + length])
    blob = data[28 + length :]
    views = []
    for view in root["bufferViews"]:
        start = view.pop("byteOffset")
        views.append(inflated(blob[start : start + view.pop("byteLength")]))
    root.pop("buffers")
    return root, views


def inflated(view):
    if not view.startswith(b"\x89PNG"):
        return view
    at, header, pixels = 8, b"", b""
    while at < len(view):
        length, kind = struct.unpack_from(">I4s", view, at)
        body = view[at + 8 : at + 8 + length]
        header += body if kind == b"IHDR" else b""
        pixels += body if kind == b"IDAT" else b""
        at += length + 12
    return header, zlib.decompress(pixels)


def check():
    stale = []
    for name, make in SCENES.items():
        path = HERE / (name + ".glb")
        fresh = make().bytes()
        stored = path.read_bytes() if path.exists() else b""
        if stored != fresh and (not stored or comparable(stored) != comparable(fresh)):
            stale.append(path.name)
    if stale:
        sys.exit("error: not what generate.py makes: %s" % ", ".join(stale))
    print("%d scenes are what generate.py makes" % len(SCENES))


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("name", nargs="?", choices=list(SCENES))
    options.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    options.add_argument("-o", "--output", type=Path)
    options.add_argument("--check", action="store_true")
    options.add_argument("--list", action="store_true")
    chosen = options.parse_args()
    if chosen.list:
        for name, make in SCENES.items():
            print("%s%s\n    %s\n" % (name, inspect.signature(make), inspect.getdoc(make).replace("\n", "\n    ")))
    elif chosen.check:
        check()
    elif chosen.name:
        data = SCENES[chosen.name](**overrides(chosen.name, chosen.set)).bytes()
        (chosen.output or HERE / (chosen.name + ".glb")).write_bytes(data)
    elif chosen.set or chosen.output:
        options.error("--set and -o need the name of a scene")
    else:
        for name, make in SCENES.items():
            (HERE / (name + ".glb")).write_bytes(make().bytes())


if __name__ == "__main__":
    main()
