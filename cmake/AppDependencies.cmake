# Libraries of the layers above gl, as penumbra::NAME. Found by header and library file, not by the packages' own CMake
# files: Debian's for OpenImageIO names an include folder that only exists with OpenCV installed. Imported targets count
# as system headers: their warnings are off.

# penumbra_dependency(NAME HEADER file [LIBRARIES names...]): each name one library file to link.
function(penumbra_dependency name)
  cmake_parse_arguments(arg "" "HEADER" "LIBRARIES" ${ARGN})
  find_path(PENUMBRA_${name}_INCLUDE ${arg_HEADER})
  if(NOT PENUMBRA_${name}_INCLUDE)
    message(FATAL_ERROR "${name}: header ${arg_HEADER} not found; install it (run.sh lists the packages)")
  endif()
  add_library(penumbra::${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(penumbra::${name} SYSTEM INTERFACE "${PENUMBRA_${name}_INCLUDE}")
  foreach(library IN LISTS arg_LIBRARIES)
    find_library(PENUMBRA_${name}_${library} ${library})
    if(NOT PENUMBRA_${name}_${library})
      message(FATAL_ERROR "${name}: library ${library} not found; install it (run.sh lists the packages)")
    endif()
    target_link_libraries(penumbra::${name} INTERFACE "${PENUMBRA_${name}_${library}}")
  endforeach()
  mark_as_advanced(PENUMBRA_${name}_INCLUDE)
endfunction()

# The layer scene compiles it from its header, without the parts that open files and decode images: see ImageDecoder.
penumbra_dependency(tinygltf HEADER tiny_gltf.h)
target_compile_definitions(penumbra::tinygltf INTERFACE TINYGLTF_NO_FS TINYGLTF_NO_STB_IMAGE
  TINYGLTF_NO_STB_IMAGE_WRITE TINYGLTF_NO_INCLUDE_JSON)
penumbra_dependency(draco HEADER draco/compression/decode.h LIBRARIES libdraco.a)  # static: penumbra-bench contains it
penumbra_dependency(meshoptimizer HEADER meshoptimizer.h)                           # loaded when a file needs it
penumbra_dependency(embree HEADER embree3/rtcore.h LIBRARIES embree3)
penumbra_dependency(xxhash HEADER xxhash.h)
penumbra_dependency(openimageio HEADER OpenImageIO/imageio.h LIBRARIES OpenImageIO OpenImageIO_Util)
penumbra_dependency(png HEADER png.h LIBRARIES png)
penumbra_dependency(toml HEADER toml++/toml.h)
penumbra_dependency(json HEADER nlohmann/json.hpp)
penumbra_dependency(cli11 HEADER CLI/CLI.hpp)

# The viewer. Debian's ImGui has its GLFW and OpenGL 3 backends built in.
if(PENUMBRA_VIEWER)
  penumbra_dependency(glfw HEADER GLFW/glfw3.h LIBRARIES glfw)
  penumbra_dependency(imgui HEADER imgui/imgui.h LIBRARIES imgui libstb.a)
  target_include_directories(penumbra::imgui SYSTEM INTERFACE "${PENUMBRA_imgui_INCLUDE}/imgui")
  target_link_libraries(penumbra::imgui INTERFACE penumbra::glfw)
endif()
