#include "app/compare/comparison.h"

#include <functional>
#include <future>
#include <memory>
#include <numeric>
#include <utility>

#include "app/compare/draw.h"
#include "app/techniques.h"
#include "image/read.h"
#include "render/renderer.h"
#include "studio/progress.h"
#include "studio/stage.h"
#include "studio/studio.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

// All that draws, for all scenes. Members are in the order of their making: what is made last goes first.
struct Machine {
  std::unique_ptr<gl::Context> context;
  gl::DeviceInfo info;
  truth::TruthTechnique truth;
  shadow::Registry techniques;
  gl::Device device;

  Machine(const CompareOptions& options, std::unique_ptr<gl::Context> opened)
      : context(std::move(opened)),
        info(gl::device_info()),
        truth({.cache = options.reference == "truth" ? options.folder() : std::filesystem::path(),
               .threads = options.threads.value_or(0)}),
        techniques(truth.registry()),
        device(gl::ShaderFiles(options.glsl), info.software ? gl::Timers::Mode::finish : gl::Timers::Mode::query) {}
};

ComparedScene compare_scene(const CompareOptions& options, const studio::Stage& stage, Machine& machine,
                            const Comparison& comparison, const std::vector<ParamSet>& params,
                            const std::function<void()>& drawn) {
  scene::GpuScene scene(machine.device, stage.scene);
  const CameraPath path(options, stage);
  const DrawnScene common{options, machine.device, machine.techniques, scene, path, drawn};
  ComparedScene result{.path = options.scene};
  const std::vector<ReferenceFrame> reference = draw_reference(common, comparison.reference_params, result.reference);
  const std::vector<std::uint8_t>& receivers = reference.back().receivers;
  result.pixels = receivers.size();
  result.receivers = std::accumulate(receivers.begin(), receivers.end(), std::size_t{0});
  for (std::size_t i = 0; i < params.size(); ++i)
    result.techniques.push_back(draw_technique(common, options.contenders[i], params[i], reference));
  return result;
}

}  // namespace

Comparison compare(const CompareOptions& options) {
  Comparison comparison;
  std::vector<ParamSet> params;
  for (const Contender& contender : options.contenders)
    params.push_back(params_of(options, contender, all_techniques()));
  comparison.reference_params = reference_params(options, all_techniques());

  // Drivers take as long to start as scenes to load, and there are two cores nearly everywhere.
  std::vector<CompareOptions> of_scenes(options.scenes.size(), options);
  for (std::size_t i = 0; i < of_scenes.size(); ++i) of_scenes[i].scene = options.scenes[i];
  const auto load = [](const CompareOptions& one) { return studio::load_stage(one, image::image_decoder()); };
  std::future<studio::Stage> loading = std::async(std::launch::async, load, std::cref(of_scenes.front()));
  std::unique_ptr<gl::Context> context = studio::open_context(options, options);
  Machine machine(options, std::move(context));
  comparison.device = machine.info;
  comparison.backend = gl::to_string(machine.context->backend());

  const std::size_t drawings = options.scenes.size() * (params.size() + 1);
  const int frames = options.frames ? options.frames->count() : 1;
  studio::Progress progress("picture", static_cast<int>(drawings) * frames, !options.quiet);
  const std::function<void()> drawn = [&progress] { progress.step(); };
  for (std::size_t i = 0; i < of_scenes.size(); ++i) {
    const studio::Stage stage = i == 0 ? loading.get() : load(of_scenes[i]);
    comparison.scenes.push_back(compare_scene(of_scenes[i], stage, machine, comparison, params, drawn));
  }
  return comparison;
}

}  // namespace penumbra::app
