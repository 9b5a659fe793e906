// Tiles of lamps: mask.tiles misses no penumbra of a spot or of a cube's faces, nor where these meet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "image/tiles_run.h"

namespace penumbra::test {
namespace {

constexpr std::array techniques{"pcss", "slices"};  // those for which tiles are decided

class LampTiles : public TilesTest {
 protected:
  // The most of the pixels that a technique decides.
  double expect_none_is_missed(const render::FrameLight& light) {
    lights_ = {light};
    double most = 0;
    for (const char* technique : techniques) most = std::max(most, expect_no_penumbra_is_missed(technique, 0));
    return most;
  }
};

render::LampLight lamp_at(const glm::vec3& place, float radius) { return {.position = place, .radius = radius}; }

render::LampLight spot_at(const glm::vec3& place, float radius, const glm::vec3& target, float cone) {
  render::LampLight lamp = lamp_at(place, radius);
  lamp.axis = glm::normalize(target - place);
  lamp.outer_cone = glm::radians(cone);
  return lamp;
}

// A camera that sees the light's faces meet in the picture: lamps of several heights among the casters.
TEST_F(LampTiles, MissNoPenumbraAroundALamp) {
  double decided = 0;
  for (const char* scene : {"posts", "foliage", "fence", "steps"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const float radius : {0.0f, 0.03f, 0.2f}) {
      for (const float height : {1.0f, 4.0f}) {
        SCOPED_TRACE(fmt::format("lamp of {} m, {} m high", radius, height));
        decided += expect_none_is_missed(lamp_at({0.3f, height, 0.6f}, radius)) / 24;
      }
    }
  }
  EXPECT_GT(decided, 0.4);
}

TEST_F(LampTiles, MissNoPenumbraOfTheLampsOfAnInterior) {
  load("gallery", 320, 180);
  int lamps = 0;
  for (const render::PlacedLight& light : setup().lights) {
    SCOPED_TRACE(light.name);
    if (!std::holds_alternative<render::LampLight>(light.light)) continue;
    ++lamps;
    // All that the pendant lights lies in the penumbra of its own shade.
    EXPECT_GT(expect_none_is_missed(light.light), light.name == "pendant" ? 0.05 : 0.2);
  }
  EXPECT_EQ(lamps, 3);
}

TEST_F(LampTiles, MissNoPenumbraOfSpotsNorTheEdgeOfTheirCones) {
  for (const char* scene : {"posts", "courtyard"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const float cone : {10.0f, 40.0f, 75.0f}) {
      SCOPED_TRACE(fmt::format("cone of {} degrees", cone));
      render::LampLight spot = spot_at({2, 5, 3}, 0.05f, {0, 0, 0}, cone);
      expect_none_is_missed(spot);
      spot.range = 6;
      expect_none_is_missed(spot);
    }
  }
}

TEST_F(LampTiles, DecideMostOfWhatASpotLights) {
  for (const char* scene : {"posts", "knife_edge"}) {
    SCOPED_TRACE(scene);
    load(scene, 320, 180);
    for (const float cone : {25.0f, 59.0f})
      EXPECT_GT(expect_none_is_missed(spot_at({0, 40, 0}, 0.05f, {0, 0, 0}, cone)), 0.5) << cone << " degrees";
  }
}

// Seams of the cube's faces, faded or not, wide or not, and with maps so coarse that two faces show other things.
TEST_F(LampTiles, MissNoPenumbraWhereFacesMeet) {
  for (const char* seam : {"none", "fade", "dither"}) {
    for (const int size : {128, 1024}) {
      settings_ = {fmt::format("cascades.seam={}", seam), "cascades.blend=0.3", fmt::format("lamps.size={}", size)};
      SCOPED_TRACE(fmt::format("{}, {}", settings_[0], settings_[2]));
      for (const char* scene : {"posts", "steps"}) {
        load(scene, 320, 180);
        expect_none_is_missed(lamp_at({0.3f, 2, 0.6f}, 0.1f));
      }
    }
  }
}

// Sheets a few millimetres above what they shadow, which one face may show and another not.
TEST_F(LampTiles, MissNoContactWhereFacesMeet) {
  load("coincident", 320, 192);
  for (const int size : {64, 128, 256}) {
    settings_ = {"cascades.blend=0.5", fmt::format("lamps.size={}", size)};
    SCOPED_TRACE(size);
    for (const float x : {-1.5f, 0.2f, 1.5f}) expect_none_is_missed(lamp_at({x, 2, 0.6f}, 0.02f));
  }
}

TEST_F(LampTiles, MissNoPenumbraWithANormalOffset) {
  settings_ = {"bias.normal_offset=4"};
  load("posts", 320, 180);
  for (const float radius : {0.0f, 0.05f}) expect_none_is_missed(lamp_at({0.3f, 2, 0.6f}, radius));
  for (const float radius : {0.0f, 0.05f}) expect_none_is_missed(spot_at({2, 5, 3}, radius, {0, 0, 0}, 40));
}

TEST_F(LampTiles, AreTheSameInBothDrivers) {
  for (const char* scene : {"gallery", "posts"}) {
    load(scene, 97, 61);
    for (const render::FrameLight& light :
         {render::FrameLight(lamp_at({0.3f, 2, 0.6f}, 0.05f)), render::FrameLight(spot_at({2, 3, 3}, 0.05f, {}, 40))}) {
      lights_ = {light};
      mask(renderer_, "pcss", 0, true);
      const std::vector<std::vector<float>> fragment = read_all(aovs);
      mask(renderer_, "pcss_compute", 0, true);
      for (std::size_t i = 0; i < aovs.size(); ++i)
        EXPECT_EQ(fragment[i], renderer_.read_aov(aovs.at(i))) << scene << ", " << aovs.at(i);
    }
  }
}

// A light's tiles are listed for it alone, whatever other kinds of light there are.
TEST_F(LampTiles, OfEachLightAreItsOwn) {
  load("posts", 160, 90);
  settings_ = {"cascades.size=512", "lamps.size=512"};
  const std::vector<render::FrameLight> all{render::SunLight{.to_light = render::direction_to(2.0f, 0.9f)},
                                            lamp_at({0.3f, 2, 0.6f}, 0.05f), spot_at({2, 5, 3}, 0.05f, {}, 20),
                                            lamp_at({-1.5f, 1, 1}, 0.02f)};
  for (const char* technique : {"pcss", "pcss_compute", "thesis_8x8", "slices_denoised"}) {
    SCOPED_TRACE(technique);
    std::vector<std::vector<float>> alone;
    for (const render::FrameLight& light : all) {
      lights_ = {light};
      mask(renderer_, technique, 2.0f, true);
      alone.push_back(layers()[0]);
    }
    lights_ = all;
    mask(renderer_, technique, 2.0f, true);
    EXPECT_EQ(layers(), alone);
  }
}

// What a denoiser makes of decided pixels is what it makes of computed ones.
TEST_F(LampTiles, LeaveDenoisedMasksAsTheyAre) {
  load("gallery", 320, 180);
  for (const char* technique : {"thesis", "slices_denoised", "thesis_compute"}) {
    SCOPED_TRACE(technique);
    for (const render::PlacedLight& light : setup().lights) {
      lights_ = {light.light};
      const std::vector<float> with = mask(renderer_, technique, 2.0f, true);
      const std::vector<float> without = mask(renderer_, technique, 2.0f, false);
      double squares = 0;
      for (std::size_t i = 0; i < with.size(); ++i) squares += std::pow(with[i] - without[i], 2);
      EXPECT_LT(std::sqrt(squares / static_cast<double>(with.size())), 0.002) << light.name;
    }
  }
}

}  // namespace
}  // namespace penumbra::test
