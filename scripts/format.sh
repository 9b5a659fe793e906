#!/usr/bin/env bash
# Checks that every C and C++ file is formatted as .clang-format says, and no line of GLSL is wider than 120. With --fix,
# formats these files.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
mode=(--dry-run -Werror)
[[ ${1:-} == --fix ]] && mode=(-i)
find src tests tools bench examples python \( -name '*.cpp' -o -name '*.hpp' -o -name '*.c' -o -name '*.h' \) -print0 | xargs -0 -r clang-format "${mode[@]}"
if LC_ALL=C.UTF-8 grep -rnE '^.{121,}' glsl; then
  echo "lines of GLSL wider than 120" >&2
  exit 1
fi
