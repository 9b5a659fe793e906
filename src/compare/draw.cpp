#include "compare/draw.h"

#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "bench/times.h"
#include "compare/figures.h"
#include "compare/pictures.h"
#include "image/packed.h"
#include "render/receivers.h"
#include "render/renderer.h"

namespace penumbra::compare {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int usual_warmup = 32;  // with the default history weight, e^-3 of the first frame is left after these
constexpr int usual_cost_frames = 3;

// The cost over `frames`, which are indices of the device's timed frames.
ShadowCost shadow_cost(gl::Timers& timers, const std::vector<std::size_t>& frames) {
  const bench::Summary summary = bench::summary_of(bench::PassTimes::of_frames(timers.rows(), frames).shadow_sums());
  return {summary.median, summary.min, summary.max, summary.count};
}

cli::FrameRange range_of(const CompareOptions& options) { return options.frames.value_or(cli::FrameRange{}); }

std::vector<float> error_of(const std::vector<float>& visibility, const ReferenceFrame& reference) {
  std::vector<float> error(visibility.size(), static_cast<float>(none));
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (reference.receivers[i] != 0) error[i] = metrics::signed_error(visibility[i], reference.visibility[i]);
  }
  return error;
}

std::size_t frames_drawn(gl::Timers& timers) {
  const std::vector<gl::Timers::Row> rows = timers.rows();
  return rows.empty() ? 0 : rows.back().milliseconds.size();
}

// The state of one contender. Each has its own renderer, so that no history is shared.
struct ContenderRun {
  ContenderRun(const DrawnScene& scene, const std::string& name, const ParamSet& own)
      : label(name), params(own), renderer(scene.device, scene.techniques), sums(scene.options.size, scene.lights) {}

  const std::string& label;
  const ParamSet& params;
  render::Renderer renderer;
  FigureSums sums;
  ComparedPictures pictures;
  std::vector<std::size_t> timed;  // the device's frames that its cost is taken from
  std::size_t shadow_bytes = 0;
};

class PartRuns {
 public:
  PartRuns(const DrawnScene& scene, const Part& part, const std::vector<ParamSet>& params,
           const std::vector<ReferenceFrame>& reference)
      : scene_(scene),
        part_(part),
        params_(params),
        reference_(reference),
        range_(range_of(scene.options)),
        frames_drawn_(frames_drawn(scene.device.timers)) {
    // Programs that were deleted between two frames of a contender would be compiled again in a timed one.
    scene.device.shaders.keep_idle(std::numeric_limits<std::size_t>::max());
  }

  // One contender after the other: only one of them has textures at any time.
  std::vector<ComparedTechnique> untimed() {
    std::vector<ComparedTechnique> results;
    for (std::size_t i = 0; i < part_.count; ++i) {
      const std::unique_ptr<ContenderRun> run = start(i);
      for (int frame = range_.first; frame <= range_.last; ++frame) measure(*run, frame);
      results.push_back(result_of(*run, {.median = none, .min = none, .max = none}));
    }
    return results;
  }

  // In turn, frame by frame. A sequence's cost is that of all its frames but the first, which compiles shaders; a
  // single picture is drawn again.
  std::vector<ComparedTechnique> timed() {
    std::vector<std::unique_ptr<ContenderRun>> runs;
    for (std::size_t i = 0; i < part_.count; ++i) runs.push_back(start(i));
    for (int frame = range_.first; frame <= range_.last; ++frame) {
      for (const auto& run : runs) measure(*run, frame);
    }
    for (int i = cost_frames_of(scene_.options); i > 0; --i) {
      for (const auto& run : runs) draw(*run, scene_.path.frame(range_.first, /* again= */ true), /* timed= */ true);
    }
    std::vector<ComparedTechnique> results;
    for (const auto& run : runs) results.push_back(result_of(*run, shadow_cost(scene_.device.timers, run->timed)));
    return results;
  }

 private:
  std::unique_ptr<ContenderRun> start(std::size_t i) const {
    return std::make_unique<ContenderRun>(scene_, scene_.options.contenders[part_.first + i].label,
                                          params_[part_.first + i]);
  }

  static ComparedTechnique result_of(ContenderRun& run, const ShadowCost& cost) {
    return {.label = run.label,
            .params = &run.params,
            .cost = cost,
            .shadow_bytes = run.shadow_bytes,
            .figures = run.sums.figures(),
            .pictures = std::move(run.pictures)};
  }

  void draw(ContenderRun& run, const render::FrameInputs& inputs, bool timed) {
    const std::size_t before = scene_.device.target_bytes("shadow ");
    run.renderer.draw(scene_.scene, inputs, run.params);
    run.shadow_bytes += scene_.device.target_bytes("shadow ") - before;
    if (timed) run.timed.push_back(frames_drawn_);
    ++frames_drawn_;
  }

  void measure(ContenderRun& run, int frame) {
    draw(run, scene_.path.frame(frame), /* timed= */ frame > range_.first);
    for (int i = warmup_of(scene_.options, run.params); i > 0; --i)
      draw(run, scene_.path.frame(frame, /* again= */ true), /* timed= */ false);
    const std::vector<float> visibility = run.renderer.read_visibilities();
    const ReferenceFrame& reference = reference_[static_cast<std::size_t>(frame - range_.first)];
    run.sums.add(visibility, reference, scene_.path.cuts(frame));
    if (frame == range_.last) {
      run.pictures = encoded_pictures(run.renderer.read_display(), visibility, scene_.options.size);
      run.pictures.error = image::pack_floats(error_of(visibility, reference));
    }
    scene_.drawn();
  }

  const DrawnScene& scene_;
  const Part& part_;
  const std::vector<ParamSet>& params_;
  const std::vector<ReferenceFrame>& reference_;
  cli::FrameRange range_;
  std::size_t frames_drawn_;  // by the device
};

}  // namespace

int warmup_of(const CompareOptions& options, const ParamSet& params) {
  if (options.frames || !params.get_bool("history.reuse")) return 0;
  return options.warmup.value_or(usual_warmup);
}

int cost_frames_of(const CompareOptions& options) {
  if (options.no_cost || range_of(options).count() > 1) return 0;
  return options.cost_frames.value_or(usual_cost_frames);
}

std::vector<ReferenceFrame> draw_reference(const DrawnScene& scene, const ParamSet& params, ComparedPictures& last) {
  render::Renderer renderer(scene.device, scene.techniques);
  const cli::FrameRange range = range_of(scene.options);
  std::vector<ReferenceFrame> frames;
  for (int frame = range.first; frame <= range.last; ++frame) {
    renderer.draw(scene.scene, scene.path.frame(frame), params);
    frames.push_back({renderer.read_visibilities(), render::receivers_of(renderer, scene.path.lights(frame), params)});
    scene.drawn();
  }
  last = encoded_pictures(renderer.read_display(), frames.back().visibility, scene.options.size);
  return frames;
}

std::vector<ComparedTechnique> draw_techniques(const DrawnScene& scene, const Part& part,
                                               const std::vector<ParamSet>& params,
                                               const std::vector<ReferenceFrame>& reference) {
  PartRuns runs(scene, part, params, reference);
  return scene.options.no_cost ? runs.untimed() : runs.timed();
}

}  // namespace penumbra::compare
