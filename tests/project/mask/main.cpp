// What a library with a new technique offers and draws:
//   mask list            what its registry has, "technique NAME" a line
//   mask NAME=VALUE...   under these parameters the mask of a floor seen from above, as a grey picture (PGM, text)
#include <penumbra/gl/context.h>
#include <penumbra/shadow/soft_shadows.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string_view>

#include "engine.h"

namespace {

using namespace penumbra;

template <class Pieces>
void list(const char* kind, const Pieces& pieces) {
  for (const auto& piece : pieces) std::printf("%s %s\n", kind, piece.name.c_str());
}

void list_all(const shadow::Registry& registry) {
  list("technique", registry.techniques());
  list("filter", registry.filters());
  list("denoiser", registry.denoisers());
  list("product", registry.recipes());
  list("param", registry.params());
}

std::vector<float> draw(shadow::SoftShadows& shadows, const ParamSet& params) {
  const engine::Scene scene;
  const glm::mat4 view = engine::view({0, 8, 0.01f});
  const engine::Targets targets = engine::draw_frame(scene, view);
  std::vector<shadow::Light> lights(1);
  lights[0].source = shadow::Sun{.to_light = glm::normalize(glm::vec3(-1, 2, 0.5f))};

  shadow::Inputs inputs;
  inputs.view.view = inputs.view.last_view = view;
  inputs.view.projection = inputs.view.last_projection = engine::projection();
  inputs.conventions = {.reversed_z = false, .depth_zero_to_one = false, .octahedral_normals = false};
  inputs.depth = {targets.depth, engine::width, engine::height};
  inputs.normals = {targets.normals, engine::width, engine::height};
  inputs.lights = lights;
  inputs.casters = {{-engine::floor_half, 0, -engine::floor_half}, {engine::floor_half, 1, engine::floor_half}};
  inputs.receivers = inputs.casters;
  inputs.draw = [&scene](const shadow::CasterPass& pass, gl::Pass&) { scene.draw(pass.world_to_clip, false); };
  return gl::read_floats(*shadows.render(inputs, params).texture, 4);
}

void print(const std::vector<float>& mask) {
  std::printf("P2\n%d %d\n255\n", engine::width, engine::height);
  for (int y = engine::height - 1; y >= 0; --y) {
    for (int x = 0; x < engine::width; ++x)
      std::printf("%d ",
                  static_cast<int>(std::lround(255 * mask[static_cast<std::size_t>(4 * (y * engine::width + x))])));
    std::puts("");
  }
}

void run(int argc, char** argv) {
  engine::make_context();
  gl::load_api(engine::proc_address);
  gl::Device device(gl::ShaderFiles(), gl::Timers::Mode::off);
  shadow::SoftShadows shadows(device);
  if (argc == 2 && std::string_view(argv[1]) == "list") return list_all(shadows.registry());
  ParamSet params(shadows.registry().params());
  for (int i = 1; i < argc; ++i) params.assign(argv[i]);
  print(draw(shadows, params));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
