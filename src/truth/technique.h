#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "shadow/technique.h"
#include "truth/cache.h"
#include "truth/tracer.h"

namespace penumbra::truth {

struct TechniqueOptions {
  std::filesystem::path cache = default_cache_folder();  // empty: nothing is found or kept
  int threads = 0;                                       // 0: one a core
  std::function<bool(double share_done)> progress;       // as TraceOptions::progress
  // In the place of the sun, at the seconds of the frame.
  std::function<LocalLight(double seconds)> local_light;
};

// The technique `truth`: the mask is ray traced from the triangles that the G-buffer shows. It needs a
// render::Renderer's frame, whose scene it asks for; the Renderer, and all registries made here, may outlive it. One
// thread at a time.
class TruthTechnique {
 public:
  explicit TruthTechnique(TechniqueOptions options = {});
  ~TruthTechnique();

  // `base` and, last, `truth`.
  shadow::Registry registry(const shadow::Registry& base = shadow::built_in_registry()) const;

  // What the last frame drew by it; rows from the bottom.
  struct Last {
    Traced traced;
    std::vector<float>
        receiver;  // a pixel: 1 where all of the light is before the surface (see docs/metrics.md), else 0
    bool from_cache = false;
    std::optional<BuildStats> build;  // where triangles had to be laid out for it
  };
  const Last& last() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace penumbra::truth
