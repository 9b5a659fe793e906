"""The tables of docs/techniques.md, made from what `penumbra list` prints.

  tables.py PROGRAM           exits 1 if the tables differ from the program
  tables.py PROGRAM --write   puts the tables into the file
"""

import json
import pathlib
import re
import subprocess
import sys

DOCUMENT = pathlib.Path(__file__).resolve().parents[1] / "docs" / "techniques.md"


def listed(program, what):
    return json.loads(subprocess.run([program, "list", what, "--json"], check=True, capture_output=True, text=True).stdout)["rows"]


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def techniques(program):
    rows = []
    for row in listed(program, "techniques"):
        means = f"`{row['technique']}` with `{' '.join(row['sets'])}`" if "sets" in row else row["source"]
        rows.append([f"`{row['name']}`", row["help"], means])
    return table(["technique", "what it does", "source"], rows)


def filters(program):
    rows = [[f"`{row['name']}`", f"`{row['param']}`", row["help"], row["source"]] for row in listed(program, "filters")]
    return table(["filter", "parameter", "what it does", "source"], rows)


def denoisers(program):
    rows = [[f"`{row['name']}`", row["help"], row["source"]] for row in listed(program, "denoisers")]
    return table(["denoiser", "what it does", "source"], rows)


def products(program):
    rows = [[f"`{row['name']}`", row["help"], row["source"]] for row in listed(program, "products")]
    return table(["product", "what it holds", "source"], rows)


def value(default):
    if isinstance(default, bool):
        return str(default).lower()
    return f"{default:g}" if isinstance(default, float) else str(default)


def params(program):
    rows = []
    for row in listed(program, "params"):
        allowed = ", ".join(row["choices"]) if row.get("choices") else ""
        if "min" in row:
            allowed = f"{row['min']:g} to {row['max']:g} {row['unit']}".strip()
        rows.append([f"`{row['name']}`", value(row["default"]), allowed or "true, false", row["help"]])
    return table(["parameter", "default", "allowed", "meaning"], rows)


def main():
    program, write = sys.argv[1], "--write" in sys.argv[2:]
    text = made = DOCUMENT.read_text()
    tables = {"techniques": techniques(program), "filters": filters(program), "denoisers": denoisers(program),
              "products": products(program), "parameters": params(program)}
    for name, rows in tables.items():
        made = re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: m[1] + rows + "\n" + m[2], made, flags=re.DOTALL)
    if write:
        DOCUMENT.write_text(made)
    elif made != text:
        sys.exit(f"{DOCUMENT.name} is not what the program says: python3 scripts/tables.py PROGRAM --write")


if __name__ == "__main__":
    main()
