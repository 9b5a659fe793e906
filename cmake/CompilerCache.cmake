# Compiles through ccache if it is installed. CCACHE_BASEDIR makes a second checkout of the same code hit the cache; without
# CCACHE_SLOPPINESS ccache does not cache files that use a precompiled header.
find_program(PENUMBRA_CCACHE ccache)
mark_as_advanced(PENUMBRA_CCACHE)
if(PENUMBRA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_SLOPPINESS=pch_defines,time_macros "${PENUMBRA_CCACHE}")
endif()
