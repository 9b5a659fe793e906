#include "app/compare/draw.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "app/compare/figures.h"
#include "bench/times.h"
#include "render/renderer.h"

namespace penumbra::app {

namespace {

constexpr int usual_warmup = 32;  // e^-3 is left of what a history of the usual weight began with

// Nested passes are in the time of the one around them.
bool is_shadow_row(const std::string& name) {
  return name != "frame" && name.find('/') == std::string::npos && bench::is_shadow_pass(name);
}

// Of the last `frames` frames.
ShadowCost shadow_cost(gl::Timers& timers, std::size_t frames) {
  std::vector<double> sums(frames, 0.0);
  for (const gl::Timers::Row& row : timers.rows()) {
    if (!is_shadow_row(row.name)) continue;
    for (std::size_t i = 0; i < frames; ++i) sums[i] += row.milliseconds[row.milliseconds.size() - frames + i];
  }
  std::ranges::sort(sums);
  const std::size_t middle = frames / 2;
  const double median = frames % 2 != 0 ? sums[middle] : 0.5 * (sums[middle - 1] + sums[middle]);
  return {median, sums.front(), sums.back(), frames};
}

std::vector<std::uint8_t> receivers_of(const render::Renderer& renderer, const glm::vec3& to_light, double sun_angle) {
  const std::vector<float> normals = renderer.read_aov("geometric_normal");
  const auto least = static_cast<float>(std::sin(glm::radians(sun_angle) * 0.5));
  std::vector<std::uint8_t> receivers(normals.size() / 3);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const float cosine = glm::dot(glm::vec3(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), to_light);
    receivers[i] = cosine > least ? 1 : 0;
  }
  return receivers;
}

studio::FrameRange range_of(const CompareOptions& options) { return options.frames.value_or(studio::FrameRange{}); }

// A single picture of a technique that remembers is the one that it settles on.
int warmup_of(const CompareOptions& options, const ParamSet& params) {
  if (options.frames || !params.get_bool("history.reuse")) return 0;
  return options.warmup.value_or(usual_warmup);
}

// The frames that cost is taken from: all of a sequence but the first, which compiles shaders; a single picture is
// drawn again.
std::size_t measured_frames(const DrawnScene& scene, render::Renderer& renderer, const ParamSet& params) {
  const studio::FrameRange range = range_of(scene.options);
  if (range.count() > 1) return static_cast<std::size_t>(range.count() - 1);
  for (int i = 0; i < scene.options.cost_frames; ++i)
    renderer.draw(scene.scene, scene.path.frame(range.first, /* again= */ true), params);
  return static_cast<std::size_t>(scene.options.cost_frames);
}

std::vector<float> error_of(const std::vector<float>& visibility, const ReferenceFrame& reference) {
  std::vector<float> error(visibility.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (reference.receivers[i] != 0) error[i] = metrics::signed_error(visibility[i], reference.visibility[i]);
  }
  return error;
}

}  // namespace

std::vector<ReferenceFrame> draw_reference(const DrawnScene& scene, const ParamSet& params, ComparedPictures& last) {
  render::Renderer renderer(scene.device, scene.techniques);
  const studio::FrameRange range = range_of(scene.options);
  std::vector<ReferenceFrame> frames;
  for (int frame = range.first; frame <= range.last; ++frame) {
    const render::FrameInputs inputs = scene.path.frame(frame);
    renderer.draw(scene.scene, inputs, params);
    frames.push_back(
        {renderer.read_aov("shadow"), receivers_of(renderer, inputs.sun.to_light, params.get_float("sun.angle"))});
    scene.drawn();
  }
  last = {.display = renderer.read_display(), .visibility = frames.back().visibility, .error = {}};
  return frames;
}

ComparedTechnique draw_technique(const DrawnScene& scene, const Contender& contender, const ParamSet& params,
                                 const std::vector<ReferenceFrame>& reference) {
  // One of its own: what another technique left behind has no say, and its memory is gone.
  render::Renderer renderer(scene.device, scene.techniques);
  const studio::FrameRange range = range_of(scene.options);
  FigureSums sums(scene.options.size.width, scene.options.size.height);
  std::vector<float> visibility;
  for (int frame = range.first; frame <= range.last; ++frame) {
    renderer.draw(scene.scene, scene.path.frame(frame), params);
    for (int i = warmup_of(scene.options, params); i > 0; --i)
      renderer.draw(scene.scene, scene.path.frame(frame, /* again= */ true), params);
    visibility = renderer.read_aov("shadow");
    sums.add(visibility, reference[static_cast<std::size_t>(frame - range.first)], scene.path.cuts(frame));
    scene.drawn();
  }
  ComparedTechnique result{.label = contender.label, .params = params};
  result.pictures.display = renderer.read_display();
  result.pictures.error = error_of(visibility, reference.back());
  result.pictures.visibility = std::move(visibility);
  result.figures = sums.figures();
  result.target_bytes = scene.device.target_bytes("shadow ");
  result.cost = shadow_cost(scene.device.timers, measured_frames(scene, renderer, params));
  return result;
}

}  // namespace penumbra::app
