# penumbra_embed_noise(TARGET): the tiles of src/shadow/noise become C++ data in TARGET, which
# shadow::built_in_noise() and built_in_sample_keys() read. "penumbra bake" makes them.
function(penumbra_embed_noise target)
  set(folder "${PROJECT_SOURCE_DIR}/src/shadow/noise")
  set(output "${PROJECT_BINARY_DIR}/generated/noise_tiles.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed_noise_tiles.cmake")
  set(tiles "")
  foreach(tile IN ITEMS blue void_and_cluster spatiotemporal sample_keys)
    list(APPEND tiles "${folder}/${tile}.u16")
  endforeach()
  add_custom_command(OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DFOLDER=${folder}" "-DOUTPUT=${output}" -P "${script}"
    DEPENDS ${tiles} "${script}"
    COMMENT "Embedding noise"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
