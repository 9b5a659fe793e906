#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

#include "app/commands.h"
#include "cli/reading.h"
#include "cli/text.h"
#include "core/error.h"
#include "image/read.h"
#include "io/report.h"
#include "scene/gltf.h"
#include "scene/scene_info.h"

namespace penumbra::app {

namespace {

std::string name_of(const std::string& name) { return name.empty() ? "(unnamed)" : cli::printable(name); }

void print_counts(const scene::SceneInfo& info) {
  const auto row = [](const char* what, const std::string& value) { fmt::print("{:<12} {}\n", what, value); };
  row("scene", name_of(info.name));
  row("nodes", fmt::format("{}, {} of them drawn", info.nodes, info.drawn_nodes));
  row("meshes", fmt::format("{} of {} primitives, {} vertices, {} morph targets", info.meshes, info.primitives,
                            info.vertices, info.morph_targets));
  row("drawn", fmt::format("{} triangles, {} lines, {} points, {} instances", info.triangles, info.lines, info.points,
                           info.instances));
  row("skins", fmt::format("{} of {} joints", info.skins, info.joints));
  row("textures", fmt::format("{} of {} images, {} decoded", info.textures, info.images,
                              cli::bytes_text(static_cast<double>(info.image_bytes))));
  row("on the GPU",
      fmt::format("{} of vertices, {} of textures", cli::bytes_text(static_cast<double>(info.gpu_vertex_bytes)),
                  cli::bytes_text(static_cast<double>(info.gpu_texture_bytes))));
  if (info.bounds.empty) {
    row("bounds", "nothing drawn");
    return;
  }
  const auto box = [](const scene::Bounds& bounds) {
    const glm::vec3 &low = bounds.min, &high = bounds.max, size = bounds.extent();
    return fmt::format("{:g} {:g} {:g} to {:g} {:g} {:g} m ({:g} x {:g} x {:g} m)", low.x, low.y, low.z, high.x, high.y,
                       high.z, size.x, size.y, size.z);
  };
  row("bounds", box(info.bounds));
  if (info.animated_bounds) row("animated", box(*info.animated_bounds) + ", while its animations run");
}

void print_materials(const scene::SceneInfo& info) {
  fmt::print("\nmaterials    {}\n", info.materials.size());
  static constexpr const char* alpha[] = {"", ", alpha mask", ", alpha blend"};
  for (const scene::MaterialInfo& material : info.materials) {
    fmt::print("  {}{}{}{}", name_of(material.name), alpha[static_cast<int>(material.alpha_mode)],
               material.double_sided ? ", double-sided" : "", material.unlit ? ", unlit" : "");
    fmt::print("{}{}\n", material.textures.empty() ? "" : ": ", fmt::join(material.textures, ", "));
  }
}

void print_light(const scene::LightInfo& light) {
  fmt::print("  {}, {}, {:g} {}", name_of(light.name), light.kind, light.intensity, light.unit);
  if (light.cones) fmt::print(", cones {:g} and {:g}°", light.cones->x, light.cones->y);
  if (light.range > 0) fmt::print(", range {:g} m", light.range);
  if (light.radius) fmt::print(", radius {:g} m", *light.radius);
  if (light.place) fmt::print(", at {:g} {:g} {:g}", light.place->x, light.place->y, light.place->z);
  fmt::print("\n");
}

void print_parts(const scene::SceneInfo& info) {
  fmt::print("\nlights       {}\n", info.lights.size());
  for (const scene::LightInfo& light : info.lights) print_light(light);
  fmt::print("\ncameras      {}\n", info.cameras.size());
  for (const scene::CameraInfo& camera : info.cameras) fmt::print("  {}, {}\n", name_of(camera.name), camera.kind);
  fmt::print("\nanimations   {}\n", info.animations.size());
  for (const scene::AnimationInfo& animation : info.animations)
    fmt::print("  {}, {:g} s, {} channels{}\n", name_of(animation.name), animation.duration, animation.channels,
               animation.played ? "" : ", not played: an earlier one moves the same nodes");
  fmt::print("\nextensions   {}\n", info.extensions.size());
  for (const std::string& extension : info.extensions) {
    const bool supported =
        std::ranges::find(info.unsupported_extensions, extension) == info.unsupported_extensions.end();
    fmt::print("  {}{}\n", cli::printable(extension), supported ? "" : ", not supported: drawn without it");
  }
}

}  // namespace

int run_info(const Arguments& arguments) {
  CLI::App app("Print what is in a scene", "penumbra info");
  std::string path;
  cli::ReadingOptions reading{.progress = true};
  bool json = false;
  app.add_option("SCENE", path, "glTF file, .gltf or .glb")->required()->type_name("");
  app.add_flag("--json", json, "Print JSON")->disable_flag_override();
  cli::add_reading_options(app, reading);
  if (!cli::parse(app, arguments)) return 0;
  const scene::Scene scene = cli::read_scene(path, reading, image::image_decoder(cli::limits_of(reading)));
  scene::SceneInfo info = scene::describe(scene);
  info.animated_bounds = scene::animated_bounds(scene);
  if (json) {
    fmt::print("{}", io::text_of(io::document("info", 1, io::to_json(info))));
    return 0;
  }
  print_counts(info);
  print_materials(info);
  print_parts(info);
  return 0;
}

}  // namespace penumbra::app
