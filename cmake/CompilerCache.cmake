# Compile through ccache when it is there. CCACHE_BASEDIR makes a second checkout of the same code hit the cache.
find_program(PENUMBRA_CCACHE ccache)
mark_as_advanced(PENUMBRA_CCACHE)
if(PENUMBRA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" "${PENUMBRA_CCACHE}")
endif()
