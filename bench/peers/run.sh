#!/usr/bin/env bash
# Measures Penumbra beside three.js, Babylon.js and PlayCanvas on the same scenes and the same driver, and prints a
# table:
#   bench/peers/run.sh SCENE... [OPTIONS]    --help lists the options
# Installs what is missing: Node.js and Chromium as packages of the system, the renderers by npm into build/peers.
set -euo pipefail
root=$(dirname -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")")
source "$root/scripts/setup.sh"

ensure_packages "run peers"
ensure_peers
if [[ -z ${PENUMBRA_PROGRAM:-} ]]; then
  build_lock
  configured "$root/build/release" || configure release -DPENUMBRA_TESTS=OFF
  build release penumbra
  build_unlock
fi
exec node "$root/bench/peers/main.mjs" "$@"
