#include "truth/penumbra_trace.h"

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <numeric>

#include "truth/parallel.h"
#include "truth/pixel_rays.h"
#include "truth/sampling.h"

namespace penumbra::truth {

namespace {

constexpr std::uint32_t no_slot = ~0u;
// Blockers nearer than this count as so far away: a millimetre, and less where pixels are smaller than a centimetre.
float least_distance(float pixel) { return std::min(1e-3f, 0.1f * pixel); }

// Where a pixel's rays start, and the cosines of the angles between its surface's normal and the light's centre and
// sides: see SeenLight.
struct Start {
  glm::vec3 origin{0};
  float cosine = 0, cosine_x = 0, cosine_y = 0;
  float pixel = 0;  // metres, the height of a pixel as far from the eye
  bool there = false;
};

// The rays of a pixel so far.
struct Count {
  std::uint32_t lit = 0;
  std::uint32_t hits = 0;  // whose distance is known
  float nearness = 0;      // sum of the reciprocals of their distances, 1 / metres
};

// Gathers rays of several pixels into packets. Each thread has its own.
class Packets {
 public:
  // With `measures` the distance of the nearest blocker is found, which takes longer.
  Packets(const EmbreeScene& scene, const SeenLight& light, const PicturePoints& points, bool measures,
          std::vector<Count>& counts)
      : scene_(scene), light_(light), points_(points), measures_(measures), counts_(counts) {
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    std::ranges::fill(rays_.ray.tnear, 0.0f);
    std::ranges::fill(rays_.ray.mask, ~0U);
  }

  void add(std::size_t slot, const Start& start, std::uint32_t point) {
    rays_.ray.org_x[used_] = start.origin.x;
    rays_.ray.org_y[used_] = start.origin.y;
    rays_.ray.org_z[used_] = start.origin.z;
    starts_[used_] = &start;
    slots_[used_] = slot;
    indices_[used_] = point;
    if (++used_ == packet_width) trace();
  }

  // To be called after the last ray.
  void finish() {
    if (used_ > 0) trace();
  }

 private:
  void aim() {
    PacketPoints points;
    points_.square(indices_, points);
    if (light_.square) {
      square_to_sides(points);
    } else {
      square_to_disc(points);
    }
    const glm::vec3 center(light_.center), side_x(light_.side_x), side_y(light_.side_y);
    for (std::size_t i = 0; i < packet_width; ++i) {
      const float x = points.x[i], y = points.y[i];
      rays_.ray.dir_x[i] = center.x + x * side_x.x + y * side_y.x;
      rays_.ray.dir_y[i] = center.y + x * side_x.y + y * side_y.y;
      rays_.ray.dir_z[i] = center.z + x * side_x.z + y * side_y.z;
      rays_.ray.tfar[i] = light_.far;
      rays_.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays_.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      // Light from behind the surface does not reach it.
      const bool traced = i < used_ && starts_[i]->cosine + x * starts_[i]->cosine_x + y * starts_[i]->cosine_y > 0;
      valid_[i] = traced ? -1 : 0;
    }
  }

  void trace() {
    aim();
    if (measures_) {
      rtcIntersect8(valid_.data(), scene_.get(), &context_, &rays_);
    } else {
      rtcOccluded8(valid_.data(), scene_.get(), &context_, &rays_.ray);
    }
    for (std::size_t i = 0; i < used_; ++i) {
      if (valid_[i] == 0) continue;
      Count& count = counts_[slots_[i]];
      if (measures_ && rays_.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
        ++count.hits;
        // Directions advance by a metre along the light.
        count.nearness += 1 / std::max(rays_.ray.tfar[i], least_distance(starts_[i]->pixel));
      } else if (rays_.ray.tfar[i] >= 0) {  // Embree sets it to −∞ for an occluded ray
        ++count.lit;
      }
    }
    used_ = 0;
  }

  const EmbreeScene& scene_;
  const SeenLight& light_;
  const PicturePoints& points_;
  bool measures_;
  std::vector<Count>& counts_;
  RTCIntersectContext context_;
  RTCRayHit8 rays_;
  alignas(32) std::array<int, packet_width> valid_{};  // Embree's mask: −1 traces the ray, 0 skips it
  std::array<const Start*, packet_width> starts_{};
  std::array<std::size_t, packet_width> slots_{};
  std::array<std::uint32_t, packet_width> indices_{};
  std::size_t used_ = 0;
};

class PenumbraTrace {
 public:
  PenumbraTrace(const EmbreeScene& scene, const PenumbraRequest& request)
      : scene_(scene),
        request_(request),
        light_(seen_from(request.sun, glm::dvec3(0))),
        world_to_clip_(glm::inverse(request.eye.clip_to_world)),
        points_(request.seed, request.rays),
        probes_(request.rays / 4),
        threads_(thread_count(request.threads)),
        starts_(request.pixels.size()),
        counts_(request.pixels.size()),
        slots_(static_cast<std::size_t>(request.eye.width) * static_cast<std::size_t>(request.eye.height), no_slot) {}

  std::vector<PenumbraPixel> trace() {
    in_parallel([this](std::size_t begin, std::size_t end) { probe(begin, end); });
    std::vector<PenumbraPixel> out(counts_.size());
    const std::vector<Count> probed = counts_;
    in_parallel([&](std::size_t begin, std::size_t end) { complete(probed, begin, end, out); });
    return out;
  }

 private:
  template <class Work>
  void in_parallel(const Work& work) {
    for_ranges(threads_, starts_.size(), work);
  }

