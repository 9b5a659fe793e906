#include "truth/embree_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "truth/posed_triangle.h"

namespace penumbra::truth {

namespace {

// AVX-512 is disabled: in Debian's build of Embree 3.13.5 some traversals of 16 rays store a 16-bit mask and read 64
// bits, so that they may loop forever, depending on what is on the stack. Without it, all processors with AVX2 also
// give identical results.
constexpr const char* device_options = "ignore_config_files=1,max_isa=avx2";
// In triangles: an instance of a smaller primitive takes more memory than a copy of its triangles.
constexpr std::size_t least_shared = 64;

// The new zero for coordinates from `low` to `high` such that subtracting it makes all of them smaller and rounds none:
// a multiple of the coarsest float step in the range, and no further out than twice the end that is nearer to zero.
double best_zero(float low, float high) {
  if (low <= 0 && high >= 0) return 0;
  if (!(low <= high)) return 0;  // the range is empty
  if (high < 0) return -best_zero(-high, -low);
  const double step = double{std::nextafter(high, std::numeric_limits<float>::infinity())} - high;
  return std::floor(std::min(0.5 * (double{low} + high), 2.0 * low) / step) * step;
}

// The triangles that rays can hit.
std::vector<std::uint32_t> solid_triangles(const scene::PosedSurface& surface) {
  std::vector<std::uint32_t> solid;
  for (std::size_t i = 0; i < triangle_count(surface); ++i) {
    if (world_triangle(surface, i)) solid.push_back(static_cast<std::uint32_t>(i));
  }
  return solid;
}

// Whether rays can be transformed to the space of the untransformed vertices without loss of precision.
bool turns_back(const glm::mat4& world) {
  const glm::dmat3 linear(world);
  const double volume = std::abs(glm::determinant(linear));
  const double longest = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
  return std::isfinite(volume) && volume > 1e-2 * longest * longest * longest;
}

// Embree filter callback: rejects hits where a surface casts no shadow (alpha, or a face that does not cast). Rays go
// towards the light, so where a ray leaves a surface through its front, that front faces the light.
void pass_through_holes(const RTCFilterFunctionNArguments* args) {
  const auto& test = *static_cast<const CasterTest*>(args->geometryUserPtr);
  const unsigned int count = args->N;
  for (unsigned int i = 0; i < count; ++i) {
    if (args->valid[i] == 0) continue;
    bool there =
        test.alpha == nullptr || test.alpha->passes(RTCHitN_primID(args->hit, count, i), RTCHitN_u(args->hit, count, i),
                                                    RTCHitN_v(args->hit, count, i));
    if (test.faces != scene::CasterFaces::both) {
      const float along = RTCHitN_Ng_x(args->hit, count, i) * RTCRayN_dir_x(args->ray, count, i) +
                          RTCHitN_Ng_y(args->hit, count, i) * RTCRayN_dir_y(args->ray, count, i) +
                          RTCHitN_Ng_z(args->hit, count, i) * RTCRayN_dir_z(args->ray, count, i);
      const bool front = (along > 0) != test.mirrored;
      there = there && front == (test.faces == scene::CasterFaces::front);
    }
    if (!there) args->valid[i] = 0;
  }
}

bool keep_to_limit(void* pointer, ssize_t bytes, bool /*already_done*/) {
  MemoryUse& use = *static_cast<MemoryUse*>(pointer);
  const std::ptrdiff_t held = use.bytes += bytes;
  return bytes <= 0 || use.limit == 0 || held <= use.limit;
}

// Embree calls this on its own threads.
bool report_progress(void* pointer, double /*share_done*/) {
  return !static_cast<const BuildOptions*>(pointer)->stop.stop_requested();
}

}  // namespace

class EmbreeSceneBuilder {
 public:
  EmbreeSceneBuilder(EmbreeScene& out, const scene::Scene& scene, const scene::PosedGeometry& geometry,
                     BuildOptions options)
      : out_(out), scene_(scene), geometry_(geometry), options_(std::move(options)) {
    out_.textures_.resize(scene.textures.size());
  }

  void build();

 private:
  using Surfaces = std::vector<const scene::PosedSurface*>;

  void check() const;
  EmbreeObject new_object();
  std::vector<Surfaces> copies();
  void find_origin(const std::vector<Surfaces>& copies);
  const AlphaTexture* texture_of(const scene::Material& material);
  void set_vertices(RTCGeometry geometry, const scene::PosedSurface& surface, const glm::dvec3& origin) const;
  void set_triangles(RTCGeometry geometry, const scene::Primitive& primitive,
                     const std::vector<std::uint32_t>& solid) const;
  void add(RTCScene object, const scene::PosedSurface& surface, const glm::dvec3& origin);
  void add_shared(const Surfaces& copies);

