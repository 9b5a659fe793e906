// Lamps on the command line.
#include "cli/lamp.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "cli/usage.h"

namespace penumbra::test {
namespace {

render::LampLight parse(const std::string& text) { return cli::parse_lamp("--lamp", text); }

std::string fault_of(const std::string& text) {
  try {
    parse(text);
  } catch (const cli::UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(CliLamp, ReadsAPlaceAndAttributesInAnyOrder) {
  const render::LampLight usual = parse("1,2,-3");
  EXPECT_EQ(usual.position, glm::vec3(1, 2, -3));
  EXPECT_EQ(usual.intensity, glm::vec3(100));
  EXPECT_FLOAT_EQ(usual.radius, 0.03f);
  EXPECT_EQ(usual.axis, glm::vec3(0));
  const render::LampLight spot = parse("0,2,0:cone=30:rgb=1,0.5,0:to=0,0,0:cd=200:radius=0.1:range=9");
  EXPECT_EQ(spot.axis, glm::vec3(0, -1, 0));
  EXPECT_FLOAT_EQ(spot.outer_cone, glm::pi<float>() / 6);
  EXPECT_FLOAT_EQ(spot.inner_cone, 0.8f * spot.outer_cone);
  EXPECT_EQ(spot.intensity, glm::vec3(200, 100, 0));
  EXPECT_EQ(spot.range, 9);
}

TEST(CliLamp, ItsTextReadsBackAsTheSame) {
  for (const char* text :
       {"1,2,3", "0.1,-2,3.3:radius=0:cd=0.5:rgb=0.2,1,0.3", "0,3,0:to=1,0,2:cone=55:range=4",
        "0,3,0:to=0,0,0:cone=55:inner=0", "0,3,0:to=0,0,0:cone=30:inner=29", "0,3,0:to=0,0,0:cone=0.05",
        "0,3,0:to=0,0,0:cone=0.001:inner=0.001", "0,3,0:to=0,0,0:cone=30:inner=30",
        "987654,321098,-765432:to=123456,-7890,4321", "1,2,3:cd=5e11:rgb=1,0.5,0.25", "1,2,3:cd=1e12"}) {
    const render::LampLight lamp = parse(text), again = parse(cli::lamp_text(lamp));
    EXPECT_EQ(again.position, lamp.position);
    EXPECT_NEAR(glm::length(again.axis - lamp.axis), 0, 1e-4f);
    EXPECT_NEAR(again.outer_cone, lamp.outer_cone, 1e-6f);
    EXPECT_NEAR(again.inner_cone, lamp.inner_cone, 1e-6f);
    EXPECT_NEAR(glm::length(again.intensity - lamp.intensity), 0, 1e-6f * glm::length(lamp.intensity));
    EXPECT_EQ(again.radius, lamp.radius);
    EXPECT_EQ(again.range, lamp.range);
  }
}

TEST(CliLamp, FaultsAreNamed) {
  for (const char* text : {"",
                           "1,2",
                           "1,2,x",
                           "1,2,3:",
                           "1,2,3:radius",
                           "1,2,3:size=1",
                           "1,2,3:radius=-1",
                           "1,2,3:radius=nan",
                           "1,2,3:cd=1e30",
                           "1,2,3:cone=0",
                           "1,2,3:cone=91",
                           "1,2,3:to=1,2,3",
                           "1,2,3:rgb=-1,0,0",
                           "1,2,3::cd=1",
                           "1,2,inf",
                           "1,2,3:to=0,0,0:cone=20:inner=30",
                           "1,2,3:cd=9e11:cd=9e11",
                           "1,2,3:radius=1:radius=1",
                           "1,2,3:cone=10",
                           "1,2,3:inner=5"})
    EXPECT_NE(fault_of(text), "") << text;
  EXPECT_EQ(fault_of("1,2,3:size=1"),
            "--lamp: no attribute 'size'; there are radius, cd, range, rgb, to, cone and inner");
  EXPECT_EQ(fault_of("1,2,3:cd=5:rgb=1,1,1:cd=5"), "--lamp: cd is given twice");
  EXPECT_EQ(fault_of("1,2,3:cone=10"), "--lamp: cone and inner are of a spot, which needs to=X,Y,Z");
}

}  // namespace
}  // namespace penumbra::test
