# libpenumbra: the layers core, gl, shadow and capi as one library. The shared one exports the C interface alone, by a
# version script; the static one has all of it, for programs that extend the library too.
set(library_objects $<TARGET_OBJECTS:penumbra_core> $<TARGET_OBJECTS:penumbra_gl> $<TARGET_OBJECTS:penumbra_shadow>
  $<TARGET_OBJECTS:penumbra_capi>)
set(version_script "${PROJECT_SOURCE_DIR}/cmake/penumbra.map")

add_library(penumbra_shared SHARED ${library_objects})
target_link_options(penumbra_shared PRIVATE "LINKER:--version-script=${version_script}" "LINKER:--no-undefined-version")
target_link_libraries(penumbra_shared PRIVATE $<BUILD_INTERFACE:penumbra_options> $<BUILD_INTERFACE:fmt::fmt>
  ${CMAKE_DL_LIBS})
set_target_properties(penumbra_shared PROPERTIES EXPORT_NAME penumbra VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}" LINK_DEPENDS "${version_script}")

# The parameters as fields of C++, from their rows, by a program that is built like the library.
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(FATAL_ERROR "penumbra: the build runs a program that it has compiled for ${CMAKE_SYSTEM_PROCESSOR}: set "
    "CMAKE_CROSSCOMPILING_EMULATOR to one that runs such programs, as qemu-user does; or to env if this machine can.")
endif()
set(typed_settings "${PROJECT_BINARY_DIR}/include/penumbra/penumbra_settings.hpp")
add_executable(penumbra_typed_settings EXCLUDE_FROM_ALL "${PROJECT_SOURCE_DIR}/src/capi/typed/main.cpp")
target_link_libraries(penumbra_typed_settings PRIVATE penumbra_options penumbra_capi)
add_custom_command(OUTPUT "${typed_settings}" COMMAND penumbra_typed_settings "${typed_settings}"
  DEPENDS penumbra_typed_settings
  COMMENT "Generating penumbra_settings.hpp" VERBATIM)
add_custom_target(penumbra_settings_header DEPENDS "${typed_settings}")

add_library(penumbra_static STATIC ${library_objects})
target_link_libraries(penumbra_static PRIVATE $<BUILD_INTERFACE:penumbra_options> fmt::fmt ${CMAKE_DL_LIBS})
set_target_properties(penumbra_static PROPERTIES EXPORT_NAME static)

# What a program needs that uses the C++ of the layers, with the same #include lines as the installed package.
add_library(penumbra_extending INTERFACE)
target_link_libraries(penumbra_extending INTERFACE penumbra_static fmt::fmt glm::glm)
set_target_properties(penumbra_extending PROPERTIES EXPORT_NAME shadow)

foreach(library penumbra_shared penumbra_static)
  target_compile_features(${library} INTERFACE cxx_std_20) # for penumbra.hpp; it changes nothing for sources in C
  add_dependencies(${library} penumbra_settings_header)
  set_target_properties(${library} PROPERTIES OUTPUT_NAME penumbra LINKER_LANGUAGE CXX)
  target_include_directories(${library} INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
  if(NOT PROJECT_IS_TOP_LEVEL AND NOT PENUMBRA_INSTALL)
    set_target_properties(${library} PROPERTIES EXCLUDE_FROM_ALL ON) # built if the project links it
  endif()
endforeach()
