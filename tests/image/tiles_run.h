#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gpu_scene.h"
#include "scene/scene.h"

namespace penumbra::test {

// Draws masks of scenes, and knows which pixels were decided tile by tile.
class TilesTest : public GpuTest {
 protected:
  TilesTest();

  void load(const std::string& name, int width, int height);

  // The visibility of the first light.
  std::vector<float> mask(render::Renderer& renderer, const std::string& technique, float angle, bool tiles);

  // All values of the layers of the last mask.
  std::vector<std::vector<float>> layers() const;

  // What the mask tells of each pixel.
  static constexpr std::array aovs{"shadow", "penumbra", "blocker", "cascade", "under_texel"};
  std::vector<std::vector<float>> read_all(std::span<const char* const> names) const;

  // Expects decided pixels to have the visibility that the technique computes for them, with a slack for the few that
  // the technique itself darkens by texels of their own surface. Returns the share of decided pixels.
  double expect_no_penumbra_is_missed(const std::string& technique, float angle);

 private:
  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};

 protected:
  render::Renderer renderer_{device_}, marks_renderer_;
  std::vector<std::string> settings_;       // "name=value"
  std::vector<render::FrameLight> lights_;  // none: the scene's sun

  const render::Setup& setup() const { return setup_; }

 private:
  int width_ = 0, height_ = 0;
  scene::Scene scene_;
  render::Setup setup_;
  std::optional<scene::GpuScene> gpu_scene_;
  render::Frame drawn_;
};

}  // namespace penumbra::test
