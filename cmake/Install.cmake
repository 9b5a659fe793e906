# cmake --install: the program with its data, and the library (core, gl, shadow) as the package "penumbra" of CMake, whose
# target penumbra::shadow brings the rest, and of pkg-config. Nothing that is installed names a path of the building
# machine.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/penumbra")
set(header_dir "${CMAKE_INSTALL_INCLUDEDIR}/penumbra")

install(TARGETS penumbra_core penumbra_gl penumbra_shadow EXPORT penumbra
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
foreach(header IN LISTS penumbra_public_headers)
  get_filename_component(layer "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/src/${header}" DESTINATION "${header_dir}/${layer}")
endforeach()
install(FILES "${PENUMBRA_GL_API_HEADER}" DESTINATION "${header_dir}/gl")

install(EXPORT penumbra NAMESPACE penumbra:: FILE penumbraTargets.cmake DESTINATION "${package_dir}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/penumbraConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/penumbraConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/penumbraConfig.cmake" "${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake"
  DESTINATION "${package_dir}")

# The same for builds that use pkg-config.
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH pc_prefix "/${pkgconfig_dir}" "/")
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
list(TRANSFORM CMAKE_DL_LIBS PREPEND "-l")
configure_file("${PROJECT_SOURCE_DIR}/cmake/penumbra.pc.in" "${PROJECT_BINARY_DIR}/penumbra.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/penumbra.pc" DESTINATION "${pkgconfig_dir}")

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/glsl" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
if(PENUMBRA_APP)
  install(TARGETS penumbra RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenes" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra"
    FILES_MATCHING PATTERN "*.glb" PATTERN "*.gltf")
endif()
