#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "truth/cache.h"
#include "truth/tracer.h"

namespace penumbra::truth {

// A picture to be traced.
struct PictureRequest {
  const scene::Scene* scene = nullptr;  // lives, with what `geometry` refers to, until its triangles are laid out
  scene::PosedGeometry geometry;
  Key casters;  // of the two
  std::vector<Receiver> receivers;
  int width = 0;
  Light light;
  TraceOptions options;
  Key key;  // of all
};

struct TracedPicture {
  Key key;
  Traced traced;
  std::optional<BuildStats> build;  // where triangles had to be laid out for it
};

// Traces pictures, and keeps the triangles for the next one of the same casters. One thread at a time.
class PictureTracer {
 public:
  // Throws what Tracer throws. `stop` ends the laying out of triangles; rays are stopped by the request's progress.
  TracedPicture trace(const PictureRequest& request, const std::stop_token& stop = {});

 private:
  std::optional<Tracer> tracer_;
  Key casters_;  // that the tracer has
};

}  // namespace penumbra::truth
