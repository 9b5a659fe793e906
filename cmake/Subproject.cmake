# penumbra::shadow for the project that this one is a folder of: the same name and the same #include lines as those of
# the installed package, and no other folder of Penumbra's among the include folders.
set(include_dir "${PROJECT_BINARY_DIR}/include")
foreach(header IN LISTS penumbra_public_headers)
  get_filename_component(folder "${header}" DIRECTORY)
  file(MAKE_DIRECTORY "${include_dir}/penumbra/${folder}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/src/${header}" "${include_dir}/penumbra/${header}" COPY_ON_ERROR SYMBOLIC)
endforeach()
file(CREATE_LINK "${PENUMBRA_GL_API_HEADER}" "${include_dir}/penumbra/gl/api.h" COPY_ON_ERROR SYMBOLIC)

add_library(penumbra_subproject INTERFACE)
target_include_directories(penumbra_subproject INTERFACE "${include_dir}")
target_link_libraries(penumbra_subproject INTERFACE $<LINK_ONLY:penumbra_shadow> fmt::fmt glm::glm)
target_compile_features(penumbra_subproject INTERFACE cxx_std_20)
add_library(penumbra::shadow ALIAS penumbra_subproject)
