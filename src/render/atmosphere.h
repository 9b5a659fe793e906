#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra::render {

// Of linear Rec. 709.
inline float luminance(const glm::vec3& color) { return glm::dot(color, {0.2126f, 0.7152f, 0.0722f}); }

// A sky as pictures need it. Radiance is divided by the luminous irradiance over pi of a level plane under a sun that
// is 45 degrees high: so it is about 1 in that light, and darker when the sun is low.
struct SkyTable {
  static constexpr int size = 48;  // texels along each side

  std::vector<glm::vec4> radiance;  // by places of glsl/lib/sky_map.glsl, row by row from 0 to 1; A: 1
  glm::vec3 sun_side{0, 0, 1};      // the side of the horizon where the sun is: unit
  // Irradiance over pi of a plane by its normal n: the sum of these times 1, y, u, y², yu, u², where u is n's part
  // towards the sun's side (Ramamoorthi and Hanrahan 2001, "An efficient representation for irradiance environment
  // maps").
  std::array<glm::vec3, 6> irradiance{};
  // Radiance as surfaces mirror it, smoother than that of the table, and without a look-up: the sum of these times 1,
  // low_sky(y) and u low_sky(y).
  std::array<glm::vec3, 3> mirrored{};
};

// Clear air around a planet like the Earth, seen from near the ground: Hillaire 2020, "A scalable and production ready
// sky and atmosphere rendering technique", with the constants of its table 1. Distances are in kilometres.
class Atmosphere {
 public:
  // `haze`: the optical depth of the aerosols from the ground to space; 0.1 is that of clear air inland.
  explicit Atmosphere(float haze);

  // The radiance from a direction (unit, world) without the sun's own disc, under a sun of illuminance 1 outside of the
  // air: linear Rec. 709. Below the horizon: that of the horizon. `to_sun`: any length; a sun below the horizon counts
  // as one that sets there.
  glm::vec3 radiance(const glm::vec3& direction, const glm::vec3& to_sun) const;

  SkyTable table(const glm::vec3& to_sun) const;

 private:
  // What fills the air at a height, 1/km.
  struct Medium {
    glm::vec3 rayleigh;    // scattering by molecules
    float mie;             // scattering by aerosols
    glm::vec3 extinction;  // by all
  };
  Medium medium(float radius) const;
  // Share of light that passes from a distance from the planet's centre to space; by the cosine to the zenith.
  glm::vec3 integrated_transmittance(float radius, float cosine) const;
  glm::vec3 sunlight(float radius, float cosine) const;
  // Radiance of light that was scattered twice or more, which is taken as equal in all directions.
  glm::vec3 integrated_multiple(float radius, float sun_cosine) const;
  glm::vec3 multiple(float radius, float sun_cosine) const;

  float aerosols_;  // extinction at the ground, 1/km
  std::vector<glm::vec3> transmittance_, multiple_;
  float unit_ = 1;  // SkyTable's, over that of radiance()
};

}  // namespace penumbra::render
