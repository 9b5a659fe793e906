// Where lamps shine and what casts their shadows, what is kept of them, and which are refused.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <variant>
#include <vector>

#include "gpu/lamp_scenes.h"

namespace penumbra::test {
namespace {

class LampLimits : public Lamps {};

// 12 m of ground around the lamp, from above.
TriangleScene wide_ground() {
  TriangleScene scene;
  scene.add_quad({-8, 0, -8}, {0, 0, 16}, {16, 0, 0});
  scene.width = scene.height = 64;
  scene.view = glm::lookAt(glm::vec3(0, 5, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(6, 6, 0.01f, 6);
  return scene;
}

TEST_F(LampLimits, CastersFarFromALampCastShadows) {
  TriangleScene scene;
  scene.add_quad({-700, 0, -700}, {0, 0, 1400}, {1400, 0, 0});
  scene.add_quad({-10, 3, -10}, {0, 0, 20}, {20, 0, 0});
  scene.add_quad({10, 610, 10}, {0, 0, 20}, {20, 0, 0});
  scene.width = scene.height = 16;
  scene.view = glm::lookAt(glm::vec3(0, 2, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(8, 8, 0.01f, 4);
  const shadow::Lamp lamp{.position = {0, 600, 0}, .radius = 0.1f};
  for (const char* technique : {"hard", "pcss", "slices"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string(technique));
    for (const float visibility : render(scene, lamp, params).visibilities()) ASSERT_EQ(visibility, 0) << technique;
  }
}

// Two triangles reach far beyond the far plane, which ends at the lamp's range.
TEST_F(LampLimits, LargeTrianglesDoNotShadowThemselvesUnderALampWithARange) {
  TriangleScene scene;
  for (const float half : {100.0f, 500.0f, 2000.0f}) {
    scene.triangles.clear();
    scene.add_quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
    scene.width = scene.height = 64;
    scene.view = glm::lookAt(glm::vec3(0, 1, 0), glm::vec3(0), glm::vec3(0, 0, -1));
    scene.projection = orthographic(6, 6, 0.01f, 2);
    for (const int layers : {1, 2}) {
      for (const char* technique : {"hard", "pcss", "slices"}) {
        ParamSet params = renderer_->params();
        params.set("technique", std::string(technique));
        params.set("maps.layers", layers);
        const shadow::Lamp lamp{.position = {0.3f, 2, 0.2f}, .radius = 0.05f, .range = 15};
        for (const float visibility : render(scene, lamp, params).visibilities())
          ASSERT_EQ(visibility, 1) << technique << ", ground of " << half << " m";
      }
    }
  }
}

TEST_F(LampLimits, CastersAreThoseBeyondTheNearPlane) {
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.width = scene.height = 16;
  scene.view = glm::lookAt(glm::vec3(0, 1, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(1, 1, 0.01f, 2);
  for (const float below : {0.01f, 0.05f}) {
    TriangleScene plated = scene;
    plated.add_quad({-0.2f, lamp_height - below, -0.2f}, {0, 0, 0.4f}, {0.4f, 0, 0});
    for (const char* technique : {"hard", "pcss", "slices"}) {
      ParamSet params = renderer_->params();
      params.set("technique", std::string(technique));
      const Shadowed shadowed = render(plated, point_lamp(0.01f), params);
      for (const float visibility : shadowed.visibilities())
        ASSERT_EQ(visibility, below < 0.02f ? 1.0f : 0.0f) << technique << ", plate " << below << " m below the lamp";
    }
  }
}

TEST_F(LampLimits, ASpotShinesWithinItsConeAlone) {
  const TriangleScene scene = wide_ground();
  for (const float degrees : {5.0f, 30.0f, 60.0f, 65.0f}) {
    const Shadowed shadowed = render(scene, spot(0.05f, degrees), renderer_->params());
    int lit = 0;
    for (size_t i = 0; i < shadowed.points.size(); ++i) {
      const glm::vec3& p = shadowed.points[i];
      const float tangent = glm::length(glm::vec2(p.x, p.z)) / lamp_height / std::tan(glm::radians(degrees));
      if (std::abs(tangent - 1) < 1e-3f) continue;
      ASSERT_EQ(shadowed.mask[4 * i], tangent < 1 ? 1.0f : 0.0f) << degrees;
      lit += tangent < 1 ? 1 : 0;
    }
    EXPECT_GT(lit, 3) << degrees;
  }
}

// A half-plane so near a spot that its shadow is wider than the cone: the spot's map ends where it goes on.
TEST_F(LampLimits, ANearCasterGoesOnBeyondTheRimOfASpotsMap) {
  const Edge edge{.height = lamp_height - 0.05f, .radius = 0.1f};
  const Edge everywhere{.height = edge.height, .radius = edge.radius, .x = 4};
  for (const bool tiles : {true, false}) {
    for (const char* technique : {"pcss", "slices", "brute_force", "pcf_poisson"}) {
      SCOPED_TRACE(fmt::format("{}, tiles {}", technique, tiles));
      ParamSet params = renderer_->params();
      params.set("technique", std::string(technique));
      params.set("mask.tiles", tiles);
      params.set("pcf_poisson.radius", 2.0f);
      const auto drawn_under = [&](const Edge& caster) {
        TriangleScene scene = scene_of(caster, 64);
        scene.height = 64;
        scene.view = glm::lookAt(glm::vec3(0, 1, 0), glm::vec3(0), glm::vec3(0, 0, -1));
        scene.projection = orthographic(0.6f, 0.6f, 0.01f, 2);
        return render(scene, spot(caster.radius, 20), params);
      };
      for (const float visibility : drawn_under(everywhere).visibilities()) ASSERT_EQ(visibility, 0);
      if (std::string(technique) == "pcf_poisson") continue;  // its kernel is not the lamp
      const Shadowed half = drawn_under(edge);
      double sum = 0;
      for (size_t i = 0; i < half.points.size(); ++i)
        sum += half.mask[4 * i] - exact_disc(edge.place(glm::dvec3(half.points[i])));
      EXPECT_NEAR(sum / static_cast<double>(half.points.size()), 0, 0.005);
    }
  }
}

TEST_F(LampLimits, ALampShinesWithinItsRangeAlone) {
  const TriangleScene scene = wide_ground();
  for (const float cone : {0.0f, 60.0f}) {
    shadow::Lamp lamp = cone > 0 ? spot(0.05f, cone) : point_lamp(0.05f);
    lamp.range = 4;
    const Shadowed shadowed = render(scene, lamp, renderer_->params());
    int lit = 0, dark = 0;
    for (size_t i = 0; i < shadowed.points.size(); ++i) {
      const float away = glm::distance(shadowed.points[i], lamp.position);
      if (std::abs(away - lamp.range) < 1e-3f) continue;
      ASSERT_EQ(shadowed.mask[4 * i], away < lamp.range ? 1.0f : 0.0f) << away << " m";
      lit += away < lamp.range ? 1 : 0;
      dark += away > lamp.range ? 1 : 0;
    }
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 100);
  }
}

TEST_F(LampLimits, AMovedLampDropsItsOwnHistoryAloneAndOneAtRestIsNotDrawnAgain) {
  const Edge edge{1, 0.1f};
  const TriangleScene scene = scene_of(edge, 32);
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  std::vector<shadow::Light> lights{{.id = 0, .source = point_lamp(0.1f)}, {.id = 1, .source = spot(0.1f, 30)}};
  int drawn = 0;
  const auto frame = [&] {
    drawn = 0;
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.lights = lights;
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs.moved = shadow::Box{glm::vec3(1), glm::vec3(-1)};
      inputs.draw = [&drawn, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        ++drawn;
        draw(casters, pass);
      };
    });
  };
  const auto has_history = [&](size_t light) { return renderer_->mask().lights[light].history; };
  frame();
  EXPECT_EQ(drawn, 7);
  frame();
  EXPECT_EQ(drawn, 0);
  EXPECT_TRUE(has_history(0) && has_history(1));
  std::get<shadow::Lamp>(lights[1].source).position.x += 0.1f;
  frame();
  EXPECT_EQ(drawn, 1);
  EXPECT_TRUE(has_history(0));
  EXPECT_FALSE(has_history(1));
  frame();
  EXPECT_EQ(drawn, 0);
  EXPECT_TRUE(has_history(0) && has_history(1));
}

TEST_F(LampLimits, BadLampsAndTechniquesForSunsAreRefused) {
  const TriangleScene scene = scene_of({1, 0.1f}, 16);
  const ParamSet params = renderer_->params();
  const auto fault = [&](const shadow::Lamp& lamp) { return message_of([&] { render(scene, lamp, params); }); };
  const float nan = std::nanf("");
  EXPECT_EQ(fault({.position = {nan, 0, 0}}), "soft shadows: light 0 has no position");
  EXPECT_EQ(fault({.position = {1e7f, 0, 0}}), "soft shadows: light 0 is too far from the origin");
  EXPECT_EQ(fault({.radius = -1}), "soft shadows: light 0 has a radius of -1 m, not 0 to 1e6");
  EXPECT_EQ(fault({.radius = 1e7f}), "soft shadows: light 0 has a radius of 10000000 m, not 0 to 1e6");
  EXPECT_EQ(fault({.radius = nan}), "soft shadows: light 0 has a radius of nan m, not 0 to 1e6");
  EXPECT_EQ(fault({.range = nan}), "soft shadows: light 0 has a range that is not 0 or more");
  EXPECT_EQ(fault({.axis = {0, 2, 0}, .cone = 0.5f}), "soft shadows: light 0 has an axis that is not of length 1");
  EXPECT_EQ(fault({.axis = {0, 1, 0}}), "soft shadows: light 0 has a cone that is not between 0 and π/2");
  ParamSet for_suns = params;
  for_suns.set("technique", std::string("ssss"));
  EXPECT_EQ(message_of([&] { render(scene, point_lamp(0.1f), for_suns); }),
            "soft shadows: light 0 is a lamp, and technique 'ssss' is for suns alone");
}

TEST_F(LampLimits, ExtremeLampsGiveFiniteMasks) {
  const TriangleScene scene = scene_of({1, 0.1f}, 32);
  for (const char* technique : {"pcss", "slices", "brute_force", "vsm", "msm", "hard", "pcf"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string(technique));
    params.set("lamps.size", 128);
    for (const shadow::Lamp& lamp :
         {shadow::Lamp{.position = {0, 1, 0}}, shadow::Lamp{.position = {0, 0, 0}},
          shadow::Lamp{.position = {0, 1e-6f, 0}, .radius = 10}, shadow::Lamp{.position = {0, 2, 0}, .radius = 0},
          shadow::Lamp{.position = {9e5f, 9e5f, 0}, .radius = 1e5f},
          shadow::Lamp{.position = {0, 2, 0}, .range = 1e-6f},
          shadow::Lamp{.position = {0, 2, 0}, .axis = {0, -1, 0}, .cone = 1e-4f}}) {
      for (const float visibility : render(scene, lamp, params).visibilities())
        ASSERT_TRUE(visibility >= 0 && visibility <= 1) << technique << ": " << visibility;
    }
  }
}

}  // namespace
}  // namespace penumbra::test
