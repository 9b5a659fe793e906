// The engine by penumbra.hpp: the shared library, exceptions from results, std::function, and GLM. Its types are
// aligned here, as some engines have them, which changes how they lie in memory.
#define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES
#include <penumbra/penumbra.hpp>
#include <penumbra/penumbra_glm.hpp>
#include <penumbra/penumbra_settings.hpp>

#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine.h"

namespace {

using namespace penumbra;

void expect(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

template <class Call>
void expect_error(penumbra_result result, const char* text, const Call& call) {
  try {
    call();
  } catch (const api::Error& error) {
    expect(error.result() == result && std::string(error.what()).find(text) != std::string::npos, error.what());
    return;
  }
  throw std::runtime_error(text);
}

api::Frame frame_of(const engine::Targets& targets, const glm::mat4& view) {
  const glm::vec3 ground(engine::floor_half, 0, engine::floor_half);
  api::Frame frame;
  api::copy(view, frame.view);
  api::copy(view, frame.last_view);
  api::copy(engine::projection(), frame.projection);
  api::copy(engine::projection(), frame.last_projection);
  frame.reversed_z = 0;
  frame.depth_zero_to_one = 0;
  frame.normals_encoding = PENUMBRA_NORMALS_XYZ;
  frame.depth = {targets.depth, engine::width, engine::height};
  frame.normals = {targets.normals, engine::width, engine::height};
  frame.casters = frame.receivers = api::box(-ground, ground + engine::caster_center);
  frame.moved_is_known = 1;
  return frame;
}

// A preset, read into fields and written to other settings, is the same preset; so are the defaults.
void check_typed_settings() {
  using Typed = api::TypedSettings;
  api::Settings defaults;
  defaults.set("sun.angle", 3);
  Typed().write(defaults);
  expect(defaults.preset() == api::Settings().preset(), "typed settings have other defaults");
  for (std::size_t i = 0; i < penumbra_technique_count(); ++i) {
    penumbra_technique technique{};
    technique.struct_size = sizeof technique;
    api::check(penumbra_technique_info(i, &technique));
    const api::Settings named(technique.name);
    api::Settings again;
    Typed::read(named).write(again);
    expect(again.preset() == named.preset(), technique.name);
  }
  Typed typed;
  typed.technique = Typed::Technique::slices;
  typed.sun.shape = Typed::Sun::Shape::square;
  typed.maps.keep = false;
  typed.cascades.count = 2;
  typed.write(defaults);
  expect(defaults.get("technique") == "slices" && defaults.get("sun.shape") == "square" &&
             defaults.get_number("maps.keep") == 0 && defaults.get_number("cascades.count") == 2,
         "typed settings are not as they were set");
}

float visibility_at(const std::vector<float>& mask, const glm::mat4& view, const glm::vec3& point) {
  const glm::vec4 clip = engine::projection() * view * glm::vec4(point, 1);
  const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(engine::width, engine::height);
  return mask[static_cast<std::size_t>(static_cast<int>(pixel.y) * engine::width + static_cast<int>(pixel.x))];
}

void run() {
  check_typed_settings();
  engine::make_context();
  const engine::Scene scene;
  const glm::mat4 view = engine::view({0, 5, 5});
  const glm::vec3 to_light = glm::normalize(glm::vec3(-1, 2, 0.5f));

  api::Device device([](const char* name) { return reinterpret_cast<penumbra_proc>(engine::proc_address(name)); });
  api::Settings settings("pcss");
  settings.set("sun.angle", 8);
  settings.set("maps.keep", true);
  expect(settings.get("sun.angle") == "8" && settings.get_number("maps.keep") == 1,
         "settings are not as they were set");
  expect(api::Settings(settings).preset() == settings.preset(), "a copy of settings is another one");
  expect_error(PENUMBRA_ERROR_REFUSED, "did you mean", [&] { settings.set("sun.angel", 8); });

  api::Frame frame = frame_of(engine::draw_frame(scene, view), view);
  const std::array lights{api::sun(0, to_light)};
  frame.light_with(lights);
  device.warm_up(settings, frame);
  expect(!device.reads_motion(settings, lights), "motion vectors are read without a history");
  frame.draw_with(
      [&](const penumbra_caster_pass& pass) { scene.draw(api::matrix(pass.world_to_clip), /*casters_only=*/false); });
  const penumbra_mask mask = device.render(settings, frame);
  const std::vector<float> values = engine::read_red(mask.texture);
  const glm::vec3 umbra = engine::caster_center - to_light * (engine::caster_center.y / to_light.y);
  expect(visibility_at(values, view, umbra) < 0.01f, "the middle of the square's shadow is not dark");
  expect(visibility_at(values, view, umbra + glm::vec3(0, 0, 2)) > 0.99f, "the floor beside the shadow is not lit");

  // What a callback throws is what the engine catches.
  api::Frame broken = frame;
  broken.view_id = 1;
  broken.draw_with([](const penumbra_caster_pass&) { throw std::out_of_range("no such mesh"); });
  bool thrown = false;
  try {
    device.render(settings, broken);
  } catch (const std::out_of_range& error) {
    thrown = error.what() == std::string("no such mesh");
  }
  expect(thrown, "a callback's exception is lost");
  // A device that takes the place of another, as where a renderer starts anew.
  device = api::Device([](const char* name) { return reinterpret_cast<penumbra_proc>(engine::proc_address(name)); });
  const penumbra_mask anew = device.render(settings, frame);
  expect(visibility_at(engine::read_red(anew.texture), view, umbra) < 0.01f, "a new device draws no shadow");
  frame.depth.width = 7;
  expect_error(PENUMBRA_ERROR_REFUSED, "not 7", [&] { device.render(settings, frame); });

  expect(engine::compiles("#version 450 core\n" + device.forward_source(settings) + engine::forward_fragment_text),
         "the forward source does not compile in a shader of the engine's");
  device.abandon();
  expect_error(PENUMBRA_ERROR_CONTEXT, "abandoned", [&] { device.forget_view(0); });
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
