#include "viewer/lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace penumbra::viewer {

namespace {

// The place of a node among those of the file's lights.
std::optional<std::size_t> index_of(const LoadedScene& scene, std::size_t node) {
  const auto found = std::ranges::find(scene.light_nodes, node);
  if (found == scene.light_nodes.end()) return {};
  return static_cast<std::size_t>(found - scene.light_nodes.begin());
}

}  // namespace

std::string text_of(const LampName& name) { return fmt::format("{} {}", name.of_file ? "light" : "lamp", name.index); }

std::vector<ShownLamp> shown_lamps(const Panel& panel) {
  std::vector<ShownLamp> shown;
  const LoadedScene& scene = *panel.status.scene;
  const cli::SceneOptions& options = panel.state.document.options;
  const render::Setup setup = session::setup_at(scene.prepared, panel.state.document.seconds());
  for (const render::PlacedLight& placed : setup.lights) {
    const auto* lamp = std::get_if<render::LampLight>(&placed.light);
    if (lamp == nullptr || !placed.node) continue;
    const std::optional<std::size_t> index = index_of(scene, *placed.node);
    // The scene follows the options a frame later.
    if (index && is_chosen(options, *index, scene.lights)) shown.push_back({{.of_file = true, .index = *index}, *lamp});
  }
  const std::vector<render::LampLight>& own = options.lamps;
  for (std::size_t i = 0; i < own.size(); ++i) shown.push_back({{.of_file = false, .index = i}, own[i]});
  return shown;
}

LampName change_lamp(const Panel& panel, const LampName& name, const render::LampLight& light) {
  cli::SceneOptions& options = panel.state.document.options;
  if (!name.of_file) {
    options.lamps[name.index] = light;
    return name;
  }
  choose_light(options, name.index, false, panel.status.scene->lights);
  options.lamps.push_back(light);
  options.lamps.back().number = free_number(std::vector(options.lamps.begin(), options.lamps.end() - 1));
  return {.of_file = false, .index = options.lamps.size() - 1};
}

bool is_chosen(const cli::SceneOptions& options, std::size_t index, const std::vector<std::string>& names) {
  return !options.lights ||
         std::ranges::find(*options.lights, render::text_of_index(names, index)) != options.lights->end();
}

void choose_light(cli::SceneOptions& options, std::size_t index, bool on, const std::vector<std::string>& names) {
  std::vector<std::string> chosen;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == index ? on : is_chosen(options, i, names)) chosen.push_back(render::text_of_index(names, i));
  }
  options.lights = std::move(chosen);
  if (options.lights->size() == names.size()) options.lights.reset();
}

int free_number(const std::vector<render::LampLight>& lamps) {
  int number = 0;
  for (const render::LampLight& lamp : lamps) number = std::max(number, lamp.number + 1);
  return number;
}

}  // namespace penumbra::viewer
