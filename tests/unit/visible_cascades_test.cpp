// Cascades that are fitted to the receivers which the view shows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "shadow/cascades.h"

namespace penumbra::shadow {
namespace {

// A slice that is a rectangle, `width` metres long and half as wide, centred in light space, that so many pixels show.
// `turn`: the angle of its long side, radians.
ReceiverSlice slice(std::uint32_t pixels, double width, double turn = 0) {
  ReceiverSlice made{.pixels = pixels, .extents = {}, .depths = {5, 10}};
  for (std::size_t k = 0; k < made.extents.size(); ++k) {
    const double angle = glm::pi<double>() * static_cast<double>(k) / measured_directions - turn;
    const double reach = width * (0.5 * std::abs(std::cos(angle)) + 0.25 * std::abs(std::sin(angle)));
    made.extents[k] = {-reach, reach};
  }
  return made;
}

int x_axis(const Cascades& cascades) {
  return static_cast<int>(std::lround(cascades.turn * measured_directions / glm::pi<double>()));
}

CascadeInputs inputs(const VisibleReceivers& visible, int count) {
  CascadeInputs in;
  in.view = glm::lookAt(glm::vec3(0, 2, 0), glm::vec3(0, 1, -10), glm::vec3(0, 1, 0));
  in.projection = glm::perspective(0.9f, 1.5f, 0.1f, 200.0f);
  in.to_light = glm::normalize(glm::vec3(0.4f, 0.7f, 0.2f));
  in.casters = in.receivers = {{-200, 0, -200}, {200, 9, 200}};
  in.count = count;
  in.size = 1024;
  in.visible = visible;
  return in;
}

// The width of a square of the area of the cascade, with whatever index, in which a slice's pixels read.
double width_for(const Cascades& cascades, const ReceiverSlice& slice) {
  const auto holds = [&](const Cascade& cascade) {
    const LightBounds bounds = slice.bounds(x_axis(cascades));
    const glm::dvec2 center(cascade.center), half(cascade.half_extent);
    return glm::all(glm::greaterThanEqual(glm::dvec2(bounds.low), center - half)) &&
           glm::all(glm::lessThanEqual(glm::dvec2(bounds.high), center + half));
  };
  const auto found = std::ranges::find_if(cascades.items, holds);
  if (found == cascades.items.end()) return std::numeric_limits<double>::infinity();
  return 2.0 * std::sqrt(found->half_extent.x * found->half_extent.y);
}

// The mean over all pixels of the logarithm of their texels.
double cost_of(const Cascades& cascades, const VisibleReceivers& slices) {
  double sum = 0, pixels = 0;
  for (const ReceiverSlice& slice : slices) {
    sum += slice.pixels * std::log2(width_for(cascades, slice) / cascades.size);
    pixels += slice.pixels;
  }
  return sum / pixels;
}

// The same for cascades that end at these slices and have so many texels together.
double cost_of_ends(const std::vector<std::size_t>& ends, const VisibleReceivers& slices, double texels) {
  const double size_of_map = std::sqrt(texels / static_cast<double>(ends.size()));
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const std::size_t end = *std::ranges::lower_bound(ends, i);
    const LightBounds bounds = slices[end].bounds(0);
    const glm::dvec2 size = glm::dvec2(bounds.high) - glm::dvec2(bounds.low);
    sum += slices[i].pixels * std::log2(std::sqrt(size.x * size.y) / size_of_map);
    pixels += slices[i].pixels;
  }
  return sum / pixels;
}

TEST(VisibleCascades, EndWhereThePixelsTexelsBecomeFinest) {
  const VisibleReceivers slices{slice(1000, 1), slice(10, 1.5), slice(3000, 9),
                                slice(40, 20),  slice(900, 33), slice(900, 90)};
  for (const int count : {1, 2, 3, 4, 6}) {
    const CascadeInputs in = inputs(slices, count);
    const std::size_t most = static_cast<std::size_t>(count), fewest = std::min(most, std::size_t{2});
    // Every choice of the slices at which all cascades but the last end.
    double best = std::numeric_limits<double>::infinity();
    const std::size_t last = slices.size() - 1;
    for (unsigned chosen = 0; chosen < 1u << last; ++chosen) {
      std::vector<std::size_t> ends;
      for (std::size_t i = 0; i < last; ++i) {
        if ((chosen >> i & 1u) != 0) ends.push_back(i);
      }
      ends.push_back(last);
      if (ends.size() >= fewest && ends.size() <= most)
        best = std::min(best, cost_of_ends(ends, slices, static_cast<double>(in.size) * in.size * count));
    }
    // A cascade's width is rounded up to a sixteenth of an octave, and has a margin of two texels on each side; its
    // texels are rounded down to a multiple of 16.
    const double cost = cost_of(fit_cascades(in), slices);
    EXPECT_GE(cost, best - 1e-3) << count;
    EXPECT_LE(cost, best + 1.0 / 16 + 0.04) << count;
  }
}

// All cascades but the last are for the receivers that a penumbra may reach.
TEST(VisibleCascades, ThoseForPenumbraeEndWithThem) {
  CascadeInputs in = inputs({slice(1000, 30), slice(3000, 60), slice(500, 90)}, 4);
  in.near_penumbrae = VisibleReceivers{slice(100, 1), slice(300, 1.5)};
  const Cascades cascades = fit_cascades(in);
  ASSERT_EQ(cascades.items.size(), 2u);
  EXPECT_EQ(cascades.size, 1440);  // the texels of four maps of 1024²
  const auto width = [&](std::size_t i) {
    return 2 * glm::max(cascades.items[i].half_extent.x, cascades.items[i].half_extent.y);
  };
  // With margins for the light's discs, of up to a quarter of the width.
  EXPECT_GE(width(0), 1.5f);
  EXPECT_LE(width(0), 1.5f * 1.25f * 1.06f);
  EXPECT_GE(width(1), 90);
  // A single cascade holds all.
  in.count = 1;
  EXPECT_GE(2 * fit_cascades(in).items.at(0).half_extent.x, 45);
}

// A cascade is as long and as wide as what it shows, whichever way that lies.
TEST(VisibleCascades, TurnWithWhatTheyShow) {
  constexpr double step = glm::pi<double>() / measured_directions;
  for (const int turn : {0, 1, 7, 16, 27}) {
    CascadeInputs in = inputs({slice(1000, 40, turn * step)}, 1);
    const Cascades turned = fit_cascades(in);
    EXPECT_EQ(x_axis(turned), turn % (measured_directions / 2)) << turn;
    const glm::dmat3 from_unturned = turned.world_to_light * glm::transpose(light_axes(in.to_light));
    const glm::dvec3 far_end = from_unturned * glm::dvec3(20 * std::cos(turn * step), 20 * std::sin(turn * step), 5);
    const glm::vec2 half = turned.items[0].half_extent;
    EXPECT_LE(std::abs(far_end.x - turned.items[0].center.x), half.x) << turn;
    EXPECT_LE(std::abs(far_end.y - turned.items[0].center.y), half.y) << turn;
    EXPECT_NEAR(std::max(half.x, half.y) / std::min(half.x, half.y), 2, 0.1) << turn;
    EXPECT_NEAR(std::max(half.x, half.y), 20, 1) << turn;
    in.may_turn = false;
    EXPECT_EQ(fit_cascades(in).world_to_light, light_axes(in.to_light)) << turn;
  }
}

// A texel's width and height never differ by more than a factor of four (and a step of its size).
TEST(VisibleCascades, AreNotNarrowStripes) {
  VisibleReceivers line{slice(1000, 40)};
  for (glm::dvec2& extent : line[0].extents) extent *= 1e-3;
  line[0].extents[0] = {-20, 20};
  const glm::vec2 half = fit_cascades(inputs(line, 1)).items[0].half_extent;
  EXPECT_LE(std::max(half.x, half.y) / std::min(half.x, half.y), 4 * 1.05f);
}

// Fewer cascades where more of them would have hardly finer texels; each then has more of these.
TEST(VisibleCascades, AreAsManyAsMakeTheFinestTexels) {
  struct Case {
    VisibleReceivers slices;
    int count, maps, size;
  };
  const VisibleReceivers alike{slice(100, 10), slice(100, 10.5), slice(100, 11), slice(100, 12), slice(100, 13)};
  const VisibleReceivers unlike{slice(100, 0.01), slice(100, 0.1), slice(100, 1), slice(100, 10), slice(100, 100)};
  for (const Case& each : {Case{alike, 4, 2, 1440}, Case{unlike, 4, 4, 1024}, Case{alike, 8, 2, 2048},
                           Case{alike, 2, 2, 1024}, Case{alike, 1, 1, 1024}, Case{unlike, 8, 5, 1280}}) {
    const Cascades cascades = fit_cascades(inputs(each.slices, each.count));
    EXPECT_EQ(cascades.items.size(), static_cast<std::size_t>(each.maps)) << each.count;
    EXPECT_EQ(cascades.size, each.size) << each.count;
  }
}

TEST(VisibleCascades, HaveTheSizeThatIsAskedForWhereTexelsAreNotDivided) {
  CascadeInputs in = inputs({slice(100, 10), slice(100, 10.5), slice(100, 11), slice(100, 12), slice(100, 13)}, 4);
  in.divides_texels = false;
  const Cascades cascades = fit_cascades(in);
  EXPECT_EQ(cascades.items.size(), 4u);
  EXPECT_EQ(cascades.size, 1024);
}

// The last cascade also holds what is drawn forward. Where that is far wider than the rest, more cascades stay fine.
TEST(VisibleCascades, AreMoreWhereOtherReceiversWidenTheLastOne) {
  CascadeInputs in = inputs({slice(100, 1), slice(100, 4), slice(100, 16), slice(5, 17)}, 4);
  const std::size_t alone = fit_cascades(in).items.size();
  in.others = {{-150, 0, -150}, {150, 1, 150}};
  EXPECT_GT(fit_cascades(in).items.size(), alone);
}

TEST(VisibleCascades, OfPlacesThatAreNoNumbersAreOne) {
  VisibleReceivers slices{slice(100, 10)};
  for (const double end : {1e300, std::numeric_limits<double>::quiet_NaN()}) {
    for (glm::dvec2& extent : slices[0].extents) extent = {-end, end};
    for (const int count : {1, 4}) EXPECT_EQ(fit_cascades(inputs(slices, count)).items.size(), 1u);
  }
}

TEST(VisibleCascades, HaveNoMoreTexelsThanTheyMay) {
  const VisibleReceivers slices{slice(100, 10), slice(100, 10.5), slice(100, 11)};
  for (const int size : {16, 17, 100, 1000, 2048, 8191, 8192}) {
    CascadeInputs in = inputs(slices, 4);
    in.size = size;
    const Cascades cascades = fit_cascades(in);
    EXPECT_GE(cascades.size, size);
    EXPECT_LE(cascades.size, std::max(size, max_cascade_size));
    EXPECT_LE(static_cast<double>(cascades.size) * cascades.size * static_cast<double>(cascades.items.size()),
              4.0 * size * size);
  }
}

TEST(VisibleCascades, AreNotMoreThanThereAreSlices) {
  const VisibleReceivers slices{slice(7, 2), slice(5, 30)};
  const Cascades cascades = fit_cascades(inputs(slices, 4));
  ASSERT_EQ(cascades.items.size(), 2u);
  for (const ReceiverSlice& each : slices) EXPECT_TRUE(std::isfinite(width_for(cascades, each)));
}

TEST(VisibleCascades, OfASinglePointHaveAnExtent) {
  VisibleReceivers point{slice(1, 0)};
  point[0].depths = {10, 10};
  for (const Cascade& cascade : fit_cascades(inputs(point, 4)).items) {
    EXPECT_GT(cascade.half_extent.x, 0);
    EXPECT_GT(cascade.half_extent.y, 0);
    EXPECT_GT(cascade.far_z, cascade.near_z);
  }
}

// A receiver's disc is as wide as the light's cone at the height of the highest caster.
TEST(VisibleCascades, TheLastHoldsTheDiscsOfItsReceivers) {
  CascadeInputs in = inputs({slice(100, 2), slice(100, 6)}, 3);
  in.tan_half_angle = std::tan(glm::radians(5.0f));
  in.casters = {{-1000, 0, -1000}, {1000, 80, 1000}};
  const Cascades cascades = fit_cascades(in);
  const glm::dmat3 to_world = glm::transpose(cascades.world_to_light);
  for (const double x : {-3.0, 3.0}) {
    for (const double edge : {-1.0, 1.0}) {
      const glm::dvec3 receiver(x, 0, 10);
      // The ray from the receiver to an edge of the sun, up to the top of the casters' box.
      const glm::dvec3 ray = glm::dvec3(edge * in.tan_half_angle, 0, -1);
      const double height = (cascades.anchor + to_world * receiver).y;
      const glm::dvec3 top = receiver + ray * ((80 - height) / (to_world * ray).y);
      const Cascade& last = cascades.items.back();
      EXPECT_LE(std::abs(top.x - last.center.x), last.half_extent.x) << x << ", " << edge;
      EXPECT_GE(top.z, last.near_z);
    }
  }
}

// A receiver reads 1.5 texels of the longer side beside it (layer_edge() in glsl/shadow/projection/layers.glsl), also
// where texels are long and the light is a point, so that no margin for discs covers them.
TEST(VisibleCascades, TheLastHoldsTheTexelsBesideItsReceivers) {
  for (int i = 0; i < 400; ++i) {
    const double width = 2 + 0.01 * i;
    ReceiverSlice long_slice = slice(100, width);
    for (glm::dvec2& extent : long_slice.extents) extent += 0.37 * width;
    CascadeInputs in = inputs({long_slice}, 1);
    in.may_turn = false;
    in.size = 64;
    in.jitter = glm::dvec2(0.01 * (i % 100));
    const Cascades cascades = fit_cascades(in);
    const Cascade& last = cascades.items.back();
    const LightBounds bounds = long_slice.bounds(x_axis(cascades));
    const glm::vec2 texel = cascades.texel(0);
    const glm::dvec2 beside(1.5 * std::max(texel.x, texel.y));
    const glm::dvec2 low = glm::dvec2(bounds.low) - beside, high = glm::dvec2(bounds.high) + beside;
    const glm::dvec2 center(last.center), half(last.half_extent);
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(low, center - half)) &&
                glm::all(glm::lessThanEqual(high, center + half)))
        << width;
  }
}

TEST(VisibleCascades, TheLastHoldsOtherReceiversInTheViewAlone) {
  const VisibleReceivers slices{slice(1000, 1), slice(1000, 2)};
  CascadeInputs in = inputs(slices, 2);
  in.may_turn = false;  // else the axes would turn for the others, too
  const Cascades without = fit_cascades(in);
  in.others = {{-1, 0, -40}, {1, 2, -38}};
  const Cascades ahead = fit_cascades(in);
  for (const glm::dvec3& corner : in.others.corners()) {
    const glm::dvec4 clip = ahead.items.back().world_to_clip * glm::dvec4(corner, 1);
    EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), 1.0);
  }
  EXPECT_EQ(ahead.items.front().half_extent, without.items.front().half_extent);
  in.others = {{-1, 0, 38}, {1, 2, 40}};  // behind the camera
  EXPECT_EQ(fit_cascades(in).items.back().half_extent, without.items.back().half_extent);
}

}  // namespace
}  // namespace penumbra::shadow
