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

static_assert(sizeof(glsl::DirectLightBlock) == 32);
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
  return {.to_light = sun.to_light, .pad_a = 0, .illuminance = sun.illuminance * exposure, .pad_b = 0};
}

// Illuminance in lux, first on a plane that faces the light, then on a horizontal one.
glm::vec3 illuminance_of(const SunLight& sun) { return sun.illuminance; }
float level_share(const SunLight& sun) { return std::max(sun.to_light.y, 0.0f); }

glsl::LightingBlock lighting_block(const LightingInputs& inputs) {
  glm::vec3 direct(0);
  for (const FrameLight& light : inputs.lights)
    direct += std::visit([](const auto& kind) { return illuminance_of(kind); }, light);
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
          block.lights[block.light_count++] = block_of(kind, exposure);
        },
        light);
  }
  return block;
}

gl::ProgramDesc program(bool emission, std::size_t lights) {
  return {.name = "lighting",
          .vertex = "shared/full_screen.vert",
          .fragment = "render/lighting.frag",
          .defines = {{"EMISSION", emission ? "1" : "0"}, {"LIGHTS", std::to_string(lights)}}};
}

}  // namespace

const gl::Texture& light_surfaces(gl::Device& device, const LightingInputs& inputs) {
  const GBuffer& gbuffer = inputs.gbuffer;
  const gl::Texture& lit =
      device.target("lit", {.format = GL_RGBA16F, .width = gbuffer.depth->width(), .height = gbuffer.depth->height()});
  const gl::Buffer& block = device.scratch("lighting", sizeof(glsl::LightingBlock));
  gl::write_value(block, lighting_block(inputs));
  gl::Pass pass(device, {.name = "lighting", .colors = {{.texture = &lit, .dont_care = true}}});
  pass.use(program(gbuffer.emission != nullptr, inputs.lights.size()));
  block.bind_uniform(lighting_binding);
  GLuint unit = first_unit;
  std::vector<const gl::Texture*> sources{gbuffer.albedo, gbuffer.normal, gbuffer.material, inputs.mask.texture};
  if (gbuffer.emission != nullptr) sources.push_back(gbuffer.emission);
  for (const gl::Texture* texture : sources) {
    device.sampler({}).bind(unit);
    texture->bind(unit++);
  }
  pass.draw_full_screen();
  return lit;
}

std::vector<gl::ProgramDesc> lighting_programs() {
  return {program(/*emission=*/true, 1), program(/*emission=*/false, 1), program(/*emission=*/false, 2)};
}

}  // namespace penumbra::render
