#include "receiver_region.h"

#include <algorithm>
#include <array>
#include <span>

#include "convex.h"

namespace penumbra::shadow {

namespace {

// The frustum is taken a little wider than the view, for rounding and the corners of pixels.
constexpr double frustum_width = 1.02;

// The view's sides, and for a perspective view the plane through the camera, in light space. An orthographic view may
// show what lies behind its camera. `width`: of the view in NDC, 1 for the view itself.
std::vector<HalfSpace> view_sides(const CascadeInputs& in, const Cascades& cascades, double width) {
  const glm::dmat3 view_to_light = cascades.world_to_light * glm::inverse(glm::dmat3(glm::dmat4(in.view)));
  const glm::dmat4 projection(in.projection);
  const auto point = [&](double depth, double ndc_x, double ndc_y) {
    return view_to_light * frustum_corner(projection, depth, ndc_x * width, ndc_y * width);
  };
  const auto plane = [](const glm::dvec3& normal, const glm::dvec3& on_it, const glm::dvec3& inside) {
    const HalfSpace side{normal, glm::dot(normal, on_it)};
    return glm::dot(normal, inside) <= side.limit ? side : HalfSpace{-side.normal, -side.limit};
  };
  static constexpr std::array<glm::dvec2, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const glm::dvec3 inside = point(1, 0, 0);
  std::vector<HalfSpace> sides;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2& a = corners[i];
    const glm::dvec2& b = corners[(i + 1) % corners.size()];
    const glm::dvec3 start = point(0, a.x, a.y);
    const glm::dvec3 end = point(1, a.x, a.y);
    sides.push_back(plane(glm::normalize(glm::cross(end - start, point(1, b.x, b.y) - start)), start, inside));
  }
  const bool perspective = projection[2][3] != 0;
  if (perspective) sides.push_back(plane(view_to_light * glm::dvec3(0, 0, 1), glm::dvec3(0), inside));
  return sides;
}

std::vector<Polygon> faces_of(const Box& box, const Cascades& cascades) {
  const std::array<glm::dvec3, 8> corners = box.corners();
  std::vector<Polygon> polygons;
  for (const auto& face : box_faces) {
    Polygon& polygon = polygons.emplace_back();
    for (const size_t corner : face) polygon.push_back(cascades.world_to_light * (corners[corner] - cascades.anchor));
  }
  return polygons;
}

std::array<HalfSpace, 4> column_sides(const Cascade& cascade) {
  const glm::dvec2 half(cascade.half_extent), center(cascade.center);
  return {{{{1, 0, 0}, half.x + center.x},
           {{-1, 0, 0}, half.x - center.x},
           {{0, 1, 0}, half.y + center.y},
           {{0, -1, 0}, half.y - center.y}}};
}

std::vector<Polygon> within(std::vector<Polygon> faces, std::span<const HalfSpace> sides) {
  for (const HalfSpace& side : sides) clip(faces, side);
  return faces;
}

LightBounds bounds_of(const std::vector<Polygon>& faces) {
  LightBounds bounds;
  for (const Polygon& face : faces) {
    for (const glm::dvec3& point : face) bounds = {glm::min(bounds.low, point), glm::max(bounds.high, point)};
  }
  return bounds;
}

// The texels of a map that a rectangle touches, in whole blocks: a camera that moves a little then needs the same ones
// (see kept_maps.h).
TexelRange texels_around(const glm::dvec2& low, const glm::dvec2& high, int size) {
  const double block = std::max(size / 128, 1);
  const auto last = static_cast<double>(size - 1);
  return {glm::ivec2(glm::clamp(glm::floor(low / block) * block, 0.0, last)),
          glm::ivec2(glm::clamp((glm::floor(high / block) + 1.0) * block - 1.0, 0.0, last))};
}

}  // namespace

LightBounds seen_bounds(const Box& box, const CascadeInputs& inputs, const Cascades& cascades) {
  if (box.min.x > box.max.x) return {};
  return bounds_of(within(faces_of(box, cascades), view_sides(inputs, cascades, frustum_width)));
}

void narrow_to_receivers(Cascades& cascades, const CascadeInputs& inputs, const ReadMargins& margins) {
  const LightBounds casters = bounds_of(faces_of(inputs.casters, cascades));
  // A block of a pyramid counts as empty unless it is drawn whole, with the row of texels around it.
  constexpr double beside_casters = 8;  // texels
  const std::vector<Polygon> seen =
      within(faces_of(inputs.receivers, cascades), view_sides(inputs, cascades, frustum_width + margins.ndc));
  // A disc is as wide in finer cascades as in the last one, whose casters bound it.
  double nearest = margins.nearest;
  for (const Cascade& cascade : cascades.items) nearest = std::min<double>(nearest, cascade.near_z);
  for (size_t i = 0; i < cascades.items.size(); ++i) {
    Cascade& cascade = cascades.items[i];
    LightBounds receivers = bounds_of(within(seen, column_sides(cascade)));
    // The view sees no receiver there: a point of the cascade.
    if (receivers.empty()) receivers.low = receivers.high = glm::dvec3(cascade.center, cascade.near_z);
    const glm::dvec2 texel(cascades.texel(static_cast<int>(i)));
    const double disc = inputs.tan_half_angle * std::max(receivers.high.z - nearest, 0.0);
    // A disc's bounds are read from 2 × 2 texels of a pyramid, each less than twice as wide as the disc along the axis
    // where texels are smaller.
    const double larger = glm::max(texel.x, texel.y), smaller = glm::min(texel.x, texel.y);
    const glm::dvec2 beyond = 5 * (disc + 1.5 * larger) * (texel / smaller) + margins.texels * larger;
    const glm::dvec2 origin = glm::dvec2(cascade.center) - glm::dvec2(cascade.half_extent);
    const auto texels_at = [&](const glm::dvec3& place) { return (glm::dvec2(place) - origin) / texel; };
    const glm::dvec2 low = glm::max(texels_at(receivers.low) - beyond / texel, texels_at(casters.low) - beside_casters);
    const glm::dvec2 high =
        glm::min(texels_at(receivers.high) + beyond / texel, texels_at(casters.high) + beside_casters);
    cascade.drawn = texels_around(low, glm::max(low, high), cascades.size);
  }
}

}  // namespace penumbra::shadow
