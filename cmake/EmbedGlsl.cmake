# penumbra_embed_glsl(TARGET): every file under glsl/ becomes C++ data in TARGET, which gl::ShaderFiles reads by its name
# relative to glsl/. glsl/ is also an include folder: C++ reads the headers in glsl/shared and the functions in glsl/lib.
function(penumbra_embed_glsl target)
  set(root "${PROJECT_SOURCE_DIR}/glsl")
  file(GLOB_RECURSE names CONFIGURE_DEPENDS RELATIVE "${root}" "${root}/*")
  list(FILTER names INCLUDE REGEX "\\.(glsl|vert|frag|comp|geom|h)$")
  list(SORT names)
  list(TRANSFORM names PREPEND "${root}/" OUTPUT_VARIABLE paths)

  set(list_file "${PROJECT_BINARY_DIR}/generated/glsl_files.txt")
  set(output "${PROJECT_BINARY_DIR}/generated/glsl_files.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed_glsl_files.cmake")
  file(CONFIGURE OUTPUT "${list_file}" CONTENT "${names}" @ONLY)
  add_custom_command(OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${root}" "-DLIST=${list_file}" "-DOUTPUT=${output}" -P "${script}"
    DEPENDS ${paths} "${list_file}" "${script}"
    COMMENT "Embedding glsl/"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${root}>)
endfunction()
