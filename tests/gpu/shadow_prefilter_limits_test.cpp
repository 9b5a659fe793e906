// Techniques that filter a map before it is compared, where their parameters are as large or small as they may be.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <variant>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

class PrefilterLimits : public TriangleTest {
 protected:
  ParamSet parameters(const std::string& technique) const {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("cascades.count", 1);
    params.set("cascades.size", 512);
    return params;
  }
};

void set_to_limit(ParamSet& params, const Param& param, bool most) {
  const double limit = most ? param.max : param.min;
  if (std::holds_alternative<std::string>(param.default_value))
    params.set(param.name, most ? param.choices.back() : param.choices.front());
  else if (std::holds_alternative<int>(param.default_value))
    params.set(param.name, static_cast<int>(limit));
  else if (std::holds_alternative<float>(param.default_value))
    params.set(param.name, static_cast<float>(limit));
  else
    params.set(param.name, most);
}

// Of a picture whose values are all shares.
double mean_share(const Shadowed& shadowed) {
  double sum = 0;
  for (const float visibility : shadowed.visibilities()) {
    EXPECT_TRUE(visibility >= 0 && visibility <= 1) << visibility;
    sum += static_cast<double>(visibility);
  }
  return sum / static_cast<double>(shadowed.width * shadowed.height);
}

// The ground under a half-plane on one side, or on the other: the kernel is as wide as the layer.
TriangleScene half_covered(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.add_quad(corner, u, v);
  scene.width = scene.height = 8;
  scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.1f, 0.1f, 0.1f, 2);
  scene.receivers = shadow::Box{{-4, 0, -4}, {4, 0, 4}};
  scene.casters = shadow::Box{{-4, 0, -4}, {4, 1, 4}};
  return scene;
}

TEST_F(PrefilterLimits, KernelsAsWideAsTheMapCountEveryTexel) {
  for (const std::string technique : {"vsm", "evsm", "msm", "esm", "csm_fourier"}) {
    ParamSet params = parameters(technique);
    params.set(technique + ".radius", 1000.0f);
    if (params.contains(technique + ".bleeding")) params.set(technique + ".bleeding", 0.0f);
    const auto mean = [&](const TriangleScene& scene) { return mean_share(renderer_->render(scene, params)); };
    const double left = mean(half_covered({-4, 1, -4}, {0, 0, 8}, {4, 0, 0}));
    const double right = mean(half_covered({0, 1, -4}, {0, 0, 8}, {4, 0, 0}));
    const double near = mean(half_covered({-4, 1, 0}, {0, 0, 4}, {8, 0, 0}));
    const double far = mean(half_covered({-4, 1, -4}, {0, 0, 4}, {8, 0, 0}));
    EXPECT_NEAR(left, right, 0.02) << technique;
    EXPECT_NEAR(near, far, 0.02) << technique;
    EXPECT_NEAR(left, near, 0.02) << technique;
  }
}

// The ground is at the map's far plane, whose warp has the largest square of all.
TEST_F(PrefilterLimits, TheLargestExponentsOverflowNothing) {
  TriangleScene scene = half_plane_over_ground(64);
  scene.projection = orthographic(0.5f, 0.5f, 0.1f, 5);
  for (const float radius : {0.25f, 1.0f}) {
    for (const float least : {0.0f, 10.0f}) {
      ParamSet params = parameters("evsm");
      params.set("evsm.radius", radius);
      params.set("evsm.warps", 1);
      params.set("evsm.least_deviation", least);
      const auto with = [&](float exponent) {
        params.set("evsm.positive", exponent);
        params.set("evsm.negative", exponent);
        return mean_share(renderer_->render(scene, params));
      };
      EXPECT_NEAR(with(42), with(39), 0.01) << "radius " << radius << ", least deviation " << least;
    }
  }
}

// One pixel shows the shadows of a whole fence. It shows no more if it is a hundred times as wide.
TEST_F(PrefilterLimits, PixelsWiderThanTheMapShowItsMean) {
  TriangleScene scene;
  scene.add_quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
  for (int i = 0; i < 200; ++i) scene.add_quad({-20 + 0.2f * static_cast<float>(i), 2, -20}, {0, 0, 40}, {0.1f, 0, 0});
  scene.width = scene.height = 1;
  scene.view = glm::lookAt(glm::vec3(0, 1, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  for (const std::string technique : {"vsm", "evsm", "msm"}) {
    const auto mean = [&](float half_width) {
      scene.projection = orthographic(half_width, half_width, 0.1f, 2);
      return mean_share(renderer_->render(scene, parameters(technique)));
    };
    const double whole = mean(50);
    EXPECT_TRUE(whole > 0.3 && whole < 0.9) << technique << ": " << whole;
    EXPECT_NEAR(mean(5000), whole, 0.01) << technique;
  }
}

TEST_F(PrefilterLimits, EveryParameterAtItsLimitsGivesShares) {
  const TriangleScene scene = box_on_ground(32);
  for (const std::string technique : {"vsm", "evsm", "msm", "esm", "csm_fourier", "cssm", "vssm", "ssss"}) {
    const ParamSet defaults = parameters(technique);
    const double usual = mean_share(renderer_->render(scene, defaults));
    ASSERT_TRUE(usual > 0.2 && usual < 1) << technique;
    for (const Param& param : renderer_->shadows().registry().params()) {
      if (!param.name.starts_with(technique + ".")) continue;
      SCOPED_TRACE(param.name);
      for (const bool most : {false, true}) {
        ParamSet params = defaults;
        set_to_limit(params, param, most);
        mean_share(renderer_->render(scene, params));
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test
