// The clear sky: the equations of Hillaire 2020, and the table and irradiance that pictures take from
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "lib/sky_map.glsl"
#include "render/atmosphere.h"
#include "render/setup.h"

namespace penumbra::test {
namespace {

using render::Atmosphere;
using render::SkyTable;

// The paper's equations in double precision, without tables: each integral is a sum of its own. Kilometres.
struct Published {
  double haze;  // optical depth of the aerosols
  static constexpr double bottom = 6360, top = 6460, pi = glm::pi<double>();
  int dirs_up = 12, dirs_round = 6, fine = 40;

  struct Air {
    glm::dvec3 rayleigh, extinction;
    double mie;
  };
  Air air(double radius) const {
    const double height = radius - bottom, aerosols = haze / 1.2 * std::exp(-height / 1.2);
    const glm::dvec3 rayleigh = glm::dvec3(5.802e-3, 13.558e-3, 33.1e-3) * std::exp(-height / 8);
    const glm::dvec3 ozone = glm::dvec3(0.650e-3, 1.881e-3, 0.085e-3) * std::max(0.0, 1 - std::abs(height - 25) / 15);
    return {rayleigh, rayleigh + aerosols + ozone, 0.9 * aerosols};
  }
  // Where a ray from (0, radius) leaves the air or meets the ground.
  static double end_of(double radius, double cosine, bool& ground) {
    const double to_ground = radius * radius * (cosine * cosine - 1) + bottom * bottom;
    ground = cosine < 0 && to_ground > 0;
    if (ground) return -radius * cosine - std::sqrt(to_ground);
    return -radius * cosine + std::sqrt(radius * radius * (cosine * cosine - 1) + top * top);
  }
  // Calls visit(distance, step) along a ray.
  template <class Visit>
  static void march(double length, int steps, Visit visit) {
    for (int i = 0; i < steps; ++i) {
      const double from = double(i) / steps, to = double(i + 1) / steps;
      visit(length * (from * from + to * to) / 2, length * (to * to - from * from));
    }
  }
  static double radius_after(double radius, double cosine, double distance) {
    return std::sqrt(radius * radius + distance * distance + 2 * radius * cosine * distance);
  }
  glm::dvec3 sunlight(double radius, double cosine) const {
    bool ground = false;
    const double length = end_of(radius, cosine, ground);
    if (ground) return glm::dvec3(0);
    glm::dvec3 depth(0);
    march(length, fine,
          [&](double d, double step) { depth += air(radius_after(radius, cosine, d)).extinction * step; });
    return glm::exp(-depth);
  }
  glm::dvec3 multiple(double radius, double sun) const {
    glm::dvec3 second(0), factor(0);
    for (int i = 0; i < dirs_up; ++i) {
      const double cosine = 2 * (i + 0.5) / dirs_up - 1, sine = std::sqrt(1 - cosine * cosine);
      for (int j = 0; j < dirs_round; ++j) {
        const double between =
            cosine * sun + sine * std::sqrt(1 - sun * sun) * std::cos(2 * pi * (j + 0.5) / dirs_round);
        bool ground = false;
        const double length = end_of(radius, cosine, ground);
        glm::dvec3 depth(0);
        march(length, fine, [&](double d, double step) {
          const double here = radius_after(radius, cosine, d);
          const Air a = air(here);
          const glm::dvec3 scattered = glm::exp(-depth - 0.5 * step * a.extinction) * (a.rayleigh + a.mie) * step;
          second += scattered * sunlight(here, (radius * sun + d * between) / here) / (4 * pi);
          factor += scattered;
          depth += a.extinction * step;
        });
        const double on_ground = (radius * sun + length * between) / bottom;
        if (ground && on_ground > 0) second += glm::exp(-depth) * 0.3 / pi * on_ground * sunlight(bottom, on_ground);
      }
    }
    const double count = dirs_up * dirs_round;
    return second / count / (1.0 - factor / count);
  }
  // At 680, 550 and 440 nm.
  glm::dvec3 radiance(const glm::dvec3& from, const glm::dvec3& to_sun) const {
    const double eye = bottom + 0.2, between = glm::dot(from, to_sun), g = 0.8;
    const double rayleigh = 3 / (16 * pi) * (1 + between * between);
    const double mie = 3 / (8 * pi) * (1 - g * g) * (1 + between * between) /
                       ((2 + g * g) * std::pow(1 + g * g - 2 * g * between, 1.5));
    bool ground = false;
    glm::dvec3 depth(0), sum(0);
    march(end_of(eye, from.y, ground), 60, [&](double d, double step) {
      const double here = radius_after(eye, from.y, d), sun = (eye * to_sun.y + d * between) / here;
      const Air a = air(here);
      sum += glm::exp(-depth - 0.5 * step * a.extinction) * step *
             ((a.rayleigh * rayleigh + a.mie * mie) * sunlight(here, sun) + (a.rayleigh + a.mie) * multiple(here, sun));
      depth += a.extinction * step;
    });
    return sum;
  }
};

float luminance(const glm::vec3& c) { return glm::dot(c, {0.2126f, 0.7152f, 0.0722f}); }

glm::vec3 direction(double azimuth, double elevation) {
  return render::direction_to(static_cast<float>(glm::radians(azimuth)), static_cast<float>(glm::radians(elevation)));
}

constexpr double azimuths = 72, elevations = 45;

// Visits directions of the upper hemisphere on a grid, with their solid angles.
template <class Visit>
void visit_sky(Visit visit) {
  for (double azimuth = 180 / azimuths; azimuth < 360; azimuth += 360 / azimuths) {
    for (double elevation = 45 / elevations; elevation < 90; elevation += 90 / elevations)
      visit(direction(azimuth, elevation),
            std::cos(glm::radians(elevation)) * glm::radians(90 / elevations) * glm::radians(360 / azimuths));
  }
}

// Irradiance over pi of a plane, by the sky alone.
glm::dvec3 irradiance(const Atmosphere& sky, const glm::vec3& to_sun, const glm::vec3& normal) {
  glm::dvec3 sum(0);
  visit_sky([&](const glm::vec3& from, double solid_angle) {
    sum += glm::dvec3(sky.radiance(from, to_sun)) * (std::max(glm::dot(from, normal), 0.0f) * solid_angle);
  });
  return sum / glm::pi<double>();
}

TEST(AtmosphereTest, IsThatOfThePublishedEquations) {
  for (const float haze : {0.05f, 0.3f}) {
    const Atmosphere sky(haze);
    const Published published{.haze = haze};
    for (const double elevation : {5.0, 45.0}) {
      const glm::vec3 to_sun = direction(70, elevation);
      for (const glm::vec3& from : {direction(0, 90), direction(85, 30), direction(250, 4)}) {
        // Light at wavelengths becomes Rec. 709 by a matrix that keeps white; its rows are those of the code.
        const glm::dvec3 at = published.radiance(from, to_sun);
        const glm::dvec3 expected(0.5963 * at.x + 0.4670 * at.y - 0.0633 * at.z,
                                  0.0303 * at.x + 0.8790 * at.y + 0.0907 * at.z,
                                  -0.0199 * at.x + 0.0581 * at.y + 0.9618 * at.z);
        const glm::vec3 seen = sky.radiance(from, to_sun);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(seen[i], expected[i], 0.06 * expected[i])
              << haze << ' ' << elevation << ' ' << from.x << ' ' << from.y << ' ' << i;
      }
    }
  }
}

TEST(AtmosphereTest, IsBlueAtTheZenithPaleAtTheHorizonAndAsBrightAsMeasuredSkies) {
  const Atmosphere sky(0.1f);
  const glm::vec3 to_sun = direction(0, 45);
  const glm::vec3 zenith = sky.radiance({0, 1, 0}, to_sun), horizon = sky.radiance(direction(90, 0.5), to_sun);
  EXPECT_GT(zenith.b, 1.8f * zenith.r);
  EXPECT_LT(horizon.b, 1.5f * horizon.r);
  EXPECT_GT(luminance(horizon), 1.5f * luminance(zenith));
  // The sun gives 128 klx outside of the air, and the clear sky 0.8 + 15.5 sqrt(sine of its elevation) klx to a level
  // plane (Gillette, Pierpoint and Treado 1984, "A general illuminance model for daylight availability").
  const double level = 128 * luminance(irradiance(sky, to_sun, {0, 1, 0})) * glm::pi<double>();
  EXPECT_NEAR(level, 0.8 + 15.5 * std::sqrt(to_sun.y), 3);
}

TEST(AtmosphereTest, IsDarkerUnderALowerSunAndDefinedUnderEverySun) {
  double last = 1e9;
  const Atmosphere usual(0.1f);
  for (const double elevation : {60.0, 45.0, 30.0, 15.0, 5.0, 0.0}) {
    const double level = luminance(irradiance(usual, direction(20, elevation), {0, 1, 0}));
    EXPECT_LT(level, last) << elevation;
    EXPECT_GT(level, 0) << elevation;
    last = level;
  }
  for (const float haze : {0.0f, 1.0f}) {
    const Atmosphere sky(haze);
    for (const glm::vec3& to_sun :
         {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), direction(20, -30), direction(20, 1e-5), glm::vec3(3, 4, 0)}) {
      visit_sky([&](const glm::vec3& from, double) {
        const glm::vec3 seen = sky.radiance(from, to_sun);
        ASSERT_TRUE(std::isfinite(seen.r + seen.g + seen.b));
        ASSERT_GE(std::min({seen.r, seen.g, seen.b}), 0);
        ASSERT_GT(seen.g, 0);
        const glm::vec3 below = sky.radiance({from.x, -from.y, from.z}, to_sun);
        ASSERT_TRUE(std::isfinite(below.r + below.g + below.b));
      });
    }
  }
  // After sunset it stays that of the sunset.
  const glm::vec3 set = usual.radiance(direction(50, 20), direction(20, -30));
  const glm::vec3 setting = usual.radiance(direction(50, 20), direction(20, 0));
  EXPECT_LT(glm::distance(set, setting), 1e-5f * glm::length(setting));
}

TEST(AtmosphereTest, IsBrightestNearTheSun) {
  const Atmosphere sky(0.1f);
  for (const double elevation : {10.0, 20.0, 45.0, 70.0}) {
    const glm::vec3 to_sun = direction(130, elevation);
    glm::vec3 brightest(0, 1, 0);
    visit_sky([&](const glm::vec3& from, double) {
      if (luminance(sky.radiance(from, to_sun)) > luminance(sky.radiance(brightest, to_sun))) brightest = from;
    });
    EXPECT_GT(glm::dot(brightest, to_sun), std::cos(glm::radians(7.0)))
        << elevation << ": directions are up to 5 degrees apart";
  }
}

TEST(SkyTableTest, ItsIrradianceIsTheIntegralOfTheSky) {
  for (const float haze : {0.0f, 0.1f, 0.4f}) {
    const Atmosphere sky(haze);
    const double unit = luminance(irradiance(sky, direction(0, 45), {0, 1, 0}));
    for (const double elevation : {2.0, 20.0, 45.0, 85.0}) {
      const glm::vec3 to_sun = direction(200, elevation);
      const SkyTable table = sky.table(to_sun);
      const double level = luminance(irradiance(sky, to_sun, {0, 1, 0})) / unit;
      for (const glm::vec3& n : {glm::vec3(0, 1, 0), direction(200, 0), direction(20, 0), direction(110, 0),
                                 direction(200, 45), direction(20, 45), direction(80, -30), glm::vec3(0, -1, 0)}) {
        const float u = glm::dot(n, table.sun_side);
        const std::array<float, 6> terms{1, n.y, u, n.y * n.y, n.y * u, u * u};
        glm::vec3 seen(0);
        for (std::size_t i = 0; i < terms.size(); ++i) seen += terms[i] * table.irradiance[i];
        const glm::dvec3 expected = irradiance(sky, to_sun, n) / unit;
        // What these harmonics leave out, in the light of a level plane.
        EXPECT_NEAR(luminance(seen), luminance(expected), 0.1 * std::max<double>(level, luminance(expected)))
            << haze << ' ' << elevation << ' ' << n.x << ' ' << n.y << ' ' << n.z;
        if (elevation == 45.0 && n.y == 1) {
          EXPECT_NEAR(luminance(seen), 1, 0.05) << haze;
        }
      }
    }
  }
}

TEST(SkyTableTest, SurfacesMirrorTheSkyWithoutItsFineDetail) {
  for (const float haze : {0.0f, 0.1f, 0.4f}) {
    const Atmosphere sky(haze);
    for (const double elevation : {-10.0, 2.0, 20.0, 45.0, 85.0}) {
      const glm::vec3 to_sun = direction(200, elevation);
      const SkyTable table = sky.table(to_sun);
      const float unit = table.radiance.back().g / sky.radiance({0, 1, 0}, to_sun).g;
      double errors = 0, solid_angles = 0;
      visit_sky([&](const glm::vec3& from, double solid_angle) {
        const float low = glsl::low_sky(from.y);
        const glm::vec3 mirrored =
            table.mirrored[0] + low * table.mirrored[1] + low * glm::dot(from, table.sun_side) * table.mirrored[2];
        ASSERT_GE(std::min({mirrored.r, mirrored.g, mirrored.b}), 0);
        const glm::vec3 seen = unit * sky.radiance(from, to_sun);
        for (int i = 0; i < 3; ++i) errors += solid_angle * std::abs(mirrored[i] - seen[i]) / seen[i] / 3;
        solid_angles += solid_angle;
      });
      EXPECT_LT(errors / solid_angles, 0.3) << haze << ' ' << elevation;
    }
  }
}

TEST(SkyTableTest, HoldsEachDirectionWherePicturesLookForIt) {
  const glm::vec3 to_sun = direction(250, 30);
  const Atmosphere sky(0.1f);
  const SkyTable table = sky.table(to_sun);
  const glm::vec2 side(table.sun_side.x, table.sun_side.z);
  ASSERT_EQ(table.radiance.size(), std::size_t{SkyTable::size} * SkyTable::size);
  const auto texel = [&](const glm::ivec2& at) {
    const glm::ivec2 inside = glm::clamp(at, 0, SkyTable::size - 1);
    return table.radiance[static_cast<std::size_t>(inside.y * SkyTable::size + inside.x)].g;
  };
  const auto seen_at = [&](const glm::vec3& from) {  // by linear interpolation
    const glm::vec2 place = glsl::sky_place(from, side) * (SkyTable::size - 1.0f);
    const glm::ivec2 at(glm::floor(place));
    const glm::vec2 part = place - glm::vec2(at);
    return glm::mix(glm::mix(texel(at), texel(at + glm::ivec2(1, 0)), part.x),
                    glm::mix(texel(at + glm::ivec2(0, 1)), texel(at + glm::ivec2(1, 1)), part.x), part.y);
  };
  visit_sky([&](const glm::vec3& from, double) {
    // The direction, or its mirror image in the sun's plane.
    const glm::vec3 found = glsl::sky_direction(glsl::sky_place(from, side), side);
    EXPECT_NEAR(glm::length(found), 1, 1e-5f);
    EXPECT_NEAR(found.y, from.y, 1e-5f);
    EXPECT_NEAR(glm::dot(found, table.sun_side), glm::dot(from, table.sun_side), 1e-5f);
    const float expected = seen_at({0, 1, 0}) * sky.radiance(from, to_sun).g / sky.radiance({0, 1, 0}, to_sun).g;
    EXPECT_NEAR(seen_at(from), expected, 0.1f * expected) << from.x << ' ' << from.y << ' ' << from.z;
  });
  for (const glm::vec3& below : {direction(10, -20), direction(200, -89), glm::vec3(0, -1, 0.001f)}) {
    EXPECT_EQ(glsl::sky_place(below, side).y, 0) << "the horizon";
  }
}

}  // namespace
}  // namespace penumbra::test
