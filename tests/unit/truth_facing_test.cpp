#include "truth/facing.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <random>

namespace penumbra {
namespace {

using truth::Receiver;
using truth::TracedSun;

// A receiver whose surface the sun's centre is so many degrees above, in the plane of the sun and `side`.
Receiver receiver_below(const TracedSun& sun, double degrees, const glm::dvec3& side) {
  const double angle = glm::radians(degrees);
  return {.normal = std::sin(angle) * sun.to_light + std::cos(angle) * side, .there = true};
}

bool sees_all(const TracedSun& sun, double degrees, const glm::dvec3& side) {
  return truth::before_light(std::vector{receiver_below(sun, degrees, side)}, sun).front() == 1;
}

TEST(TruthFacing, AReceiverSeesADiscDownToItsRim) {
  const TracedSun sun{.angle = glm::radians(20.0)};
  for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, 0, 1))}) {
    EXPECT_TRUE(sees_all(sun, 10.001, side));
    EXPECT_FALSE(sees_all(sun, 9.999, side));
  }
}

TEST(TruthFacing, NoPartOfASquareIsBelowAReceiver) {
  const TracedSun sun{.to_light = glm::normalize(glm::dvec3(1, 2, 3)), .angle = glm::radians(20.0), .square = true};
  const truth::SeenLight seen = truth::seen_from(sun, glm::dvec3(0));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  int whole = 0, part = 0;
  for (int i = 0; i < 10'000; ++i) {
    const glm::dvec3 any(number(random), number(random), number(random));
    const glm::dvec3 side = glm::normalize(any - glm::dot(any, sun.to_light) * sun.to_light);
    const double degrees = 15 + 5 * number(random);
    const glm::dvec3 normal = receiver_below(sun, degrees, side).normal;
    double lowest = 1;
    for (const double x : {-1, 1}) {
      for (const double y : {-1, 1})
        lowest = std::min(lowest, glm::dot(normal, seen.center + x * seen.side_x + y * seen.side_y));
    }
    const bool all = sees_all(sun, degrees, side);
    EXPECT_TRUE(!all || lowest > 0) << degrees;
    (all ? whole : part) += 1;
    // The angle of the corners, whichever way the square is turned.
    EXPECT_EQ(all, degrees > glm::degrees(std::atan(std::sqrt(2.0) * std::tan(glm::radians(10.0))))) << degrees;
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(part, 1000);
}

}  // namespace
}  // namespace penumbra
