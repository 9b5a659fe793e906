#include "render/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "lib/sky_map.glsl"

namespace penumbra::render {

namespace {

constexpr float bottom = 6360, top = 6460;  // radii of the ground and of the air's end
constexpr float eye = bottom + 0.2f;
const glm::vec3 rayleigh_scattering(5.802e-3f, 13.558e-3f, 33.1e-3f);
constexpr float rayleigh_height = 8;
constexpr float mie_height = 1.2f, mie_asymmetry = 0.8f;
constexpr float mie_albedo = 0.9f;  // share of scattering (Bruneton and Neyret 2008)
const glm::vec3 ozone_absorption(0.650e-3f, 1.881e-3f, 0.085e-3f);
constexpr float ozone_middle = 25, ozone_width = 15;
constexpr float planet_albedo = 0.3f;

// Radiance at 680, 550 and 440 nm, for which the constants are, to linear Rec. 709: interpolated linearly over the
// wavelength, times the colour-matching functions as Wyman, Sloan and Shirley 2013 fitted them ("Simple analytic
// approximations to the CIE XYZ color matching functions"), so that a radiance of 1 at all wavelengths is white.
const glm::mat3 to_rec709(0.5963f, 0.0303f, -0.0199f, 0.4670f, 0.8790f, 0.0581f, -0.0633f, 0.0907f, 0.9618f);

constexpr float pi = glm::pi<float>();
constexpr float isotropic = 1 / (4 * pi);

// Sizes of the tables, and steps along a ray.
constexpr int transmittance_radii = 24, transmittance_cosines = 48, transmittance_steps = 24;
constexpr int multiple_radii = 12, multiple_cosines = 32, multiple_rings = 8, multiple_spokes = 4, multiple_steps = 16;
constexpr int view_steps = 24;
constexpr int integral_rows = 32;  // of directions

float rayleigh_phase(float cosine) { return 3 / (16 * pi) * (1 + cosine * cosine); }

// Cornette and Shanks 1992, as in the paper.
float mie_phase(float cosine) {
  constexpr float g = mie_asymmetry;
  const float base = 1 + g * g - 2 * g * cosine;
  return 3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) / ((2 + g * g) * base * std::sqrt(base));
}

// From a radius in a direction by its cosine to the zenith: whether the ground is met, and the distance to it or to
// space.
bool meets_ground(float radius, float cosine) {
  return cosine < 0 && radius * radius * (cosine * cosine - 1) + bottom * bottom > 0;
}
float distance_to(float end, float radius, float cosine) {
  const float root = std::sqrt(std::max(radius * radius * (cosine * cosine - 1) + end * end, 0.0f));
  return end == bottom ? -radius * cosine - root : -radius * cosine + root;
}
float path_length(float radius, float cosine) {
  return std::max(distance_to(meets_ground(radius, cosine) ? bottom : top, radius, cosine), 0.0f);
}

// A place along a ray that starts at `radius`.
float radius_at(float radius, float cosine, float distance) {
  return std::clamp(std::sqrt(distance * distance + 2 * radius * cosine * distance + radius * radius), bottom, top);
}

// Steps that are shorter where the ray begins, in denser air: visits their middles and lengths.
template <class Visit>
void march(float length, int steps, Visit visit) {
  const auto place = [&](float step) { return length * step * step / static_cast<float>(steps * steps); };
  for (int i = 0; i < steps; ++i) {
    const auto step = static_cast<float>(i);
    visit(place(step + 0.5f), place(step + 1) - place(step));
  }
}

// Linear interpolation of a table, of which x runs fastest; x and y from 0 to 1.
glm::vec3 look_up(const std::vector<glm::vec3>& table, int width, int height, float x, float y) {
  const glm::vec2 at = glm::clamp(glm::vec2(x, y), 0.0f, 1.0f) * glm::vec2(width - 1, height - 1);
  const glm::ivec2 first = glm::min(glm::ivec2(at), glm::ivec2(width - 2, height - 2));
  const glm::vec2 part = at - glm::vec2(first);
  const auto* texel = &table[static_cast<std::size_t>(first.y * width + first.x)];
  return glm::mix(glm::mix(texel[0], texel[1], part.x), glm::mix(texel[width], texel[width + 1], part.x), part.y);
}

// The transmittance's table has more room near the horizon and the ground (Bruneton and Neyret 2008, section 4).
const float horizon_distance = std::sqrt(top * top - bottom * bottom);

// The side of the horizon where a direction points, as a unit vector.
glm::vec3 side_of(const glm::vec3& direction) {
  const glm::vec3 level(direction.x, 0, direction.z);
  const float length = glm::length(level);
  return length > 1e-6f ? level / length : glm::vec3(0, 0, 1);
}

glm::vec3 above_horizon(const glm::vec3& to_sun) {
  const glm::vec3 unit = glm::normalize(to_sun);
  return unit.y >= 0 ? unit : side_of(unit);
}

// Directions all over the upper hemisphere, with the solid angle of each: those of the upper half of an octahedron,
// seen from above and turned so that the horizon is the edge of a square.
template <class Visit>
void visit_sky(int rows, Visit visit) {
  const auto size = static_cast<float>(rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < rows; ++column) {
      const glm::vec2 turned = (glm::vec2(column, row) + 0.5f) * (2.0f / size) - 1.0f;
      const glm::vec2 level = glm::vec2(turned.x + turned.y, turned.x - turned.y) * 0.5f;
      const glm::vec3 p(level.x, 1.0f - std::abs(level.x) - std::abs(level.y), level.y);
      const float length = glm::length(p);
      visit(p / length, 2.0f / (size * size) / (length * length * length));
    }
  }
}

}  // namespace