  EmbreeScene& out_;
  const scene::Scene& scene_;
  const scene::PosedGeometry& geometry_;
  BuildOptions options_;
};

void EmbreeSceneBuilder::check() const {
  const RTCError error = rtcGetDeviceError(out_.device_.get());
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_CANCELLED) throw Interrupted();
  if (error == RTC_ERROR_OUT_OF_MEMORY) fail("ray tracing: not enough memory for {} triangles", out_.stats_.triangles);
  if (error == RTC_ERROR_UNSUPPORTED_CPU) fail("ray tracing: Embree does not support this processor");
  fail("ray tracing: Embree fails with its error {}", static_cast<int>(error));
}

EmbreeObject EmbreeSceneBuilder::new_object() {
  EmbreeObject object(rtcNewScene(out_.device_.get()));
  check();
  // Robust mode: a ray through a shared edge hits one of its triangles, and rounding of bounding boxes misses no
  // triangle.
  rtcSetSceneFlags(object.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(object.get(), RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneProgressMonitorFunction(object.get(), report_progress, &options_);
  return object;
}

// The casters, grouped by vertices, material and casting faces.
std::vector<EmbreeSceneBuilder::Surfaces> EmbreeSceneBuilder::copies() {
  std::map<std::tuple<const scene::Primitive*, const glm::vec3*, scene::CasterFaces>, std::size_t> place;
  std::vector<Surfaces> all;
  for (const scene::PosedSurface& surface : geometry_.surfaces) {
    const std::size_t count = triangle_count(surface);
    if (surface.casts == scene::CastMode::never || count == 0) continue;
    out_.stats_.triangles += count;
    const auto [at, added] =
        place.try_emplace({surface.primitive, surface.positions.data(), surface.faces}, all.size());
    if (added) all.emplace_back();
    all[at->second].push_back(&surface);
  }
  return all;
}

void EmbreeSceneBuilder::find_origin(const std::vector<Surfaces>& copies) {
  glm::vec3 low(std::numeric_limits<float>::infinity());
  glm::vec3 high = -low;
  for (const Surfaces& surfaces : copies) {
    for (const scene::PosedSurface* surface : surfaces) {
      for (std::uint32_t i = 0; i < surface->positions.size(); ++i) {
        const glm::vec3 p = world_position(*surface, i);
        if (!near_enough(p)) continue;
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
  }
  for (glm::length_t axis = 0; axis < 3; ++axis) out_.origin_[axis] = best_zero(low[axis], high[axis]);
  const glm::dvec3 extent =
      glm::max(glm::abs(glm::dvec3(low) - out_.origin_), glm::abs(glm::dvec3(high) - out_.origin_));
  out_.shared_extent_ = glm::length(extent);
}

const AlphaTexture* EmbreeSceneBuilder::texture_of(const scene::Material& material) {
  const int index = material.base_color_texture.texture;
  if (index < 0) return nullptr;
  const scene::Texture& texture = scene_.textures[static_cast<std::size_t>(index)];
  if (texture.image < 0) return nullptr;
  std::unique_ptr<AlphaTexture>& made = out_.textures_[static_cast<std::size_t>(index)];
  if (!made) made = std::make_unique<AlphaTexture>(texture, scene_.images[static_cast<std::size_t>(texture.image)]);
  return made.get();
}

void EmbreeSceneBuilder::set_vertices(RTCGeometry geometry, const scene::PosedSurface& surface,
                                      const glm::dvec3& origin) const {
  auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                         3 * sizeof(float), surface.positions.size()));
  check();
  for (std::uint32_t i = 0; i < surface.positions.size(); ++i) {
    const glm::vec3 p(glm::dvec3(world_position(surface, i)) - origin);
    for (glm::length_t axis = 0; axis < 3; ++axis) *to++ = p[axis];
  }
}

void EmbreeSceneBuilder::set_triangles(RTCGeometry geometry, const scene::Primitive& primitive,
                                       const std::vector<std::uint32_t>& solid) const {
  auto* to = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(std::uint32_t), solid.size()));
  check();
  for (const std::uint32_t triangle : solid) {
    std::memcpy(to, &primitive.indices[3 * std::size_t{triangle}], 3 * sizeof(std::uint32_t));
    to += 3;
  }
}

