// Filters of a constant radius under a lamp, whose maps have smaller texels for nearer receivers.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/lamp_screens.h"
#include "shadow/soft_shadows.h"

namespace penumbra::test {
namespace {

constexpr float radius = 0.1f;  // of the kernels, metres

// A spot with one map, whose texels are those of a cube's face: a cube takes six times as long to filter.
const shadow::Lamp one_face{.radius = 0, .axis = {0, -1, 0}, .cone = glm::pi<float>() / 4};
const shadow::Lamp cube{.radius = 0};

constexpr std::array techniques{"pcf", "pcf_poisson", "vsm", "evsm", "msm", "esm", "csm_fourier"};

class LampFilters : public Lamps {
 protected:
  ParamSet parameters(const std::string& technique) const {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set(technique + ".radius", radius);
    if (params.contains(technique + ".bleeding")) params.set(technique + ".bleeding", 0.0f);
    if (technique == "pcf") params.set("pcf.filter_taps", 256);
    if (technique == "esm") params.set("esm.exponent", 200.0f);  // lets no light through that would change the width
    if (technique == "pcf_poisson") params.set("pcf_poisson.taps", 64);
    return params;
  }

  // Metres on a ground at that depth below a lamp, from where a tenth to where nine tenths of the light are visible
  // under the edge of a half-plane. What else the lamp shines on is 7 m away.
  double width(float depth, const ParamSet& params, const shadow::Lamp& lamp = one_face) {
    const float height = 0.25f * depth;
    TriangleScene scene;
    scene.add_quad({-depth, -depth, -depth}, {0, 0, 2 * depth}, {2 * depth, 0, 0});
    scene.add_quad({-depth, height - depth, -depth}, {0, 0, 2 * depth}, {depth, 0, 0});
    scene.add_quad({-4, -4, -4}, {0, 0, 8}, {8, 0, 0});
    // At the lamp's height, so that only lamps.near says where the near plane is.
    scene.add_quad({3.9f, -0.5f, -4}, {0, 1, 0}, {0.1f, 0, 0});
    scene.width = 192;
    scene.height = 4;
    scene.view = glm::lookAt(glm::vec3(0, 0.9f * height - depth, 0), glm::vec3(0, -depth, 0), glm::vec3(0, 0, -1));
    scene.projection = orthographic(2.5f * radius, 2.5f * radius * 4 / 192, 0.001f, height);
    const Shadowed shadowed = render(scene, lamp, params);
    std::vector<double> row;
    for (int x = 0; x < shadowed.width; ++x) row.push_back(static_cast<double>(shadowed.visibility(x, 1)));
    return width_10_90(row, static_cast<double>(shadowed.point(1, 1).x - shadowed.point(0, 1).x));
  }
};

// Of the kernel of filtered maps along an edge, from a tenth to nine tenths; of a disc.
constexpr double gaussian_width = 1.044, disc_width = 1.3737;

// Its maps are eight times as large as those of others, and its series rings.
bool is_series(const std::string& technique) { return technique == "csm_fourier"; }

TEST_F(LampFilters, KernelsAreAsWideAsAskedForAtEveryDepth) {
  for (const std::string technique : techniques) {
    ParamSet params = parameters(technique);
    params.set("lamps.size", is_series(technique) ? 512 : 1024);
    const double share = is_series(technique) ? 0.15 : 0.05;
    const double exact = radius * (technique.starts_with("pcf") ? disc_width : gaussian_width);
    for (const float depth : {4.0f, 2.8f, 2.0f, 1.4f, 1.0f, 0.5f})
      EXPECT_NEAR(width(depth, params), exact, share * exact) << technique << ", " << depth << " m below the lamp";
    EXPECT_NEAR(width(1.4f, params, cube), exact, share * exact) << technique << ", in a cube";
  }
}

TEST_F(LampFilters, KernelsDependOnNeitherMapSizeNorNearPlane) {
  for (const std::string technique : techniques) {
    for (const float depth : {4.0f, 1.4f}) {
      ParamSet params = parameters(technique);
      params.set("lamps.size", is_series(technique) ? 512 : 2048);
      const double fine = width(depth, params);
      if (!is_series(technique)) {
        params.set("lamps.size", 1024);
        EXPECT_NEAR(width(depth, params), fine, 0.03 * fine) << technique << ", " << depth << " m, maps of 1024²";
      }
      for (const float near : {0.002f, 0.2f}) {
        params.set("lamps.near", near);
        EXPECT_NEAR(width(depth, params), fine, 0.03 * fine) << technique << ", " << depth << " m, near " << near;
      }
    }
  }
}

TEST_F(LampFilters, KernelsInACubeDependOnNeitherMapSizeNorNearPlane) {
  ParamSet params = parameters("evsm");
  params.set("lamps.size", 2048);
  const double fine = width(1.4f, params, cube);
  params.set("lamps.size", 1024);
  EXPECT_NEAR(width(1.4f, params, cube), fine, 0.03 * fine);
  params.set("lamps.near", 0.2f);
  EXPECT_NEAR(width(1.4f, params, cube), fine, 0.03 * fine);
}

// A wall that nothing shadows, with kernels that reach beyond the rims of the cube's faces.
TEST_F(LampFilters, WideKernelsLeaveAWallLit) {
  for (const std::string technique : {"pcf", "vsm", "evsm", "msm", "esm", "csm_fourier"}) {
    ParamSet params = parameters(technique);
    params.set("lamps.size", 256);
    for (const float wide : {0.25f, 0.5f, 1.0f, 2.0f}) {
      params.set(technique + ".radius", wide);
      float least = 1;
      for (const Screen& screen : screens()) {
        TriangleScene scene = scene_of(screen, 64);
        scene.triangles.resize(2);  // the wall alone
        for (const float visibility : render(scene, {.radius = 0.03f}, params).visibilities())
          least = std::min(least, visibility);
      }
      EXPECT_GE(least, technique == "csm_fourier" ? 0.99f : 0.999f) << technique << ", kernel of " << wide << " m";
    }
  }
}

}  // namespace
}  // namespace penumbra::test
