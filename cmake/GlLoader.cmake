# penumbra_gl_loader(TARGET): generates api.h and api.cpp, the entry points of OpenGL 4.5 core, from the system's
# GL/glcorearb.h at configure time and adds them to TARGET. PENUMBRA_GL_API_HEADER is the header to install.
find_package(Python3 3.8 REQUIRED COMPONENTS Interpreter)
find_path(PENUMBRA_GLCOREARB_INCLUDE GL/glcorearb.h)
mark_as_advanced(PENUMBRA_GLCOREARB_INCLUDE)
if(NOT PENUMBRA_GLCOREARB_INCLUDE)
  message(FATAL_ERROR "GL/glcorearb.h not found; install it (Debian: libgl-dev)")
endif()

set(PENUMBRA_GL_API_DIR "${PROJECT_BINARY_DIR}/generated/gl")
set(PENUMBRA_GL_API_HEADER "${PENUMBRA_GL_API_DIR}/api.h")

function(penumbra_gl_loader target)
  set(generator "${PROJECT_SOURCE_DIR}/cmake/generate_gl_api.py")
  set(header "${PENUMBRA_GLCOREARB_INCLUDE}/GL/glcorearb.h")
  set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${generator}" "${header}")
  execute_process(COMMAND "${Python3_EXECUTABLE}" "${generator}" "${header}" "${PENUMBRA_GL_API_DIR}"
    COMMAND_ERROR_IS_FATAL ANY)
  target_sources(${target} PRIVATE "${PENUMBRA_GL_API_DIR}/api.cpp")
  # As "gl/api.h" from the include root, and as "api.h" beside it from the headers of src/gl.
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated> $<BUILD_INTERFACE:${PENUMBRA_GL_API_DIR}>)
endfunction()
