# Compiles through ccache if it is installed.
find_program(PENUMBRA_CCACHE ccache)
mark_as_advanced(PENUMBRA_CCACHE)
if(PENUMBRA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    sh "${CMAKE_CURRENT_LIST_DIR}/compile_cached.sh" "${PROJECT_SOURCE_DIR}" "${PENUMBRA_CCACHE}")
endif()
