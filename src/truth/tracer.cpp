#include "truth/tracer.h"

#include "truth/embree_scene.h"
#include "truth/picture_trace.h"

namespace penumbra::truth {

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
