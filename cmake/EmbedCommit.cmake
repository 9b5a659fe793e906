# penumbra_embed_commit(TARGET): bench::commit() returns the commit that was built. Every build looks it up,
# since no file of the build changes with it, and compiles it only if it differs.
find_package(Git QUIET)

function(penumbra_embed_commit target)
  set(output "${PROJECT_BINARY_DIR}/generated/commit.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake")
  add_custom_target(penumbra_commit
    COMMAND "${CMAKE_COMMAND}" "-DGIT=${GIT_EXECUTABLE}" "-DROOT=${PROJECT_SOURCE_DIR}" "-DOUTPUT=${output}"
            -P "${script}"
    BYPRODUCTS "${output}"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
  add_dependencies(${target} penumbra_commit)
endfunction()
