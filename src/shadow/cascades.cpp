#include "cascades.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "convex.h"
#include "visible_cascades.h"

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

Sphere sphere_about(const Box& box) {
  const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5;
  return {glm::dvec3(box.min) + half, glm::length(half)};
}

// Rounds up to a power of 2^(1 / steps_an_octave), so that ranges and sizes seldom change while the camera moves.
double step_up(double value, double steps_an_octave) {
  return value <= 0 ? 0 : std::exp2(std::ceil(std::log2(value) * steps_an_octave - 1e-9) / steps_an_octave);
}

glm::dvec2 step_up(const glm::dvec2& value, double steps_an_octave) {
  return {step_up(value.x, steps_an_octave), step_up(value.y, steps_an_octave)};
}

double step_down(double value, double steps_an_octave) {
  return value <= 0 ? 0 : std::exp2(std::floor(std::log2(value) * steps_an_octave + 1e-9) / steps_an_octave);
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

// A column along the light, or a pyramid that widens towards it: it extends by `half` from its centre at the depth
// `base`, and by `slope` more for each metre towards the light.
struct Column {
  glm::dvec2 center{0}, half{0};
  double base = 0, slope = 0;
};

// The range of light-space depths of the part of a world box within a column.
Range range_within(const Column& column, const std::array<glm::dvec3, 8>& corners) {
  const glm::dvec2 half = column.half + column.slope * column.base;
  const std::array<HalfSpace, 4> sides = {{{{1, 0, column.slope}, half.x + column.center.x},
                                           {{-1, 0, column.slope}, half.x - column.center.x},
                                           {{0, 1, column.slope}, half.y + column.center.y},
                                           {{0, -1, column.slope}, half.y - column.center.y}}};
  Range range{1e30, -1e30};
  Polygon polygon, spare;
  for (const auto& face : box_faces) {
    polygon.clear();
    for (const size_t corner : face) polygon.push_back(corners[corner]);
    for (const HalfSpace& side : sides) clip(polygon, side, spare);
    for (const glm::dvec3& point : polygon) range = {std::min(range.min, point.z), std::max(range.max, point.z)};
  }
  return range;
}

// The range of view depths in which receivers lie, metres from `start`: the camera, or a depth behind it that an
// orthographic view shows.
struct ViewRange {
  double start = 0;
  Range range;
};

// How far behind its camera an orthographic view shows receivers, metres; 0 for all other views.
double shown_behind(const CascadeInputs& in) {
  if (in.nearest >= 0) return 0;
  // Places in the picture, and the view depth there: the picture is a column of the receivers' box.
  const glm::dmat4 view(in.view), projection(in.projection);
  std::array<glm::dvec3, 8> shown = in.receivers.corners();
  for (glm::dvec3& corner : shown) {
    const glm::dvec4 at = view * glm::dvec4(corner, 1);
    corner = glm::dvec3(glm::dvec2(projection * at) / projection[3][3], -at.z);
  }
  const Range range = range_within({.half = glm::dvec2(1)}, shown);
  if (range.min > range.max) return 0;
  const double behind = std::max(-std::max(range.min, in.nearest), 0.0);
  return in.distance > 0 ? std::min<double>(behind, in.distance) : behind;
}

ViewRange view_range(const CascadeInputs& in, CutOff& cut_off) {
  Range range{1e30, -1e30};
  double farthest = 0;
  for (const glm::dvec3& corner : in.receivers.corners()) {
    const glm::dvec3 at(glm::dmat4(in.view) * glm::dvec4(corner, 1));
    range = {std::min(range.min, -at.z), std::max(range.max, -at.z)};
    farthest = std::max(farthest, glm::length(at));
  }
  double limit = in.distance > 0 ? in.distance : range.max;
  double behind = shown_behind(in);
  if (!in.exact_bounds && in.distance <= 0 && farthest > wide_bounds) {
    limit = std::min(limit, std::max(range_in_wide_bounds, 10 * range.min));
    cut_off.view = limit < range.max || behind > range_in_wide_bounds;
    behind = std::min(behind, range_in_wide_bounds);
  }
  const double start = -step_up(behind, 3);
  const double far = (in.distance > 0 ? limit : step_up(std::max(limit, 1e-6), 3)) - start;
  return {start, {std::max(step_down(std::max(range.min - start, 0.0), 3), far * 1e-3), far}};
}

// Split distances, the last one the far end (Zhang et al. 2006, "Parallel-split shadow maps", eq. 3).
double split_distance(const Range& range, int index, int count, double blend) {
  const double part = static_cast<double>(index + 1) / count;
  const double logarithmic = range.min * std::pow(range.max / range.min, part);
  const double uniform = range.min + (range.max - range.min) * part;
  return glm::mix(uniform, logarithmic, blend);
}

// The part of a range of light-space depths that a cascade's map holds.
Range held_range(const Range& range, const Region& region, const CascadeInputs& in, CutOff& cut_off) {
  if (in.exact_bounds) return range;
  Range held = range;
  if (range.min < region.shallowest - wide_bounds) {
    held.min = region.shallowest - wide_bounds;
    cut_off.light = true;
  }
  if (range.max > region.deepest + wide_bounds) held.max = region.deepest;  // which shadows no receiver
  return held;
}

// Half the width and height of a map, or as much more as it takes to hold receivers within `held` of the middle: with a
// texel to be placed, and 1.5 of a texel's longer side beside each receiver (layer_edge() in
// glsl/shadow/projection/layers.glsl).
glm::dvec2 with_texels_beside(const glm::dvec2& half, const glm::dvec2& held, double size) {
  const double longer = std::max({half.x, half.y, glm::max(held.x, held.y) / (1 - 5 / size)});
  return glm::max(half, (held + 3 * longer / size) / (1 - 2 / size));
}

// About the part of the frustum up to each cascade's range, or about all receivers if that is smaller. A region turns
// with the camera without changing size.
std::vector<Region> stable_regions(const CascadeInputs& in, Cascades& cascades) {
  const auto [start, view] = view_range(in, cascades.cut_off);
  const Sphere all = sphere_about(in.receivers);
  std::vector<Region> regions;
  for (int i = 0; i < in.count; ++i) {
    const double end = split_distance(view, i, in.count, in.split_blend);
    Sphere sphere = frustum_sphere(in, start + view.min, start + end);
    if (all.radius < sphere.radius) sphere = all;
    const glm::dvec3 center = cascades.world_to_light * (sphere.center - cascades.anchor);
    // The receivers' box may be a point, whose place the GPU computes in floats.
    const double radius = std::max({sphere.radius, 1e-4 * glm::length(center), 1e-6});
    regions.push_back({center, glm::dvec2(radius), center.z - radius, center.z + radius});
  }
  return regions;
}

}  // namespace

