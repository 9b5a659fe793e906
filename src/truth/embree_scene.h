#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "scene/posed_geometry.h"
#include "truth/alpha.h"
#include "truth/tracer.h"

namespace penumbra::truth {

template <auto release>
struct Release {
  template <class Object>
  void operator()(Object* object) const {
    release(object);
  }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, Release<rtcReleaseDevice>>;
using EmbreeObject = std::unique_ptr<RTCSceneTy, Release<rtcReleaseScene>>;
using EmbreeGeometry = std::unique_ptr<RTCGeometryTy, Release<rtcReleaseGeometry>>;

// Counts the memory that Embree allocates, against a limit; called by all of its threads.
struct MemoryUse {
  std::atomic<std::ptrdiff_t> bytes = 0;
  std::ptrdiff_t limit = 0;  // bytes; 0: no limit
};

// Which hits on a geometry count: those where its alpha passes, on the faces that cast shadows.
struct CasterTest {
  std::unique_ptr<AlphaTest> alpha;  // null: opaque everywhere
  scene::CasterFaces faces = scene::CasterFaces::both;
  bool mirrored = false;  // front faces are clockwise, as Embree has them
};

// All casters of a posed scene in Embree. Copies what it needs from the scene.
class EmbreeScene {
 public:
  // Throws Error if there is not enough memory, and Interrupted.
  EmbreeScene(const scene::Scene& scene, const scene::PosedGeometry& geometry, const BuildOptions& options);

  RTCScene get() const { return top_.get(); }
  // Rays are relative to this point (world space), so that a scene far from the world's origin loses no precision.
  const glm::dvec3& origin() const { return origin_; }
  // Metres from the origin to the furthest point of a scene with instanced triangles, or of these from the origin of
  // their own space if that is further; 0 without instances. Rays are transformed to the space of an instance, with a
  // rounding error that grows with this distance.
  double shared_extent() const { return shared_extent_; }
  const BuildStats& stats() const { return stats_; }

 private:
  friend class EmbreeSceneBuilder;

  // Members are destroyed in reverse order.
  std::unique_ptr<MemoryUse> memory_ = std::make_unique<MemoryUse>();
  EmbreeDevice device_;
  std::vector<std::unique_ptr<AlphaTexture>> textures_;  // per texture of the scene; null if no caster reads its alpha
  std::vector<std::unique_ptr<CasterTest>> tests_;
  std::vector<EmbreeObject> prototypes_;
  EmbreeObject top_;
  glm::dvec3 origin_{0};
  double shared_extent_ = 0;
  BuildStats stats_;
};

}  // namespace penumbra::truth
