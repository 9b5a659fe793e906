# cpack -G DEB: packages for Debian, one for each component that Install.cmake names. What the binaries link is found by
# dpkg-shlibdeps; what they load by name is listed here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "Penumbra contributors")
set(CPACK_PACKAGE_CONTACT "Penumbra contributors <maintainers@penumbra.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(files "${PROJECT_BINARY_DIR}/packages")
set(runtime_package "libpenumbra${PROJECT_VERSION_MAJOR}")

# penumbra_package(COMPONENT NAME SECTION section SUMMARY text DESCRIPTION lines... DEPENDS packages... RECOMMENDS packages...
# LIBRARIES): what a component's package is called and says, with its copyright and its changelog. LIBRARIES: it has files
# whose libraries dpkg-shlibdeps looks up.
set(packages)
function(penumbra_package component name)
  cmake_parse_arguments(arg "LIBRARIES" "SECTION;SUMMARY" "DESCRIPTION;DEPENDS;RECOMMENDS" ${ARGN})
  string(TOUPPER "${component}" key)
  list(JOIN arg_DESCRIPTION "\n" description)
  list(JOIN arg_DEPENDS ", " depends)
  list(JOIN arg_RECOMMENDS ", " recommends)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME "${name}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION "${arg_SECTION}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${recommends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS "${arg_LIBRARIES}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${arg_SUMMARY}\n${description}" PARENT_SCOPE)
  install(FILES "${files}/copyright" "${files}/changelog.Debian"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}" COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" RENAME changelog
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}" COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(packages ${packages} ${component} PARENT_SCOPE)
endfunction()

penumbra_package(runtime ${runtime_package}
  SECTION libs LIBRARIES
  SUMMARY "soft shadows for OpenGL engines - shared library"
  DESCRIPTION "Penumbra draws masks of soft shadows with an engine's own OpenGL 4.5"
    "context, depth buffer and draw calls. This package has the shared library"
    "with its C interface.")
penumbra_package(development libpenumbra-dev
  SECTION libdevel
  SUMMARY "soft shadows for OpenGL engines - development files"
  DESCRIPTION "Penumbra draws masks of soft shadows with an engine's own OpenGL 4.5"
    "context, depth buffer and draw calls. This package has the headers for C and"
    "C++, their reference, the static library, files for CMake and pkg-config,"
    "shaders and examples."
  DEPENDS "${runtime_package} (= ${PROJECT_VERSION}-1)" libfmt-dev libgl-dev libglm-dev)
if(PENUMBRA_APP)
  penumbra_package(program penumbra
    SECTION graphics LIBRARIES
    SUMMARY "renderer and workbench of soft shadows"
    DESCRIPTION "Penumbra draws the soft shadows of glTF scenes with OpenGL 4.5, in a window"
    "or without a display, measures their cost, and compares techniques with each"
    "other and with ray-traced truth."
    DEPENDS libegl1 libgl1-mesa-dri
    RECOMMENDS libosmesa6 libmeshoptimizer2d)
endif()
if(TARGET penumbra_python)
  get_property(python_version TARGET penumbra_python PROPERTY PYTHON_VERSION)
  penumbra_package(python python3-penumbra
    SECTION python LIBRARIES
    SUMMARY "soft shadows of glTF scenes as NumPy arrays"
    DESCRIPTION "Penumbra draws the soft shadows of glTF scenes, and ray traces their truth."
    "This package has its Python module, which gives both as arrays, without a"
    "display, and measures how far they differ."
    DEPENDS "python3 (>= ${python_version})" "python3 (<< ${python_version}.99)" python3-numpy libegl1 libgl1-mesa-dri
    RECOMMENDS penumbra)
endif()
set(CPACK_COMPONENTS_ALL ${packages})

# Copyright in Debian's format.
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" license)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)" line "${license}")
set(copyright "${CMAKE_MATCH_1}")
string(REGEX REPLACE "^.*Copyright[^\n]*\n+" "" license "${license}")
string(STRIP "${license}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
file(CONFIGURE OUTPUT "${files}/copyright" CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Penumbra

Files: *
Copyright: @copyright@
License: Expat
 @license@

Files: html/*.js
Copyright: 1997-2020 Dimitri van Heesch
 OpenJS Foundation and other contributors
License: Expat
" @ONLY)

# What the runtime package tells the system: that it has a library, and which package provides it.
file(WRITE "${files}/triggers" "activate-noawait ldconfig\n")
file(WRITE "${files}/shlibs" "libpenumbra ${PROJECT_VERSION_MAJOR} ${runtime_package} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${files}/triggers;${files}/shlibs")

# The changelog of the project, and that of the packages, dated by the commit: the same commit gives the same packages.
set(date "")
if(GIT_EXECUTABLE)
  execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${PROJECT_SOURCE_DIR}" log -1 --format=%cD
    OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT date)
  set(date "Thu, 1 Jan 1970 00:00:00 +0000")  # a copy of the sources without their history
endif()
string(REGEX REPLACE "^([A-Z][a-z]+), ([0-9]) " "\\1, 0\\2 " date "${date}")
file(CONFIGURE OUTPUT "${files}/changelog.Debian" CONTENT
"penumbra (@PROJECT_VERSION@-1) unstable; urgency=medium

  * The changes are those of the project's changelog.

 -- @CPACK_PACKAGE_CONTACT@  @date@
" @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/finish_packages.cmake")
include(CPack)
