#include "truth/pixel_rays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

namespace penumbra::truth {

static_assert(packet_width == 8);

namespace {

// Half a unit in the last place of a float, as a relative error.
constexpr double rounding = 0x1p-24;
// How far a ray starts off its plane, in rounding errors of the numbers in Embree's test of that plane: those of the
// start, of three differences with the corners, and of products of two such differences.
constexpr double clearance = 8;

}  // namespace

glm::vec3 start_of(const Receiver& receiver, const EmbreeScene& scene) {
  const glm::dvec3 place = receiver.position - scene.origin();
  const double furthest = std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
  const double off = clearance * rounding * (receiver.extent + furthest + 2 * scene.shared_extent());
  return glm::vec3(place + receiver.normal * off);
}

PixelRays::PixelRays(const EmbreeScene& scene, const TracedLight& light) : scene_(scene), light_(light), rays_{} {
  std::ranges::fill(rays_.tnear, 0.0f);
  std::ranges::fill(rays_.mask, ~0U);
}

void PixelRays::start_at(const Receiver& receiver) {
  const glm::vec3 start = start_of(receiver, scene_);
  std::ranges::fill(rays_.org_x, start.x);
  std::ranges::fill(rays_.org_y, start.y);
  std::ranges::fill(rays_.org_z, start.z);
  seen_ = seen_from(light_, glm::dvec3(start) + scene_.origin());
  cosine_center_ = glm::dot(receiver.normal, seen_.center);
  cosine_x_ = glm::dot(receiver.normal, seen_.side_x);
  cosine_y_ = glm::dot(receiver.normal, seen_.side_y);
}

// Returns how many rays have to be traced: those to points of the light that are above the surface.
long PixelRays::aim(const PacketPoints& points) {
  const glm::vec3 center(seen_.center);
  const glm::vec3 side_x(seen_.side_x);
  const glm::vec3 side_y(seen_.side_y);
  const auto cosine = static_cast<float>(cosine_center_);
  const auto cosine_x = static_cast<float>(cosine_x_);
  const auto cosine_y = static_cast<float>(cosine_y_);
  for (std::size_t i = 0; i < packet_width; ++i) {
    const float x = points.x[i];
    const float y = points.y[i];
    rays_.dir_x[i] = center.x + x * side_x.x + y * side_y.x;
    rays_.dir_y[i] = center.y + x * side_x.y + y * side_y.y;
    rays_.dir_z[i] = center.z + x * side_x.z + y * side_y.z;
    rays_.tfar[i] = seen_.far;
    valid_[i] = seen_.shines && cosine + x * cosine_x + y * cosine_y > 0 ? -1 : 0;
  }
  return std::ranges::count(valid_, -1);
}

void PixelRays::count_lit(LitCounts& lit) const {
  for (std::size_t i = 0; i < packet_width; ++i) {
    lit[i] += valid_[i] != 0 && rays_.tfar[i] >= 0 ? 1 : 0;  // Embree sets tfar to −∞ for an occluded ray
  }
}

void PixelRays::trace(const PixelPoints& pixel, std::uint32_t first, std::uint32_t last, LitCounts& lit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  PacketPoints points;
  for (std::uint32_t index = first; index < last; ++index) {
    pixel.square(index, points);
    if (seen_.square) {
      square_to_sides(points);
    } else {
      square_to_disc(points);
    }
    const long rays = aim(points);
    if (rays == 0) continue;
    traced_ += rays;
    rtcOccluded8(valid_.data(), scene_.get(), &context, &rays_);
    count_lit(lit);
  }
}

bool PixelRays::center_lit() {
  if (!(cosine_center_ > 0) || !seen_.shines) return false;
  RTCRay ray{.org_x = rays_.org_x[0],
             .org_y = rays_.org_y[0],
             .org_z = rays_.org_z[0],
             .tnear = 0,
             .dir_x = static_cast<float>(seen_.center.x),
             .dir_y = static_cast<float>(seen_.center.y),
             .dir_z = static_cast<float>(seen_.center.z),
             .time = 0,
             .tfar = seen_.far,
             .mask = ~0U,
             .id = 0,
             .flags = 0};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &ray);
  ++traced_;
  return ray.tfar >= 0;
}

}  // namespace penumbra::truth
