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
  std::filesystem::path cache = default_cache_folder();  // empty: no cache
  std::uintmax_t cache_bytes = Cache::usual_bytes;       // the most that it takes
  int threads = 0;                                       // 0: one for each core
  // Same as TraceOptions::progress, of the pictures of all lights of the frame; with background tracing of the picture
  // of one, and called on the background thread. If it interrupts a picture, the frame throws Interrupted.
  std::function<bool(double share_done)> progress;
  // Frames don't wait for their picture. Until it is traced, the mask is 0 where the surface faces away from the
  // light's centre, else 1. A light that needs another picture than in the view's last frame cancels the one that is
  // being traced for it. The lights of a frame, and views of different ids, are traced one after the other. The next
  // frame throws an error of the tracing (such as not enough memory), once; the same picture is not tried again until
  // another one is requested or stop() is called.
  bool background = false;
};

// The technique `truth`: the mask is ray traced from the triangles that the G-buffer shows. It works only in frames of
// a render::Renderer, whose scene it reads. The Renderer and all registries made here may outlive this object; they
// then trace synchronously. For one thread at a time.
class TruthTechnique {
 public:
  explicit TruthTechnique(TechniqueOptions options = {});
  ~TruthTechnique();
  TruthTechnique(const TruthTechnique&) = delete;
  TruthTechnique& operator=(const TruthTechnique&) = delete;

  // `base` with `truth`, `hybrid` and the preset `hybrid_denoised` appended.
  shadow::Registry registry(const shadow::Registry& base = shadow::built_in_registry()) const;

  struct Pending {
    double share_done;  // of the picture, 0 to 1; never falls while frames request the same one
  };
  // With background tracing: set while a picture that the last frame requested is being traced. When it is empty
  // again, the next frame shows the picture, and starts tracing that of the next light that has none.
  std::optional<Pending> pending() const;
  // With background tracing: whether the last frame showed a light without its picture, and a later one will show it.
  // That one may have to be drawn although pending() was never seen set: few rays can be traced before it is called.
  bool unfinished() const;

  // Cancels background tracing. Returns at once; the scene may still be read for a moment.
  void cancel();
  // Stops background tracing and waits until nothing refers to the scene any more. Call it before the GpuScene of the
  // last frames, or its scene::Scene, is destroyed. The next frame starts tracing again.
  void stop();

  // A traced picture of a light; rows bottom to top.
  struct Last {
    Traced traced;
    std::vector<float>
        receiver;  // one value per pixel: 1 where all of the light is above the surface (see docs/metrics.md), else 0
    bool from_cache = false;
    std::optional<BuildStats> build;  // set if a tracer had to be built for it
  };
  // The last one that a frame of this technique showed of the light of that layer of the mask.
  const Last& last(int layer = 0) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace penumbra::truth
