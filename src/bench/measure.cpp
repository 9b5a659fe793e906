#include "bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/caster_grid.h"
#include "cli/command_line.h"
#include "cli/input_files.h"
#include "cli/no_effect.h"
#include "cli/progress.h"
#include "core/error.h"
#include "gl/api.h"
#include "scene/pose.h"
#include "session/prepared_scene.h"

namespace penumbra::bench {

namespace {

using Contenders = std::vector<std::unique_ptr<Contender>>;

// What is measured of one entry at one point, over all visits.
struct Kept {
  PassTimes own, floor;
};

// The frames of a visit to a point, one after the other.
class FrameClock {
 public:
  FrameClock(const Options& options, const session::PreparedScene& prepared, const cli::Size& size)
      : options_(options), prepared_(prepared), size_(size) {}

  render::FrameInputs next() {
    constexpr double rate = 60;  // frames a second
    const double last = options_.time + (options_.play ? std::max(frame_ - 1, 0) / rate : 0);
    const double now = options_.time + (options_.play ? frame_ / rate : 0);
    return session::frame_inputs(prepared_, size_, {.time = now, .last_time = last, .cut = frame_++ == 0});
  }

 private:
  const Options& options_;
  const session::PreparedScene& prepared_;
  cli::Size size_;
  int frame_ = 0;
};

class Bench {
 public:
  Bench(const Options& options, const scene::ImageDecoder& decode, const shadow::Registry& registry)
      : options_(options), decode_(decode), registry_(registry), device_(gl::device_info()) {
    results_.entries = entries_of(options, registry);
    if (options.sweep == "casters" && !options.scene.empty()) {
      model_ = cli::read_scene(options.scene, options.reading, decode);
      session::check_extent(*model_, options.time);
    }
    results_.sweep = make_sweep(options.sweep, limits());
    results_.frames = frame_counts(options, device_.software);
    for (const Point& point : results_.sweep.points) {
      for (const Entry& entry : results_.entries) params_at(point, entry.params);  // throws before minutes are spent
    }
  }

  const Sweep& sweep() const { return results_.sweep; }

  Results run(const std::optional<OnePoint>& only) {
    describe();
    if (only) keep(*only);
    told_lights_ = only.has_value();  // when the work was planned
    kept_.assign(results_.sweep.points.size(), std::vector<Kept>(results_.entries.size()));
    results_.points.resize(results_.sweep.points.size());
    const int visits = visit_count();
    const int points = static_cast<int>(results_.sweep.points.size());
    cli::Progress progress("frame", points * (results_.frames.measured + visits * results_.frames.warmup),
                           !options_.quiet);
    for (int visit = 0; visit < visits; ++visit) {
      for (std::size_t i = 0; i < results_.sweep.points.size(); ++i) {
        const int measured = results_.frames.measured / visits + (visit < results_.frames.measured % visits ? 1 : 0);
        visit_point(i, measured, progress);
      }
    }
    if (!only) fit_models(results_);
    return std::move(results_);
  }

 private:
  SweepLimits limits() const {
    SweepLimits limits{.software = device_.software, .size = options_.size, .cascades = 1};
    gl::glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.max_texture);
    for (const Entry& entry : results_.entries)
      limits.cascades = std::max(limits.cascades, entry.params.get_int("cascades.count"));
    if (model_) limits.own_triangles = drawn_triangles(*model_);
    if (options_.sweep == "lights" || is_of_suns(options_.sweep)) {
      const render::Setup setup = session::load_scene(options_, decode_).setup;
      limits.lights = static_cast<int>(render::shadowed_lights(setup).size());
      limits.sun = setup.sun_shines;
    }
    return limits;
  }

  void keep(const OnePoint& only) {
    std::vector<Point>& points = results_.sweep.points;
    if (points.size() != only.of)
      fail("on this device the sweep has {} points, but {} were planned: plan on a device of the same kind",
           points.size(), only.of);
    points = {points[only.index]};
  }

  // Points are measured alternately, so that a machine that slows down during the run slows all of them alike. Where
  // each point needs its own scene they are measured one after the other, to build each scene once.
  int visit_count() const {
    constexpr int most = 4;
    const Sweep& sweep = results_.sweep;
    return sweep.axes.empty() || sweep.points.front().triangles ? 1 : std::min(results_.frames.measured, most);
  }

  void describe() {
    results_.version = cli::version();
    results_.commit = commit();
    results_.command = options_.command;
    results_.machine = machine();
    results_.threads = options_.threads;
    results_.device = device_;
    results_.timing = timing();
  }

  std::string timing() const {
    if (!device_.software) return "GPU timestamps, read some frames later";
    return fmt::format("CPU clock, a finish around each {}", options_.whole_frames ? "frame" : "pass");
  }

