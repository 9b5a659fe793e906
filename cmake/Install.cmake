# cmake --install: the program with its data, and libpenumbra as the packages "penumbra" of CMake and of pkg-config.
# CMake's has the targets penumbra::penumbra, the shared library with the C interface, penumbra::static, the same as a
# static library, and penumbra::shadow, which adds the C++ of the layers, GLM and fmt; pkg-config's has the first two, and
# the package "penumbra-shadow" the third. Nothing that is installed names a path of the building machine.
#
# Components, each a package of Debian's (Packages.cmake): program, runtime, which is the shared library for programs that
# use it, and development.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development) # of what names none
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/penumbra")
set(header_dir "${CMAKE_INSTALL_INCLUDEDIR}/penumbra")

install(TARGETS penumbra_shared EXPORT penumbra
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT development
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS penumbra_static penumbra_extending EXPORT penumbra_static
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
foreach(header IN LISTS penumbra_interface_headers)
  install(FILES "${PROJECT_SOURCE_DIR}/src/capi/${header}" DESTINATION "${header_dir}")
endforeach()
install(FILES "${typed_settings}" DESTINATION "${header_dir}")
foreach(header IN LISTS penumbra_public_headers)
  get_filename_component(layer "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/src/${header}" DESTINATION "${header_dir}/${layer}")
endforeach()
install(FILES "${PENUMBRA_GL_API_HEADER}" DESTINATION "${header_dir}/gl")

install(EXPORT penumbra NAMESPACE penumbra:: FILE penumbraTargets.cmake DESTINATION "${package_dir}")
install(EXPORT penumbra_static NAMESPACE penumbra:: FILE penumbraStaticTargets.cmake DESTINATION "${package_dir}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/penumbraConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/penumbraConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake" COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/penumbraConfig.cmake" "${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake"
  DESTINATION "${package_dir}")

# The same for builds that use pkg-config.
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH pc_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
foreach(dir includedir libdir)
  string(TOUPPER ${dir} DIR)
  set(pc_${dir} "${CMAKE_INSTALL_${DIR}}")
  if(NOT IS_ABSOLUTE "${pc_${dir}}")
    string(PREPEND pc_${dir} "\${prefix}/")
  endif()
endforeach()
list(TRANSFORM CMAKE_DL_LIBS PREPEND "-l" OUTPUT_VARIABLE dl_libraries)
foreach(package penumbra penumbra-shadow)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${package}.pc.in" "${PROJECT_BINARY_DIR}/${package}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${package}.pc" DESTINATION "${pkgconfig_dir}")
endforeach()

# Programs that use the library, as sources.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/glsl" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra")
if(TARGET reference)
  install(DIRECTORY "${PROJECT_BINARY_DIR}/reference/html"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libpenumbra-dev")
endif()
if(PENUMBRA_APP)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
  install(TARGETS penumbra RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenes" DESTINATION "${CMAKE_INSTALL_DATADIR}/penumbra"
    FILES_MATCHING PATTERN "*.glb" PATTERN "*.gltf" PATTERN gen EXCLUDE PATTERN __pycache__ EXCLUDE)
  # The manual page, and what completes command lines.
  set(manual "${PROJECT_BINARY_DIR}/manual")
  install(FILES "${manual}/penumbra.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${manual}/penumbra.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
    RENAME penumbra)
  install(FILES "${manual}/_penumbra" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
endif()