// Adds a surface in world space, relative to `origin`.
void EmbreeSceneBuilder::add(RTCScene object, const scene::PosedSurface& surface, const glm::dvec3& origin) {
  if (options_.stop.stop_requested()) throw Interrupted();
  const std::vector<std::uint32_t> solid = solid_triangles(surface);
  if (solid.empty()) return;
  const EmbreeGeometry geometry(rtcNewGeometry(out_.device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  check();
  set_vertices(geometry.get(), surface, origin);
  set_triangles(geometry.get(), *surface.primitive, solid);
  auto test =
      std::make_unique<CasterTest>(CasterTest{.alpha = nullptr, .faces = surface.faces, .mirrored = surface.mirrored});
  if (surface.casts == scene::CastMode::by_alpha) {
    static const scene::Material unspecified;
    const int index = surface.primitive->material;
    const scene::Material& material = index < 0 ? unspecified : scene_.materials[static_cast<std::size_t>(index)];
    test->alpha = std::make_unique<AlphaTest>(material, *surface.primitive, texture_of(material), solid);
  }
  if (test->alpha != nullptr || test->faces != scene::CasterFaces::both) {
    rtcSetGeometryUserData(geometry.get(), test.get());
    rtcSetGeometryOccludedFilterFunction(geometry.get(), pass_through_holes);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), pass_through_holes);
    out_.tests_.push_back(std::move(test));
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(object, geometry.get());
  check();
  out_.stats_.stored += solid.size();
}

// Adds one object of the untransformed triangles, and an instance of it for each copy.
void EmbreeSceneBuilder::add_shared(const Surfaces& copies) {
  EmbreeObject object = new_object();
  scene::PosedSurface at_rest = *copies.front();
  at_rest.world = glm::mat4(1);
  at_rest.mirrored = false;  // their instance matrices mirror them
  add(object.get(), at_rest, glm::dvec3(0));
  rtcCommitScene(object.get());
  check();
  double furthest = 0;
  for (const glm::vec3& position : at_rest.positions) {
    if (near_enough(position)) furthest = std::max(furthest, static_cast<double>(glm::length(position)));
  }
  for (const scene::PosedSurface* surface : copies) {
    const glm::dmat3 turn(surface->world);
    const double scale = std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
    out_.shared_extent_ = std::max(out_.shared_extent_, scale * furthest);
    glm::mat4 world = surface->world;
    world[3] = glm::vec4(glm::dvec3(world[3]) - out_.origin_, 1.0);
    const EmbreeGeometry instance(rtcNewGeometry(out_.device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    check();
    rtcSetGeometryInstancedScene(instance.get(), object.get());
    rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &world);
    rtcCommitGeometry(instance.get());
    rtcAttachGeometry(out_.top_.get(), instance.get());
    check();
    ++out_.stats_.instances;
  }
  out_.prototypes_.push_back(std::move(object));
}

void EmbreeSceneBuilder::build() {
  out_.memory_->limit = static_cast<std::ptrdiff_t>(options_.memory);
  std::string device = device_options;
  if (options_.threads > 0) device += fmt::format(",threads={}", options_.threads);
  out_.device_.reset(rtcNewDevice(device.c_str()));
  check();
  rtcSetDeviceMemoryMonitorFunction(out_.device_.get(), keep_to_limit, out_.memory_.get());
  const std::vector<Surfaces> all = copies();
  find_origin(all);
  out_.top_ = new_object();
  const bool share = out_.stats_.triangles > options_.flat_triangles;
  for (const Surfaces& surfaces : all) {
    Surfaces shared;
    Surfaces flat;
    for (const scene::PosedSurface* surface : surfaces) {
      const bool fit = share && triangle_count(*surface) >= least_shared && turns_back(surface->world);
      (fit ? shared : flat).push_back(surface);
    }
    if (shared.size() == 1) flat.push_back(shared.front());
    if (shared.size() > 1) add_shared(shared);
    for (const scene::PosedSurface* surface : flat) add(out_.top_.get(), *surface, out_.origin_);
  }
  if (out_.stats_.instances == 0) out_.shared_extent_ = 0;
  rtcCommitScene(out_.top_.get());
  check();
}

EmbreeScene::EmbreeScene(const scene::Scene& scene, const scene::PosedGeometry& geometry, const BuildOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  try {
    EmbreeSceneBuilder(*this, scene, geometry, options).build();
  } catch (const std::bad_alloc&) {
    fail("ray tracing: not enough memory for {} triangles", stats_.triangles);
  }
  stats_.memory = static_cast<std::size_t>(std::max<std::ptrdiff_t>(memory_->bytes, 0));
  stats_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace penumbra::truth
