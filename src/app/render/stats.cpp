#include "app/render/stats.h"

#include <sys/resource.h>

#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "app/commands.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

using io::Json;

Json json_of(const glm::vec3& v) { return {v.x, v.y, v.z}; }

// What another renderer needs to draw the same view: directions are unit vectors in world space, lengths in metres.
Json json_of(const render::Camera& camera) {
  const glm::mat3 to_world = glm::transpose(glm::mat3(camera.view));
  Json json{{"eye", json_of(render::position_of(camera))},
            {"forward", json_of(-to_world[2])},
            {"up", json_of(to_world[1])},
            {"near", camera.near}};
  if (camera.orthographic) {
    json["half_height"] = camera.half_height;
  } else {
    json["fov_y_degrees"] = glm::degrees(camera.fov_y);
  }
  return json;
}

// The corners of the plane that the program put under the scene, or null where it put none.
Json ground_of(const session::PreparedScene& prepared) {
  if (!prepared.setup.ground) return nullptr;
  Json corners = Json::array();
  for (const glm::vec3& corner : prepared.scene.meshes.back().primitives.front().positions)
    corners.push_back(json_of(corner));
  return corners;
}

Json json_of(const render::SunLight& sun) {
  return {{"kind", "sun"}, {"to_light", json_of(sun.to_light)}, {"illuminance", json_of(sun.illuminance)}};
}

Json json_of(const render::LampLight& lamp) {
  const bool spot = lamp.axis != glm::vec3(0);
  Json json{{"kind", spot ? "spot" : "point"},
            {"position", json_of(lamp.position)},
            {"radius", lamp.radius},
            {"range", lamp.range},
            {"intensity", json_of(lamp.intensity)}};
  if (!spot) return json;
  json["axis"] = json_of(lamp.axis);
  json["cone_half_angles_degrees"] = {glm::degrees(lamp.inner_cone), glm::degrees(lamp.outer_cone)};
  return json;
}

// All that shine, in the order in which the mask has layers for them.
Json lights_of(const render::Setup& setup) {
  Json lights = Json::array();
  for (const render::FrameLight& light : render::frame_lights(setup))
    lights.push_back(std::visit([](const auto& kind) { return json_of(kind); }, light));
  return lights;
}

// Kilobytes, as the system counts them for this process.
long peak_resident() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

Json stats_of(const RenderOptions& options, const session::PreparedScene& prepared, const ParamSet& params,
              session::RenderSession& session, std::size_t measured) {
  const render::Setup& setup = session.setup();
  const std::vector<gl::Timers::Row> rows = session.device().timers.rows();
  Json passes = Json::array(), frame;
  for (const io::PassCost& cost : io::pass_costs(rows, measured)) {
    if (cost.name == "frame") {
      frame = io::to_json(cost);
    } else {
      passes.push_back(io::to_json(cost));
    }
  }
  return io::document(
      "render", 1,
      {{"version", cli::version()},
       {"scene", options.scene},
       {"scene_facts", io::to_json(scene::describe(prepared.scene))},
       {"width", options.size.width},
       {"height", options.size.height},
       {"supersample", options.supersample},
       {"samples", options.samples},
       {"sample_shadows", options.own_shadows},
       {"aov_samples", options.average_aovs ? "all" : "first"},
       {"technique", params.get_word("technique")},
       {"label", session::technique_label(params)},
       {"backend", gl::to_string(session.context().backend())},
       {"device", io::to_json(session.device_info())},
       {"camera", json_of(setup.camera)},
       {"sun_to_light", setup.sun_shines ? json_of(setup.sun.to_light) : nullptr},
       {"lights", lights_of(setup)},
       {"ground", ground_of(prepared)},
       {"params", io::to_json(params)},
       {"measured_frames", measured},
       {"maps", options.frames && options.frames->count() > 1 && params.get_bool("maps.keep")
                    ? "kept where nothing moved"
                    : "drawn anew in every frame"},
       {"timing", session.device().timers.mode() == gl::Timers::Mode::query ? "gpu timestamps" : "finish"},
       {"frame", frame},
       {"passes", passes},
       {"target_bytes", session.device().target_bytes()},
       {"peak_resident_kilobytes", peak_resident()}});
}

}  // namespace penumbra::app
