#include "cascades.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "convex.h"
#include "receiver_region.h"

namespace penumbra::shadow {

namespace {

struct Sphere {
  glm::dvec3 center{0};
  double radius = 0;
};

struct Range {
  double min = 0, max = 0;
};

Box joined(const Box& a, const Box& b) { return {glm::min(a.min, b.min), glm::max(a.max, b.max)}; }

LightBounds joined(const LightBounds& a, const LightBounds& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

Sphere sphere_about(const Box& box) {
  const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5;
  return {glm::dvec3(box.min) + half, glm::length(half)};
}

// Rounds up to a power of 2^(1 / steps_an_octave), so that ranges and sizes seldom change while the camera moves.
double step_up(double value, double steps_an_octave) {
  return value <= 0 ? 0 : std::exp2(std::ceil(std::log2(value) * steps_an_octave - 1e-9) / steps_an_octave);
}

double step_down(double value, double steps_an_octave) {
  return value <= 0 ? 0 : std::exp2(std::floor(std::log2(value) * steps_an_octave + 1e-9) / steps_an_octave);
}

// The range of view depths, metres in front of the camera, in which receivers lie.
Range view_range(const CascadeInputs& in) {
  Range range{1e30, -1e30};
  for (const glm::dvec3& corner : in.receivers.corners()) {
    const double depth = -(glm::dmat4(in.view) * glm::dvec4(corner, 1)).z;
    range = {std::min(range.min, depth), std::max(range.max, depth)};
  }
  const double limit = in.distance > 0 ? in.distance : range.max;
  const double far = in.distance > 0 ? limit : step_up(std::max(limit, 1e-6), 3);
  return {std::max(step_down(std::max(range.min, 0.0), 3), far * 1e-3), far};
}

// The smallest sphere, with its centre on the frustum's axis, that contains the part of the frustum between two depths.
Sphere frustum_sphere(const CascadeInputs& in, double near, double far) {
  const glm::dmat4 projection(in.projection);
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<size_t>(i)] =
        frustum_corner(projection, (i & 4) != 0 ? far : near, (i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1);
  }
  const glm::dvec3 near_middle = (corners[0] + corners[3]) * 0.5;
  const glm::dvec3 far_middle = (corners[4] + corners[7]) * 0.5;
  const double near_radius = glm::length(corners[0] - near_middle);
  const double far_radius = glm::length(corners[4] - far_middle);
  const double length = std::max(glm::length(far_middle - near_middle), 1e-9);
  const double along =
      std::clamp(0.5 + (far_radius * far_radius - near_radius * near_radius) / (2 * length * length), 0.0, 1.0);
  Sphere sphere{glm::mix(near_middle, far_middle, along), 0};
  for (const glm::dvec3& corner : corners) sphere.radius = std::max(sphere.radius, glm::length(corner - sphere.center));
  sphere.center = glm::dvec3(glm::inverse(glm::dmat4(in.view)) * glm::dvec4(sphere.center, 1));
  return sphere;
}

// A square column along the light, or a pyramid that widens towards it: `half` wide at the depth `base`, and `slope`
// more for each metre towards the light.
struct Column {
  glm::dvec2 center{0};
  double half = 0;
  double base = 0, slope = 0;
};

// The range of light-space depths of the part of a world box within a column.
Range range_within(const Column& column, const std::array<glm::dvec3, 8>& corners) {
  static constexpr std::array<std::array<int, 4>, 6> faces = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  Range range{1e30, -1e30};
  for (const auto& face : faces) {
    Polygon polygon;
    for (const int corner : face) polygon.push_back(corners[static_cast<size_t>(corner)]);
    const double half = column.half + column.slope * column.base;
    polygon = clipped(polygon, HalfSpace{{1, 0, column.slope}, half + column.center.x});
    polygon = clipped(polygon, HalfSpace{{-1, 0, column.slope}, half - column.center.x});
    polygon = clipped(polygon, HalfSpace{{0, 1, column.slope}, half + column.center.y});
    polygon = clipped(polygon, HalfSpace{{0, -1, column.slope}, half - column.center.y});
    for (const glm::dvec3& point : polygon) range = {std::min(range.min, point.z), std::max(range.max, point.z)};
  }
  return range;
}

// Split distances, the last one the far end (Zhang et al. 2006, "Parallel-split shadow maps", eq. 3).
double split_distance(const Range& range, int index, int count, double blend) {
  const double part = static_cast<double>(index + 1) / count;
  const double logarithmic = range.min * std::pow(range.max / range.min, part);
  const double uniform = range.min + (range.max - range.min) * part;
  return glm::mix(uniform, logarithmic, blend);
}

// What a cascade contains in light space, without margins: a square column about `center`, as deep as `deepest`.
struct Region {
  glm::dvec3 center{0};
  double half_width = 0;
  double deepest = 0;
};

// About the part of the frustum up to each cascade's range, or about all receivers if that is smaller. A region turns
// with the camera without changing size.
std::vector<Region> stable_regions(const CascadeInputs& in, const Cascades& cascades) {
  const Range view = view_range(in);
  const Sphere all = sphere_about(in.receivers);
  std::vector<Region> regions;
  for (int i = 0; i < in.count; ++i) {
    Sphere sphere = frustum_sphere(in, view.min, split_distance(view, i, in.count, in.split_blend));
    if (all.radius < sphere.radius) sphere = all;
    const glm::dvec3 center = cascades.world_to_light * (sphere.center - cascades.anchor);
    regions.push_back({center, sphere.radius, center.z + sphere.radius});
  }
  return regions;
}

double width_of(const LightBounds& bounds) {
  return std::max(bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y);
}

// The receivers up to the end of each slice.
VisibleReceivers accumulated(VisibleReceivers slices) {
  for (size_t i = 1; i < slices.size(); ++i) {
    slices[i].pixels += slices[i - 1].pixels;
    slices[i].bounds = joined(slices[i].bounds, slices[i - 1].bounds);
  }
  return slices;
}

// The last slice of each cascade, so that the texels of the pixels' cascades, in units of the pixels' own sizes, have
// the least geometric mean. `up_to`: see accumulated(). Some may be equal, where there are fewer slices than cascades.
std::vector<size_t> best_splits(const VisibleReceivers& up_to, int count) {
  // The sum over the pixels up to a slice of the logarithm of their texels, with the best cascades of which the last
  // one ends there, and where the one before it ends.
  struct Best {
    double sum = 0;
    size_t before = 0;
  };
  const auto sum_of = [&](size_t last, size_t before) {
    return std::log2(std::max(width_of(up_to[last].bounds), 1e-9)) * (up_to[last].pixels - up_to[before].pixels);
  };
  std::vector<std::vector<Best>> best(static_cast<size_t>(count), std::vector<Best>(up_to.size()));
  for (size_t last = 0; last < up_to.size(); ++last) {
    best[0][last] = {std::log2(std::max(width_of(up_to[last].bounds), 1e-9)) * up_to[last].pixels, 0};
  }
  for (size_t cascade = 1; cascade < best.size(); ++cascade) {
    for (size_t last = 0; last < up_to.size(); ++last) {
      best[cascade][last] = {best[cascade - 1][last].sum, last};
      for (size_t before = 0; before < last; ++before) {
        const double sum = best[cascade - 1][before].sum + sum_of(last, before);
        if (sum < best[cascade][last].sum) best[cascade][last] = {sum, before};
      }
    }
  }
  std::vector<size_t> ends(best.size(), up_to.size() - 1);
  for (size_t cascade = best.size() - 1; cascade > 0; --cascade) {
    ends[cascade - 1] = best[cascade][ends[cascade]].before;
  }
  return ends;
}

// About what the view shows up to each cascade's range; the last one about all other receivers too.
std::vector<Region> visible_regions(const CascadeInputs& in, const Cascades& cascades) {
  // Receivers are computed from the same depths on the GPU, in floats.
  constexpr double rounding = 1e-4;
  const VisibleReceivers up_to = accumulated(*in.visible);
  std::vector<Region> regions;
  for (const size_t end : best_splits(up_to, in.count)) {
    LightBounds bounds = up_to[end].bounds;
    const bool last = regions.size() + 1 == static_cast<size_t>(in.count);
    if (last) bounds = joined(bounds, seen_bounds(in.others, in, cascades));
    const glm::dvec3 center = 0.5 * (bounds.low + bounds.high), half = 0.5 * (bounds.high - bounds.low);
    const double pad = rounding * (glm::length(center) + glm::length(half));
    regions.push_back({center, std::max(half.x, half.y) + pad, bounds.high.z + pad});
  }
  return regions;
}

glm::dmat4 clip_from_world(const Cascades& cascades, const Cascade& cascade) {
  const double range = cascade.far_z - cascade.near_z;
  const glm::dvec3 scale{1.0 / cascade.half_extent, 1.0 / cascade.half_extent, 1.0 / range};
  const glm::dvec3 origin{cascade.center.x, cascade.center.y, cascade.near_z};
  const glm::dmat4 to_light = glm::dmat4(cascades.world_to_light) * glm::translate(glm::dmat4(1), -cascades.anchor);
  return glm::scale(glm::dmat4(1), scale) * glm::translate(glm::dmat4(1), -origin) * to_light;
}

}  // namespace

glm::dmat3 light_axes(const glm::dvec3& to_light) {
  const glm::dvec3 z = -glm::normalize(to_light);
  const glm::dvec3 horizontal = glm::cross(z, glm::dvec3(0, 1, 0));
  const glm::dvec3 x = glm::length(horizontal) > 1e-6 ? glm::normalize(horizontal) : glm::dvec3(1, 0, 0);
  const glm::dvec3 y = glm::cross(x, z);
  return glm::transpose(glm::dmat3(x, y, z));
}

glm::dvec3 frustum_corner(const glm::dmat4& projection, double depth, double ndc_x, double ndc_y) {
  const bool perspective = projection[2][3] != 0;
  const double scale = perspective ? depth : 1.0;
  const double shift_x = perspective ? projection[2][0] : -projection[3][0];
  const double shift_y = perspective ? projection[2][1] : -projection[3][1];
  return {(ndc_x + shift_x) / projection[0][0] * scale, (ndc_y + shift_y) / projection[1][1] * scale, -depth};
}

Cascades fit_cascades(const CascadeInputs& in) {
  assert(in.count >= 1 && in.count <= max_cascades && in.size >= 1);
  Cascades cascades;
  cascades.world_to_light = light_axes(in.to_light);
  cascades.anchor = glm::dvec3(glm::inverse(glm::dmat4(in.view))[3]);
  cascades.size = in.size;

  std::array<glm::dvec3, 8> corners = joined(in.casters, in.receivers).corners();
  for (glm::dvec3& corner : corners) corner = cascades.world_to_light * (corner - cascades.anchor);
  const std::vector<Region> regions = in.visible ? visible_regions(in, cascades) : stable_regions(in, cascades);
  const glm::dvec3 anchor = cascades.world_to_light * cascades.anchor;

  for (int i = 0; i < in.count; ++i) {
    const auto& [center, half_width, deepest] = regions[static_cast<size_t>(i)];

    // Margin for the search discs of receivers at the border: their radius follows from the light's size and the height
    // of casters above the deepest receiver. A finer cascade may leave some discs to the next one; the last one
    // contains all.
    const double nearest = range_within({center, half_width, deepest, in.tan_half_angle}, corners).min;
    const double all_discs = in.tan_half_angle * std::max(deepest - nearest, 0.0);
    const double margin = i + 1 < in.count ? std::min(all_discs, 0.25 * half_width) : all_discs;
    const double half = step_up(half_width + margin, 16) * (1.0 + 4.0 / in.size);
    const double texel = 2.0 * half / in.size;
    const glm::dvec2 snapped = glm::floor(glm::dvec2(center + anchor) / texel) * texel - glm::dvec2(anchor);

    Range range = range_within({snapped, half}, corners);
    if (range.max < range.min) range = {center.z - half_width, center.z + half_width};
    const double pad = 1e-3 * (range.max - range.min) + texel;
    Cascade cascade;
    cascade.center = glm::vec2(snapped);
    cascade.half_extent = static_cast<float>(half);
    cascade.near_z = static_cast<float>(range.min - pad);
    cascade.far_z = static_cast<float>(range.max + pad);
    cascade.world_to_clip = clip_from_world(cascades, cascade);
    cascades.items.push_back(cascade);
  }
  return cascades;
}

CullVolume cull_volume(const Cascades& cascades, int index) {
  const Cascade& cascade = cascades.items.at(static_cast<size_t>(index));
  const glm::dmat3 axes = glm::transpose(cascades.world_to_light);
  // A plane; in front of it lies what is no farther than `limit` from the anchor along `direction`.
  const auto side = [&](const glm::dvec3& direction, double limit) {
    return glm::dvec4(-direction, glm::dot(direction, cascades.anchor) + limit);
  };
  const TexelRange drawn = cascades.drawn_texels(index);
  const double texel = 2.0 * cascade.half_extent / cascades.size;
  const glm::dvec2 origin = glm::dvec2(cascade.center) - static_cast<double>(cascade.half_extent);
  const glm::dvec2 low = origin + glm::dvec2(drawn.first) * texel;
  const glm::dvec2 high = origin + glm::dvec2(drawn.last + 1) * texel;
  return {.planes = {side(axes[0], high.x), side(-axes[0], -low.x), side(axes[1], high.y), side(-axes[1], -low.y),
                     side(axes[2], cascade.far_z)}};
}

}  // namespace penumbra::shadow
