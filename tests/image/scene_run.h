#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "scene/scene.h"
#include "truth/technique.h"

namespace penumbra::test {

// A frame's visibility, rows top to bottom; -1 for the sky.
using Visibility = std::vector<float>;

// A scene of scenes/ that is drawn frame by frame by a technique under test and by brute_force, whose pictures it is
// compared with.
class SceneRun {
 public:
  SceneRun(const std::string& scene, int width, int height, const std::string& camera = {});

  // What the technique under test is: a technique or a preset.
  void choose(const std::string& technique);
  ParamSet& params() { return params_; }

  // Draws the next frame, with the history of the last one unless `cut`.
  Visibility draw(bool cut = false);
  // The same frame by brute_force, or by `truth` with so many rays a pixel.
  Visibility draw_reference();
  Visibility draw_truth(int rays);
  std::vector<float> read_aov(const char* name) const { return renderer_.read_aov(name); }

  // Whether each pixel of the last draw_reference() or draw_truth() shows a receiver (docs/metrics.md).
  std::vector<std::uint8_t> receivers() const;

  // What the last draw_truth() traced.
  const truth::TruthTechnique::Last& traced() const { return truth_.last(); }
  // Under a mask of the last draw_reference() or draw_truth().
  std::vector<float> read_reference_aov(const char* name) const { return reference_.read_aov(name); }

  // Of the next frame.
  render::Camera& camera() { return setup_.camera; }
  render::SunLight& sun() { return setup_.sun; }
  // In place of the sun; only draw() knows it.
  void shine(const render::FrameLight& light) { light_ = light; }
  // Whether the mask has more than visibility; it has by default.
  void set_details(bool details) { details_ = details; }
  double& time() { return time_; }

  int width() const { return width_; }
  gl::Device& device() { return device_; }

 private:
  Visibility picture_of(const render::Renderer& renderer) const;
  Visibility draw_by(const char* technique, const ParamSet& params);
  ParamSet reference_params() const;
  render::FrameInputs inputs(bool cut) const;

  int width_, height_;
  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  scene::Scene scene_;
  render::Setup setup_;
  std::optional<scene::GpuScene> gpu_scene_;
  truth::TruthTechnique truth_{{.cache = {}}};
  render::Renderer renderer_{device_, truth_.registry()}, reference_{device_, truth_.registry()};
  ParamSet params_{render::Renderer::params(renderer_.registry())};
  double time_ = 0, last_time_ = 0;
  render::Camera last_camera_;
  std::optional<render::FrameLight> light_;
  bool details_ = true;
  bool drawn_ = false;
};

// Receivers in the penumbra: those whose reference lies between 0.02 and 0.98.
std::vector<std::size_t> penumbra_of(const Visibility& reference);
double rmse(const Visibility& picture, const Visibility& reference, const std::vector<std::size_t>& pixels);
double mean_error(const Visibility& picture, const Visibility& reference, const std::vector<std::size_t>& pixels);
double decibels(double rmse);

}  // namespace penumbra::test
