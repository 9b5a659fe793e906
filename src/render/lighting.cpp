#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "render/ground.h"
#include "render/passes.h"
#include "shared/lighting_block.h"

namespace penumbra::render {

namespace {

static_assert(sizeof(glsl::DirectLightBlock) == 64);
static_assert(offsetof(glsl::LightingBlock, lights) == 48);
static_assert(LIGHTING_MAX_LIGHTS == max_lights);

float luminance(const glm::vec3& color) { return glm::dot(color, {0.2126f, 0.7152f, 0.0722f}); }

// The factor from luminance to picture values. With manual exposure, it follows EV at ISO 100, with the middle of a
// light meter's range at 1.2 · 2^EV (ISO 2720 with K = 12.5). With automatic exposure, white in the sun becomes 1, and
// measure_exposure() computes the remaining factor.
float exposure_factor(const LightingInputs& inputs, float white) {
  if (!inputs.params.get_bool("exposure.auto"))
    return 1.0f / (1.2f * std::exp2(inputs.params.get_float("exposure.ev")));
  return white > 0.0f ? 1.0f / white : 1.0f;
}

// The uniform block of a light, with its illuminance exposed.
glsl::DirectLightBlock block_of(const SunLight& sun, float exposure) {
  glsl::DirectLightBlock block{};
  block.place = sun.to_light;
  block.illuminance = sun.illuminance * exposure;
  return block;
}

// Least difference of the cosines of a spot's cones: between equal ones light would end without a width to fade over.
constexpr float narrowest_fade = 1e-6f;

// Nearer to a lamp than its radius, but at least this far, light grows no more.
constexpr float least_distance = 1e-2f;  // metres

glsl::DirectLightBlock block_of(const LampLight& lamp, float exposure) {
  glsl::DirectLightBlock block{};
  const float nearest = std::max(lamp.radius, least_distance);
  block.place = lamp.position;
  block.least_square = nearest * nearest;
  block.illuminance = lamp.intensity * exposure;
  block.inverse_range = lamp.range > 0 ? 1.0f / lamp.range : 0.0f;
  block.axis = lamp.axis;
  block.cone_offset = 1;
  if (lamp.axis == glm::vec3(0)) return block;
  const float inner = std::cos(lamp.inner_cone), outer = std::cos(lamp.outer_cone);
  block.cone_scale = 1.0f / std::max(inner - outer, narrowest_fade);
  block.cone_offset = -outer * block.cone_scale;
  return block;
}

// Illuminance in lux: on a plane that faces the light, which for a lamp is 2 m away, as in a room. Light that is
// reflected around the scene and automatic exposure follow from it.
constexpr float usual_distance = 2;
glm::vec3 illuminance_of(const SunLight& sun) { return sun.illuminance; }
glm::vec3 illuminance_of(const LampLight& lamp) { return lamp.intensity / (usual_distance * usual_distance); }

// The share of that on the ground around the scene, which lamps don't reach.
float level_share(const SunLight& sun) { return std::max(sun.to_light.y, 0.0f); }
float level_share(const LampLight& /*lamp*/) { return 0; }

// The sum of the lights' illuminance without those that the ground hides. Where it hides all, with them: what reaches
// surfaces is then the light of the sky alone, as the picture would be black without it.
glm::vec3 direct_light(const LightingInputs& inputs) {
  glm::vec3 hidden(0), others(0);
  for (const FrameLight& light : inputs.lights) {
    glm::vec3& sum = is_hidden(light, inputs.on_ground, inputs.params) ? hidden : others;
    sum += std::visit([](const auto& kind) { return illuminance_of(kind); }, light);
  }
  return others == glm::vec3(0) ? hidden : others;
}

glsl::LightingBlock lighting_block(const LightingInputs& inputs) {
  const glm::vec3 direct = direct_light(inputs);
  const float sky_share = inputs.params.get_float("render.sky_light");
  const float white = luminance(direct) * (1.0f + sky_share) / glm::pi<float>();
  const float exposure = exposure_factor(inputs, white);
  glsl::LightingBlock block{};
  block.sky = glm::vec3(exposure * sky_share * luminance(direct) / glm::pi<float>());
  block.ground_albedo = ground_albedo;
  block.ground_light = inputs.params.get_float("render.ground_light");
  block.emission = inputs.emission_in_nits ? exposure : exposure * white;
  for (const FrameLight& light : inputs.lights) {
    std::visit(
        [&](const auto& kind) {
          const float level = level_share(kind) / glm::pi<float>();
          block.ground += ground_albedo * illuminance_of(kind) * (exposure * level);
          block.lights[block.light_count] = block_of(kind, exposure);
        },
        light);
    // Where no mask is read: on blended surfaces, and of lights that are too many to cast shadows.
    if (is_hidden(light, inputs.on_ground, inputs.params)) block.lights[block.light_count].illuminance = glm::vec3(0);
    ++block.light_count;
  }
  return block;
}

glm::mat4 clip_to_world(const glsl::ViewBlock& view) { return glm::mat4(glm::inverse(glm::dmat4(view.world_to_clip))); }

// What the program is compiled for.
struct Lit {
  std::size_t lights = 1, shadowed = 1;
  bool lamps = false, emission = false;
  bool further = false;  // a further sample, which reads the mask of the first
};

gl::ProgramDesc program(const Lit& lit) {
  return {.name = "lighting",
          .vertex = "shared/full_screen.vert",
          .fragment = "render/lighting.frag",
          .defines = {{"EMISSION", lit.emission ? "1" : "0"},
                      {"LIGHTS", std::to_string(lit.lights)},
                      {"SHADOWED", std::to_string(lit.shadowed)},
                      {"LAMPS", lit.lamps ? "1" : "0"},
                      {"FURTHER_SAMPLE", lit.further ? "1" : "0"}}};
}

}  // namespace

glm::vec2 pixel_size(const Camera& camera, int height) {
  const float pixels = static_cast<float>(height) * 0.5f;
  if (camera.orthographic) return {camera.half_height / pixels, 0};
  return {0, std::tan(camera.fov_y * 0.5f) / pixels};
}

const gl::Texture& light_surfaces(gl::Device& device, const LightingInputs& inputs) {
  const GBuffer& gbuffer = inputs.gbuffer;
  const bool further = inputs.first != nullptr;
  const gl::Texture& lit =
      device.target(further ? "sample lit" : "lit",
                    {.format = GL_RGBA16F, .width = gbuffer.depth->width(), .height = gbuffer.depth->height()});
  const gl::Buffer& block = device.scratch("lighting", sizeof(glsl::LightingBlock));
  gl::write_value(block, lighting_block(inputs));
  gl::Pass pass(device,
                {.name = further ? "sample lighting" : "lighting", .colors = {{.texture = &lit, .dont_care = true}}});
  const bool lamps = has_lamps(inputs.lights);
  const gl::Program& used = pass.use(program({.lights = inputs.lights.size(),
                                              .shadowed = inputs.mask.lights.size(),
                                              .lamps = lamps,
                                              .emission = gbuffer.emission != nullptr,
                                              .further = further}));
  block.bind_uniform(lighting_binding);
  GLuint unit = first_unit;
  std::vector<const gl::Texture*> sources{gbuffer.albedo, gbuffer.normal, gbuffer.material, inputs.mask.texture};
  if (gbuffer.emission != nullptr || lamps || further) sources.push_back(gbuffer.emission);
  if (lamps || further) {
    sources.push_back(gbuffer.depth);
    used.set("clip_to_world", clip_to_world(inputs.view));
  }
  if (further) {
    for (const gl::Texture* texture :
         {gbuffer.geometric_normal, inputs.first->gbuffer.depth, inputs.first->gbuffer.geometric_normal})
      sources.push_back(texture);
    used.set("first_clip_to_world", clip_to_world(inputs.first->view));
    used.set("offset", inputs.first->offset);
    used.set("pixel_size", inputs.first->pixel_size);
  }
  for (const gl::Texture* texture : sources) {
    device.sampler({}).bind(unit);
    if (texture != nullptr) texture->bind(unit);
    ++unit;
  }
  pass.draw_full_screen();
  return lit;
}

std::vector<gl::ProgramDesc> lighting_programs() {
  return {program({.emission = true}),
          program({}),
          program({.lights = 2, .shadowed = 2}),
          program({.lights = 10, .shadowed = 8, .lamps = true, .emission = true}),
          program({.lamps = true}),
          program({.further = true}),
          program({.lights = 10, .shadowed = 8, .lamps = true, .emission = true, .further = true})};
}

}  // namespace penumbra::render
