# The reference of the interface in C and C++ as HTML, in BUILD/reference/html, if Doxygen is there. It is a part of the
# whole build: it takes a second, and is made again when a header has changed.
find_program(PENUMBRA_DOXYGEN doxygen)
mark_as_advanced(PENUMBRA_DOXYGEN)
set(reference_dir "${PROJECT_BINARY_DIR}/reference")
if(PENUMBRA_DOXYGEN)
  list(TRANSFORM penumbra_interface_headers PREPEND "${PROJECT_SOURCE_DIR}/src/capi/" OUTPUT_VARIABLE described)
  list(APPEND described "${typed_settings}" "${PROJECT_SOURCE_DIR}/docs/reference.md")
  add_custom_command(OUTPUT "${reference_dir}/html/index.html"
    COMMAND ${CMAKE_COMMAND} -E rm -rf "${reference_dir}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${reference_dir}"
    COMMAND ${CMAKE_COMMAND} -E copy "${PROJECT_SOURCE_DIR}/docs/reference.md" "${reference_dir}"
    COMMAND "${PENUMBRA_DOXYGEN}" "${PROJECT_SOURCE_DIR}/docs/Doxyfile"
    WORKING_DIRECTORY "${PROJECT_BINARY_DIR}"
    DEPENDS ${described} "${PROJECT_SOURCE_DIR}/docs/Doxyfile"
    COMMENT "Writing the reference" VERBATIM)
  add_custom_target(reference ALL DEPENDS "${reference_dir}/html/index.html")
  add_dependencies(reference penumbra_settings_header)
endif()