Atmosphere::Atmosphere(float haze) : aerosols_(haze / mie_height) {
  std::vector<glm::vec3> table;
  for (int y = 0; y < transmittance_radii; ++y) {
    const float rho = horizon_distance * static_cast<float>(y) / (transmittance_radii - 1);
    const float radius = std::sqrt(rho * rho + bottom * bottom);
    for (int x = 0; x < transmittance_cosines; ++x) {
      const float nearest = top - radius, farthest = rho + horizon_distance;
      const float distance = glm::mix(nearest, farthest, static_cast<float>(x) / (transmittance_cosines - 1));
      const float cosine = distance == 0 ? 1.0f
                                         : (horizon_distance * horizon_distance - rho * rho - distance * distance) /
                                               (2 * radius * distance);
      table.push_back(integrated_transmittance(radius, std::clamp(cosine, -1.0f, 1.0f)));
    }
  }
  transmittance_ = std::move(table);
  for (int y = 0; y < multiple_radii; ++y) {
    const float height = static_cast<float>(y) / (multiple_radii - 1);
    const float radius = bottom + (top - bottom) * height * height * height;
    for (int x = 0; x < multiple_cosines; ++x) {
      const float root = 2 * static_cast<float>(x) / (multiple_cosines - 1) - 1;
      multiple_.push_back(integrated_multiple(radius, root * std::abs(root)));
    }
  }
  glm::vec3 level(0);
  visit_sky(integral_rows, [&](const glm::vec3& direction, float solid_angle) {
    level += radiance(direction, {1, 1, 0}) * (direction.y * solid_angle);
  });
  unit_ = pi / luminance(level);
}

Atmosphere::Medium Atmosphere::medium(float radius) const {
  const float height = radius - bottom;
  const float aerosols = aerosols_ * std::exp(-height / mie_height);
  const float ozone = std::max(1 - std::abs(height - ozone_middle) / ozone_width, 0.0f);
  Medium medium{.rayleigh = rayleigh_scattering * std::exp(-height / rayleigh_height),
                .mie = mie_albedo * aerosols,
                .extinction = {}};
  medium.extinction = medium.rayleigh + aerosols + ozone_absorption * ozone;
  return medium;
}

glm::vec3 Atmosphere::integrated_transmittance(float radius, float cosine) const {
  glm::vec3 depth(0);
  march(std::max(distance_to(top, radius, cosine), 0.0f), transmittance_steps,
        [&](float distance, float step) { depth += medium(radius_at(radius, cosine, distance)).extinction * step; });
  return glm::exp(-depth);
}

// Of a sun of illuminance 1.
glm::vec3 Atmosphere::sunlight(float radius, float cosine) const {
  if (meets_ground(radius, cosine)) return glm::vec3(0);
  const float rho = std::sqrt(std::max(radius * radius - bottom * bottom, 0.0f));
  const float nearest = top - radius, farthest = rho + horizon_distance;
  const float distance = distance_to(top, radius, cosine);
  return look_up(transmittance_, transmittance_cosines, transmittance_radii,
                 (distance - nearest) / (farthest - nearest), rho / horizon_distance);
}

// Equations 5 to 10 of the paper.
glm::vec3 Atmosphere::integrated_multiple(float radius, float sun_cosine) const {
  const float sun_sine = std::sqrt(std::max(1 - sun_cosine * sun_cosine, 0.0f));
  glm::vec3 twice(0), again(0);  // radiance by the second scattering, and the share that each further one leaves
  for (int ring = 0; ring < multiple_rings; ++ring) {
    const float cosine = 2 * (static_cast<float>(ring) + 0.5f) / multiple_rings - 1;
    const float sine = std::sqrt(1 - cosine * cosine);
    const float length = path_length(radius, cosine);
    for (int spoke = 0; spoke < multiple_spokes; ++spoke) {
      const float azimuth = pi * (static_cast<float>(spoke) + 0.5f) / multiple_spokes;  // the other half is its mirror
      const float between = sun_cosine * cosine + sun_sine * sine * std::cos(azimuth);
      glm::vec3 passes(1);
      march(length, multiple_steps, [&](float distance, float step) {
        const float here = radius_at(radius, cosine, distance);
        const Medium air = medium(here);
        const glm::vec3 through = glm::exp(-air.extinction * step);
        const glm::vec3 scattered = passes * (air.rayleigh + air.mie) * (1.0f - through) / air.extinction;
        twice += scattered * isotropic * sunlight(here, (radius * sun_cosine + distance * between) / here);
        again += scattered;
        passes *= through;
      });
      if (!meets_ground(radius, cosine)) continue;
      const float on_ground = (radius * sun_cosine + length * between) / bottom;
      twice += passes * sunlight(bottom, on_ground) * (planet_albedo / pi * std::max(on_ground, 0.0f));
    }
  }
  constexpr float share = 1.0f / (multiple_rings * multiple_spokes);
  return twice * share / (1.0f - again * share);
}

