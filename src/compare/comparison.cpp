#include "compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "cli/progress.h"
#include "compare/draw.h"
#include "core/log.h"
#include "image/read.h"
#include "io/output_file.h"
#include "render/renderer.h"
#include "scene/gltf.h"
#include "session/prepared_scene.h"
#include "session/render_device.h"
#include "session/techniques.h"
#include "truth/technique.h"

namespace penumbra::compare {

namespace {

// Errors about cameras do not name the file: this adds it.
session::PreparedScene load_scene(const CompareOptions& options, const scene::ImageDecoder& decode) {
  scene::Scene scene = cli::read_scene(options.scene, options.reading, decode);
  check_inputs(options, scene.files);
  try {
    return session::prepare_scene(std::move(scene), options);
  } catch (const Error& error) {
    fail("{}: {}", io::quoted(options.scene), error.what());
  }
}

// Throws for a camera that the scene lacks. Reads the scene without decoding its images.
void check_camera(const CompareOptions& options) {
  load_scene(options, [](std::span<const std::byte>, const std::string& name) {
    return scene::Image{.name = name, .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
  });
}

std::size_t receiver_count(const ReferenceFrame& frame) {
  return std::accumulate(frame.receivers.begin(), frame.receivers.end(), std::size_t{0});
}

void warn_of_frames_without_receivers(const std::string& scene, const std::vector<ReferenceFrame>& frames) {
  const auto count = std::ranges::count_if(frames, [](const auto& frame) { return receiver_count(frame) == 0; });
  if (count == 0) return;
  const std::string which = frames.size() == 1 ? "the picture" : fmt::format("{} of {} frames", count, frames.size());
  warn("{}: no surface faces a light in {}, so there is nothing to measure", io::quoted(scene), which);
}

ComparedScene compare_scene(const CompareOptions& options, const session::PreparedScene& prepared, gl::Device& device,
                            const shadow::Registry& techniques, const ComparedValues& values,
                            const std::function<void()>& drawn) {
  scene::GpuScene scene(device, prepared.scene);
  const CameraPath path(options, prepared);
  const int first = options.frames ? options.frames->first : 0;
  const auto lights = static_cast<int>(path.lights(first).size());
  const DrawnScene common{options, device, techniques, scene, path, lights, drawn};
  ComparedScene result{
      .path = options.scene, .camera = path.frame(first).camera, .lights = path.lights(first), .target = path.target()};
  const std::vector<ReferenceFrame> reference = draw_reference(common, values.reference, result.reference);
  warn_of_frames_without_receivers(options.scene, reference);
  result.pixels = reference.back().receivers.size();
  result.receivers = receiver_count(reference.back());
  result.techniques = draw_techniques(common, values.contenders, reference);
  return result;
}

}  // namespace

Angles angles_of(const glm::vec3& to_light) {
  const glm::dvec3 v(to_light);
  return {.azimuth = glm::degrees(std::atan2(v.x, v.z)),
          .elevation = glm::degrees(std::atan2(v.y, std::hypot(v.x, v.z)))};
}

Comparison compare(const CompareOptions& options, const ComparedValues& values) {
  Comparison comparison{.reference_params = values.reference};

  // Starting the driver takes about as long as loading a scene: do both at once.
  std::vector<CompareOptions> of_scenes(options.scenes.size(), options);
  for (std::size_t i = 0; i < of_scenes.size(); ++i) of_scenes[i].scene = options.scenes[i];
  const auto load = [](const CompareOptions& one) {
    return load_scene(one, image::image_decoder(cli::limits_of(one.reading)));
  };
  std::future<session::PreparedScene> loading = std::async(std::launch::async, load, std::cref(of_scenes.front()));
  const std::unique_ptr<gl::Context> context = session::open_context(options, options);
  const truth::TruthTechnique truth(session::truth_options(options, options));
  const shadow::Registry techniques = truth.registry();
  session::RenderDevice device(options);
  comparison.device = device.info;
  comparison.backend = gl::to_string(context->backend());
  std::optional<session::PreparedScene> prepared = loading.get();
  for (std::size_t i = 1; i < of_scenes.size(); ++i) check_camera(of_scenes[i]);  // before minutes of drawing

  const std::size_t drawings = options.scenes.size() * (values.contenders.size() + 1);
  const int frames = options.frames ? options.frames->count() : 1;
  cli::Progress progress("picture", static_cast<int>(drawings) * frames, !options.quiet);
  const std::function<void()> drawn = [&progress] { progress.step(); };
  for (const CompareOptions& one : of_scenes) {
    if (!prepared) prepared = load(one);
    comparison.scenes.push_back(compare_scene(one, *prepared, device.device, techniques, values, drawn));
    prepared.reset();
  }
  return comparison;
}

}  // namespace penumbra::compare