glm::dmat3 light_axes(const glm::dvec3& to_light, double turn) {
  const glm::dvec3 z = -glm::normalize(to_light);
  const glm::dvec3 horizontal = glm::cross(z, glm::dvec3(0, 1, 0));
  const glm::dvec3 x = glm::length(horizontal) > 1e-6 ? glm::normalize(horizontal) : glm::dvec3(1, 0, 0);
  const glm::dvec3 y = glm::cross(x, z);
  const double along = std::cos(turn), across = std::sin(turn);
  return glm::transpose(glm::dmat3(along * x + across * y, along * y - across * x, z));
}

glm::dvec3 frustum_corner(const glm::dmat4& projection, double depth, double ndc_x, double ndc_y) {
  const double w = projection[3][3] - depth * projection[2][3];
  const auto place = [&](int axis, double ndc) {
    return (ndc * w + depth * projection[2][axis] - projection[3][axis]) / projection[axis][axis];
  };
  return {place(0, ndc_x), place(1, ndc_y), -depth};
}

glm::dmat4 clip_from_world(const Cascades& cascades, const Cascade& cascade) {
  const double range = cascade.far_z - cascade.near_z;
  const glm::dvec3 scale{1.0 / glm::dvec2(cascade.half_extent), 1.0 / range};
  const glm::dvec3 origin{cascade.center.x, cascade.center.y, cascade.near_z};
  const glm::dmat4 to_light = glm::dmat4(cascades.world_to_light) * glm::translate(glm::dmat4(1), -cascades.anchor);
  return glm::scale(glm::dmat4(1), scale) * glm::translate(glm::dmat4(1), -origin) * to_light;
}