glm::vec3 Atmosphere::multiple(float radius, float sun_cosine) const {
  return look_up(multiple_, multiple_cosines, multiple_radii,
                 std::copysign(std::sqrt(std::abs(sun_cosine)), sun_cosine) * 0.5f + 0.5f,
                 std::cbrt(std::max(radius - bottom, 0.0f) / (top - bottom)));
}

glm::vec3 Atmosphere::radiance(const glm::vec3& direction, const glm::vec3& to_sun) const {
  const glm::vec3 sun = above_horizon(to_sun);
  const float cosine = std::max(direction.y, 0.0f);
  const float between = std::clamp(glm::dot(direction, sun), -1.0f, 1.0f);
  const float rayleigh = rayleigh_phase(between), mie = mie_phase(between);
  glm::vec3 passes(1), sum(0);
  march(path_length(eye, cosine), view_steps, [&](float distance, float step) {
    const float here = radius_at(eye, cosine, distance);
    const float sun_cosine = (eye * sun.y + distance * between) / here;
    const Medium air = medium(here);
    const glm::vec3 through = glm::exp(-air.extinction * step);
    const glm::vec3 scattered = sunlight(here, sun_cosine) * (air.rayleigh * rayleigh + air.mie * mie) +
                                multiple(here, sun_cosine) * (air.rayleigh + air.mie);
    sum += passes * scattered * (1.0f - through) / air.extinction;
    passes *= through;
  });
  return glm::max(to_rec709 * sum, 0.0f);
}

SkyTable Atmosphere::table(const glm::vec3& to_sun) const {
  SkyTable table{.sun_side = side_of(above_horizon(to_sun))};
  table.radiance.reserve(std::size_t{SkyTable::size} * SkyTable::size);
  for (int y = 0; y < SkyTable::size; ++y) {
    for (int x = 0; x < SkyTable::size; ++x) {
      const glm::vec3 direction =
          glsl::sky_direction(glm::vec2(x, y) / (SkyTable::size - 1.0f), {table.sun_side.x, table.sun_side.z});
      table.radiance.emplace_back(unit_ * radiance(direction, to_sun), 1.0f);
    }
  }
  // Spherical harmonics of the first two orders, whose pole is the zenith; the sky is symmetric about the sun's side.
  glm::vec3 l00(0), l10(0), l11(0), l20(0), l21(0), l22(0);
  // The terms of what is mirrored: least squares of the errors relative to the luminance.
  glm::dmat3 products(0);
  glm::dmat3 moments(0);
  visit_sky(integral_rows, [&](const glm::vec3& direction, float solid_angle) {
    const glm::vec3 seen = unit_ * radiance(direction, to_sun);
    const glm::vec3 light = seen * solid_angle;
    const float y = direction.y, u = glm::dot(direction, table.sun_side);
    const float low = glsl::low_sky(y);
    const glm::dvec3 terms(1, low, low * u);
    const double weight = solid_angle / std::pow(luminance(seen), 2);
    products += glm::outerProduct(terms, weight * terms);
    moments += glm::outerProduct(weight * terms, glm::dvec3(seen));
    l00 += light * 0.282095f;
    l10 += light * (0.488603f * y);
    l11 += light * (0.488603f * u);
    l20 += light * (0.315392f * (3.0f * y * y - 1.0f));
    l21 += light * (1.092548f * y * u);
    l22 += light * (0.546274f * (2.0f * u * u + y * y - 1.0f));
  });
  // Of each order: the share that the cosine leaves, over pi.
  constexpr float first = 2.0f / 3.0f, second = 0.25f;
  table.irradiance = {0.282095f * l00 - second * (0.315392f * l20 + 0.546274f * l22),
                      first * 0.488603f * l10,
                      first * 0.488603f * l11,
                      second * (3.0f * 0.315392f * l20 + 0.546274f * l22),
                      second * 1.092548f * l21,
                      second * 2.0f * 0.546274f * l22};
  const glm::dmat3 mirrored = glm::transpose(glm::inverse(products) * moments);
  for (int i = 0; i < 3; ++i) table.mirrored[static_cast<std::size_t>(i)] = mirrored[i];
  return table;
}

}  // namespace penumbra::render
