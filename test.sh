#!/usr/bin/env bash
# Builds everything, runs the test suite and the static checks, and prints the counts last.
#   ./test.sh [--quick] [-R REGEX]
#     --quick    leave out what is slow: clang-tidy and the builds with sanitizers
#     -R REGEX   only the tests whose name matches, and no static checks
# Tests on third-party scenes need PENUMBRA_ASSETS, the folder that holds them; without it they are skipped.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
source "$root/scripts/setup.sh"

quick=0 regex=
while (($# > 0)); do
  case $1 in
    --quick) quick=1 ;;
    -R) [[ -n ${2:-} ]] || { echo "-R takes a regular expression" >&2 && exit 2; }
      regex=$2 && shift ;;
    *) sed -n '3,6s/^# //p' "$0" && exit 2 ;;
  esac
  shift
done
# A software rasteriser keeps its textures in the memory of the process. The program itself asks for huge pages, which takes
# up to half of a short run's time away; this asks for them for the other programs that the tests draw with.
export GLIBC_TUNABLES=${GLIBC_TUNABLES-glibc.malloc.hugetlb=1}
# The tests compile more shaders than Mesa keeps by default, and it would drop other programs' shaders for them: a folder of
# their own.
shaders=${XDG_CACHE_HOME:-~/.cache}/penumbra
mkdir -p "$shaders"
export MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$shaders} MESA_SHADER_CACHE_MAX_SIZE=${MESA_SHADER_CACHE_MAX_SIZE:-4G}
[[ -z ${PENUMBRA_ASSETS:-} ]] || PENUMBRA_ASSETS=$(cd "$PENUMBRA_ASSETS" && pwd)

# suite PRESET CTEST-ARGUMENTS...: results stay in the build folder for the count at the end.
suite() {
  local folder=$root/build/$1
  shift
  find "$folder/test-results" -type f -delete
  ctest --test-dir "$folder" --output-on-failure --no-tests=error --parallel "$(nproc)" \
    --output-junit "$folder/test-results/ctest.xml" "$@" || failed=1
  result_folders+=("$folder/test-results")
}

# check NAME COMMAND...: a static check, by its exit code.
check() {
  local name=$1 begin=$SECONDS
  shift
  if "$@"; then
    checks_passed=$((checks_passed + 1))
    note "passed: $name ($((SECONDS - begin)) s)"
  else
    checks_failed=$((checks_failed + 1)) failed=1
    note "FAILED: $name ($((SECONDS - begin)) s)"
  fi
}

failed=0 checks_passed=0 checks_failed=0 result_folders=()
ensure_packages "run test"
(ensure_packages peers && ensure_peers) || note "without them the tests of bench/peers are skipped"
tests_built release all
suite_begin=$SECONDS
suite release ${regex:+-R "$regex"}
suite_seconds=$((SECONDS - suite_begin))

if [[ -z $regex ]]; then
  check "shader variants" python3 "$root/scripts/variants.py" "$root/build/release/tools/penumbra-variants"
  check "clang-format" "$root/scripts/format.sh"
  ((quick)) || check "clang-tidy" python3 "$root/scripts/tidy.py" "$root/build/release"
fi
if ((!quick)) && [[ -z $regex ]]; then
  tests_built asan penumbra_sanitized
  # Mesa and LLVM keep memory to the end of the process; that is theirs to mend. The sanitizer guesses the size of the
  # thread-local storage of plugins from what lies before it in memory, and reads out of bounds where that is wrong.
  ASAN_OPTIONS=intercept_tls_get_addr=0 \
  LSAN_OPTIONS=suppressions=$root/tests/lsan.supp:print_suppressions=0 suite asan -L sanitize
  tests_built tsan penumbra_threads_tests
  TSAN_OPTIONS=suppressions=$root/tests/tsan.supp suite tsan -L threads
fi

python3 "$root/scripts/count_tests.py" "${result_folders[@]}"
printf 'static checks: %d passed, %d failed\n' "$checks_passed" "$checks_failed"
printf 'time: %d s, of which the suite %d s\n' "$SECONDS" "$suite_seconds"
exit "$failed"
