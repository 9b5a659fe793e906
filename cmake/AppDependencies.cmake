# Libraries of the layers that only the program needs.

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
penumbra_dependency(zlib HEADER zlib.h LIBRARIES z)
penumbra_dependency(json HEADER nlohmann/json.hpp)
penumbra_dependency(cli11 HEADER CLI/CLI.hpp)

# The viewer. Debian's ImGui has its GLFW and OpenGL 3 backends built in.
if(PENUMBRA_VIEWER)
  penumbra_dependency(glfw HEADER GLFW/glfw3.h LIBRARIES glfw)
  penumbra_dependency(imgui HEADER imgui/imgui.h LIBRARIES imgui libstb.a)
  target_include_directories(penumbra::imgui SYSTEM INTERFACE "${PENUMBRA_imgui_INCLUDE}/imgui")
  target_link_libraries(penumbra::imgui INTERFACE penumbra::glfw)
endif()
