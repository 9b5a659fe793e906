// How wide the maps of lamps are.
#include "shadow/lamp_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

namespace penumbra::shadow {
namespace {

constexpr Box slab{.min = {-20, -1, -20}, .max = {20, 1, 20}};

LampInputs spot(double height, double radius, double cone_degrees) {
  return {.position = {0, height, 0},
          .axis = {0, -1, 0},
          .cone = glm::radians(cone_degrees),
          .radius = radius,
          .nearest = 0.02,
          .size = 1024,
          .casters = slab,
          .receivers = slab};
}

// The tangent at which a caster at a distance from the lamp shows in the map that shadows a receiver at the cone's rim.
double tangent_needed(double cone_degrees, double radius, double distance) {
  const double rim = std::tan(glm::radians(cone_degrees));
  return rim + (1 + rim * rim) * radius / distance;
}

TEST(LampMaps, OfSpotsFarFromAllCastersAreAsNarrowAsTheirCones) {
  for (const double cone : {4.0, 15.0, 40.0}) {
    for (const double radius : {0.0, 0.05, 0.1}) {
      for (const double height : {30.0, 300.0}) {
        const double tangent = fit_lamp(spot(height, radius, cone)).tangent;
        EXPECT_GE(tangent, tangent_needed(cone, radius, height - 1)) << cone << " degrees, " << height << " m";
        EXPECT_LE(tangent, 1.03 * tangent_needed(cone, radius, 0.3 * height)) << cone << " degrees, " << height << " m";
      }
    }
  }
}

TEST(LampMaps, ShowCastersFromTwoRadiiAndTwentyCentimetresOn) {
  for (const double radius : {0.0, 0.05, 0.3}) {
    const double tangent = fit_lamp(spot(0.5, radius, 20)).tangent;
    EXPECT_GE(tangent, tangent_needed(20, radius, std::max(2 * radius, 0.2))) << radius << " m";
  }
}

}  // namespace
}  // namespace penumbra::shadow
