#pragma once

#include <optional>
#include <string>

#include "bench/floor.h"
#include "bench/times.h"
#include "core/params.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "session/render_device.h"

namespace penumbra::bench {

// A technique with its values, under the name that it was asked for by.
struct Entry {
  std::string label;
  ParamSet params;
};

// An entry that takes turns with others. Each has a device of its own, which keeps timers, programs and histories
// apart.
class Contender {
 public:
  // `scene` outlives this.
  Contender(const Entry& entry, const scene::Scene& scene, const cli::DeviceOptions& options, bool with_floor);

  // One frame, and after it one of its floor. With `params` of the entry's technique.
  void draw(const render::FrameInputs& inputs, const ParamSet& params);

  // Keeps the last `count` frames as measured. Waits for what is outstanding.
  void keep(PassTimes& own, PassTimes& floor, std::size_t count);
  // Of the floor beside what it is the floor of.
  std::optional<FloorCost> floor_cost(const PassTimes& own, const PassTimes& floor) const;

  std::size_t target_bytes() const { return device_.device.target_bytes("shadow "); }

 private:
  session::RenderDevice device_;
  scene::GpuScene scene_;
  render::Renderer renderer_;
  std::optional<Floor> floor_;
};

}  // namespace penumbra::bench
