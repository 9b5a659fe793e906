// What presets cost, pass by pass, in one run: frames of each alternate, each with a history of its own.
//   presets [SCENE.glb] [FRAMES] [PRESET...]
// The shadow passes are all from the shadow mask to the filtered one; maps are the same for all and not among them.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "image/read.h"
#include "render/renderer.h"
#include "scene/gltf.h"

namespace penumbra {
namespace {

constexpr std::array shadow_passes{"shadow mask", "median", "shadow history", "filter", "unpack"};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

// A device for each preset keeps their timers, programs and histories apart.
struct Run {
  Run(const std::string& name, const scene::Scene& scene, gl::Timers::Mode timing)
      : preset(name), device(gl::ShaderFiles(), timing), gpu_scene(device, scene), renderer(device) {
    renderer.registry().select(params, preset);
  }

  std::string preset;
  gl::Device device;
  scene::GpuScene gpu_scene;
  render::Renderer renderer;
  ParamSet params{render::Renderer::params(renderer.registry())};
};

// Milliseconds of each shadow pass, a median, the first frames of `warm_up` left out; the last is their sum.
std::vector<double> costs_of(Run& run, std::size_t warm_up) {
  std::vector<double> costs;
  for (const char* pass : shadow_passes) {
    costs.push_back(0);
    for (const gl::Timers::Row& row : run.device.timers.rows()) {
      if (row.name != pass) continue;
      const auto& all = row.milliseconds;
      costs.back() = median({all.begin() + static_cast<std::ptrdiff_t>(std::min(warm_up, all.size())), all.end()});
    }
  }
  double sum = 0;
  for (const double cost : costs) sum += cost;
  costs.push_back(sum);
  return costs;
}

int run(const std::filesystem::path& path, int frames, const std::vector<std::string>& presets) {
  const auto context = gl::make_context("auto");
  const auto timing = gl::device_info().software ? gl::Timers::Mode::finish : gl::Timers::Mode::query;
  scene::Scene scene = scene::read_gltf(path, image::image_decoder());
  const scene::Pose pose = scene::pose_at(scene, 0);
  const render::Setup setup = render::choose_setup(scene, pose);
  if (setup.ground) render::add_ground(scene, scene::bounds_of(scene, pose));
  const render::FrameInputs frame{.camera = setup.camera, .last_camera = setup.camera, .sun = setup.sun};

  std::vector<std::unique_ptr<Run>> runs;
  for (const std::string& preset : presets) runs.push_back(std::make_unique<Run>(preset, scene, timing));
  constexpr std::size_t warm_up = 2;
  for (int i = 0; i < frames + static_cast<int>(warm_up); ++i) {
    for (const std::unique_ptr<Run>& each : runs) each->renderer.draw(each->gpu_scene, frame, each->params);
  }

  fmt::print("{}, {}x{}, 4 cascades of 2048x2048, {}; ms, medians of {}\n", path.filename().string(), frame.width,
             frame.height, gl::device_info().renderer, frames);
  fmt::print("{:22}", "preset");
  for (const char* pass : shadow_passes) fmt::print("{:>16}", pass);
  fmt::print("{:>16}{:>16}\n", "shadow passes", "of the first");
  double first = 0;
  for (const std::unique_ptr<Run>& each : runs) {
    fmt::print("{:22}", each->preset);
    const std::vector<double> costs = costs_of(*each, warm_up);
    for (const double cost : costs) fmt::print("{:16.2f}", cost);
    if (first == 0) first = costs.back();
    fmt::print("{:>15.1f}x\n", first / costs.back());
  }
  return 0;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  std::vector<std::string> presets(argv + std::min(argc, 3), argv + argc);
  if (presets.empty()) {
    presets = {"brute_force", "brute_force_compute", "thesis_8x8", "thesis_8x8_compute", "thesis", "thesis_compute"};
  }
  try {
    return penumbra::run(argc > 1 ? argv[1] : PENUMBRA_ROOT "/scenes/thesis.glb", argc > 2 ? std::atoi(argv[2]) : 5,
                         presets);
  } catch (const penumbra::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
