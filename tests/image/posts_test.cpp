// scenes/posts.glb: one penumbra at all distances. Its width must not depend on cascades, map size or the scene's
// bounds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "render/renderer.h"
#include "scene/gltf.h"

namespace penumbra::test {
namespace {

constexpr float sun_angle = 2.5f;
constexpr float edge_x = -1.225261f;  // of the bars' shadows on the ground
constexpr int width = 320;
constexpr int height = 216;

// The penumbra's radius across x, on the ground, of an edge at 3 m under a sun at 40 degrees.
double ground_radius() {
  const double sine = std::sin(glm::radians(40.0));
  return std::tan(glm::radians(sun_angle / 2.0)) * 3 / (sine * sine);
}

// x on the ground under a pixel's centre, rows from the top.
double ground_x(const render::Camera& camera, int x, int y) {
  const glm::dmat4 to_world = glm::inverse(glm::dmat4(camera.view));
  const double half = std::tan(camera.fov_y / 2);
  const glm::dvec3 ray((2 * (x + 0.5) / width - 1) * half * width / height, (1 - 2 * (y + 0.5) / height) * half, -1);
  const glm::dvec3 eye(to_world[3]);
  const glm::dvec3 direction = glm::dmat3(to_world) * ray;
  return (eye - direction * (eye.y / direction.y)).x;
}

// Mean visibility by distance across the edge, in bins over ±1.3 radii.
std::vector<double> profile_of(const render::Camera& camera, const std::vector<float>& shadow) {
  constexpr size_t bins = 80;
  std::vector<double> sum(bins, 0.0), count(bins, 0.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double t = (ground_x(camera, x, y) - edge_x) / ground_radius();
      const double bin = std::floor((t + 1.3) / 2.6 * bins);
      if (bin < 0 || bin >= static_cast<double>(bins)) continue;
      sum[static_cast<size_t>(bin)] += shadow[static_cast<size_t>(y * width + x)];
      count[static_cast<size_t>(bin)] += 1;
    }
  }
  for (size_t i = 0; i < bins; ++i) sum[i] /= count[i];
  return sum;
}

// Distance over which the profile passes from 10 to 90 % of light, metres; the far edge's shadow lies at greater x.
double width_10_90(std::vector<double> profile) {
  if (profile.front() > profile.back()) std::reverse(profile.begin(), profile.end());
  const auto crossing = [&](double level) {
    for (size_t i = 1; i < profile.size(); ++i) {
      if (profile[i - 1] < level && profile[i] >= level) {
        return static_cast<double>(i - 1) + (level - profile[i - 1]) / (profile[i] - profile[i - 1]);
      }
    }
    return std::nan("");
  };
  return (crossing(0.9) - crossing(0.1)) * 2.6 * ground_radius() / static_cast<double>(profile.size());
}

class Posts : public GpuTest {
 protected:
  Posts() : device_(gl::ShaderFiles(), gl::Timers::Mode::off), renderer_(device_) {}

  struct Measured {
    double width = 0;
    double kernel_texels = 0;
  };

  Measured measure(scene::GpuScene& gpu_scene, const render::Setup& setup, int cascades, int size) {
    ParamSet params(render::Renderer::params(renderer_.registry()));
    params.set("sun.angle", sun_angle);
    params.set("pcss.blocker_taps", 64);
    params.set("pcss.filter_taps", 64);
    params.set("cascades.count", cascades);
    params.set("cascades.size", size);
    const render::Frame& frame = renderer_.draw(gpu_scene,
                                                {.width = width,
                                                 .height = height,
                                                 .camera = setup.camera,
                                                 .last_camera = setup.camera,
                                                 .lights = {setup.sun},
                                                 .mask_details = true},
                                                params);
    const std::vector<float> cascade = renderer_.read_aov("cascade");
    const int coarsest = static_cast<int>(*std::max_element(cascade.begin(), cascade.end()));
    const float radius = std::tan(glm::radians(sun_angle / 2)) * 3 / std::sin(glm::radians(40.0f));
    return {width_10_90(profile_of(setup.camera, renderer_.read_aov("shadow"))),
            radius / frame.mask.lights[0].projection.cascades().texel(std::clamp(coarsest, 0, cascades - 1)).x};
  }

  gl::Device device_;
  render::Renderer renderer_;
};

// A copy of a post far behind the camera, which only widens the bounds.
void add_far_object(scene::Scene& scene) {
  const auto post =
      std::find_if(scene.nodes.begin(), scene.nodes.end(), [](const scene::Node& n) { return n.mesh >= 0; });
  scene::Node copy = *post;
  copy.parent = -1;
  copy.children.clear();
  copy.matrix.reset();
  copy.transform.translation = {0, 0, 2500};
  scene.nodes.push_back(std::move(copy));
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
}

// From one eye over the ground, at the middle of a post's far edge; the picture shows 0.6 m across.
render::Setup setup_at(const scene::Scene& scene, float z) {
  render::Setup setup = render::choose_setup(scene, scene::pose_at(scene, 0));
  const glm::vec3 eye{edge_x, 12, 4};
  const glm::vec3 target{edge_x, 0, z};
  const float half = 0.3f * height / width / glm::length(target - eye);
  setup.camera = render::look_at(eye, target, 2 * std::atan(half), 0.1f);
  return setup;
}

TEST_F(Posts, PenumbraWidthIsTheSameForEveryCascadeCountMapSizeAndBounds) {
  scene::Scene near = scene::read_gltf(PENUMBRA_ROOT "/scenes/posts.glb", image::image_decoder());
  scene::Scene far = near;
  add_far_object(far);
  scene::GpuScene near_gpu(device_, near);
  scene::GpuScene far_gpu(device_, far);
  int all = 0;
  int qualified = 0;
  for (const float z : {-6.0f, -16.31f, -30.044f}) {
    const render::Setup setup = setup_at(near, z);
    double least = 1e9;
    double greatest = 0;
    for (const int cascades : {1, 2, 4, 8}) {
      for (const int size : {1024, 2048, 4096}) {
        if (cascades == 8 && size == 4096) continue;  // would take as long as all others
        for (scene::GpuScene* scene : {&near_gpu, &far_gpu}) {
          const Measured measured = measure(*scene, setup, cascades, size);
          ++all;
          if (measured.kernel_texels < 4) continue;
          ++qualified;
          ASSERT_TRUE(std::isfinite(measured.width)) << z << " m, " << cascades << " cascades of " << size;
          least = std::min(least, measured.width);
          greatest = std::max(greatest, measured.width);
        }
      }
    }
    EXPECT_LE(greatest / least, 1.03) << "post at " << z << " m: from " << least << " to " << greatest << " m";
    // 10 to 90 % of a disc's penumbra is 0.687 of its full width.
    EXPECT_NEAR(least / (1.374 * ground_radius()), 1, 0.06) << "post at " << z << " m";
  }
  EXPECT_GE(2 * qualified, all) << "too few cases have a kernel of 4 texels";
}

}  // namespace
}  // namespace penumbra::test
