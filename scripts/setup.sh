# Shared by run.sh, test.sh and bench/peers/run.sh: packages and build. Sourced, with $root set. Everything it prints
# goes to stderr, so that the program's own output can be piped.

note() { printf '%s\n' "$*" >&2; }
die() {
  note "error: $*"
  exit 1
}

# found KIND FILE: whether the file is on this machine. It looks for the file itself, without a package manager: that
# takes milliseconds and works on every distribution.
found() {
  local folder
  case $1 in
    command)
      PATH=$PATH:/usr/sbin:/sbin command -v "$2" >/dev/null  # where Debian has daemons
      return
      ;;
    python)
      python3 -c "import importlib.util, sys; sys.exit(importlib.util.find_spec('$2') is None)" 2>/dev/null
      return
      ;;
    header) set -- "$2" /usr/include /usr/local/include "${triplet_include[@]}" "${extra_include[@]}" ;;
    library) set -- "$2" /usr/lib /usr/lib64 /usr/local/lib "${triplet_library[@]}" "${extra_library[@]}" ;;
    *) die "scripts/packages.txt: unknown kind '$1'" ;;
  esac
  local file=$1
  shift
  for folder; do
    [[ -e $folder/$file ]] && return
  done
  return 1
}

# Folders to search besides the usual ones: Debian's per architecture, and those in the variables that CMake and the
# compiler read.
search_paths() {
  local IFS=':' prefix
  triplet_include=("/usr/include/$HOSTTYPE-linux-gnu")
  triplet_library=("/usr/lib/$HOSTTYPE-linux-gnu")
  extra_include=(${CPATH:-})
  extra_library=(${LIBRARY_PATH:-} ${LD_LIBRARY_PATH:-})
  for prefix in ${CMAKE_PREFIX_PATH:-}; do
    extra_include+=("$prefix/include")
    extra_library+=("$prefix/lib" "$prefix/lib64")
  done
}

# missing_packages STAGES: fills `missing` with "package (file)" and `packages` with the names.
missing_packages() {
  local stage kind file package
  missing=() packages=()
  search_paths
  while read -r stage kind file package; do
    [[ $stage == "#"* || -z $stage || " $1 " != *" $stage "* ]] && continue
    found "$kind" "$file" && continue
    missing+=("$package ($file)")
    packages+=("$package")
  done <"$root/scripts/packages.txt"
}

