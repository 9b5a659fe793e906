// Shadow maps that the caller draws with its own matrices: what the library makes of them, and which it refuses.
#include "shadow/light_matrices.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"

namespace penumbra::shadow {
namespace {

const glm::vec3 to_light = glm::normalize(glm::vec3(0.4f, 0.7f, 0.2f));

// As engines make them: a view from the light to a place, rolled about its direction, and a box of half that size.
glm::mat4 map_matrix(const glm::vec3& target, float half, float roll = 0.3f, float near = 1, float far = 60) {
  const glm::vec3 up(std::sin(roll), std::cos(roll), 0.1f);
  return glm::orthoRH_ZO(-half, half, -half, half, near, far) * glm::lookAt(target + 30.0f * to_light, target, up);
}

SunMatrices maps_of(const std::vector<glm::mat4>& matrices) {
  return {.world_to_clip = matrices, .to_light = to_light, .size = 1024, .camera = glm::vec3(3, 1.7f, 8)};
}

glm::dvec3 clip(const glm::dmat4& matrix, const glm::dvec3& at) {
  const glm::dvec4 clip = matrix * glm::dvec4(at, 1);
  return glm::dvec3(clip) / clip.w;
}

std::string refusal(const SunMatrices& maps) {
  try {
    sun_projection(maps);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const std::vector<glm::mat4>& matrices) { return refusal(maps_of(matrices)); }

TEST(LightMatrices, PlaceTheSameTexelsAndDepths) {
  const std::vector<glm::mat4> matrices{map_matrix({1, 0, 2}, 5), map_matrix({-2, 0, -9}, 24, 0.3f, -10, 69)};
  const LightProjection projection = sun_projection(maps_of(matrices));
  ASSERT_EQ(projection.layers(), 2);
  EXPECT_EQ(projection.size(), 1024);
  EXPECT_EQ(projection.fault(), "");
  for (int layer = 0; layer < 2; ++layer) {
    const auto i = static_cast<std::size_t>(layer);
    EXPECT_NEAR(projection.texel(layer).x, (layer == 0 ? 10.0 : 48.0) / 1024, 1e-6);
    EXPECT_NEAR(projection.depth_range(layer), layer == 0 ? 59 : 79, 1e-4);
    for (const glm::dvec3 at : {glm::dvec3(0), {3, 2, -4}, {-7, 1, 11}}) {
      const glm::dvec3 expected = clip(glm::dmat4(matrices[i]), at), made = clip(projection.world_to_clip(layer), at);
      EXPECT_LT(glm::length(expected - made), 1e-4) << layer;  // of a map: a tenth of a texel
    }
  }
}

TEST(LightMatrices, DepthsFromMinusOneAreThoseThatTheMapStores) {
  const glm::mat4 to_minus_one(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1);
  const std::vector<glm::mat4> from_zero{map_matrix({1, 0, 2}, 5)}, from_minus_one{to_minus_one * from_zero[0]};
  SunMatrices maps = maps_of(from_minus_one);
  maps.depth_zero_to_one = false;
  const glm::dvec3 at(3, 2, -4);
  const glm::dvec3 a = clip(sun_projection(maps).world_to_clip(0), at);
  const glm::dvec3 b = clip(sun_projection(maps_of(from_zero)).world_to_clip(0), at);
  EXPECT_LT(glm::length(a - b), 1e-5);
}

TEST(LightMatrices, ReversedDepthsAreThoseOfAMapThatIsNot) {
  const glm::mat4 reversal(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
  const std::vector<glm::mat4> plain{map_matrix({1, 0, 2}, 5)}, reversed{reversal * plain[0]};
  SunMatrices maps = maps_of(reversed);
  maps.reversed = true;
  const glm::dvec3 at(3, 2, -4);
  const glm::dvec3 a = clip(sun_projection(maps).world_to_clip(0), at);
  const glm::dvec3 b = clip(sun_projection(maps_of(plain)).world_to_clip(0), at);
  EXPECT_LT(glm::length(a - b), 1e-5);
}

const glm::vec3 spot_at(3, 6, 2);

// Of a spot at spot_at that shines at the origin.
glm::mat4 spot_matrix(float angle, const glm::mat4& projection) {
  return projection * glm::lookAt(spot_at, glm::vec3(0), glm::vec3(std::sin(angle), std::cos(angle), 0.1f));
}
glm::mat4 spot_perspective() { return glm::perspectiveRH_ZO(1.2f, 1.0f, 0.5f, 30.0f); }

SpotMatrix spot_map(const glm::mat4& world_to_clip) {
  return {.world_to_clip = world_to_clip,
          .lamp = {.position = spot_at, .radius = 0.1f, .axis = glm::normalize(-spot_at), .cone = 0.55f},
          .size = 1024};
}

std::string spot_refusal(const SpotMatrix& map) {
  try {
    spot_projection(map);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SpotMatrices, PlaceTheSameTexelsAndDepths) {
  const glm::mat4 to_minus_one(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1);
  const glm::mat4 reversal(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
  const glm::mat4 matrix = spot_matrix(0.3f, spot_perspective());
  SpotMatrix minus_one = spot_map(to_minus_one * matrix), reversed = spot_map(reversal * matrix);
  minus_one.depth_zero_to_one = false;
  reversed.reversed = true;
  for (const SpotMatrix& map : {spot_map(matrix), minus_one, reversed, spot_map(7.0f * matrix)}) {
    const LightProjection projection = spot_projection(map);
    ASSERT_EQ(projection.layers(), 1);
    EXPECT_EQ(projection.size(), 1024);
    EXPECT_EQ(projection.fault(), "");
    for (const glm::dvec3 at : {glm::dvec3(0), {1, 2, 1}, {-1, 0, 1}, {2.5, 5, 1.5}}) {
      const glm::dvec3 expected = clip(glm::dmat4(matrix), at), made = clip(projection.world_to_clip(0), at);
      EXPECT_LT(glm::length(expected - made), 1e-4);
    }
  }
}

TEST(SpotMatrices, MatricesThatCannotServeAreRefusedWithTheReason) {
  const std::string begin = "shadow maps by the caller's matrices: ", map = begin + "the spot's map ";
  const glm::mat4 perspective = spot_perspective(), good = spot_matrix(0, perspective);
  ASSERT_EQ(spot_refusal(spot_map(good)), "accepted");
  const auto of_projection = [&](const glm::mat4& projection) {
    return spot_refusal(spot_map(spot_matrix(0, projection)));
  };
  EXPECT_EQ(of_projection(glm::orthoRH_ZO(-5.0f, 5.0f, -5.0f, 5.0f, 1.0f, 60.0f)),
            map + "is orthographic: it must be a perspective from the lamp's centre");
  EXPECT_EQ(of_projection(glm::perspectiveRH_ZO(1.2f, 1.5f, 0.5f, 30.0f)), map + "spans different angles in x and y");
  EXPECT_EQ(of_projection(glm::perspectiveRH_ZO(1.0f, 1.0f, 0.5f, 30.0f)), map + "spans less than the spot's cone");
  SpotMatrix half_space = spot_map(good);
  half_space.lamp.cone = glm::half_pi<float>();  // as a float, a little more than a right angle
  EXPECT_EQ(spot_refusal(half_space), map + "spans less than the spot's cone");
  EXPECT_EQ(of_projection(glm::frustumRH_ZO(-0.4f, 0.5f, -0.4f, 0.5f, 0.5f, 30.0f)),
            map + "is skewed or off-centre: the spot's axis must be in its middle");
  EXPECT_EQ(of_projection(glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1)) * perspective),
            map + "is mirrored: as seen from the lamp, x must grow to the right where y grows upwards");
  glm::mat4 oblique = perspective;
  oblique[0][2] = 0.1f;
  EXPECT_EQ(of_projection(oblique), map + "has an oblique near plane");
  EXPECT_EQ(of_projection(glm::perspectiveRH_ZO(1.2f, 1.0f, 30.0f, 0.5f)),
            map + "has depths that grow towards the lamp: say that they are reversed");
  glm::mat4 endless = perspective;
  endless[2][2] = -1;
  EXPECT_EQ(of_projection(endless), map + "has no far plane");
  EXPECT_EQ(of_projection(glm::perspectiveRH_ZO(1.2f, 1.0f, 0.01f, 30.0f)),
            begin + "the lamp's maps have a near plane at 0.01 m, less than 1/2000 of the far plane's 30 m");
  EXPECT_EQ(spot_refusal(spot_map(perspective * glm::lookAt(spot_at, {0, 0, 0.1f}, {0, 1, 0}))),
            map + "does not look along the spot's axis");
  EXPECT_EQ(spot_refusal(spot_map(good * glm::translate(glm::mat4(1), {0, 0, 0.01f}))),
            map + "does not look from the lamp's centre: at its border that is more than a quarter of a texel");
  EXPECT_EQ(spot_refusal(spot_map(glm::mat4(0))),
            map + "is orthographic: it must be a perspective from the lamp's centre");
  EXPECT_EQ(spot_refusal(spot_map(good * std::numeric_limits<float>::quiet_NaN())),
            map + "has a matrix that is not finite");
  SpotMatrix all_round = spot_map(good), no_size = spot_map(good), no_cone = spot_map(good);
  all_round.lamp.axis = glm::vec3(0);
  no_size.size = 0;
  no_cone.lamp.cone = 0;
  EXPECT_EQ(spot_refusal(all_round), begin + "the lamp shines all round; maps can be given for suns and spots alone");
  EXPECT_EQ(spot_refusal(no_size), begin + "a size of 0 texels");
  EXPECT_EQ(spot_refusal(no_cone), begin + "the lamp has a cone that is not between 0 and π/2");
}

TEST(LightMatrices, MatricesThatCannotServeAreRefusedWithTheReason) {
  const std::string begin = "shadow maps by the caller's matrices: layer ";
  const glm::mat4 good = map_matrix({1, 0, 2}, 5);
  ASSERT_EQ(refusal({good}), "accepted");

  const glm::mat4 spot =
      glm::perspectiveRH_ZO(1.0f, 1.0f, 1.0f, 60.0f) * glm::lookAt(30.0f * to_light, glm::vec3(0), glm::vec3(0, 1, 0));
  EXPECT_EQ(refusal({good, spot}),
            begin + "1 is warped (clip w is not constant): penumbrae need maps whose texels all have the same size");
  const glm::mat4 elsewhere = glm::orthoRH_ZO(-5.0f, 5.0f, -5.0f, 5.0f, 1.0f, 60.0f) *
                              glm::lookAt(glm::vec3(0, 30, 0), glm::vec3(0), glm::vec3(0, 0, 1));
  EXPECT_EQ(refusal({elsewhere}), begin + "0 does not look along the sun's rays");
  const glm::mat4 reversed(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
  EXPECT_EQ(refusal({reversed * good}),
            begin +
                "0 has depths that grow towards the light: store 0 near the light and 1 far from it, or say that "
                "they are reversed");
  const glm::mat4 mirror = glm::scale(glm::mat4(1), glm::vec3(1, -1, 1));
  EXPECT_EQ(refusal({mirror * good}),
            begin + "0 is mirrored: as seen from the light, x must grow to the right where y grows upwards");
  glm::mat4 shear(1);
  shear[1][0] = 0.2f;
  EXPECT_EQ(refusal({shear * good}),
            begin + "0 is skewed: its axes are not perpendicular to each other and the sun's rays");
  EXPECT_EQ(refusal({good, map_matrix({1, 0, 2}, 20, 0.5f)}),
            begin + "1 is turned against layer 0 about the sun's rays");
  EXPECT_EQ(refusal({map_matrix({1, 0, 2}, 20), good}),
            begin + "1 has finer texels than the layer before it: order layers from the finest to the coarsest");
  EXPECT_EQ(refusal({glm::mat4(0)}),
            begin + "0 is warped (clip w is not constant): penumbrae need maps whose texels all have the same size");
  glm::mat4 flat = good;
  for (glm::length_t column = 0; column < 4; ++column) flat[column].x = 0;
  EXPECT_EQ(refusal({flat}), begin + "0 has a matrix that can't be inverted");
  glm::mat4 endless = good;
  endless[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal({endless}), begin + "0 has a matrix that is not finite");
}

TEST(LightMatrices, OneThatHoldsAllOthersIsAddedWhereTheLastDoesNot) {
  const glm::mat4 good = map_matrix({1, 0, 2}, 5);
  const auto made_of = [](const std::vector<glm::mat4>& matrices) { return sun_projection(maps_of(matrices)); };
  const LightProjection nested = made_of({good, map_matrix({1, 0, 2}, 20)});
  EXPECT_EQ(nested.layers(), 2);
  EXPECT_EQ(nested.given_layers(), 2);
  for (const glm::mat4& other : {map_matrix({30, 0, 0}, 20, 0.3f, -40, 80), map_matrix({1, 0, 2}, 20, 0.3f, 5, 60)}) {
    const LightProjection made = made_of({good, other});
    ASSERT_EQ(made.layers(), 3);
    EXPECT_EQ(made.given_layers(), 2);
    EXPECT_EQ(made.fault(), "");
    for (const glm::mat4& given : {good, other}) {
      for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : 0);
        const glm::dvec3 at = clip(made.world_to_clip(2), clip(glm::inverse(glm::dmat4(given)), corner));
        EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1.0001);
        EXPECT_GE(at.z, -1e-4);
        EXPECT_LE(at.z, 1.0001);
      }
    }
  }
  std::vector<glm::mat4> eight(7, good);
  eight.push_back(map_matrix({30, 0, 0}, 20));
  EXPECT_EQ(refusal(eight), "shadow maps by the caller's matrices: the last of 8 layers must hold all others");
}

// Half a thousandth of a radian is a few texels at the border of the map.
TEST(LightMatrices, ASunThatIsNotTheMapsOwnIsNoticed) {
  const std::vector<glm::mat4> matrices{map_matrix({1, 0, 2}, 5)};
  SunMatrices maps = maps_of(matrices);
  maps.to_light = glm::normalize(to_light + glm::vec3(5e-4f, 0, 0));
  EXPECT_EQ(
      refusal(maps),
      "shadow maps by the caller's matrices: layer 0 does not look along the sun's rays exactly: at its border that "
      "is more than a quarter of a texel");
  maps.to_light = glm::normalize(to_light + glm::vec3(1e-6f, 0, 0));
  EXPECT_EQ(refusal(maps), "accepted");
}

TEST(LightMatrices, TheNumberOfLayersTheSizeAndTheSunAreChecked) {
  const std::string begin = "shadow maps by the caller's matrices: ";
  EXPECT_EQ(refusal(std::vector<glm::mat4>()), begin + "0 layers, not 1 to 8");
  EXPECT_EQ(refusal(std::vector<glm::mat4>(9, map_matrix({1, 0, 2}, 5))), begin + "9 layers, not 1 to 8");
  const std::vector<glm::mat4> matrices{map_matrix({1, 0, 2}, 5)};
  SunMatrices maps = maps_of(matrices);
  maps.size = 0;
  EXPECT_EQ(refusal(maps), begin + "a size of 0 texels");
  maps = maps_of(matrices);
  maps.casters.min.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(maps), begin + "the camera or the casters' box is not finite");
  maps = maps_of(matrices);
  maps.to_light = glm::vec3(0);
  EXPECT_TRUE(refusal(maps).starts_with(begin + "the sun ")) << refusal(maps);
}

// Engines often let casters before the near plane be clamped to it, so that the map has more precision.
TEST(LightMatrices, CastersBeforeTheNearPlaneAreNoticed) {
  const std::vector<glm::mat4> matrices{map_matrix({1, 0, 2}, 5, 0.3f, 27, 60)};
  SunMatrices maps = maps_of(matrices);
  maps.casters = {{-3, 0, -3}, {3, 2, 3}};
  EXPECT_EQ(refusal(maps), "accepted");
  maps.casters.max.y = 12;  // its corner (3, 12, 3) is 11.32 m towards the sun from the target, the near plane 3 m
  EXPECT_EQ(refusal(maps).substr(0, 66), "shadow maps by the caller's matrices: layer 0 begins 8.32 m behind");
  maps.casters = {{40, 0, -3}, {43, 30, 3}};  // beside the map
  EXPECT_EQ(refusal(maps), "accepted");
}

}  // namespace
}  // namespace penumbra::shadow
