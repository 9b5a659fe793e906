# Warnings, sanitizers and include root, shared by every target of the project. -Wrestrict, -Wstringop-overflow and
# -Warray-bounds are off: GCC 12 gives false warnings for "text" + std::string (GCC bug 105651), more of them with
# precompiled headers of the standard library. The sanitizers find the same faults.
add_library(penumbra_options INTERFACE)
target_compile_options(penumbra_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  -Woverloaded-virtual -Wno-missing-field-initializers -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds
  $<$<BOOL:${PENUMBRA_WERROR}>:-Werror>)
# The same command must give the same picture, so expressions are not contracted into fused multiply-adds, which not
# every machine has.
target_compile_options(penumbra_options INTERFACE -ffp-contract=off)
# The same source must give the same program, so it may not contain paths of the building machine.
target_compile_options(penumbra_options INTERFACE "-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=")
if(PENUMBRA_SANITIZE)
  # GCC's manual says that with sanitizers -Wmaybe-uninitialized gives false warnings; GCC 12 does for <regex>.
  target_compile_options(penumbra_options INTERFACE -fsanitize=${PENUMBRA_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -Wno-maybe-uninitialized)
  target_link_options(penumbra_options INTERFACE -fsanitize=${PENUMBRA_SANITIZE})
endif()

# penumbra_join_command_lines(TARGET sources...): compiles the sources that declare a command line six at a time, as one
# file that includes them. Each would compile most of CLI11 for itself: five of them together take 40 % of the time of
# five alone. With -O1 it is a third less again; they run once per command, and other files do the work.
function(penumbra_join_command_lines target)
  set(joined)
  foreach(source IN LISTS ARGN)
    file(STRINGS "${source}" command_line REGEX "^#include <CLI/CLI\\.hpp>" LIMIT_COUNT 1)
    if(command_line)
      list(APPEND joined "${source}")
    endif()
  endforeach()
  set_source_files_properties(${joined} PROPERTIES HEADER_FILE_ONLY ON)
  set(number 0)
  while(joined)
    list(SUBLIST joined 0 6 sources)
    list(REMOVE_ITEM joined ${sources})
    set(text "")
    foreach(source IN LISTS sources)
      file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}/src" "${source}")
      string(APPEND text "#include \"${name}\"\n")
    endforeach()
    math(EXPR number "${number} + 1")
    set(file "${PROJECT_BINARY_DIR}/generated/${target}_command_lines_${number}.cpp")
    file(CONFIGURE OUTPUT "${file}" CONTENT "${text}")
    set_source_files_properties("${file}" PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O1>")
    target_sources(${target} PRIVATE "${file}")
  endwhile()
endfunction()

# penumbra_layer(NAME LINK targets... PRIVATE targets...): src/NAME and all below it as the static library
# penumbra_NAME. Sources are globbed so that adding a technique or a filter touches no build file. main.cpp is the
# program's, not the layer's, and src/NAME/module holds modules: see penumbra_module().
function(penumbra_layer name)
  cmake_parse_arguments(arg "" "" "LINK;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${name}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$|/module/")
  add_library(penumbra_${name} STATIC ${sources})
  set_target_properties(penumbra_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(penumbra_${name} PUBLIC cxx_std_20)
  target_include_directories(penumbra_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                     PRIVATE ${PROJECT_SOURCE_DIR}/glsl)
  target_link_libraries(penumbra_${name} PUBLIC ${arg_LINK} PRIVATE $<BUILD_INTERFACE:penumbra_options> ${arg_PRIVATE})
  penumbra_precompile(penumbra_${name} library)
  penumbra_join_command_lines(penumbra_${name} ${sources})
endfunction()

# penumbra_module(LAYER NAME LINK targets...): src/LAYER/module/NAME.cpp as the shared library penumbra_NAME.so, which the
# layer loads when it is first needed, from the folder of the program or from where it is installed.
function(penumbra_module layer name)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  set(target penumbra_${name})
  add_library(${target} MODULE "${PROJECT_SOURCE_DIR}/src/${layer}/module/${name}.cpp")
  set_target_properties(${target} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${target} PRIVATE penumbra_options ${arg_LINK})
  penumbra_precompile(${target} library)
  add_dependencies(penumbra_${layer} ${target})
  file(RELATIVE_PATH folder "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}/penumbra")
  target_compile_definitions(penumbra_${layer} PRIVATE "PENUMBRA_MODULE_FOLDER=\"${folder}\"")
  if(PENUMBRA_INSTALL)
    install(TARGETS ${target} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/penumbra" COMPONENT program)
  endif()
endfunction()
