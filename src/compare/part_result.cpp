#include "compare/part_result.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "plan/json_reader.h"

namespace penumbra::compare {

namespace {

using io::Json;
using plan::any_number_in;
using plan::array_in;
using plan::member_of;
using plan::whole_in;

// The figures of a technique by name, for writing and for reading.
struct FigureName {
  const char* name;
  double ComparedFigures::*value;
};
constexpr FigureName figure_names[] = {{"rmse", &ComparedFigures::rmse},
                                       {"psnr", &ComparedFigures::psnr},
                                       {"rmse_penumbra", &ComparedFigures::rmse_penumbra},
                                       {"psnr_penumbra", &ComparedFigures::psnr_penumbra},
                                       {"bias", &ComparedFigures::bias},
                                       {"max", &ComparedFigures::max},
                                       {"p99", &ComparedFigures::p99},
                                       {"ssim", &ComparedFigures::ssim},
                                       {"flip", &ComparedFigures::flip},
                                       {"width_error", &ComparedFigures::width_error},
                                       {"width_lost", &ComparedFigures::width_lost}};

Json number(double value) { return io::json_number(value); }

Json list_of(const float* values, int count) {
  Json list = Json::array();
  for (int i = 0; i < count; ++i) list.push_back(number(static_cast<double>(values[i])));
  return list;
}

float float_in(const Json& json, const char* name) { return static_cast<float>(any_number_in(json, name)); }

void read_list(const Json& json, const char* name, float* values, std::size_t count) {
  const Json& list = array_in(json, name);
  if (list.size() != count) fail("\"{}\" has not {} numbers", name, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!list[i].is_number()) fail("\"{}\" has something that is no number", name);
    values[i] = list[i].get<float>();
  }
}

Json json_of(const render::Camera& camera) {
  return {{"view", list_of(&camera.view[0][0], 16)},
          {"orthographic", camera.orthographic},
          {"fov_y", number(camera.fov_y)},
          {"half_height", number(camera.half_height)},
          {"near", number(camera.near)},
          {"far", number(camera.far)}};
}

render::Camera camera_from(const Json& json) {
  render::Camera camera;
  read_list(json, "view", &camera.view[0][0], 16);
  camera.orthographic = member_of(json, "orthographic") == true;
  camera.fov_y = float_in(json, "fov_y");
  camera.half_height = float_in(json, "half_height");
  camera.near = float_in(json, "near");
  camera.far = float_in(json, "far");
  return camera;
}

Json json_of(const render::SunLight& sun) {
  return {{"to_light", list_of(&sun.to_light[0], 3)}, {"illuminance", list_of(&sun.illuminance[0], 3)}};
}

Json json_of(const render::LampLight& lamp) {
  return {{"position", list_of(&lamp.position[0], 3)},  {"radius", number(lamp.radius)},
          {"axis", list_of(&lamp.axis[0], 3)},          {"inner_cone", number(lamp.inner_cone)},
          {"outer_cone", number(lamp.outer_cone)},      {"range", number(lamp.range)},
          {"intensity", list_of(&lamp.intensity[0], 3)}};
}

render::FrameLight light_from(const Json& json) {
  if (json.is_object() && json.contains("to_light")) {
    render::SunLight sun;
    read_list(json, "to_light", &sun.to_light[0], 3);
    read_list(json, "illuminance", &sun.illuminance[0], 3);
    return sun;
  }
  render::LampLight lamp;
  read_list(json, "position", &lamp.position[0], 3);
  lamp.radius = float_in(json, "radius");
  read_list(json, "axis", &lamp.axis[0], 3);
  lamp.inner_cone = float_in(json, "inner_cone");
  lamp.outer_cone = float_in(json, "outer_cone");
  lamp.range = float_in(json, "range");
  read_list(json, "intensity", &lamp.intensity[0], 3);
  return lamp;
}

std::vector<render::FrameLight> lights_from(const Json& list) {
  std::vector<render::FrameLight> lights;
  for (const Json& light : list) lights.push_back(light_from(light));
  if (lights.empty() || lights.size() > render::max_shadowed_lights)
    fail("a result has {} lights that cast shadows", lights.size());
  return lights;
}

// What reports show of a sequence.
Json json_of(const metrics::SequenceFigures& sequence) {
  Json recoveries = Json::array();
  for (const metrics::Recovery& recovery : sequence.recoveries) {
    recoveries.push_back({{"frame", recovery.frame},
                          {"frames", recovery.frames ? Json(*recovery.frames) : Json()},
                          {"static_error", number(recovery.static_error)}});
  }
  return {{"flicker", number(sequence.flicker)}, {"ghost", number(sequence.ghost)}, {"recoveries", recoveries}};
}

metrics::SequenceFigures sequence_from(const Json& json) {
  metrics::SequenceFigures sequence;
  sequence.flicker = any_number_in(json, "flicker");
  sequence.ghost = any_number_in(json, "ghost");
  for (const Json& one : array_in(json, "recoveries")) {
    metrics::Recovery recovery{.frame = whole_in(one, "frame", SIZE_MAX)};
    if (!member_of(one, "frames").is_null()) recovery.frames = whole_in(one, "frames", SIZE_MAX);
    recovery.static_error = any_number_in(one, "static_error");
    sequence.recoveries.push_back(recovery);
  }
  return sequence;
}

Json json_of(const ComparedTechnique& technique) {
  Json figures = Json::object();
  for (const auto& [name, value] : figure_names) figures[name] = number(technique.figures.*value);
  const std::optional<metrics::SequenceFigures>& sequence = technique.figures.sequence;
  figures["sequence"] = sequence ? json_of(*sequence) : Json();
  figures["not_finite"] = technique.figures.not_finite;
  return {{"shadow_bytes", technique.shadow_bytes},
          {"cost",
           {{"median", number(technique.cost.median)},
            {"min", number(technique.cost.min)},
            {"max", number(technique.cost.max)},
            {"frames", technique.cost.frames}}},
          {"figures", figures}};
}

ComparedTechnique technique_from(const Json& json) {
  ComparedTechnique technique;
  technique.shadow_bytes = whole_in(json, "shadow_bytes", SIZE_MAX);
  const Json& cost = member_of(json, "cost");
  technique.cost = {.median = any_number_in(cost, "median"),
                    .min = any_number_in(cost, "min"),
                    .max = any_number_in(cost, "max"),
                    .frames = whole_in(cost, "frames", SIZE_MAX)};
  const Json& figures = member_of(json, "figures");
  for (const auto& [name, value] : figure_names) technique.figures.*value = any_number_in(figures, name);
  if (const Json& sequence = member_of(figures, "sequence"); !sequence.is_null())
    technique.figures.sequence = sequence_from(sequence);
  technique.figures.not_finite = whole_in(figures, "not_finite", SIZE_MAX);
  return technique;
}

void add_pictures(plan::Result& result, const std::string& begin, const ComparedPictures& pictures) {
  if (!pictures.display.png) return;
  result.files.push_back({begin + "display.png", *pictures.display.png});
  result.files.push_back({begin + "visibility.png", *pictures.visibility.png});
  if (!pictures.error.empty()) result.files.push_back({begin + "error.f32z", pictures.error});
}

report::EncodedPicture picture_from(const plan::Result& result, const std::string& name, const cli::Size& size) {
  return report::make_picture(result.file(name).bytes, size.width, size.height);
}

// The shadows of all lights are one below the other.
ComparedPictures pictures_from(const plan::Result& result, const std::string& begin, const cli::Size& size,
                               std::size_t lights) {
  const cli::Size of_masks{.width = size.width, .height = size.height * static_cast<int>(lights)};
  return {.display = picture_from(result, begin + "display.png", size),
          .visibility = picture_from(result, begin + "visibility.png", of_masks),
          .error = {}};
}

std::string begin_of(std::size_t technique) { return fmt::format("technique_{}_", technique); }

}  // namespace

