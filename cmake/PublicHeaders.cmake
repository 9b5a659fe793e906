# What an engine may include; the other headers are the library's own. As <penumbra/FOLDER/NAME.h>.
set(penumbra_public_headers
  core/error.h core/log.h core/names.h core/params.h
  gl/buffer.h gl/context.h gl/debug.h gl/device.h gl/handle.h gl/pass.h gl/pass_desc.h gl/program.h
  gl/shader_library.h gl/shader_source.h
  gl/texture.h gl/timer.h
  shadow/cascades.h shadow/denoise_context.h shadow/denoiser.h shadow/filter.h shadow/inputs.h shadow/lamp_maps.h
  shadow/light_frame.h
  shadow/light_projection.h shadow/pass_context.h shadow/recipe.h shadow/registry.h shadow/soft_shadows.h
  shadow/technique.h shadow/volume.h)
