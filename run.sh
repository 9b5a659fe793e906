#!/usr/bin/env bash
# Builds Penumbra when something changed (installing what is missing) and runs it:
#   ./run.sh                     renders the default scene to out/penumbra.png
#   ./run.sh ARGS...             runs `penumbra ARGS...`
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
source "$root/scripts/setup.sh"

ensure_packages run
build_lock
configured "$root/build/release" || configure release -DPENUMBRA_TESTS=OFF
build release penumbra
build_unlock

program=$root/build/release/penumbra
(($# > 0)) && exec "$program" "$@"

picture=$root/out/penumbra.png
mkdir -p "$root/out"
"$program" render "$root/scenes/courtyard.glb" -o "$picture"
note "The picture is in $picture"
