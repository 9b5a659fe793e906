#include "light_matrices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <utility>

#include "../core/error.h"

namespace penumbra::shadow {

namespace {

// By how much directions may differ, radians: what matrices of floats round away, and more; see check_places().
constexpr double same_direction = 1e-3;
constexpr double widest_cone = glm::half_pi<double>() - 1e-6;

template <typename... Args>
[[noreturn]] void refuse(std::size_t layer, fmt::format_string<Args...> text, Args&&... args) {
  fail("shadow maps by the caller's matrices: layer {} {}", layer, fmt::format(text, std::forward<Args>(args)...));
}

// A clip-space coordinate as a function of the place in the world: how much it changes for each metre, in which
// direction, and its value at the anchor.
struct Axis {
  glm::dvec3 direction{0};
  double per_metre = 0, at_anchor = 0;
};

Axis axis_of(const glm::dmat4& world_to_clip, int row, const glm::dvec3& anchor) {
  const glm::dvec4 values(world_to_clip[0][row], world_to_clip[1][row], world_to_clip[2][row], world_to_clip[3][row]);
  const double length = glm::length(glm::dvec3(values));
  return {glm::dvec3(values) / length, length, glm::dot(glm::dvec3(values), anchor) + values.w};
}

struct Axes {
  Axis x, y, z;
};

// The clip space whose z is in 0..1, 0 near the light.
glm::dmat4 zero_to_one(glm::dmat4 world_to_clip, bool already, bool reversed) {
  for (glm::length_t column = 0; column < 4; ++column) {
    glm::dvec4& values = world_to_clip[column];
    if (!already) values.z = 0.5 * (values.z + values.w);
    if (reversed) values.z = values.w - values.z;
  }
  return world_to_clip;
}

// The same with w = 1.
glm::dmat4 zero_to_one(const SunMatrices& maps, std::size_t layer) {
  const glm::dmat4 world_to_clip(maps.world_to_clip[layer]);
  return zero_to_one(world_to_clip / world_to_clip[3].w, maps.depth_zero_to_one, maps.reversed);
}

bool is_finite(const glm::dmat4& matrix) {
  for (glm::length_t column = 0; column < 4; ++column) {
    for (glm::length_t row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

Axes axes_of(const SunMatrices& maps, std::size_t layer) {
  glm::dmat4 matrix(maps.world_to_clip[layer]);
  if (!is_finite(matrix)) refuse(layer, "has a matrix that is not finite");
  const double w = matrix[3].w;
  const glm::dvec3 warp(matrix[0].w, matrix[1].w, matrix[2].w);
  if (w == 0 || glm::length(warp) > 1e-9 * std::abs(w)) {
    refuse(layer, "is warped (clip w is not constant): penumbrae need maps whose texels all have the same size");
  }
  matrix = zero_to_one(maps, layer);
  const glm::dvec3 anchor(maps.camera);
  const Axes axes{axis_of(matrix, 0, anchor), axis_of(matrix, 1, anchor), axis_of(matrix, 2, anchor)};
  for (const Axis* axis : {&axes.x, &axes.y, &axes.z}) {
    if (!(axis->per_metre > 0)) refuse(layer, "has a matrix that can't be inverted");
  }
  return axes;
}

void check_directions(const Axes& axes, const SunMatrices& maps, std::size_t layer) {
  const glm::dvec3 rays = -glm::normalize(glm::dvec3(maps.to_light));
  const double along = glm::dot(axes.z.direction, rays);
  if (along < -1 + same_direction * same_direction) {
    refuse(layer,
           "has depths that grow towards the light: store 0 near the light and 1 far from it, or say that they "
           "are reversed");
  }
  if (glm::length(axes.z.direction - rays) > same_direction) refuse(layer, "does not look along the sun's rays");
  const double skew =
      std::max({std::abs(glm::dot(axes.x.direction, axes.y.direction)), std::abs(glm::dot(axes.x.direction, rays)),
                std::abs(glm::dot(axes.y.direction, rays))});
  if (skew > same_direction)
    refuse(layer, "is skewed: its axes are not perpendicular to each other and the sun's rays");
  // Light space is left-handed, as what an observer at the light sees: x to the right, y up, z away.
  if (glm::dot(glm::cross(axes.x.direction, axes.y.direction), rays) > 0) {
    refuse(layer, "is mirrored: as seen from the light, x must grow to the right where y grows upwards");
  }
}

// Rows: unit vectors, exactly perpendicular.
glm::dmat3 light_space_of(const Axes& axes, const SunMatrices& maps) {
  const glm::dvec3 z = -glm::normalize(glm::dvec3(maps.to_light));
  const glm::dvec3 x = glm::normalize(axes.x.direction - glm::dot(axes.x.direction, z) * z);
  return glm::transpose(glm::dmat3(x, glm::cross(x, z), z));
}

// The angle by which its x and y axes are turned from those of light_axes().
double turn_of(const glm::dmat3& world_to_light, const glm::dvec3& to_light) {
  const glm::dvec3 x = light_axes(to_light) * glm::transpose(world_to_light)[0];
  return std::atan2(x.y, x.x);
}

Cascade cascade_of(const Axes& axes, const Cascades& cascades) {
  Cascade cascade;
  cascade.half_extent = glm::vec2(1 / axes.x.per_metre, 1 / axes.y.per_metre);
  cascade.center = glm::vec2(-axes.x.at_anchor / axes.x.per_metre, -axes.y.at_anchor / axes.y.per_metre);
  cascade.near_z = static_cast<float>(-axes.z.at_anchor / axes.z.per_metre);
  cascade.far_z = static_cast<float>((1 - axes.z.at_anchor) / axes.z.per_metre);
  cascade.world_to_clip = clip_from_world(cascades, cascade);
  return cascade;
}

// Half of a layer's longer side, metres.
double half_side_of(const Cascade& cascade) { return glm::max(cascade.half_extent.x, cascade.half_extent.y); }

// The library reads a layer by exact axes, the caller has drawn it by the matrix: within the whole layer they must
// place points within a quarter of a texel of each other, also along the light.
void check_places(const Cascades& cascades, const SunMatrices& maps, std::size_t layer) {
  const Cascade& cascade = cascades.items[layer];
  const glm::dmat4 drawn = zero_to_one(maps, layer);
  const glm::dmat4 to_world = glm::inverse(cascade.world_to_clip);
  const double range = static_cast<double>(cascade.far_z) - cascade.near_z;
  const double depth_of_texel = 2 * half_side_of(cascade) / cascades.size / range;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : 0);
    const glm::dvec4 at = drawn * to_world * glm::dvec4(corner, 1);
    const glm::dvec3 apart = glm::abs(glm::dvec3(at) / at.w - corner);
    if (std::max({apart.x * cascades.size / 2, apart.y * cascades.size / 2, apart.z / depth_of_texel}) > 0.25) {
      refuse(layer, "does not look along the sun's rays exactly: at its border that is more than a quarter of a texel");
    }
  }
}

// Whether the last layer holds all others. A receiver's search begins there: it shows how near to the light casters
// are.
bool last_holds_all(const Cascades& cascades) {
  const Cascade& last = cascades.items.back();
  const glm::dvec2 low = last.center - last.half_extent, high = last.center + last.half_extent;
  const double rounding = 0.5 * half_side_of(last) / cascades.size;
  return std::ranges::all_of(cascades.items, [&](const Cascade& cascade) {
    const glm::dvec2 from = cascade.center - cascade.half_extent, to = cascade.center + cascade.half_extent;
    return glm::all(glm::greaterThanEqual(from, low - rounding)) && glm::all(glm::lessThanEqual(to, high + rounding)) &&
           cascade.near_z >= last.near_z - rounding;
  });
}

// Adds a layer that holds all others, whose map copy_maps() makes from theirs.
void add_composed(Cascades& cascades) {
  if (cascades.items.size() == max_cascades)
    fail("shadow maps by the caller's matrices: the last of {} layers must hold all others", max_cascades);
  glm::dvec2 low(1e30), high(-1e30);
  Cascade all{.near_z = 1e30f, .far_z = -1e30f};
  for (const Cascade& cascade : cascades.items) {
    low = glm::min(low, glm::dvec2(cascade.center - cascade.half_extent));
    high = glm::max(high, glm::dvec2(cascade.center + cascade.half_extent));
    all.near_z = std::min(all.near_z, cascade.near_z);
    all.far_z = std::max(all.far_z, cascade.far_z);
  }
  all.center = glm::vec2(0.5 * (low + high));
  all.half_extent = glm::vec2(0.5 * (high - low));
  all.world_to_clip = clip_from_world(cascades, all);
  cascades.items.push_back(all);
  cascades.composed = true;
}

void check_casters(const Cascades& cascades, std::size_t layer, const Box& casters) {
  if (glm::any(glm::greaterThan(casters.min, casters.max))) return;
  const Cascade& cascade = cascades.items[layer];
  std::array<glm::dvec3, 8> corners = casters.corners();
  for (glm::dvec3& corner : corners) corner = cascades.world_to_light * (corner - cascades.anchor);
  const double nearest = nearest_within(cascade, corners);
  const double rounding = 1e-3 * (static_cast<double>(cascade.far_z) - cascade.near_z);
  if (nearest < cascade.near_z - rounding) {
    refuse(layer,
           "begins {:.3g} m behind casters above it, whose depths are clamped to its near plane or cut off: move "
           "the near plane towards the sun",
           cascade.near_z - nearest);
  }
}

template <typename... Args>
[[noreturn]] void refuse_spot(fmt::format_string<Args...> text, Args&&... args) {
  fail("shadow maps by the caller's matrices: the spot's map {}", fmt::format(text, std::forward<Args>(args)...));
}

glm::dvec4 row_of(const glm::dmat4& matrix, glm::length_t row) { return glm::transpose(matrix)[row]; }

// Rows: unit vectors, exactly perpendicular, x and y across the map and z along its axis. `matrix`: of which w is the
// depth in metres.
glm::dmat3 spot_space_of(const glm::dmat4& matrix, const glm::dvec3& axis) {
  const glm::dvec3 x(row_of(matrix, 0)), y(row_of(matrix, 1)), z(row_of(matrix, 3));
  const double along_x = glm::length(x), along_y = glm::length(y);
  if (!(along_x > 0) || !(along_y > 0)) refuse_spot("has a matrix that can't be inverted");
  if (glm::length(z - axis) > same_direction) refuse_spot("does not look along the spot's axis");
  const double skew = std::max({std::abs(glm::dot(x, y)) / along_y, std::abs(glm::dot(x, z)),
                                std::abs(glm::dot(y, z)) * along_x / along_y}) /
                      along_x;
  if (skew > same_direction) refuse_spot("is skewed or off-centre: the spot's axis must be in its middle");
  if (std::abs(along_x / along_y - 1) > same_direction) refuse_spot("spans different angles in x and y");
  if (glm::dot(glm::cross(x, y), z) > 0)
    refuse_spot("is mirrored: as seen from the lamp, x must grow to the right where y grows upwards");
  const glm::dvec3 across = glm::normalize(x - glm::dot(x, z) * z);
  return glm::transpose(glm::dmat3(across, glm::cross(across, z), z));
}

// Sets the planes at which the map stores 0 and 1. Depths of a perspective are a + b / z.
void set_planes(LampMaps& maps, const glm::dmat4& matrix) {
  const glm::dvec4 depth = row_of(matrix, 2), along = row_of(matrix, 3);
  const double a = glm::dot(glm::dvec3(depth), glm::dvec3(along)), b = depth.w - a * along.w;
  if (glm::length(glm::dvec3(depth) - a * glm::dvec3(along)) > same_direction) refuse_spot("has an oblique near plane");
  if (!(b < 0)) refuse_spot("has depths that grow towards the lamp: say that they are reversed");
  if (!(a > 1 + 1e-7)) refuse_spot("has no far plane");
  maps.near = -b / a;
  maps.far = b / (1 - a);
}

// As check_places(): between the far plane and a twentieth of its distance, where casters are far enough from the lamp
// to need the map's resolution.
void check_spot_places(const LampMaps& maps, const glm::dmat4& drawn) {
  const glm::dmat4 read = maps.world_to_clip(0), to_world = glm::inverse(read);
  for (const double distance : {maps.far, std::max(maps.near, maps.far / 20)}) {
    const double depth = (1 / maps.near - 1 / distance) / (1 / maps.near - 1 / maps.far);
    const double texel = 2 * maps.tangent * distance / maps.size;
    const double texels_deep = distance * distance * (1 / maps.near - 1 / maps.far) / texel;
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 corner((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, depth);
      const glm::dvec4 world = to_world * glm::dvec4(corner, 1);
      const glm::dvec4 at = drawn * (world / world.w);
      const glm::dvec3 apart = glm::abs(glm::dvec3(at) / at.w - corner);
      if (!(std::max({apart.x * maps.size / 2, apart.y * maps.size / 2, apart.z * texels_deep}) <= 0.25))
        refuse_spot("does not look from the lamp's centre: at its border that is more than a quarter of a texel");
    }
  }
}

}  // namespace

LightProjection sun_projection(const SunMatrices& maps) {
  const std::size_t count = maps.world_to_clip.size();
  const auto finite = [](const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  if (count < 1 || count > max_cascades) {
    fail("shadow maps by the caller's matrices: {} layers, not 1 to {}", count, max_cascades);
  }
  if (maps.size < 1) fail("shadow maps by the caller's matrices: a size of {} texels", maps.size);
  if (const std::string fault = fault_of(Sun{maps.to_light}); !fault.empty()) {
    fail("shadow maps by the caller's matrices: the sun {}", fault);
  }
  if (!finite(maps.camera) || !finite(maps.casters.min) || !finite(maps.casters.max)) {
    fail("shadow maps by the caller's matrices: the camera or the casters' box is not finite");
  }
  Cascades cascades;
  cascades.anchor = glm::dvec3(maps.camera);
  cascades.size = maps.size;
  for (std::size_t layer = 0; layer < count; ++layer) {
    const Axes axes = axes_of(maps, layer);
    check_directions(axes, maps, layer);
    if (layer == 0) {
      cascades.world_to_light = light_space_of(axes, maps);
      cascades.turn = turn_of(cascades.world_to_light, glm::dvec3(maps.to_light));
    } else if (glm::length(axes.x.direction - glm::transpose(cascades.world_to_light)[0]) > same_direction) {
      refuse(layer, "is turned against layer 0 about the sun's rays");
    }
    cascades.items.push_back(cascade_of(axes, cascades));
    if (layer > 0 && half_side_of(cascades.items[layer]) < half_side_of(cascades.items[layer - 1])) {
      refuse(layer, "has finer texels than the layer before it: order layers from the finest to the coarsest");
    }
    check_places(cascades, maps, layer);
    check_casters(cascades, layer, maps.casters);
  }
  if (!last_holds_all(cascades)) add_composed(cascades);
  LightProjection projection(std::move(cascades));
  if (const std::string fault = projection.fault(); !fault.empty()) {
    fail("shadow maps by the caller's matrices: {}", fault);
  }
  return projection;
}

ComposedPart composed_part(const LightProjection& projection, int layer) {
  constexpr double most_slope = 4;  // metres along the light for each across
  const Cascades& cascades = projection.cascades();
  const Cascade &given = cascades.items.at(static_cast<std::size_t>(layer)), &all = cascades.items.back();
  const glm::dvec2 texel(cascades.texel(static_cast<int>(cascades.items.size()) - 1)), own(cascades.texel(layer));
  const glm::dvec2 origin(all.center - all.half_extent), low(given.center - given.half_extent),
      high(given.center + given.half_extent);
  const double range = static_cast<double>(given.far_z) - given.near_z;
  const double whole = static_cast<double>(all.far_z) - all.near_z;
  const glm::ivec2 first(glm::ceil((low - origin) / texel - 0.5)), last(glm::floor((high - origin) / texel - 0.5));
  return {.texels = {glm::max(first, glm::ivec2(0)), glm::min(last, glm::ivec2(cascades.size - 1))},
          .place = glm::vec4(texel / own, (origin - low) / own),
          .depths = glm::vec2(range / whole, (static_cast<double>(given.near_z) - all.near_z) / whole),
          .spread = static_cast<float>(most_slope * std::max(own.x, own.y) / range)};
}

LightProjection spot_projection(const SpotMatrix& map) {
  const Lamp& lamp = map.lamp;
  if (const std::string fault = fault_of(lamp); !fault.empty())
    fail("shadow maps by the caller's matrices: the lamp {}", fault);
  if (lamp.axis == glm::vec3(0))
    fail("shadow maps by the caller's matrices: the lamp shines all round; maps can be given for suns and spots alone");
  if (map.size < 1) fail("shadow maps by the caller's matrices: a size of {} texels", map.size);
  const glm::dmat4 given(map.world_to_clip);
  if (!is_finite(given)) refuse_spot("has a matrix that is not finite");
  const double scale = glm::length(glm::dvec3(row_of(given, 3)));
  if (!(scale > 1e-9)) refuse_spot("is orthographic: it must be a perspective from the lamp's centre");
  const glm::dmat4 drawn = zero_to_one(given / scale, map.depth_zero_to_one, map.reversed);
  LampMaps maps{.position = glm::dvec3(lamp.position),
                .size = map.size,
                .radius = lamp.radius,
                .cone = std::cos(lamp.cone),
                .range = lamp.range};
  maps.world_to_lamp = spot_space_of(drawn, glm::normalize(glm::dvec3(lamp.axis)));
  maps.tangent = 1 / glm::length(glm::dvec3(row_of(drawn, 0)));
  set_planes(maps, drawn);
  // The tangent of a float that is a little above a right angle is negative.
  const double cone = std::min(static_cast<double>(lamp.cone), widest_cone);
  if (maps.tangent < std::tan(cone) * (1 - same_direction)) refuse_spot("spans less than the spot's cone");
  check_spot_places(maps, drawn);
  LightProjection projection(maps);
  if (const std::string fault = projection.fault(); !fault.empty())
    fail("shadow maps by the caller's matrices: {}", fault);
  return projection;
}

}  // namespace penumbra::shadow
