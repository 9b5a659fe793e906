// Measures the cost of a movement map: as a second target of the shadow pass against a separate pass, with the last
// positions and the pyramid, in both forms, with and without the bounds of what moved. The frames of all variants
// alternate in one run.
//   movement_map [SCENE.glb] [FRAMES]

#include "shadow/movement_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "image/read.h"
#include "io/report.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/gpu_scene.h"
#include "shadow/shadow_map.h"

namespace penumbra {
namespace {

struct Way {
  const char* name;
  shadow::MovementForm form;
  bool second_target, bounds, none;
};

constexpr std::array<Way, 6> ways{{
    {"no movement map", shadow::MovementForm::maximum, false, false, true},
    {"maximum, own pass", shadow::MovementForm::maximum, false, false, false},
    {"maximum, second target", shadow::MovementForm::maximum, true, false, false},
    {"maximum, second target, bounds", shadow::MovementForm::maximum, true, true, false},
    {"average, second target", shadow::MovementForm::average, true, false, false},
    {"average, second target, bounds", shadow::MovementForm::average, true, true, false},
}};

shadow::Box box_of(const scene::Bounds& bounds) { return {bounds.min, bounds.max}; }

scene::CasterSubset casters_of(shadow::CasterKind kind) {
  switch (kind) {
    case shadow::CasterKind::depth_and_moved:
      return scene::CasterSubset::all_and_moved;
    case shadow::CasterKind::moved_now:
      return scene::CasterSubset::moved_now;
    case shadow::CasterKind::moved_last:
      return scene::CasterSubset::moved_last;
    default:
      return scene::CasterSubset::all;
  }
}

// An animated scene with its camera and sun.
struct Stage {
  gl::Device& device;
  scene::GpuScene& scene;
  shadow::LightProjection projection;
};

void draw(Stage& stage, const Way& way) {
  const shadow::DrawCasters draw = [&](const shadow::CasterPass& casters, gl::Pass& pass) {
    stage.scene.draw_casters(stage.device, pass, casters_of(casters.kind),
                             {casters.anchored.to_clip, casters.anchored.anchor}, [&](const scene::Bounds& box) {
                               return casters.cull.holds(box_of(box)) ? scene::Overlap::part : scene::Overlap::none;
                             });
  };
  const int layers = stage.projection.layers();
  const bool average = way.form == shadow::MovementForm::average;
  const gl::Texture* map = way.none ? nullptr
                                    : &shadow::movement_target(stage.device, average ? "average" : "maximum",
                                                               stage.projection.size(), layers, way.form);
  std::optional<shadow::Box> moved;
  if (way.bounds) moved = box_of(stage.scene.moved_bounds());
  const gl::Texture& depth = shadow::shadow_map_target(stage.device, "shadow map", stage.projection);
  shadow::draw_shadow_map(stage.device, {.map = depth,
                                         .projection = stage.projection,
                                         .draw = draw,
                                         .moved = way.second_target ? map : nullptr,
                                         .moved_bounds = moved});
  if (map == nullptr) return;
  shadow::draw_movement(stage.device, {.map = *map,
                                       .form = way.form,
                                       .projection = stage.projection,
                                       .draw = draw,
                                       .depth = &depth,
                                       .moved = moved,
                                       .present_is_drawn = way.second_target});
}

int run(const std::filesystem::path& path, int frames) {
  const auto context = gl::make_context("auto");
  const auto timing = gl::device_info().software ? gl::Timers::Mode::finish : gl::Timers::Mode::query;
  scene::Scene scene = scene::read_gltf(path, image::image_decoder());
  const scene::Pose pose = scene::pose_at(scene, 0);
  const render::Setup setup = render::choose_setup(scene, pose);

  // One device for each variant, so that each has its own timer rows.
  struct Case {
    gl::Device device;
    scene::GpuScene scene;
    Case(gl::Timers::Mode timing, const scene::Scene& of) : device(gl::ShaderFiles(), timing), scene(device, of) {}
  };
  std::vector<std::unique_ptr<Case>> cases;
  for (size_t i = 0; i < ways.size(); ++i) cases.push_back(std::make_unique<Case>(timing, scene));
  for (int frame = 0; frame <= frames; ++frame) {  // the first compiles shaders and does not count
    for (size_t i = 0; i < ways.size(); ++i) {
      Case& own = *cases[i];
      own.scene.pose(own.device, 0.5 + (frame - 1) / 60.0, 0.5 + frame / 60.0);
      Stage stage{own.device, own.scene,
                  shadow::fit_cascades({.view = setup.camera.view,
                                        .projection = render::projection_of(setup.camera, 1280.0f / 720.0f),
                                        .to_light = setup.sun.to_light,
                                        .tan_half_angle = 0.0046f,
                                        .casters = box_of(own.scene.casters()),
                                        .receivers = box_of(own.scene.receivers())})};
      own.device.timers.begin_frame();
      draw(stage, ways[i]);
      own.device.timers.end_frame();
    }
  }
  for (size_t i = 0; i < ways.size(); ++i) {
    const gl::Device& device = cases[i]->device;
    fmt::print("{}\n", ways[i].name);
    for (const io::PassCost& cost : io::pass_costs(cases[i]->device.timers.rows(), static_cast<std::size_t>(frames)))
      fmt::print("  {:<20} {:8.2f} ms\n", cost.name, cost.median);
    if (ways[i].none) continue;
    const std::size_t bytes = device.target_bytes("maximum") + device.target_bytes("average");
    fmt::print("  memory, share of the shadow map's {:.1f} %\n",
               100.0 * static_cast<double>(bytes) / static_cast<double>(device.target_bytes("shadow map")));
  }
  fmt::print("{}, 4 cascades of 2048x2048, {}, medians of {}\n", path.filename().string(), gl::device_info().renderer,
             frames);
  return 0;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  try {
    return penumbra::run(argc > 1 ? argv[1] : PENUMBRA_ROOT "/scenes/moving.glb", argc > 2 ? std::atoi(argv[2]) : 15);
  } catch (const penumbra::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