  // Scenes stay loaded between visits, unless each point has its own scene.
  void prepare(const Point& point) {
    if (prepared_ && !point.triangles) return;
    contenders_.clear();
    prepared_.emplace(scene_at(point));
    const cli::LightKinds lights = session::kinds_of_light(*prepared_);
    if (!std::exchange(told_lights_, true)) cli::warn_without_lights(options_, options_, lights);
    results_.sun = lights.sun;
    const cli::InputFiles inputs = inputs_of(options_, prepared_->scene.files);
    for (const std::string& output : options_.outputs) inputs.check("-o", output);
    results_.scene = options_.scene.empty() ? "generated grid of casters"
                                            : std::filesystem::path(options_.scene).filename().string();
    for (const Entry& entry : results_.entries)
      contenders_.push_back(
          std::make_unique<Contender>(entry, registry_, prepared_->scene, options_,
                                      Measuring{.passes = !options_.whole_frames, .floor = options_.floor}));
  }

  session::PreparedScene scene_at(const Point& point) const {
    if (!point.triangles) return session::load_scene(options_, decode_);
    return session::prepare_scene(model_ ? repeated(*model_, *point.triangles) : caster_grid(*point.triangles),
                                  options_);
  }

  void visit_point(std::size_t index, int measured, cli::Progress& progress) {
    const Point& point = results_.sweep.points[index];
    prepare(point);
    const cli::Size size = point.size.value_or(options_.size);
    std::vector<ParamSet> params;
    for (const Entry& entry : results_.entries) params.push_back(params_at(point, entry.params));
    FrameClock clock(options_, *prepared_, size);
    for (int i = 0; i < results_.frames.warmup + measured; ++i) {
      render::FrameInputs inputs = clock.next();
      if (point.lights) {
        inputs.lights.resize(static_cast<std::size_t>(*point.lights));
        inputs.light_ids.resize(inputs.lights.size());
        inputs.light_names.resize(inputs.lights.size());
      }
      for (std::size_t c = 0; c < contenders_.size(); ++c) contenders_[c]->draw(inputs, params[c]);
      progress.step();
    }
    for (std::size_t c = 0; c < contenders_.size(); ++c) {
      Kept& kept = kept_[index][c];
      contenders_[c]->keep(kept.own, kept.floor, static_cast<std::size_t>(measured));
    }
    sum_up(index, size);
  }

  void sum_up(std::size_t index, const cli::Size& size) {
    Measured& point = results_.points[index];
    point = {.point = results_.sweep.points[index], .size = size, .triangles = drawn_triangles(prepared_->scene)};
    for (std::size_t c = 0; c < contenders_.size(); ++c) {
      const Kept& kept = kept_[index][c];
      Cost cost = cost_of(kept.own, kept_[index].front().own);
      cost.label = results_.entries[c].label;
      const std::string& pass = results_.sweep.pass;
      cost.swept = pass.empty() ? cost.shadow : summary_of(kept.own.of(pass));
      cost.shadow_bytes = contenders_[c]->shadow_bytes();
      cost.floor = contenders_[c]->floor_cost(kept.own, kept.floor);
      point.costs.push_back(std::move(cost));
    }
  }

  const Options& options_;
  const scene::ImageDecoder& decode_;
  const shadow::Registry& registry_;
  gl::DeviceInfo device_;
  Results results_;
  std::optional<scene::Scene> model_;  // the scene that a sweep of casters copies
  std::optional<session::PreparedScene> prepared_;
  bool told_lights_ = false;             // warned of settings for lights that the scene lacks
  Contenders contenders_;                // destroyed before the scenes that they draw
  std::vector<std::vector<Kept>> kept_;  // by point, by entry
};

}  // namespace

Results measure(const Options& options, const scene::ImageDecoder& decode, const shadow::Registry& registry,
                const std::optional<OnePoint>& only) {
  return Bench(options, decode, registry).run(only);
}

Sweep sweep_of(const Options& options, const scene::ImageDecoder& decode, const shadow::Registry& registry) {
  return Bench(options, decode, registry).sweep();
}

void fit_models(Results& results) {
  if (results.points.size() < results.sweep.axes.size() + 2 || results.sweep.axes.empty()) return;
  for (std::size_t c = 0; c < results.entries.size(); ++c) {
    std::vector<std::vector<double>> xs;
    std::vector<double> ys;
    for (const Measured& point : results.points) {
      xs.push_back(point.point.at);
      ys.push_back(point.costs[c].swept.median);
    }
    try {
      results.models.push_back({results.entries[c].label, fit_linear(xs, ys)});
    } catch (const Error&) {
      return;  // what was measured is worth writing without a model
    }
  }
}

}  // namespace penumbra::bench
