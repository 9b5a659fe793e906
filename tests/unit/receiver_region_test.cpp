#include "shadow/receiver_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "shadow/light_projection.h"

namespace penumbra::shadow {
namespace {

CascadeInputs town(float elevation, float sun_angle) {
  CascadeInputs in;
  in.view = glm::lookAt(glm::vec3(3, 1.7f, 8), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0));
  in.projection = glm::perspective(0.9f, 16.0f / 9.0f, 0.1f, 200.0f);
  in.to_light = {std::cos(glm::radians(elevation)), std::sin(glm::radians(elevation)), 0};
  in.tan_half_angle = std::tan(glm::radians(sun_angle) / 2);
  in.casters = in.receivers = {{-60, 0, -60}, {60, 9, 60}};
  return in;
}

// Calls `test` for points of the receivers' box that the view sees, or one that is wider by `beside` in NDC.
template <class Test>
int for_each_seen(const CascadeInputs& in, double beside, const Test& test) {
  const glm::dmat4 world_to_clip = glm::dmat4(in.projection) * glm::dmat4(in.view);
  int seen = 0;
  for (int x = 0; x <= 80; ++x) {
    for (int y = 0; y <= 6; ++y) {
      for (int z = 0; z <= 80; ++z) {
        const glm::dvec3 point = glm::mix(glm::dvec3(in.receivers.min), glm::dvec3(in.receivers.max),
                                          glm::dvec3(x / 80.0, y / 6.0, z / 80.0));
        const glm::dvec4 clip = world_to_clip * glm::dvec4(point, 1);
        const double most = (1 + beside) * clip.w;
        if (clip.w <= 0 || std::abs(clip.x) > most || std::abs(clip.y) > most) continue;
        ++seen;
        test(point);
      }
    }
  }
  return seen;
}

// The rectangle that the casters' box covers in light space: nothing has to be drawn beside it.
LightBounds casters_in(const CascadeInputs& in, const Cascades& cascades) {
  LightBounds bounds;
  for (const glm::dvec3& corner : in.casters.corners()) {
    const glm::dvec3 point = cascades.world_to_light * (corner - cascades.anchor);
    bounds = {glm::min(bounds.low, point), glm::max(bounds.high, point)};
  }
  return bounds;
}

// Texels of a map.
struct Texels {
  glm::dvec2 low, high;
};

// What a disc's bounds are read from: 2 x 2 texels of a pyramid's finest level at which the disc and the texels beside
// it touch no more. `radius`: of the disc, texels.
Texels read_around(const glm::dvec2& place, const glm::dvec2& radius) {
  const glm::dvec2 reach = radius * ((glm::max(radius.x, radius.y) + 1.5) / std::max(radius.x, radius.y));
  double width = 4;
  while (width < 2 * glm::max(reach.x, reach.y)) width *= 2;
  return {glm::floor((place - reach) / width) * width, (glm::floor((place + reach) / width) + 1.0) * width};
}

// How many points have a disc around which the map is not drawn whole, as far as there may be casters, in a cascade
// that contains the point.
int cut_discs(const CascadeInputs& in, const ReadMargins& margins = {}) {
  Cascades cascades = fit_cascades(in);
  narrow_to_receivers(cascades, in, margins);
  const LightBounds casters = casters_in(in, cascades);
  const double nearest = std::min<double>(cascades.items.back().near_z, margins.nearest);
  int cut = 0;
  const int seen = for_each_seen(in, margins.ndc, [&](const glm::dvec3& world) {
    const glm::dvec3 point = cascades.world_to_light * (world - cascades.anchor);
    for (int i = 0; i < in.count; ++i) {
      const Cascade& cascade = cascades.items[static_cast<size_t>(i)];
      const glm::dvec2 from_center = glm::abs(glm::dvec2(point) - glm::dvec2(cascade.center));
      const glm::dvec2 half(cascade.half_extent), texel(cascades.texel(i));
      if (glm::any(glm::greaterThan(from_center, half))) continue;
      const double disc = in.tan_half_angle * (point.z - nearest);
      const glm::dvec2 moved = margins.texels * glm::max(texel.x, texel.y) / texel;
      const glm::dvec2 place = (glm::dvec2(point) - glm::dvec2(cascade.center) + half) / texel;
      const TexelRange drawn = cascades.drawn_texels(i);
      const glm::dvec2 origin = glm::dvec2(cascade.center) - half;
      const glm::dvec2 radius = glm::max(disc / texel, 1e-6);
      const glm::dvec2 low =
          glm::max(read_around(place - moved, radius).low, glm::max((glm::dvec2(casters.low) - origin) / texel, 0.0));
      const glm::dvec2 high =
          glm::min(read_around(place + moved, radius).high,
                   glm::min((glm::dvec2(casters.high) - origin) / texel, static_cast<double>(in.size)));
      if (glm::any(glm::greaterThan(low, high))) continue;
      const bool whole = glm::all(glm::lessThanEqual(glm::dvec2(drawn.first), low)) &&
                         glm::all(glm::greaterThanEqual(glm::dvec2(drawn.last + 1), high));
      if (!whole) ++cut;
    }
  });
  EXPECT_GT(seen, 100);
  return cut;
}

TEST(ReceiverRegion, HoldsTheDiscOfEveryReceiverThatTheViewSees) {
  for (const float elevation : {5.0f, 45.0f, 90.0f}) {
    for (const float angle : {0.0f, 0.53f, 8.0f}) {
      CascadeInputs in = town(elevation, angle);
      EXPECT_EQ(cut_discs(in), 0) << elevation << ", " << angle;
      in.casters = {{-120, 0, -120}, {120, 9, 120}};
      EXPECT_EQ(cut_discs(in), 0) << elevation << ", " << angle << ", casters beside all receivers";
      in.casters = in.receivers;
      in.distance = 20;
      EXPECT_EQ(cut_discs(in), 0) << elevation << ", " << angle << ", within 20 m";
      in.distance = 0;
      in.projection = glm::ortho(-30.0f, 20.0f, -5.0f, 10.0f, 0.0f, 100.0f);
      EXPECT_EQ(cut_discs(in), 0) << elevation << ", " << angle << ", orthographic";
      in.view = glm::lookAt(glm::vec3(0, 40, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1));
      EXPECT_EQ(cut_discs(in), 0) << elevation << ", " << angle << ", from above";
    }
  }
}

// Offsets along normals, jittered views, and casters that were nearer to the light in the last frame.
TEST(ReceiverRegion, HoldsWhatMarginsAskFor) {
  for (const float elevation : {5.0f, 45.0f, 90.0f}) {
    for (const float angle : {0.0f, 0.53f, 8.0f}) {
      const CascadeInputs in = town(elevation, angle);
      EXPECT_EQ(cut_discs(in, {.texels = 40}), 0) << elevation << ", " << angle;
      EXPECT_EQ(cut_discs(in, {.ndc = 0.4}), 0) << elevation << ", " << angle;
      EXPECT_EQ(cut_discs(in, {.nearest = -1000}), 0) << elevation << ", " << angle;
    }
  }
}

// So that a camera that moves a little needs the same ones.
TEST(ReceiverRegion, IsOfWholeBlocksOfTexels) {
  for (const auto& [size, block] : {std::pair(100, 1), {512, 4}, {2048, 16}}) {
    CascadeInputs in = town(45, 0.53f);
    in.size = size;
    Cascades cascades = fit_cascades(in);
    narrow_to_receivers(cascades, in, {});
    EXPECT_EQ(cut_discs(in), 0) << size;
    for (int i = 0; i < in.count; ++i) {
      const TexelRange drawn = cascades.drawn_texels(i);
      EXPECT_EQ(drawn.first % block, glm::ivec2(0)) << size;
      EXPECT_EQ((drawn.last + 1) % block, glm::ivec2(0)) << size;
    }
  }
}

double drawn_share(const LightProjection& projection, int layer) {
  const TexelRange texels = projection.drawn_texels(layer);
  const glm::dvec2 size(texels.last - texels.first + 1);
  return size.x * size.y / (static_cast<double>(projection.size()) * projection.size());
}

TEST(ReceiverRegion, LeavesOutWhatTheViewDoesNotSee) {
  const CascadeInputs in = town(45, 0.53f);
  Cascades cascades = fit_cascades(in);
  const LightProjection whole(cascades);
  narrow_to_receivers(cascades, in, {});
  const LightProjection narrow(cascades);
  for (int i = 0; i < narrow.layers(); ++i) {
    EXPECT_EQ(drawn_share(whole, i), 1.0) << i;
    // What is seen near the camera fills the first layer.
    if (i > 0) {
      EXPECT_LT(drawn_share(narrow, i), 1.0) << i;
    }
    EXPECT_EQ(whole.world_to_clip(i), narrow.world_to_clip(i)) << i;
  }
  const int last = narrow.layers() - 1;
  EXPECT_LT(drawn_share(narrow, last), 0.6);
  // Behind the camera, and within the map.
  const Box behind{{2.9f, 1, 18}, {3.1f, 2, 18.2f}};
  EXPECT_TRUE(whole.cull_volume(last).holds(behind));
  EXPECT_FALSE(narrow.cull_volume(last).holds(behind));
}

// Maps of a wide ground that casts nothing are drawn only around what stands on it.
TEST(ReceiverRegion, HoldsTheCastersAloneWhereTheyAreFew) {
  CascadeInputs in = town(40, 0.53f);
  in.casters = {{-2, 0, -2}, {2, 3, 2}};
  Cascades few = fit_cascades(in);
  Cascades many = few;
  narrow_to_receivers(few, in, {});
  CascadeInputs everywhere = in;
  everywhere.casters = in.receivers;
  narrow_to_receivers(many, everywhere, {});
  const auto area = [](const TexelRange& drawn) {
    const glm::dvec2 size(drawn.last - drawn.first + 1);
    return size.x * size.y;
  };
  for (int i = 0; i < in.count; ++i) {
    const Cascade& cascade = few.items[static_cast<size_t>(i)];
    const TexelRange drawn = few.drawn_texels(i);
    EXPECT_TRUE(many.drawn_texels(i).contains(drawn)) << i;
    for (const glm::dvec3& corner : in.casters.corners()) {
      const glm::dvec3 point = few.world_to_light * (corner - few.anchor);
      const glm::ivec2 texel(
          glm::floor((glm::dvec2(point) - glm::dvec2(cascade.center) + glm::dvec2(cascade.half_extent)) /
                     glm::dvec2(few.texel(i))));
      const TexelRange all = many.drawn_texels(i);
      if (glm::any(glm::lessThan(texel, all.first)) || glm::any(glm::greaterThan(texel, all.last))) continue;
      // With the whole block of a pyramid's finest level, 4 x 4 texels, and the row of texels around it.
      const TexelRange around{glm::max(texel / 4 * 4 - 1, all.first), glm::min(texel / 4 * 4 + 4, all.last)};
      EXPECT_TRUE(drawn.contains(around)) << "cascade " << i;
    }
  }
  const int last = in.count - 1;
  EXPECT_LT(area(few.drawn_texels(last)), 0.05 * area(many.drawn_texels(last)));
}

TEST(ReceiverRegion, IsWithinTheMapWhereTheViewSeesNoReceiver) {
  CascadeInputs in = town(45, 0.53f);
  in.view = glm::lookAt(glm::vec3(0, 50, 0), glm::vec3(0, 100, 1), glm::vec3(0, 1, 0));
  Cascades cascades = fit_cascades(in);
  narrow_to_receivers(cascades, in, {});
  const LightProjection projection(cascades);
  for (int i = 0; i < projection.layers(); ++i) {
    const TexelRange texels = projection.drawn_texels(i);
    EXPECT_TRUE(glm::all(glm::lessThanEqual(texels.first, texels.last))) << i;
    EXPECT_TRUE(glm::all(glm::lessThan(texels.last, glm::ivec2(projection.size())))) << i;
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(texels.first, glm::ivec2(0)))) << i;
  }
}

TEST(CullVolume, ContainsOnlyBoxesThatLieInsideItWhole) {
  const Cascades cascades = fit_cascades(town(45, 0.53f));
  const CullVolume volume = cull_volume(cascades, 0);
  const Cascade& cascade = cascades.items[0];
  const auto box_at = [&](double x) {
    const glm::dvec3 light_space(cascade.center.x + x, cascade.center.y, cascade.near_z);
    const glm::vec3 center(glm::transpose(cascades.world_to_light) * light_space + cascades.anchor);
    return Box{center - 0.1f, center + 0.1f};
  };
  const double half = cascade.half_extent.x;
  EXPECT_TRUE(volume.contains(box_at(0)));
  EXPECT_TRUE(volume.contains(box_at(half - 0.5)));
  EXPECT_TRUE(volume.holds(box_at(half)));
  EXPECT_FALSE(volume.contains(box_at(half)));
  EXPECT_FALSE(volume.contains(box_at(half + 0.5)));
}

}  // namespace
}  // namespace penumbra::shadow
