// Where the faces of a lamp's cube meet.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/lamp_screens.h"

namespace penumbra::test {
namespace {

class LampFaces : public Lamps {};

TEST_F(LampFaces, NoSeamShowsWhereCubeFacesMeet) {
  constexpr float radius = 0.1f;
  for (const char* technique : {"slices", "brute_force"}) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string(technique));
    params.set("brute_force.every_texel", true);
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    params.set("lamps.size", 512);
    for (const char* seam : {"fade", "dither"}) {
      params.set("cascades.seam", std::string(seam));
      int pairs = 0;
      for (const Screen& screen : screens()) {
        const Steps steps = steps_of(render(scene_of(screen, 96), {.radius = radius}, params), screen, radius);
        EXPECT_LE(steps.across, steps.within + 1.0 / 255)
            << technique << ", " << seam << ", screen towards " << screen.towards.x << " " << screen.towards.y << " "
            << screen.towards.z;
        EXPECT_LE(steps.worst_error, 0.03) << technique << ", " << seam;
        pairs += steps.pairs;
      }
      EXPECT_GT(pairs, 300);
    }
  }
}

TEST_F(LampFaces, EachFaceOfATransitionIsReadAtItsOwnDepth) {
  constexpr float radius = 0.1f;
  ParamSet params = renderer_->params();
  params.set("technique", std::string("brute_force"));
  params.set("brute_force.every_texel", true);
  params.set("lamps.size", 512);
  params.set("cascades.blend", 0.2f);
  const float s = std::sqrt(0.5f);
  const std::vector<Screen> below{{{0, -s, s}, {1, 0, 0}}, {{0, -s, s}, {0, s, s}}, {{s, -s, 0}, {0, 0, 1}}};
  for (const char* seam : {"fade", "dither"}) {
    params.set("cascades.seam", std::string(seam));
    for (const Screen& screen : below) {
      const Steps steps = steps_of(render(scene_of(screen, 96), {.radius = radius}, params), screen, radius);
      EXPECT_LE(steps.worst_error, 0.03) << seam << ", screen towards " << screen.towards.x << " " << screen.towards.y
                                         << " " << screen.towards.z;
    }
  }
}

TEST_F(LampFaces, NoLightLeaksWhereCubeFacesMeet) {
  for (const float radius : {0.0f, 0.002f, 0.1f}) {
    for (const Screen& screen : screens()) {
      TriangleScene scene = scene_of(screen, 64);
      scene.triangles.resize(2);  // the wall alone
      scene.add_box(glm::vec3(-0.5f), glm::vec3(0.5f));
      for (const char* technique : {"hard", "pcss", "slices", "pcf", "pcf_poisson"}) {
        ParamSet params = renderer_->params();
        params.set("technique", std::string(technique));
        params.set("pcf.radius", 1.0f);
        params.set("pcf_poisson.radius", 1.0f);
        for (const char* seam : {"fade", "dither"}) {
          params.set("cascades.seam", std::string(seam));
          for (const float visibility : render(scene, {.radius = radius}, params).visibilities())
            ASSERT_LT(visibility, 1e-3f) << technique << ", " << seam << ", lamp of " << radius << " m";
        }
      }
    }
  }
}

// What filters of a constant radius find does not depend on how far the maps of the faces reach beyond the cube's
// edges, which the lamp's size decides: beyond a map's rim they go on in the next face.
TEST_F(LampFaces, FiltersOfAConstantRadiusGoOnBeyondTheRim) {
  ParamSet wide = renderer_->params();
  wide.set("pcf.radius", 1.0f);
  wide.set("pcf_poisson.radius", 1.0f);
  wide.set("pcf_tent.width", 31);
  wide.set("pcf.filter_taps", 64);
  wide.set("pcf_poisson.taps", 64);
  ParamSet narrow = wide;
  wide.set("lamps.size", 1024);  // of 2.03 times the cube's edge: texels of the same size
  narrow.set("lamps.size", 512);
  for (const char* technique : {"pcf", "pcf_poisson", "pcf_tent"}) {
    for (ParamSet* params : {&wide, &narrow}) params->set("technique", std::string(technique));
    for (const Screen& screen : screens()) {
      const TriangleScene scene = scene_of(screen, 64);
      const std::vector<float> a = render(scene, {.radius = 0.1f}, wide).visibilities();
      const std::vector<float> b = render(scene, {.radius = 0}, narrow).visibilities();
      double most = 0, sum = 0;
      for (size_t i = 0; i < a.size(); ++i) {
        most = std::max<double>(most, std::abs(a[i] - b[i]));
        sum += std::abs(a[i] - b[i]);
      }
      EXPECT_LE(most, 0.1) << technique;
      EXPECT_LE(sum, 0.005 * static_cast<double>(a.size())) << technique;
    }
  }
}

// A wall that nothing shadows is lit wherever it is read from: through the face that a receiver reads, or another one.
TEST_F(LampFaces, NoAcneBeyondTheRim) {
  ParamSet params = renderer_->params();
  params.set("lamps.size", 256);
  params.set("pcf.radius", 2.0f);
  params.set("pcf_poisson.radius", 2.0f);
  params.set("pcf_tent.width", 31);
  for (const char* technique : {"pcf", "pcf_poisson", "pcf_tent"}) {
    params.set("technique", std::string(technique));
    for (const Screen& screen : screens()) {
      TriangleScene scene = scene_of(screen, 64);
      scene.triangles.resize(2);  // the wall alone
      for (const float visibility : render(scene, {.radius = 0}, params).visibilities())
        ASSERT_EQ(visibility, 1.0f) << technique;
    }
  }
}

TEST_F(LampFaces, ShadowVolumesAreThoseOfTheCentre) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("shadow_volume"));
  for (const Screen& screen : screens()) {
    const Shadowed shadowed = render(scene_of(screen, 64), {.radius = 0.1f}, params);
    int lit = 0;
    for (size_t i = 0; i < shadowed.points.size(); ++i) {
      const double place = screen.place(glm::dvec3(shadowed.points[i]), 1.0);
      if (std::abs(place) < 1e-5) continue;
      ASSERT_EQ(shadowed.mask[4 * i], place > 0 ? 1.0f : 0.0f) << "at " << place;
      lit += place > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, 1000);
    EXPECT_LT(lit, 3000);
  }
}

}  // namespace
}  // namespace penumbra::test