# ensure_packages STAGES (such as "run test"): installs what is missing, if this system has apt.
ensure_packages() {
  missing_packages "$1"
  ((${#packages[@]} == 0)) && return
  if ! command -v apt-get >/dev/null; then
    note "Not found on this system (Debian's package names; the file looked for in brackets):"
    printf '  %s\n' "${missing[@]}" >&2
    die "install these, or build by hand with CMake if they lie where this script does not look"
  fi
  local as_root=() log="$root/build/packages.log"
  if ((EUID != 0)); then
    command -v sudo >/dev/null || die "packages are missing; run as root: apt-get install ${packages[*]}"
    as_root=(sudo)
  fi
  note "Installing ${packages[*]}"
  mkdir -p "$root/build"
  "${as_root[@]}" apt-get -q update >"$log" 2>&1 || note "apt-get update failed; going on with the lists at hand"
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 install --yes \
    --no-install-recommends "${packages[@]}" >>"$log" 2>&1 </dev/null; then
    tail -n 20 "$log" >&2
    die "apt-get could not install the packages; the whole log is in $log"
  fi
  hash -r
  missing_packages "$1"
  ((${#packages[@]} == 0)) || die "still not found after installing: ${missing[*]}$(other_python)"
}

# What to do if a module is still missing since apt installs for the system's Python and PATH has another one first.
other_python() {
  local python package
  python=$(command -v python3) || return 0
  [[ $python == /usr/bin/python3 ]] && return
  for package in "${packages[@]}"; do
    [[ $package == python3-* ]] || continue
    printf '; apt installs for another Python than %s: %s -m pip install %s' "$python" "$python" "${package#python3-}"
  done
}

# ensure_peers: installs the npm packages that bench/peers measures into build/peers, in the versions of its lock file.
# No script of a package is run. It ends the program if npm fails.
ensure_peers() {
  local from=$root/bench/peers folder=$root/build/peers file
  cmp -s "$from/package-lock.json" "$folder/installed.json" && return
  command -v npm >/dev/null || die "npm is not there; bench/peers needs it to install the renderers that it measures"
  build_lock
  if cmp -s "$from/package-lock.json" "$folder/installed.json"; then  # another run has just done so
    build_unlock
    return
  fi
  note "Installing the packages of bench/peers"
  mkdir -p "$folder"
  rm -f "$folder/installed.json"
  for file in package.json package-lock.json; do cp "$from/$file" "$folder/$file"; done
  if ! npm --prefix "$folder" ci --ignore-scripts --no-audit --no-fund >"$folder/npm.log" 2>&1 </dev/null; then
    tail -n 20 "$folder/npm.log" >&2
    die "npm could not install the packages of bench/peers; the whole log is in $folder/npm.log"
  fi
  cp "$from/package-lock.json" "$folder/installed.json"
  build_unlock
}

# free_kib [FOLDER OF THE CGROUP]: the memory that is free on this machine, or in this container if that is less.
free_kib() {
  local group=${1:-/sys/fs/cgroup} kib limit left
  kib=$(awk '$1 == "MemAvailable:" { print $2 }' /proc/meminfo)
  kib=${kib:-2000000}
  limit=$(cat "$group/memory.max" 2>/dev/null) || limit=max
  if [[ $limit != max ]]; then
    # The files that it has read count as used, but make room.
    left=$(awk -v left="$limit" 'NF == 1 { left -= $1 } $1 == "inactive_file" { left += $2 }
      END { printf "%d", left / 1024 }' "$group/memory.current" "$group/memory.stat")
    ((left < kib)) && kib=$left
  fi
  echo "$kib"
}

# A compiler process takes up to 1.5 GiB on this code: as many jobs as the cores and the free memory allow.
build_jobs() {
  local cores jobs
  cores=$(nproc)
  jobs=$(($(free_kib) / 1572864))
  ((jobs > cores)) && jobs=$cores
  ((jobs < 1)) && jobs=1
  echo "$jobs"
}

# Only one build at a time in this checkout: ninja does not lock its folder. Held until build_unlock or the end.
build_lock() {
  mkdir -p "$root/build"
  exec 9>"$root/build/.lock"
  flock --nonblock 9 && return
  note "Waiting for another build of this checkout"
  flock 9
}
build_unlock() { exec 9>&-; }

# A build folder is configured again only if the presets have changed or the checkout has moved; ninja itself notices
# all other changes.
configured() {
  local folder=$1
  [[ -f $folder/build.ninja && ! $root/CMakePresets.json -nt $folder/build.ninja ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"
}

# configure PRESET [CMAKE ARGUMENTS]
configure() {
  local preset=$1 folder=$root/build/$1 log=$root/build/$1.configure.log
  shift
  note "Configuring $preset"
  if [[ -f $folder/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    rm -rf "$folder"
  fi
  if ! (cd "$root" && cmake --preset "$preset" "$@") >"$log" 2>&1 9>&-; then
    cat "$log" >&2
    die "CMake could not configure the preset '$preset'"
  fi
}

# report_progress PRESET LOG: prints how far a build is until standard input ends: on a terminal in one line that it
# rewrites, elsewhere every 20 seconds. It waits by `read`, since a `sleep` would run on after its end.
report_progress() {
  local step seconds=20 begin='' end='\n'
  [[ -t 2 ]] && seconds=1 begin='\r' end=''
  while ! read -rt "$seconds" && ((PIPESTATUS[0] > 128)); do
    step=$(grep -so '^\[[0-9]*/[0-9]*\]' "$2" | tail -n 1) || true  # nothing yet
    [[ -z $step ]] || printf "${begin}Building %s %s${end}" "$1" "$step" >&2
  done
}

# build PRESET TARGETS...: prints nothing if there is nothing to do, progress if it takes long, and on failure what
# failed.
build() {
  local preset=$1 log=$root/build/$1.build.log target targets=() building reporter status=0
  shift
  for target; do targets+=(--target "$target"); done
  : >"$log"
  # The reporter reads a pipe that is closed when the build ends, however it ends.
  exec {building}> >(report_progress "$preset" "$log" 9>&-)
  reporter=$!
  cmake --build "$root/build/$preset" --parallel "$(build_jobs)" "${targets[@]}" >"$log" 2>&1 9>&- {building}>&- ||
    status=$?
  exec {building}>&-
  wait "$reporter" || true
  [[ -t 2 ]] && printf '\r\033[K' >&2
  ((status == 0)) && return
  if grep -q "rebuilding 'build.ninja'" "$log" || ! grep -q '^FAILED:' "$log"; then
    tail -n 40 "$log" >&2
  else
    awk '/^FAILED:/ { failed = 1 } failed' "$log" | head -n 60 >&2
  fi
  die "the build of '$preset' failed; the whole log is in $log"
}

# tests_built PRESET TARGETS...: the preset with its tests, up to date.
tests_built() {
  local preset=$1
  shift
  build_lock
  if ! configured "$root/build/$preset" || grep -qx 'PENUMBRA_TESTS:BOOL=OFF' "$root/build/$preset/CMakeCache.txt"; then
    configure "$preset" -DPENUMBRA_TESTS=ON
  fi
  build "$preset" "$@"
  build_unlock
}
