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

// A technique with its values, and the label that the user gave it.
struct Entry {
  std::string label;
  ParamSet params;
};

// What is measured of a contender's frames besides their time.
struct Measuring {
  bool passes = true;
  bool floor = false;
};

// Draws one entry; several are drawn alternately while they are measured. Each has its own device, so that timers,
// programs and histories are separate.
class Contender {
 public:
  // `scene` must outlive this object.
  Contender(const Entry& entry, const shadow::Registry& registry, const scene::Scene& scene,
            const cli::DeviceOptions& options, const Measuring& what);

  // Draws one frame, then one frame of its floor (floor.h). `params` are those of the entry's technique.
  void draw(const render::FrameInputs& inputs, const ParamSet& params);

  // Appends the times of the last `count` frames. Waits until they are measured.
  void keep(PassTimes& own, PassTimes& floor, std::size_t count);
  // The cost of the floor, and its ratio to the technique's.
  std::optional<FloorCost> floor_cost(const PassTimes& own, const PassTimes& floor) const;

  std::size_t shadow_bytes() const { return device_.device.target_bytes("shadow "); }

 private:
  session::RenderDevice device_;
  scene::GpuScene scene_;
  render::Renderer renderer_;
  std::optional<Floor> floor_;
};

}  // namespace penumbra::bench
