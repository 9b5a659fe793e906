#!/bin/sh
# Compiles through ccache: compile_cached.sh ROOT CCACHE COMPILER ARGUMENTS...
#
# CCACHE_BASEDIR lets a second checkout hit the cache, if its build folder is as many levels below its root. Without
# CCACHE_SLOPPINESS ccache does not cache files that use a precompiled header. Such a header is 100 MB large, which ccache
# would read for every file that uses it; beside it is its checksum, which ccache reads instead (CCACHE_PCH_EXTSUM).
export CCACHE_BASEDIR="$1" CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1
shift

output= last=
for argument; do
  [ "$last" = -o ] && output=$argument
  last=$argument
done
case $output in
  # An old one would be read while the new one is compiled, and so would be part of the new one's key.
  *.gch) rm -f "$output" "$output.sum" && "$@" && sha256sum <"$output" >"$output.sum" ;;
  *) exec "$@" ;;
esac
