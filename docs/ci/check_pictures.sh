#!/usr/bin/env bash
# Draws every scene of a folder and compares the pictures with those that were recorded.
#   check_pictures.sh [--record] [OPTIONS OF RENDER...]
#     --record   keeps the pictures as those to compare with
# Exits with 1 if a picture changed, is missing, could not be drawn or recorded, or has no scene any more. Set by
# environment variables: PENUMBRA, the program; SCENES, the folder of scenes; RECORDED, the folder of the recorded
# pictures; RESULTS, where pictures, differences and figures are written; LIMIT, the greatest FLIP error (0: no
# difference, 1: black against white).
set -uo pipefail
penumbra=${PENUMBRA:-penumbra} scenes=${SCENES:-scenes} recorded=${RECORDED:-recorded}
results=${RESULTS:-out/pictures} limit=${LIMIT:-0.005}
record=0 failed=0
[[ ${1:-} == --record ]] && record=1 && shift

shopt -s nullglob
files=("$scenes"/*.{glb,gltf})
((${#files[@]})) || { printf 'no scene in %s\n' "$scenes" >&2 && exit 1; }
for scene in "${files[@]}"; do
  name=$(basename "${scene%.*}")
  if [[ $scene == *.gltf && -e $scenes/$name.glb ]]; then
    printf '%s and %s would have the same picture\n' "$scene" "$scenes/$name.glb" >&2
    failed=1
    continue
  fi
  picture=$results/$name.png
  # Frames in software are the same on every machine with the same version of Mesa; a GPU has its own rounding.
  if ! "$penumbra" render "$scene" -o "$picture" --size 320x180 --backend osmesa --quiet "$@"; then
    failed=1
  elif ((record)); then
    { mkdir -p "$recorded" && cp "$picture" "$recorded/$name.png"; } || failed=1
  elif ! "$penumbra" diff "$picture" "$recorded/$name.png" --metric flip --max "$limit" --quiet \
    --heatmap "$results/$name.difference.png" --json "$results/$name.json"; then
    printf 'changed: %s\n' "$name" >&2
    failed=1
  fi
done
for picture in "$recorded"/*.png; do
  name=$(basename "${picture%.png}")
  if ((!record)) && [[ ! -e $scenes/$name.glb && ! -e $scenes/$name.gltf ]]; then
    printf 'without a scene: %s\n' "$picture" >&2
    failed=1
  fi
done
exit "$failed"
