// The engine hands its depth, its normals and a callback that draws its casters to Penumbra, gets a shadow mask, and
// checks it: umbra under the square, light beside it, penumbra in between. Then it does the same with maps that it has
// drawn itself, and with the same maps after the camera has moved. One of its programs includes the forward source.
// Last, it draws with a technique of its own.
#include <penumbra/gl/context.h>
#include <penumbra/shadow/registry.h>
#include <penumbra/shadow/soft_shadows.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "engine.h"

namespace {

using namespace penumbra;

struct Setting {
  const engine::Scene& scene;
  engine::Targets targets;
  glm::mat4 view;
  glm::vec3 to_light;
};

shadow::Inputs inputs_of(const Setting& setting, std::span<const shadow::Light> lights) {
  const glm::vec3 ground(engine::floor_half, 0, engine::floor_half);
  const glm::vec3 caster(engine::caster_half, 0, engine::caster_half);
  shadow::Inputs inputs;
  inputs.view.view = inputs.view.last_view = setting.view;
  inputs.view.projection = inputs.view.last_projection = engine::projection();
  inputs.conventions = {.reversed_z = false, .depth_zero_to_one = false, .octahedral_normals = false};
  inputs.depth = {setting.targets.depth, engine::width, engine::height};
  inputs.normals = {setting.targets.normals, engine::width, engine::height};
  inputs.lights = lights;
  inputs.casters = {glm::min(engine::caster_center - caster, -ground),
                    glm::max(engine::caster_center + caster, ground)};
  inputs.receivers = inputs.casters;
  inputs.moved = shadow::Box{glm::vec3(1), glm::vec3(-1)};  // nothing moves
  inputs.draw = [&scene = setting.scene](const shadow::CasterPass& pass, gl::Pass&) {
    scene.draw(pass.world_to_clip, /*casters_only=*/false);
  };
  return inputs;
}

float visibility_at(const std::vector<float>& mask, const Setting& setting, const glm::vec3& point) {
  const glm::vec4 clip = engine::projection() * setting.view * glm::vec4(point, 1);
  const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(engine::width, engine::height);
  return mask[static_cast<size_t>(4 * (static_cast<int>(pixel.y) * engine::width + static_cast<int>(pixel.x)))];
}

void expect(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

void check_mask(const std::vector<float>& mask, const Setting& setting) {
  const glm::vec3 umbra = engine::caster_center - setting.to_light * (engine::caster_center.y / setting.to_light.y);
  expect(visibility_at(mask, setting, umbra) < 0.01f, "the middle of the square's shadow is not dark");
  expect(visibility_at(mask, setting, umbra + glm::vec3(0, 0, 2)) > 0.99f, "the floor beside the shadow is not lit");
  int penumbra_pixels = 0;
  for (size_t i = 0; i < mask.size(); i += 4) penumbra_pixels += mask[i] > 0.1f && mask[i] < 0.9f;
  expect(penumbra_pixels > 100, "the shadow has no penumbra");
}

float mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
  float sum = 0;
  for (size_t i = 0; i < a.size(); i += 4) sum += std::abs(a[i] - b[i]);
  return 4 * sum / static_cast<float>(a.size());
}

// The matrix of each layer, for maps that the engine draws itself.
shadow::FinishedMaps draw_own_maps(const Setting& setting, const shadow::LightProjection& projection) {
  std::vector<glm::mat4> matrices;
  for (int layer = 0; layer < projection.layers(); ++layer) matrices.push_back(projection.world_to_clip(layer));
  const int size = projection.size();
  const GLuint depth = engine::draw_depth_array(setting.scene, matrices.data(), projection.layers(), size);
  return {{depth, size, size}, projection};
}

// A technique of the engine's own beside the library's: hard shadows in which half of the light remains.
constexpr const char* pale_text = R"(
#include "shadow/light.glsl"
float read_radius(Receiver receiver, Light light) { return 0.0; }
Visibility visibility(Receiver receiver, Light light) {
  float lit = lit_share(receiver, vec2(0.0), depth_bias(receiver, light), light);
  return Visibility(mix(0.5, 1.0, lit), 0.0, 0.0, true, true);
}
)";

shadow::Registry with_pale() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  contents.techniques.push_back({.name = "pale",
                                 .summary = "Hard shadows in which half of the light remains.",
                                 .source = "the engine's own",
                                 .glsl = "engine/pale.glsl",
                                 .needs = {"shadow_map"},
                                 .soft = false});
  return shadow::Registry(contents);
}

void check_pale(const std::vector<float>& mask) {
  int shadowed = 0;
  for (size_t i = 0; i < mask.size(); i += 4) {
    expect(mask[i] > 0.49f, "less than half of the light remains");
    shadowed += mask[i] < 0.51f;
  }
  expect(shadowed > 100, "the engine's own technique draws no shadow");
}

void run() {
  engine::make_context();
  gl::load_api(engine::proc_address);
  const engine::Scene scene;
  const glm::mat4 view = engine::view({0, 5, 5});
  Setting setting{scene, engine::draw_frame(scene, view), view, glm::normalize(glm::vec3(-1, 2, 0.5f))};

  gl::ShaderFiles files;
  files.put("engine/pale.glsl", pale_text);
  gl::Device device(files, gl::Timers::Mode::off);
  shadow::SoftShadows shadows(device, with_pale());
  ParamSet params(shadows.registry().params());
  params.assign("sun.angle=8");

  std::vector<shadow::Light> lights(1);
  lights[0].source = shadow::Sun{.to_light = setting.to_light};
  const shadow::Mask drawn = shadows.render(inputs_of(setting, lights), params);
  const std::vector<float> mask = gl::read_floats(*drawn.texture, 4);
  check_mask(mask, setting);

  lights[0].maps = draw_own_maps(setting, drawn.lights[0].projection);
  const shadow::Mask given = shadows.render(inputs_of(setting, lights), params);
  expect(gl::read_floats(*given.texture, 4) == mask, "maps of the engine's own give another mask than the callback");

  // The maps and their projection are those of the first camera.
  setting.view = engine::view({1.5f, 4, 5.5f});
  setting.targets = engine::draw_frame(scene, setting.view);
  const std::vector<float> moved = gl::read_floats(*shadows.render(inputs_of(setting, lights), params).texture, 4);
  check_mask(moved, setting);
  lights[0].maps.reset();
  const std::vector<float> fresh = gl::read_floats(*shadows.render(inputs_of(setting, lights), params).texture, 4);
  expect(mean_difference(moved, fresh) < 0.005f,
         "maps of an earlier camera give another shadow than those of this one");

  expect(engine::compiles("#version 450 core\n" + shadows.forward_source(params) + engine::forward_fragment_text),
         "the forward source does not compile in a shader of the engine's");

  params.assign("technique=pale");
  check_pale(gl::read_floats(*shadows.render(inputs_of(setting, lights), params).texture, 4));
  std::puts("mask as expected");
}

}  // namespace

int main() {
  try {
    run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
