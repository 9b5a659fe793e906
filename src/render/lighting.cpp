#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "render/passes.h"
#include "shared/lighting_block.h"

namespace penumbra::render {

namespace {

static_assert(sizeof(glsl::DirectLightBlock) == 64);
static_assert(offsetof(glsl::LightingBlock, lights) == 160);
static_assert(LIGHTING_MAX_LIGHTS == max_lights);

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

// The lights' luminous illuminance, as above, without those that the ground hides. Where it hides all, with them: what
// reaches surfaces is then the light of the sky alone, as the picture would be black without it.
struct Illuminance {
  float suns = 0, lamps = 0;
  float all() const { return suns + lamps; }
  void add(const SunLight& sun) { suns += luminance(illuminance_of(sun)); }
  void add(const LampLight& lamp) { lamps += luminance(illuminance_of(lamp)); }
};

Illuminance illuminance_of(const LightingInputs& inputs) {
  Illuminance hidden, others;
  for (const FrameLight& light : inputs.lights) {
    Illuminance& sum = is_hidden(light, inputs.on_ground, inputs.params) ? hidden : others;
    std::visit([&](const auto& kind) { sum.add(kind); }, light);
  }
  return others.all() == 0 ? hidden : others;
}

// Where the ground around the scene is, and how far the eye sees the scene upon it.
void place_ground(glsl::LightingBlock& block, const scene::Bounds& scene, const glm::vec3& eye) {
  block.ground_height = scene.min.y;
  const glm::vec2 farthest = glm::max(glm::abs(glm::vec2(scene.min.x, scene.min.z) - glm::vec2(eye.x, eye.z)),
                                      glm::abs(glm::vec2(scene.max.x, scene.max.z) - glm::vec2(eye.x, eye.z)));
  block.scene_reach = std::max(glm::length(glm::vec3(farthest, eye.y - scene.min.y)), 1e-6f);
}

// What surfaces get of the sky and, as from the sky, of lamps; and irradiance over pi by the ground from below.
glsl::AmbientLight ambient_light(const SkyTable& table, float sky, float room, const glm::vec3& from_ground) {
  const auto& [all, upward, side, square, side_up, side_square] = table.irradiance;
  glsl::AmbientLight ambient{};
  ambient.zenith = sky * table.mirrored[0] + room;
  ambient.horizon = sky * table.mirrored[1];
  ambient.side = sky * luminance(table.mirrored[2]) / std::max(luminance(ambient.zenith), 1e-6f);
  ambient.sun_side = {table.sun_side.x, table.sun_side.z};
  ambient.vertical = sky * all + 0.5f * (room + from_ground);
  ambient.upward = sky * upward + 0.5f * (room - from_ground);
  ambient.shares = glm::vec4(luminance(square), luminance(side), luminance(side_up), luminance(side_square)) *
                   (sky / std::max(luminance(ambient.vertical), 1e-6f));
  return ambient;
}

glsl::LightingBlock lighting_block(const LightingInputs& inputs) {
  const Illuminance direct = illuminance_of(inputs);
  const float sky_share = inputs.params.get_float("render.sky_light");
  const float white = direct.all() * (1.0f + sky_share) / glm::pi<float>();
  const float exposure = exposure_factor(inputs, white);
  const float ambience = exposure * sky_share / glm::pi<float>();
  const auto& level = inputs.sky.table.irradiance;
  glsl::LightingBlock block{};
  block.sky = ambience * direct.suns;
  block.room = ambience * direct.lamps;
  block.ground_albedo = inputs.ground_color;
  block.emission = inputs.emission_in_nits ? exposure : exposure * white;
  block.soft_terminator = inputs.params.get_bool("render.soft_terminator") ? 1.0f : 0.0f;
  glm::vec3 ground = block.sky * (level[0] + level[1] + level[3]) + block.room;
  for (const FrameLight& light : inputs.lights) {
    std::visit(
        [&](const auto& kind) {
          ground += illuminance_of(kind) * (exposure * level_share(kind) / glm::pi<float>());
          block.lights[block.light_count] = block_of(kind, exposure);
        },
        light);
    // Where no mask is read: on blended surfaces, and of lights that are too many to cast shadows.
    if (is_hidden(light, inputs.on_ground, inputs.params)) block.lights[block.light_count].illuminance = glm::vec3(0);
    ++block.light_count;
  }
  ground *= inputs.ground_color;
  // The scene itself blocks part of the ground's light.
  block.ambient =
      ambient_light(inputs.sky.table, block.sky, block.room, inputs.params.get_float("render.ground_light") * ground);
  block.ambient.ground = ground;
  place_ground(block, inputs.bounds, glm::vec3(inputs.view.camera));
  return block;
}

// What the program is compiled for.
struct Lit {
  std::size_t lights = 1, shadowed = 1;
  bool lamps = false, emission = false;
  bool further = false;  // a further sample, which reads the mask of the first
};

gl::ProgramDesc program(const Lit& lit) {
  return {.name = "lighting",
          .vertex = "render/lighting.vert",
          .fragment = "render/lighting.frag",
          .defines = {{"EMISSION", lit.emission ? "1" : "0"},
                      {"LIGHTS", std::to_string(lit.lights)},
                      {"SHADOWED", std::to_string(lit.shadowed)},
                      {"LAMPS", lit.lamps ? "1" : "0"},
                      {"FURTHER_SAMPLE", lit.further ? "1" : "0"}}};
}

gl::ProgramDesc sky_program(std::size_t lights, bool lamps) {
  return {.name = "sky",
          .vertex = "render/lighting.vert",
          .fragment = "render/sky.frag",
          .defines = {{"LIGHTS", std::to_string(lights)}, {"LAMPS", lamps ? "1" : "0"}}};
}

}  // namespace

glm::mat4 clip_to_world(const glsl::ViewBlock& view) { return glm::mat4(glm::inverse(glm::dmat4(view.world_to_clip))); }

void set_first_sample(const gl::Program& program, const FirstSample& first) {
  program.set("first_clip_to_world", clip_to_world(first.view));
  program.set("offset", first.offset);
  program.set("pixel_size", first.pixel_size);
}

glm::vec2 pixel_size(const Camera& camera, int height) {
  const float pixels = static_cast<float>(height) * 0.5f;
  if (camera.orthographic) return {camera.half_height / pixels, 0};
  return {0, std::tan(camera.fov_y * 0.5f) / pixels};
}

namespace {

void draw_surfaces(gl::Device& device, const LightingInputs& inputs, const gl::Texture& lit) {
  const GBuffer& gbuffer = inputs.gbuffer;
  const bool further = inputs.first != nullptr;
  gl::Pass pass(device,
                {.name = further ? "sample lighting" : "lighting", .colors = {{.texture = &lit, .dont_care = true}}});
  const bool lamps = has_lamps(inputs.lights);
  const gl::Program& used = pass.use(program({.lights = inputs.lights.size(),
                                              .shadowed = inputs.mask.lights.size(),
                                              .lamps = lamps,
                                              .emission = gbuffer.emission != nullptr,
                                              .further = further}));
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
    set_first_sample(used, *inputs.first);
  }
  for (const gl::Texture* texture : sources) {
    device.sampler({}).bind(unit);
    if (texture != nullptr) texture->bind(unit);
    ++unit;
  }
  pass.draw_full_screen();
}

// Where no surface is.
void draw_sky(gl::Device& device, const LightingInputs& inputs, const gl::Texture& lit) {
  gl::Pass pass(device, {.name = inputs.first != nullptr ? "sample sky" : "sky",
                         .colors = {{.texture = &lit}},
                         .depth = gl::Attachment{.texture = inputs.gbuffer.depth},
                         .depth_test = gl::DepthTest::equal});
  const bool lamps = has_lamps(inputs.lights);
  const gl::Program& used = pass.use(sky_program(inputs.lights.size(), lamps));
  if (lamps) used.set("clip_to_world", clip_to_world(inputs.view));
  device.sampler({.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR}).bind(first_unit);
  inputs.sky.texture.bind(first_unit);
  pass.draw_full_screen();
}

}  // namespace

const gl::Texture& light_surfaces(gl::Device& device, const LightingInputs& inputs) {
  const gl::Texture& depth = *inputs.gbuffer.depth;
  const gl::Texture& lit = device.target(inputs.sample == Sample::further ? "sample lit" : "lit",
                                         {.format = GL_RGBA16F, .width = depth.width(), .height = depth.height()});
  const gl::Buffer& block = device.scratch("lighting", sizeof(glsl::LightingBlock));
  gl::write_value(block, lighting_block(inputs));
  block.bind_uniform(lighting_binding);
  draw_surfaces(device, inputs, lit);
  draw_sky(device, inputs, lit);
  return lit;
}

std::vector<gl::ProgramDesc> lighting_programs() {
  return {program({.emission = true}),
          program({}),
          program({.lights = 2, .shadowed = 2}),
          program({.lights = 10, .shadowed = 8, .lamps = true, .emission = true}),
          program({.lamps = true}),
          program({.further = true}),
          program({.lights = 10, .shadowed = 8, .lamps = true, .emission = true, .further = true}),
          sky_program(1, false),
          sky_program(10, true)};
}

}  // namespace penumbra::render
