# cmake --install: the program with its data, and the library (core, gl, shadow) as the CMake package "penumbra", whose
# target penumbra::shadow brings the rest. Nothing that is installed names a path of the building machine.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/penumbra")
set(header_dir "${CMAKE_INSTALL_INCLUDEDIR}/penumbra")

install(TARGETS penumbra_core penumbra_gl penumbra_shadow EXPORT penumbra
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
# What an engine may include; the other headers are the library's own.
set(public_headers
  core/error.h core/log.h core/names.h core/params.h
  gl/buffer.h gl/context.h gl/debug.h gl/device.h gl/handle.h gl/pass.h gl/pass_desc.h gl/program.h
  gl/shader_library.h gl/shader_source.h
  gl/texture.h gl/timer.h
  shadow/cascades.h shadow/denoise_context.h shadow/denoiser.h shadow/filter.h shadow/inputs.h shadow/lamp_maps.h
  shadow/light_frame.h
  shadow/light_projection.h shadow/pass_context.h shadow/recipe.h shadow/registry.h shadow/soft_shadows.h
  shadow/technique.h shadow/volume.h)
foreach(header IN LISTS public_headers)
  get_filename_component(layer "${header}" DIRECTORY)
  install(FILES "${CMAKE_SOURCE_DIR}/src/${header}" DESTINATION "${header_dir}/${layer}")
endforeach()
install(FILES "${PENUMBRA_GL_API_HEADER}" DESTINATION "${header_dir}/gl")

install(EXPORT penumbra NAMESPACE penumbra:: FILE penumbraTargets.cmake DESTINATION "${package_dir}")
configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/penumbraConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/penumbraConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/penumbraConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/penumbraConfig.cmake" "${CMAKE_BINARY_DIR}/penumbraConfigVersion.cmake"
  DESTINATION "${package_dir}")

install(FILES "${CMAKE_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
install(DIRECTORY "${CMAKE_SOURCE_DIR}/glsl" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
if(PENUMBRA_APP)
  install(TARGETS penumbra RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/scenes" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra"
    FILES_MATCHING PATTERN "*.glb" PATTERN "*.gltf")
endif()