  // Traces the rays `begin` to `end` (exclusive) of a pixel. Pixels of a block of 2 × 2 begin with different quarters
  // of their points, which together cover the light evenly. After its own points a pixel takes those of the one beside
  // it in the block, which are spread evenly among its own.
  void add_rays(Packets& packets, std::size_t slot, std::uint32_t begin, std::uint32_t end) const {
    const glm::uvec2 pixel(request_.pixels[slot].pixel);
    const std::uint32_t own = points_.first(pixel.x, pixel.y), beside = points_.first(pixel.x ^ 1U, pixel.y);
    const std::uint32_t quarter = (pixel.x & 1U) + 2 * (pixel.y & 1U);
    for (std::uint32_t ray = begin; ray < end; ++ray) {
      const std::uint32_t first = ray < request_.rays ? own : beside;
      packets.add(slot, starts_[slot], first + (quarter * probes_ + ray) % request_.rays);
    }
  }

  // Where some rays leave below the surface's horizon and the others are lit, the distance is 0: no filter smooths that
  // pixel, so it counts as narrow.
  std::uint32_t rays_of(std::size_t slot, float blocker_distance) const {
    const float width = 2 * static_cast<float>(glm::length(light_.side_x)) * blocker_distance;
    return width < request_.narrow * starts_[slot].pixel ? 2 * request_.rays : request_.rays;
  }

  // Height of a pixel at that distance from the eye, metres.
  float pixel_at(const glm::dvec3& position) const {
    const glm::dvec4 clip_w = glm::row(world_to_clip_, 3);
    const glm::dvec3 along(clip_w), up(glm::row(world_to_clip_, 1));
    // Without what a lens shift adds: it is the same for all points at a distance.
    const double shift = glm::dot(up, along) / std::max(glm::dot(along, along), 1e-30);
    const double clip_y_a_metre = glm::length(up - shift * along);
    return static_cast<float>(2 * glm::dot(clip_w, glm::dvec4(position, 1)) / (clip_y_a_metre * request_.eye.height));
  }

  Start start_at(const Receiver& receiver) const {
    if (!receiver.there) return {};
    return {.origin = start_of(receiver, scene_),
            .cosine = static_cast<float>(glm::dot(receiver.normal, light_.center)),
            .cosine_x = static_cast<float>(glm::dot(receiver.normal, light_.side_x)),
            .cosine_y = static_cast<float>(glm::dot(receiver.normal, light_.side_y)),
            .pixel = pixel_at(receiver.position),
            .there = true};
  }

  void probe(std::size_t begin, std::size_t end) {
    const std::vector<Receiver> receivers =
        receivers_of(request_.geometry, request_.eye, request_.pixels.subspan(begin, end - begin));
    Packets packets(scene_, light_, points_, /*measures=*/true, counts_);
    for (std::size_t slot = begin; slot < end; ++slot) {
      starts_[slot] = start_at(receivers[slot - begin]);
      if (!starts_[slot].there) continue;
      const glm::ivec2 pixel = request_.pixels[slot].pixel;
      slots_[place(pixel)] = static_cast<std::uint32_t>(slot);
      add_rays(packets, slot, 0, probes_);
    }
    packets.finish();
  }

  std::size_t place(const glm::ivec2& pixel) const {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(request_.eye.width) +
           static_cast<std::size_t>(pixel.x);
  }

  // The probes of a pixel and its eight neighbours, as far as they were traced.
  Count probes_around(const std::vector<Count>& probed, std::size_t slot, std::uint32_t& traced) const {
    const glm::ivec2 pixel = request_.pixels[slot].pixel;
    const glm::ivec2 low = glm::max(pixel - 1, 0);
    const glm::ivec2 high = glm::min(pixel + 1, glm::ivec2(request_.eye.width, request_.eye.height) - 1);
    Count sum;
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const std::uint32_t at = slots_[place({x, y})];
        if (at == no_slot) continue;
        sum.lit += probed[at].lit;
        sum.hits += probed[at].hits;
        sum.nearness += probed[at].nearness;
        traced += probes_;
      }
    }
    return sum;
  }

  void complete(const std::vector<Count>& probed, std::size_t begin, std::size_t end, std::vector<PenumbraPixel>& out) {
    Packets packets(scene_, light_, points_, /*measures=*/false, counts_);
    std::vector<std::size_t> doubtful;
    for (std::size_t slot = begin; slot < end; ++slot) {
      if (!starts_[slot].there) continue;
      std::uint32_t traced = 0;
      const Count around = probes_around(probed, slot, traced);
      const Count& own = probed[slot];
      const Count& measured = own.hits > 0 ? own : around;
      out[slot] = {
          .visibility = own.lit > 0 ? 1.0f : 0.0f,
          .blocker_distance = measured.hits > 0 ? static_cast<float>(measured.hits) / measured.nearness : 0.0f};
      if (around.lit == 0 || around.lit == traced) continue;
      doubtful.push_back(slot);
      add_rays(packets, slot, probes_, rays_of(slot, out[slot].blocker_distance));
    }
    packets.finish();
    for (const std::size_t slot : doubtful) {
      const std::uint32_t rays = rays_of(slot, out[slot].blocker_distance);
      out[slot].visibility = static_cast<float>(counts_[slot].lit) / static_cast<float>(rays);
    }
  }

  const EmbreeScene& scene_;
  const PenumbraRequest& request_;
  SeenLight light_;
  glm::dmat4 world_to_clip_;
  PicturePoints points_;
  std::uint32_t probes_;  // rays of each pixel that are traced first
  int threads_;
  // One per pixel of the request. Only one thread at a time writes a given element.
  std::vector<Start> starts_;
  std::vector<Count> counts_;
  std::vector<std::uint32_t> slots_;  // by pixel of the picture, its place in the request
};

}  // namespace

std::vector<PenumbraPixel> trace_penumbrae(const EmbreeScene& scene, const PenumbraRequest& request) {
  return PenumbraTrace(scene, request).trace();
}

}  // namespace penumbra::truth
