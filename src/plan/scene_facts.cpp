#include "plan/scene_facts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>
#include <variant>

#include "core/error.h"
#include "io/output_file.h"
#include "scene/drawn.h"
#include "scene/scene_info.h"

namespace penumbra::plan {

namespace {

namespace fs = std::filesystem;
using io::Json;

constexpr double mebibyte = 1024.0 * 1024.0;

Json json_of(const glm::vec3& v) {
  Json list = Json::array();
  for (int i = 0; i < 3; ++i) list.push_back(io::to_json(ParamValue(v[i])));
  return list;
}

double rounded_degrees(double degrees) { return std::round(degrees * 1e4) / 1e4; }

Json json_of(const render::SunLight& sun) {
  const render::Angles angles = render::angles_of(sun.to_light);
  return {{"azimuth_degrees", rounded_degrees(angles.azimuth)},
          {"elevation_degrees", rounded_degrees(angles.elevation)}};
}

Json json_of(const render::LampLight& lamp) { return {{"position", json_of(lamp.position)}}; }

Json view_of(const render::Setup& setup) {
  const render::Camera& camera = setup.camera;
  const glm::vec3 forward = -glm::vec3(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  const std::vector<render::FrameLight> lights = render::frame_lights(setup);
  const bool is_sun = std::holds_alternative<render::SunLight>(lights.front());
  return {{"camera", {{"eye", json_of(render::position_of(camera))}, {"forward", json_of(forward)}}},
          {is_sun ? "sun" : "lamp", std::visit([](const auto& light) { return json_of(light); }, lights.front())}};
}

// Links to folders count as those, but not one that leads back to a folder in which it is: `outer`, canonical.
void find_files(std::vector<fs::path>& found, const fs::path& folder, std::vector<fs::path> outer = {}) {
  const fs::path own = fs::canonical(folder);
  if (std::ranges::find(outer, own) != outer.end()) return;
  outer.push_back(own);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code leads_nowhere;
    if (entry.is_regular_file(leads_nowhere)) found.push_back(entry.path());
    if (entry.is_directory(leads_nowhere)) find_files(found, entry.path(), outer);
  }
}

// Sample points of a technique that every pixel reads, or rays.
double points_of(const ParamSet& params, const shadow::Registry& registry) {
  const std::string& name = params.get_word("technique");
  if (name == "truth") return params.get_int("truth.samples");
  double points = 0;
  for (const shadow::SampleSet& set : registry.find(name).samples) points += params.get_int(set.count_parameter);
  return points;
}

}  // namespace

scene::ImageDecoder ImageSizes::decoder() {
  return {[this](std::span<const std::byte> encoded, const std::string& name) {
            bytes_ += static_cast<double>(probe_(scene::reader_of(encoded)).decoded_bytes);
            return scene::Image{.name = name, .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
          },
          probe_};
}

std::vector<SceneFile> shaders_of(const cli::DeviceOptions& device) {
  const fs::path folder = device.glsl;
  if (folder.empty()) return {};
  std::vector<fs::path> shaders;
  find_files(shaders, folder);
  // A shader that is put there later would change the pictures, and nothing in the plan would tell.
  if (shaders.empty()) fail("--glsl {}: there is no shader to plan with", io::quoted(folder));
  std::ranges::sort(shaders);
  std::vector<SceneFile> files;
  for (const fs::path& shader : shaders)
    files.push_back({.path = shader, .shader = shader.lexically_relative(folder).generic_string()});
  return files;
}

SceneFacts facts_of(const session::PreparedScene& prepared, const cli::DeviceOptions& device,
                    const ImageSizes& images) {
  const scene::Scene& scene = prepared.scene;
  SceneFacts facts{.view = view_of(prepared.setup), .files = {}};
  for (const fs::path& file : scene.files) facts.files.push_back({.path = file});
  std::ranges::move(shaders_of(device), std::back_inserter(facts.files));
  facts.triangles = static_cast<double>(scene::count_drawn(scene).triangles);
  facts.lights = static_cast<double>(render::shadowed_lights(prepared.setup).size());
  for (const SceneFile& file : facts.files) {
    std::error_code unread;
    const std::uintmax_t bytes = fs::file_size(file.path, unread);
    if (!unread) facts.bytes += static_cast<double>(bytes);
  }
  facts.decoded_mib = (images.bytes() + static_cast<double>(scene::describe(scene).gpu_vertex_bytes)) / mebibyte;
  return facts;
}

Estimate estimate_of(const SceneFacts& facts, const cli::Size& pixels, std::span<const Drawn> drawn,
                     const shadow::Registry& registry, double kept_bytes) {
  // Seconds: of a start; of reading a MiB; of a frame's triangle; of a pixel; of a sample point or a ray of a pixel; of
  // a further sample of a pixel.
  constexpr double start = 1, per_mib = 0.02, per_triangle = 1e-6, per_pixel = 1e-6, per_tap = 2e-8, per_ray = 1e-7;
  constexpr double per_sample = 1e-7;
  // MiB: of the program with its driver; copies of the scene (read, uploaded, traced); bytes of a pixel's targets, and
  // of those of its further samples.
  constexpr double program = 250, scene_copies = 3, per_target_pixel = 110, per_sampled_pixel = 68;
  constexpr double tracer = 100, per_traced_triangle = 300;  // MiB of a ray tracer, and bytes of a triangle in it
  constexpr double per_texel = 6;                            // bytes of a map and its pyramids
  const double count = 1.0 * pixels.width * pixels.height;
  Estimate estimate{.seconds = start + per_mib * facts.bytes / mebibyte};
  double maps = 0, traced = 0, sampled = 0;
  for (const Drawn& one : drawn) {
    const bool is_traced = one.params->get_word("technique") == "truth";
    const double points = points_of(*one.params, registry);
    const int further = one.samples - 1, masks = one.own_shadows ? one.samples : 1;
    estimate.seconds +=
        one.frames *
        (facts.triangles * (facts.lights * masks + further) * per_triangle +
         count * (per_pixel + further * per_sample + facts.lights * masks * points * (is_traced ? per_ray : per_tap)));
    if (further > 0) sampled = count * per_sampled_pixel;
    if (is_traced) traced = tracer * mebibyte + facts.triangles * per_traced_triangle;
    const double side = one.params->get_int("cascades.size");
    // Shadows of further samples have maps of their own.
    const int sets = masks > 1 ? 2 : 1;
    maps += is_traced ? 0 : sets * facts.lights * side * side * one.params->get_int("cascades.count") * per_texel;
  }
  const double targets = count * per_target_pixel * static_cast<double>(drawn.size());
  estimate.memory_mib =
      program + scene_copies * facts.decoded_mib + (maps + traced + targets + sampled + count * kept_bytes) / mebibyte;
  const auto rounded = [](double value) { return std::ceil(value * 10) / 10; };
  return {.seconds = rounded(estimate.seconds), .memory_mib = rounded(estimate.memory_mib)};
}

}  // namespace penumbra::plan
