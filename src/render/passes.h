#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "core/params.h"
#include "gl/pass.h"
#include "render/view.h"
#include "scene/gpu_scene.h"
#include "shadow/soft_shadows.h"

namespace penumbra::render {

// The passes of a frame: each a function from named inputs to a named output, in a file of its name.

// What the camera sees, before light.
struct GBuffer {
  const gl::Texture* albedo = nullptr;            // RGB10_A2: square root of linear
  const gl::Texture* normal = nullptr;            // RG16: shading normal, world, octahedral, 0..1
  const gl::Texture* geometric_normal = nullptr;  // RG32F: octahedral, -1..1
  const gl::Texture* material = nullptr;          // RGBA8: metallic, roughness, occlusion, 1 for unlit
  const gl::Texture* emission = nullptr;          // R11F_G11F_B10F: as the file gives it
  const gl::Texture* motion = nullptr;            // RG32F: where it is minus where it was, NDC
  const gl::Texture* depth = nullptr;             // 32F, reversed: 0 is the sky
};

struct GBufferInputs {
  scene::GpuScene& scene;
  const glsl::ViewBlock& view;
};
GBuffer draw_gbuffer(gl::Device& device, const GBufferInputs& inputs);
std::vector<gl::ProgramDesc> gbuffer_programs();

// Which triangle a pixel shows, for techniques that trace rays from it; drawn on demand.
struct SurfaceIdInputs {
  scene::GpuScene& scene;
  const glsl::ViewBlock& view;
};
// RG32UI: 1 + index in PosedGeometry::surfaces (0: sky), and triangle of that surface.
const gl::Texture& draw_surface_ids(gl::Device& device, const SurfaceIdInputs& inputs);
std::vector<gl::ProgramDesc> surface_id_programs();

// What shadow::Inputs::user points to in a frame of this renderer.
struct FrameScene {
  scene::GpuScene& scene;
  const glsl::ViewBlock& view;
  double time;  // seconds
};

struct ShadowMaskInputs {
  shadow::SoftShadows& soft_shadows;
  scene::GpuScene& scene;
  const Camera& camera;
  const Camera& last_camera;
  const glsl::ViewBlock& view;
  int view_id = 0;  // as FrameInputs::view
  double time = 0;
  bool cut = false;  // as FrameInputs::cut
  std::span<const Light> lights;
  const GBuffer& gbuffer;
  const ParamSet& params;
};
// One layer a light, in their order.
shadow::Mask draw_shadow_mask(gl::Device& device, const ShadowMaskInputs& inputs);

struct LightingInputs {
  const GBuffer& gbuffer;
  const shadow::Mask& mask;
  std::span<const Light> lights;  // of the mask's layers
  bool emission_in_nits = true;   // else 1 is white in the sun
  const ParamSet& params;
};
const gl::Texture& light_surfaces(gl::Device& device, const LightingInputs& inputs);  // RGBA16F, linear, exposed
std::vector<gl::ProgramDesc> lighting_programs();

struct BlendedInputs {
  shadow::SoftShadows& soft_shadows;
  scene::GpuScene& scene;
  const Camera& camera;
  const glsl::ViewBlock& view;
  const GBuffer& gbuffer;
  const shadow::Mask& mask;
  const ParamSet& params;
  const gl::Texture& lit;
};
// Over `lit`. Of several lights the first is shadowed on blended surfaces, the others shine on them unhindered.
void draw_blended(gl::Device& device, const BlendedInputs& inputs);
std::vector<gl::ProgramDesc> blended_programs(gl::Device& device, const shadow::SoftShadows& soft_shadows,
                                              const ParamSet& defaults);

struct ExposureInputs {
  const GBuffer& gbuffer;
  const gl::Texture& lit;
  const ParamSet& params;
};
const gl::Buffer& measure_exposure(gl::Device& device, const ExposureInputs& inputs);  // one float: a factor
std::vector<gl::ProgramDesc> exposure_programs();

struct ToneMapInputs {
  const gl::Texture& lit;
  const gl::Buffer& exposure;
};
const gl::Texture& tone_map(gl::Device& device, const ToneMapInputs& inputs);  // RGBA8, sRGB-encoded
std::vector<gl::ProgramDesc> tone_map_programs();

// Rows of the parameter table that these passes read.
std::vector<Param> render_params();
// Which casters they choose.
scene::CasterChoice caster_choice(const ParamSet& params);

// Uniform blocks that several passes read: bound once a frame.
inline constexpr GLuint view_binding = 4;
inline constexpr GLuint lighting_binding = 5;
// The first texture unit of the passes; the shadow library has those below it.
inline constexpr GLuint first_unit = 8;

}  // namespace penumbra::render
