#include "compare/drawing.h"

#include <algorithm>
#include <future>
#include <numeric>
#include <utility>

#include "bench/machine.h"
#include "compare/draw.h"
#include "core/log.h"
#include "image/read.h"
#include "io/output_file.h"
#include "scene/gltf.h"
#include "session/techniques.h"

namespace penumbra::compare {

namespace {

std::size_t receiver_count(const ReferenceFrame& frame) {
  return std::accumulate(frame.receivers.begin(), frame.receivers.end(), std::size_t{0});
}

void warn_of_frames_without_receivers(const std::string& scene, const std::vector<ReferenceFrame>& frames) {
  const auto count = std::ranges::count_if(frames, [](const auto& frame) { return receiver_count(frame) == 0; });
  if (count == 0) return;
  const std::string which = frames.size() == 1 ? "the picture" : fmt::format("{} of {} frames", count, frames.size());
  warn("{}: no surface faces a light in {}, so there is nothing to measure", io::quoted(scene), which);
}

session::PreparedScene load(const CompareOptions& options) {
  return load_scene(options, image::image_decoder(cli::limits_of(options.reading)));
}

// Of settings that all contenders share, and of each one's own.
void warn_of_lights(const CompareOptions& options, const cli::LightKinds& shining) {
  auto settings = static_cast<const cli::ShadowOptions&>(options);
  for (const auto& contender : options.contenders)
    settings.assignments.insert(settings.assignments.end(), contender.assignments.begin(), contender.assignments.end());
  cli::warn_without_lights(options, settings, shining);
}

using Timed = session::RenderDevice::Timed;

}  // namespace

// Errors about cameras and memory do not name the file: this adds it.
session::PreparedScene load_scene(const CompareOptions& options, const scene::ImageDecoder& decode) {
  scene::Scene scene = cli::read_scene(options.scene, options.reading, decode);
  check_inputs(options, scene.files);
  session::check_extent(scene, options.time);
  try {
    session::PreparedScene prepared = session::prepare_scene(std::move(scene), options);
    check_memory(options, render::shadowed_lights(prepared.setup).size());
    return prepared;
  } catch (const Error& error) {
    fail("{}: {}", io::quoted(options.scene), error.what());
  }
}

// Starting the driver takes about as long as loading a scene: both are done at once.
Drawing::Drawing(const CompareOptions& options, const ComparedValues& values, std::size_t first_scene)
    : options_(options),
      values_(values),
      prepared_scene_(first_scene),
      truth_(session::truth_options(options, options)),
      techniques_(truth_.registry()) {
  std::future<session::PreparedScene> loading = std::async(std::launch::async, load, of_scene(first_scene));
  context_ = session::open_context(options, options);
  device_.emplace(options, options.no_cost ? Timed::nothing : Timed::passes);
  prepared_.emplace(loading.get());
}

CompareOptions Drawing::of_scene(std::size_t scene) const {
  CompareOptions one = options_;
  one.scene = options_.scenes[scene];
  return one;
}

// Before the reference is drawn, which takes longest.
void Drawing::check_techniques(const Part& part, const session::PreparedScene& prepared) const {
  const CompareOptions options = of_scene(part.scene);
  const render::FrameInputs inputs = CameraPath(options, prepared).frame(options.frames ? options.frames->first : 0);
  for (std::size_t i = part.first; i < part.first + part.count; ++i) {
    try {
      render::check_lights(inputs, techniques_, values_.contenders[i]);
    } catch (const Error& error) {
      fail("{}: {}", io::quoted(options.scene), error.what());
    }
  }
}

void Drawing::check_scenes() const {
  check_techniques({.scene = *prepared_scene_, .count = values_.contenders.size()}, *prepared_);
  cli::LightKinds shining = session::kinds_of_light(*prepared_);
  for (std::size_t i = 0; i < options_.scenes.size(); ++i) {
    if (i == prepared_scene_) continue;
    const session::PreparedScene other =
        load_scene(of_scene(i), [](std::span<const std::byte>, const std::string& name) {
          return scene::Image{.name = name, .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
        });
    check_techniques({.scene = i, .count = values_.contenders.size()}, other);
    const cli::LightKinds kinds = session::kinds_of_light(other);
    shining = {.sun = shining.sun || kinds.sun, .lamps = shining.lamps || kinds.lamps};
  }
  warn_of_lights(options_, shining);
}

ComparedScene Drawing::draw(const Part& part, const std::function<void()>& drawn) {
  const CompareOptions options = of_scene(part.scene);
  if (prepared_scene_ != part.scene) {
    prepared_.reset();
    prepared_.emplace(load(options));
    prepared_scene_ = part.scene;
  }
  check_techniques(part, *prepared_);
  scene::GpuScene scene(device_->device, prepared_->scene);
  const CameraPath path(options, *prepared_);
  const int first = options.frames ? options.frames->first : 0;
  const auto lights = static_cast<int>(path.lights(first).size());
  const DrawnScene common{options, device_->device, techniques_, scene, path, lights, drawn};
  ComparedScene result{
      .path = options.scene, .camera = path.frame(first).camera, .lights = path.lights(first), .target = path.target()};
  const std::vector<ReferenceFrame> reference = draw_reference(common, values_.reference, result.reference);
  warn_of_frames_without_receivers(options.scene, reference);
  result.pixels = reference.back().receivers.size();
  result.receivers = receiver_count(reference.back());
  result.techniques = draw_techniques(common, part, values_.contenders, reference);
  return result;
}

DrawnBy Drawing::drawn_by() const {
  return {.device = io::to_json(device_->info),
          .backend = std::string(gl::to_string(context_->backend())),
          .timed_on = options_.no_cost ? "" : bench::described(bench::machine(), device_->info.renderer)};
}

}  // namespace penumbra::compare