double nearest_within(const Cascade& cascade, const std::array<glm::dvec3, 8>& corners) {
  return range_within({glm::dvec2(cascade.center), glm::dvec2(cascade.half_extent)}, corners).min;
}

Cascades fit_cascades(const CascadeInputs& in) {
  assert(in.count >= 1 && in.count <= max_cascades && in.size >= 1);
  Cascades cascades;
  cascades.world_to_light = light_axes(in.to_light);
  cascades.anchor = glm::dvec3(glm::inverse(glm::dmat4(in.view))[3]);
  cascades.size = in.size;

  const std::vector<Region> regions = in.visible ? visible_regions(in, cascades) : stable_regions(in, cascades);
  std::array<glm::dvec3, 8> corners = joined(in.casters, in.receivers).corners();
  for (glm::dvec3& corner : corners) corner = cascades.world_to_light * (corner - cascades.anchor);
  const glm::dvec3 anchor = cascades.world_to_light * cascades.anchor;

  for (const Region& region : regions) {
    const bool last = &region == &regions.back();
    const auto& [center, half_width, shallowest, deepest] = region;

    // Margin for the search discs of receivers at the border: their radius follows from the light's size and the height
    // of casters above the deepest receiver. A finer cascade may leave some discs to the next one; the last one
    // contains all.
    const Range in_cone = range_within({center, half_width, deepest, in.tan_half_angle}, corners);
    const double nearest = held_range(in_cone, region, in, cascades.cut_off).min;
    const double all_discs = in.tan_half_angle * std::max(deepest - nearest, 0.0);
    const glm::dvec2 margin = last ? glm::dvec2(all_discs) : glm::min(glm::dvec2(all_discs), 0.25 * half_width);
    glm::dvec2 half = step_up(half_width + margin, 16) * (1.0 + 4.0 / cascades.size);
    if (last) half = with_texels_beside(half, half_width, cascades.size);
    const glm::dvec2 texel = 2.0 * half / static_cast<double>(cascades.size);
    // At most a texel from the centre, so what is to be held stays inside.
    const glm::dvec2 placed =
        (glm::floor(glm::dvec2(center + anchor) / texel) + in.jitter) * texel - glm::dvec2(anchor);

    Range range = held_range(range_within({placed, half}, corners), region, in, cascades.cut_off);
    const double wider = glm::max(half_width.x, half_width.y);
    if (range.max < range.min) range = {center.z - wider, center.z + wider};
    const double rounding = 1e-6 * std::max(std::abs(range.min), std::abs(range.max));
    const double pad = std::max(1e-3 * (range.max - range.min) + glm::max(texel.x, texel.y), rounding);
    Cascade cascade;
    cascade.center = glm::vec2(placed);
    cascade.half_extent = glm::vec2(half);
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
  const glm::dvec2 half(cascade.half_extent), texel = 2.0 * half / static_cast<double>(cascades.size);
  const glm::dvec2 origin = glm::dvec2(cascade.center) - half;
  const glm::dvec2 low = origin + glm::dvec2(drawn.first) * texel;
  const glm::dvec2 high = origin + glm::dvec2(drawn.last + 1) * texel;
  return {.planes = {side(axes[0], high.x), side(-axes[0], -low.x), side(axes[1], high.y), side(-axes[1], -low.y),
                     side(axes[2], cascade.far_z)}};
}

}  // namespace penumbra::shadow
