#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "shadow/registry.h"
#include "truth/cache.h"
#include "truth/tracer.h"

namespace penumbra::truth {

struct TechniqueOptions {
  std::filesystem::path cache = default_cache_folder();  // empty: nothing is found or kept
  int threads = 0;                                       // 0: one a core
  // As TraceOptions::progress. In the background it is called on a thread of the technique's; a frame whose
  // picture was cancelled throws Interrupted.
  std::function<bool(double share_done)> progress;
  // In the place of the sun, at the seconds of the frame.
  std::function<LocalLight(double seconds)> local_light;
  // A frame doesn't wait for its picture: until that is traced, the mask is 0 where the surface faces away from the
  // light's centre, else 1. A frame that needs another picture stops the one that is being traced, so of two
  // that take turns none is finished. What goes wrong (not enough memory) is thrown by the next frame, once; the same
  // picture is then not tried again before another one was asked for, or stop().
  bool background = false;
};

// The technique `truth`: the mask is ray traced from the triangles that the G-buffer shows. It needs a
// render::Renderer's frame, whose scene it asks for; the Renderer, and all registries made here, may outlive it, and
// then trace within the frame. One thread at a time.
class TruthTechnique {
 public:
  explicit TruthTechnique(TechniqueOptions options = {});
  ~TruthTechnique();
  TruthTechnique(const TruthTechnique&) = delete;
  TruthTechnique& operator=(const TruthTechnique&) = delete;

  // `base` and, last, `truth`.
  shadow::Registry registry(const shadow::Registry& base = shadow::built_in_registry()) const;

  struct Pending {
    double share_done;  // of the work, 0 to 1; doesn't fall while the frames ask for the same picture
  };
  // In the background: set while the picture that the last frame asked for is being traced. Once it no longer is, the
  // next frame has it.
  std::optional<Pending> pending() const;

  // Cancels what is traced in the background. Returns at once; the scene may still be read for a moment.
  void cancel();
  // Stops what is traced in the background, and returns when nothing refers to the scene any more: to be called before
  // the GpuScene of the last frames, or its scene::Scene, goes. The next frame starts again.
  void stop();

  // What the last frame drew by it that had its picture; rows from the bottom.
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
