# What an engine may include; the other headers are the library's own. In the build folder they lie as they are
# installed, below include/penumbra.

# The interface for engines, as <penumbra/NAME>.
set(penumbra_interface_headers penumbra.h penumbra.hpp penumbra_glm.hpp)

# For engines that add techniques of their own, as <penumbra/FOLDER/NAME.h>: C++ of the static library.
set(penumbra_public_headers
  core/error.h core/log.h core/names.h core/params.h
  gl/buffer.h gl/context.h gl/debug.h gl/device.h gl/handle.h gl/pass.h gl/pass_desc.h gl/program.h
  gl/shader_library.h gl/shader_source.h
  gl/texture.h gl/timer.h
  shadow/cascades.h shadow/denoise_context.h shadow/denoiser.h shadow/depth_precision.h shadow/filter.h shadow/inputs.h
  shadow/lamp_maps.h
  shadow/light_frame.h shadow/light_matrices.h
  shadow/light_projection.h shadow/pass_context.h shadow/recipe.h shadow/registry.h shadow/soft_shadows.h
  shadow/technique.h shadow/volume.h)

set(include_dir "${PROJECT_BINARY_DIR}/include")
foreach(header IN LISTS penumbra_public_headers)
  get_filename_component(folder "${header}" DIRECTORY)
  file(MAKE_DIRECTORY "${include_dir}/penumbra/${folder}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/src/${header}" "${include_dir}/penumbra/${header}" COPY_ON_ERROR SYMBOLIC)
endforeach()
file(CREATE_LINK "${PENUMBRA_GL_API_HEADER}" "${include_dir}/penumbra/gl/api.h" COPY_ON_ERROR SYMBOLIC)
foreach(header IN LISTS penumbra_interface_headers)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/src/capi/${header}" "${include_dir}/penumbra/${header}" COPY_ON_ERROR SYMBOLIC)
endforeach()