plan::Result result_of(const ComparedScene& drawn, const DrawnBy& by) {
  Json lights = Json::array(), techniques = Json::array();
  for (const render::FrameLight& light : drawn.lights)
    lights.push_back(std::visit([](const auto& kind) { return json_of(kind); }, light));
  for (const ComparedTechnique& technique : drawn.techniques) techniques.push_back(json_of(technique));
  plan::Result result{.data = {{"backend", by.backend},
                               {"device", by.device},
                               {"timed_on", by.timed_on},
                               {"pixels", drawn.pixels},
                               {"receivers", drawn.receivers},
                               {"camera", json_of(drawn.camera)},
                               {"target", list_of(&drawn.target[0], 3)},
                               {"lights", lights},
                               {"techniques", techniques}},
                      .files = {}};
  add_pictures(result, "reference_", drawn.reference);
  for (std::size_t i = 0; i < drawn.techniques.size(); ++i)
    add_pictures(result, begin_of(i), drawn.techniques[i].pictures);
  return result;
}

KeptPart kept_part(const plan::Result& result, const CompareOptions& options, const ComparedValues& values,
                   const Part& part) {
  const Json& data = result.data;
  KeptPart kept{.scene = {.path = options.scenes[part.scene],
                          .receivers = whole_in(data, "receivers", SIZE_MAX),
                          .pixels = whole_in(data, "pixels", SIZE_MAX),
                          .camera = camera_from(member_of(data, "camera")),
                          .lights = lights_from(array_in(data, "lights"))},
                .by = {.device = member_of(data, "device"),
                       .backend = plan::text_in(data, "backend"),
                       .timed_on = plan::text_in(data, "timed_on")}};
  plan::text_in(kept.by.device, "renderer");
  read_list(data, "target", &kept.scene.target[0], 3);
  const Json& techniques = array_in(data, "techniques");
  if (techniques.size() != part.count) fail("a result has {} techniques instead of {}", techniques.size(), part.count);
  const std::size_t lights = kept.scene.lights.size();
  if (part.first == 0) kept.scene.reference = pictures_from(result, "reference_", options.size, lights);
  for (std::size_t i = 0; i < part.count; ++i) {
    ComparedTechnique technique = technique_from(techniques[i]);
    technique.label = options.contenders[part.first + i].label;
    technique.params = &values.contenders[part.first + i];
    technique.pictures = pictures_from(result, begin_of(i), options.size, lights);
    technique.pictures.error = result.file(begin_of(i) + "error.f32z").bytes;
    kept.scene.techniques.push_back(std::move(technique));
  }
  return kept;
}

}  // namespace penumbra::compare
