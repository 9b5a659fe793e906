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

// What Embree holds, kept within a limit; its threads ask all at once.
struct MemoryUse {
  std::atomic<std::ptrdiff_t> bytes = 0;
  std::ptrdiff_t limit = 0;  // 0: none
};

// Which hits of a geometry count: where its alpha leaves something, on the faces that cast.
struct CasterTest {
  std::unique_ptr<AlphaTest> alpha;  // null: it is there everywhere
  scene::CasterFaces faces = scene::CasterFaces::both;
  bool mirrored = false;  // front faces are clockwise, as Embree has them
};

// All casters of a posed scene in Embree. Keeps nothing of the scene but what it copies.
class EmbreeScene {
 public:
  // Throws Error if there is not enough memory, and Interrupted.
  EmbreeScene(const scene::Scene& scene, const scene::PosedGeometry& geometry, const BuildOptions& options);

  RTCScene get() const { return top_.get(); }
  // Rays are given relative to this point, so that a scene far from the world's origin loses no precision.
  const glm::dvec3& origin() const { return origin_; }
  // Metres from there to the furthest point of a scene with shared triangles: rounding errors of the rays that are
  // turned to where they lie grow with it. 0 if no triangles are shared.
  double shared_reach() const { return shared_reach_; }
  const BuildStats& stats() const { return stats_; }

 private:
  friend class EmbreeSceneBuilder;

  // Released in the reverse order.
  std::unique_ptr<MemoryUse> memory_ = std::make_unique<MemoryUse>();
  EmbreeDevice device_;
  std::vector<std::unique_ptr<AlphaTexture>> textures_;  // one a texture of the scene, null where none is needed
  std::vector<std::unique_ptr<CasterTest>> tests_;
  std::vector<EmbreeObject> prototypes_;
  EmbreeObject top_;
  glm::dvec3 origin_{0};
  double shared_reach_ = 0;
  BuildStats stats_;
};

}  // namespace penumbra::truth
