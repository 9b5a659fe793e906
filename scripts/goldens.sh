#!/usr/bin/env bash
# Records golden pictures again, in tests/image/golden, with the renderer of this machine:
#   scripts/goldens.sh           all of them
#   scripts/goldens.sh NAME...   these
# Look at what `git diff` shows before you commit it; tests/image/goldens.cpp lists them.
set -euo pipefail
root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
source "$root/scripts/setup.sh"

ensure_packages "run test"
tests_built release penumbra_image_tests

tests=$root/build/release/tests/penumbra_image_tests
filter='All/GoldenPictures.*'
if (($# > 0)); then
  filter=
  for name; do
    one=All/GoldenPictures.IsAsRecorded/$name
    [[ -n $("$tests" --gtest_list_tests --gtest_filter="$one") ]] || die "there is no golden picture '$name'"
    filter+=$one:
  done
fi
PENUMBRA_GOLDENS=record "$tests" --gtest_filter="$filter" --gtest_brief=1
