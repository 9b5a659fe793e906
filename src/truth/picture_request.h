#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "truth/cache.h"
#include "truth/tracer.h"

namespace penumbra::truth {

// A picture to be traced.
struct PictureRequest {
  // Must stay alive, with all that `geometry` refers to, until the tracer is built.
  const scene::Scene* scene = nullptr;
  scene::PosedGeometry geometry;
  Key casters;  // of `scene` and `geometry`
  std::vector<Receiver> receivers;
  int width = 0;
  TracedLight light;
  TraceOptions options;
  Key key;  // of the whole request
};

struct TracedPicture {
  Key key;
  Traced traced;
  std::optional<BuildStats> build;  // set if a tracer had to be built for it
};

// Traces pictures, and keeps the tracer for the next picture of the same casters. For one thread at a time.
class PictureTracer {
 public:
  // Throws what Tracer throws. `stop` interrupts the building of the tracer; the request's progress callback interrupts
  // the tracing.
  TracedPicture trace(const PictureRequest& request, const std::stop_token& stop = {});

 private:
  std::optional<Tracer> tracer_;
  Key casters_;  // those that `tracer_` was built for
};

}  // namespace penumbra::truth
