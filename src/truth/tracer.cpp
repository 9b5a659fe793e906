#include "truth/tracer.h"

#include <algorithm>

#include "truth/embree_scene.h"
#include "truth/picture_trace.h"

namespace penumbra::truth {

int first_samples(const TraceOptions& options) {
  constexpr int least_adaptive = 64;
  const int least = options.error > 0 ? least_adaptive : 1;
  return (std::max(options.samples, least) + scrambling_count - 1) / scrambling_count * scrambling_count;
}

struct Tracer::State {
  EmbreeScene scene;
};

Tracer::Tracer(const scene::Scene& scene, const scene::PosedGeometry& geometry, const BuildOptions& options)
    : state_(new State{EmbreeScene(scene, geometry, options)}) {}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&& other) noexcept = default;
Tracer& Tracer::operator=(Tracer&& other) noexcept = default;

Traced Tracer::trace(std::span<const Receiver> receivers, int width, const TracedLight& light,
                     const TraceOptions& options) const {
  return PictureTrace(state_->scene, receivers, width, light, options).trace();
}

const BuildStats& Tracer::stats() const { return state_->scene.stats(); }

}  // namespace penumbra::truth
