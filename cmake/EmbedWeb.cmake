# penumbra_embed_web(TARGET): the styles and the script of src/report/web become C++ data in TARGET, which
# report::page_css() and page_js() read.
function(penumbra_embed_web target)
  set(folder "${PROJECT_SOURCE_DIR}/src/report/web")
  set(output "${PROJECT_BINARY_DIR}/generated/web_files.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed_web_files.cmake")
  set(files "${folder}/page.css" "${folder}/pictures.css" "${folder}/figures.css" "${folder}/page.js")
  add_custom_command(OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DFOLDER=${folder}" "-DOUTPUT=${output}" -P "${script}"
    DEPENDS ${files} "${script}"
    COMMENT "Embedding src/report/web/"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
