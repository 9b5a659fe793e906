#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/params.h"
#include "gl/pass.h"
#include "render/atmosphere.h"
#include "render/view.h"
#include "scene/gpu_scene.h"
#include "shadow/soft_shadows.h"

namespace penumbra::render {

// The passes of a frame. Each is a function from named inputs to a named output, in the file that is named after it.

// The first sample of each pixel of a frame, in its middle, or a further one. The further ones share their targets, and
// leave those of the first as they are.
enum class Sample { first, further };

// The visible surfaces, before lighting.
struct GBuffer {
  const gl::Texture* albedo = nullptr;  // RGB10_A2: square root of the linear colour; A: 0 sky, 1/3 unlit, 1 lit
  const gl::Texture* normal = nullptr;  // RG16: shading normal, world space, octahedral, 0 to 1
  const gl::Texture* geometric_normal = nullptr;  // RG32F: world space, octahedral, -1 to 1
  const gl::Texture* material = nullptr;  // RGBA8: metallic, roughness, ambient occlusion, lean of smooth normals
  const gl::Texture* emission = nullptr;  // R11F_G11F_B10F: in the file's units; null where nothing emits light
  const gl::Texture* motion = nullptr;    // RG32F: present minus last position, NDC; null if not asked for
  const gl::Texture* depth = nullptr;     // 32F, reversed-Z: 0 is the sky
};

struct GBufferInputs {
  scene::GpuScene& scene;
  const glsl::ViewBlock& view;
  bool motion = false;  // whether motion vectors are drawn
  // Of the first sample of a frame, which is read once the others are drawn, or of one of the others.
  Sample sample = Sample::first;
};
GBuffer draw_gbuffer(gl::Device& device, const GBufferInputs& inputs);
std::vector<gl::ProgramDesc> gbuffer_programs();

// Inputs of the surface id pass, which stores the triangle that each pixel shows. Drawn only for techniques that trace
// rays from it.
struct SurfaceIdInputs {
  scene::GpuScene& scene;
  const glsl::ViewBlock& view;
  const gl::Texture& depth;  // the G-buffer's
};
// RG32UI: 1 + the index in PosedGeometry::surfaces (0: sky), and the index of the triangle in that surface.
const gl::Texture& draw_surface_ids(gl::Device& device, const SurfaceIdInputs& inputs);
std::vector<gl::ProgramDesc> surface_id_programs();

// What shadow::Inputs::user points to when this renderer draws a frame.
struct FrameScene {
  scene::GpuScene& scene;
  const glsl::ViewBlock& view;
  const gl::Texture& depth;  // the G-buffer's
  double time;               // seconds
  std::vector<bool> hidden;  // of each light of the mask: whether it is_hidden()
};

// The lights that cast shadows, as the shadow library takes them. `ids`: FrameInputs::light_ids.
std::vector<shadow::Light> shadow_lights(std::span<const FrameLight> lights, std::span<const int> ids);

// Whether not all lights are suns.
bool has_lamps(std::span<const FrameLight> lights);

// Whether nothing is visible by a light, whatever casts shadows: a sun whose whole disc is below the horizon, where the
// scene stands on ground (FrameInputs::on_ground).
bool is_hidden(const FrameLight& light, bool on_ground, const ParamSet& params);

// Under which id the shadow library keeps what further samples with shadows of their own need for a view.
constexpr int further_view(int view) { return -1 - view; }

// What moved since the view's last frame: what moved between the scene's two times, as after frames that follow each
// other, or nothing, as from one sample of a frame to the next.
enum class Moved { unknown, of_scene, nothing };

struct ShadowMaskInputs {
  shadow::SoftShadows& soft_shadows;
  scene::GpuScene& scene;
  const Camera& camera;
  const Camera& last_camera;
  const glsl::ViewBlock& view;
  glm::vec2 jitter{0};  // same as shadow::View::jitter
  int view_id = 0;      // same as FrameInputs::view, or further_view() of it
  double time = 0;
  bool cut = false, restart = false, mask_details = false;  // same as in FrameInputs
  Moved moved = Moved::of_scene;
  std::span<const shadow::Light> lights;
  std::span<const FrameLight> frame_lights;  // the same lights, and those without shadows
  bool on_ground = false;                    // same as in FrameInputs
  const GBuffer& gbuffer;
  const ParamSet& params;
};
// One layer for each light, in the order of the lights.
shadow::Mask draw_shadow_mask(gl::Device& device, const ShadowMaskInputs& inputs);

// The sky of a frame.
struct Sky {
  SkyTable table;
  gl::Texture texture;                   // RGBA16F: SkyTable::radiance
  std::optional<Atmosphere> atmosphere;  // what they were made of, and for which sun
  float haze = 0;
  glm::vec3 to_sun{0};
};
// Makes it that of the brightest sun, among those that is_hidden() if there is no other; it stays as it is where
// nothing changed, or there is no sun.
void update_sky(Sky& sky, std::span<const FrameLight> lights, bool on_ground, const ParamSet& params);

// How a further sample finds its shadows in the mask of the first one.
struct FirstSample {
  const GBuffer& gbuffer;
  const glsl::ViewBlock& view;
  glm::vec2 offset;      // of the further sample from the first, pixels
  glm::vec2 pixel_size;  // see pixel_size()
};

// The size of a pixel where a surface is, metres: x, and y for each metre of its distance from the camera.
glm::vec2 pixel_size(const Camera& camera, int height);

glm::mat4 clip_to_world(const glsl::ViewBlock& view);

// Sets the uniforms of glsl/render/first_mask.glsl.
void set_first_sample(const gl::Program& program, const FirstSample& first);

struct SampleMaskInputs {
  const shadow::Mask& mask;  // of the first sample
  const FirstSample& first;
  const GBuffer& gbuffer;  // of the further sample, as `view`
  const glsl::ViewBlock& view;
};
// The mask of a further sample, as lighting finds it in that of the first one. Of the details, penumbra radius and
// blocker distance are there, but no layer of the shadow map.
shadow::Mask draw_sample_mask(gl::Device& device, const SampleMaskInputs& inputs);
std::vector<gl::ProgramDesc> sample_mask_programs();

struct LightingInputs {
  const GBuffer& gbuffer;
  const shadow::Mask& mask;
  const FirstSample* first = nullptr;  // the sample that the mask is of; null: this one
  const Sky& sky;
  const scene::Bounds& bounds;         // of the scene
  const glm::vec3& ground_color;       // same as in FrameInputs
  std::span<const FrameLight> lights;  // the first ones have a layer of the mask each, the others no shadows
  bool on_ground = false;              // same as in FrameInputs
  const glsl::ViewBlock& view;
  bool emission_in_nits = true;  // false: 1 is the luminance of white in the sun
  Sample sample = Sample::first;
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
  const shadow::Light& first;  // whose shadows they receive
  bool lamps = false;          // see has_lamps()
  Sample sample = Sample::first;
};
// Draws blended surfaces over `lit`. Only the first light is shadowed on them; the others light them without shadows.
void draw_blended(gl::Device& device, const BlendedInputs& inputs);
std::vector<gl::ProgramDesc> blended_programs(gl::Device& device, const shadow::SoftShadows& soft_shadows,
                                              const ParamSet& defaults);

struct ExposureInputs {
  const GBuffer& gbuffer;
  const gl::Texture& lit;
  const ParamSet& params;
};
// One float: the factor by which the tone map multiplies colours.
const gl::Buffer& measure_exposure(gl::Device& device, const ExposureInputs& inputs);
std::vector<gl::ProgramDesc> exposure_programs();

struct ToneMapInputs {
  const gl::Texture& lit;
  const gl::Buffer& exposure;
  const gl::Texture& noise;  // dither_noise()
  const ParamSet& params;
};
// Blue noise, red channel, 0 to 1.
gl::Texture dither_noise();
const gl::Texture& tone_map(gl::Device& device, const ToneMapInputs& inputs);  // RGBA8, sRGB-encoded
std::vector<gl::ProgramDesc> tone_map_programs();

// Where in a pixel its samples are, pixels from its middle, x to the right and y upwards, -0.5 to 0.5: Halton points,
// which are shifted on the torus so that the first is the middle.
std::vector<glm::vec2> sample_offsets(int count);

// The mean of the samples so far, times their share in all.
struct SampleMean {
  const gl::Texture* display = nullptr;  // RGBA32F: tone mapped, linear
  const gl::Texture* color = nullptr;    // RGBA32F: linear light, as light_surfaces() gives it
};
struct SampleInputs {
  const gl::Texture& lit;
  const gl::Buffer& exposure;
  int index = 0;  // of the sample; 0 begins the mean
  int count = 1;
};
SampleMean add_sample(gl::Device& device, const SampleInputs& inputs);

struct EncodeInputs {
  const gl::Texture& display;  // SampleMean::display
  const gl::Texture& noise;    // dither_noise()
  const ParamSet& params;
};
// The picture of the tone map, of the mean of all samples: RGBA8, sRGB-encoded.
const gl::Texture& encode_mean(gl::Device& device, const EncodeInputs& inputs);
std::vector<gl::ProgramDesc> sample_programs();

// The parameters that these passes read.
std::vector<Param> render_params();

// Binding of the uniform block of the view, which several passes read; bound once per frame.
inline constexpr GLuint view_binding = 4;
inline constexpr GLuint lighting_binding = 5;
// The first texture unit of these passes; the shadow library uses the units below it.
inline constexpr GLuint first_unit = 8;

}  // namespace penumbra::render
