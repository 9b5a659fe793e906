#include "app/stats.h"

#include <sys/resource.h>

#include <string>
#include <vector>

#include "app/commands.h"

namespace penumbra::app {

namespace {

using io::Json;

Json json_of(const glm::vec3& v) { return {v.x, v.y, v.z}; }

// Kilobytes, the system's count for this process.
long peak_resident() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

Json stats_of(const RenderOptions& options, const studio::Stage& stage, const ParamSet& params, studio::Studio& studio,
              std::size_t measured) {
  const render::Setup& setup = studio.setup();
  const std::vector<gl::Timers::Row> rows = studio.device().timers.rows();
  Json passes = Json::array(), frame;
  for (const io::PassCost& cost : io::pass_costs(rows, measured)) {
    if (cost.name == "frame") {
      frame = io::to_json(cost);
    } else {
      passes.push_back(io::to_json(cost));
    }
  }
  return {{"version", studio::version()},
          {"scene", options.scene},
          {"scene_facts", io::to_json(scene::describe(stage.scene))},
          {"width", options.size.width},
          {"height", options.size.height},
          {"supersample", options.supersample},
          {"technique", params.get_word("technique")},
          {"backend", gl::to_string(studio.context().backend())},
          {"device", io::to_json(studio.device_info())},
          {"camera_eye", json_of(render::position_of(setup.camera))},
          {"sun_to_light", json_of(setup.sun.to_light)},
          {"params", io::to_json(params)},
          {"measured_frames", measured},
          {"timing", studio.device().timers.mode() == gl::Timers::Mode::query ? "gpu timestamps" : "finish"},
          {"frame", frame},
          {"passes", passes},
          {"target_bytes", studio.device().target_bytes()},
          {"peak_resident_kilobytes", peak_resident()}};
}

}  // namespace penumbra::app
