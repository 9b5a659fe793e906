# Run by the target bench-bundle: makes the folder BUNDLE with all that a bare server needs, and BUNDLE.tar.gz.
file(REMOVE_RECURSE "${BUNDLE}" "${BUNDLE}.tar.gz")
file(MAKE_DIRECTORY "${BUNDLE}/scenes")
file(GLOB scenes "${ROOT}/scenes/*.glb")
file(COPY ${scenes} DESTINATION "${BUNDLE}/scenes")
file(COPY "${ROOT}/LICENSE" DESTINATION "${BUNDLE}")
configure_file("${ROOT}/bench/bundle_README.txt" "${BUNDLE}/README.txt" COPYONLY)
get_filename_component(name "${PROGRAM}" NAME)
execute_process(COMMAND "${STRIP}" -o "${BUNDLE}/${name}" "${PROGRAM}" COMMAND_ERROR_IS_FATAL ANY)
get_filename_component(parent "${BUNDLE}" DIRECTORY)
get_filename_component(folder "${BUNDLE}" NAME)
execute_process(COMMAND "${CMAKE_COMMAND}" -E tar czf "${folder}.tar.gz" "${folder}" WORKING_DIRECTORY "${parent}"
  COMMAND_ERROR_IS_FATAL ANY)
