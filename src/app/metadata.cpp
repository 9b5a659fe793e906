#include "app/metadata.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "session/prepared_scene.h"

namespace penumbra::app {

namespace {

std::string text_of(const glm::vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

}  // namespace

image::Metadata metadata_of(const cli::SceneOptions& options, const render::Setup& setup, const ParamSet& params,
                            int frame) {
  const render::Camera& camera = setup.camera;
  const glm::vec3 forward = -glm::vec3(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  image::Metadata metadata{{"Software", cli::version()},
                           {"penumbra:scene", options.scene},
                           {"penumbra:technique", params.get_word("technique")},
                           {"penumbra:frame", std::to_string(frame)},
                           {"penumbra:time", fmt::format("{}", session::time_of(options, frame))},
                           {"penumbra:supersample", std::to_string(options.supersample)},
                           {"penumbra:camera.eye", text_of(render::position_of(camera))},
                           {"penumbra:camera.forward", text_of(forward)},
                           {"penumbra:lights", std::to_string(render::frame_lights(setup).size())}};
  const std::vector<std::string> names = render::shadowed_names(setup);
  for (std::size_t i = 0; i < names.size(); ++i)
    metadata.emplace_back(fmt::format("penumbra:light.{}", i + 1), names[i]);
  if (setup.sun_shines) {
    metadata.emplace_back("penumbra:sun.to_light", text_of(setup.sun.to_light));
    metadata.emplace_back("penumbra:sun.illuminance", text_of(setup.sun.illuminance));
  }
  if (camera.orthographic) {
    metadata.emplace_back("penumbra:camera.half_height", fmt::format("{}", camera.half_height));
  } else {
    metadata.emplace_back("penumbra:camera.fov", fmt::format("{}", glm::degrees(camera.fov_y)));
  }
  for (const Param& param : params.rows())
    metadata.emplace_back("penumbra:param." + param.name, to_text(params.value(param.name)));
  return metadata;
}

}  // namespace penumbra::app
