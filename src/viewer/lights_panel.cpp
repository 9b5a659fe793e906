#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>

#include "cli/lamp.h"
#include "core/error.h"
#include "core/log.h"
#include "scene/pose.h"
#include "viewer/fields.h"
#include "viewer/lamps.h"

namespace penumbra::viewer {

namespace {

constexpr auto brightest_lamp = static_cast<float>(cli::brightest_lamp);

// The lights that the options choose; nothing where none would shine.
std::optional<render::Setup> lit_by(const Panel& panel, const cli::SceneOptions& options) {
  const scene::Scene& scene = panel.status.scene->prepared.scene;
  // What is chosen in the end is told then.
  const LogSink nobody = [](LogLevel, std::string_view) {};
  const ThreadLogSink quiet(nobody);
  try {
    return render::choose_setup(scene, scene::pose_at(scene, options.time),
                                {.lights = options.lights,
                                 .no_sun = options.no_sun,
                                 .own_sun = options.sun.has_value(),
                                 .lamps = options.lamps});
  } catch (const Error&) {
    return {};
  }
}

bool has_sun_of_file(const Panel& panel, cli::SceneOptions options) {
  options.sun.reset();
  const std::optional<render::Setup> setup = lit_by(panel, options);
  return setup && setup->sun_node.has_value();
}

// Takes other lights and returns true, unless nothing would light the scene. A direction that the user gave to the
// file's sun goes with it: alone it would call for a sun that the file does not have.
bool take_lights(const Panel& panel, cli::SceneOptions wanted) {
  cli::SceneOptions& options = panel.state.document.options;
  if (has_sun_of_file(panel, options) && !has_sun_of_file(panel, wanted)) wanted.sun.reset();
  if (lit_by(panel, wanted)) {
    options = std::move(wanted);
    return true;
  }
  tell(panel.state, "the last light stays on: without it nothing would light the scene", ImGui::GetTime());
  return false;
}

// Brightness and hue apart: intensity is their product. The colour's strongest channel is always 1: else what the user
// takes from it would be taken from the intensity, once more in each frame in which the mouse is held.
void emission(const Panel& panel, render::LampLight& lamp) {
  float candela = std::max({lamp.intensity.r, lamp.intensity.g, lamp.intensity.b, 1e-3f});
  glm::vec3 color = lamp.intensity / candela;
  row("intensity", "Candela, of the strongest of red, green and blue.");
  const bool brighter =
      slider(panel.widgets, "lamp intensity", candela, 0.1f, 1e8f, "%.4g cd", ImGuiSliderFlags_Logarithmic);
  row("colour", "Linear: hue and saturation, whose strongest channel is always 1.");
  glm::vec3 wanted = color;
  const bool other = color_field(panel.widgets, "lamp colour", wanted);
  const float strongest = std::max({wanted.r, wanted.g, wanted.b});
  if (other && strongest > 0) color = wanted / strongest;
  if (brighter || other) lamp.intensity = glm::clamp(candela * color, 0.0f, brightest_lamp);
}

void spot(const Panel& panel, render::LampLight& lamp) {
  bool is_spot = lamp.axis != glm::vec3(0);
  row("spot", "Shines within a cone, not in all directions.");
  if (ImGui::Checkbox("##spot", &is_spot)) {
    render::LampLight& last = panel.state.last_spot;
    if (!is_spot) last = lamp;
    lamp.axis = is_spot ? last.axis : glm::vec3(0);
    lamp.outer_cone = last.outer_cone;
    lamp.inner_cone = last.inner_cone;
  }
  panel.widgets.mark("lamp spot");
  if (!is_spot) return;
  row("axis", "Where it shines.");
  glm::vec3 axis = lamp.axis;
  if (drag_vector(panel.widgets, "lamp axis", axis, 1, 2) && glm::length(axis) > 1e-3f)
    lamp.axis = glm::normalize(axis);
  row("cone", "From its axis to its rim.");
  float degrees = glm::degrees(lamp.outer_cone);
  if (slider(panel.widgets, "lamp cone", degrees, 1, 90, "%.1f°")) {
    const float inner = lamp.inner_cone / lamp.outer_cone;
    lamp.outer_cone = std::min(glm::radians(degrees), 1.5707f);
    lamp.inner_cone = inner * lamp.outer_cone;
  }
}

void lamp_rows(const Panel& panel, render::LampLight& lamp) {
  begin_rows("lamp");
  row("place", "Metres. The left mouse button drags the lamp's ring in the picture.");
  drag_vector(panel.widgets, "lamp place", lamp.position, 1e6f, 2);
  row("radius", "Of the sphere that emits light: the larger, the softer its shadows.");
  slider(panel.widgets, "lamp radius", lamp.radius, 0.001f, 2, "%.3g m", ImGuiSliderFlags_Logarithmic);
  emission(panel, lamp);
  spot(panel, lamp);
  end_rows();
}

// A lamp's entry in the list, which shows or hides its properties.
void entry(const Panel& panel, const LampName& name, const std::string& label) {
  std::optional<LampName>& open = panel.state.lamp;
  const bool is_open = open && *open == name;
  const std::string shown = shortened(label, ImGui::GetContentRegionAvail().x);
  if (ImGui::Selectable(fmt::format("{}##{}", shown, text_of(name)).c_str(), is_open))
    open = is_open ? std::nullopt : std::optional(name);
  if (shown != label) tooltip(label);
  panel.widgets.mark("entry of " + text_of(name));
}

// Whether light `index` of the file is a sun.
bool is_sun(const LoadedScene& loaded, std::size_t index) {
  const scene::Scene& scene = loaded.prepared.scene;
  const int light = scene.nodes[loaded.light_nodes[index]].light;
  return scene.lights[static_cast<std::size_t>(light)].kind == scene::LightKind::directional;
}

bool has_suns(const LoadedScene& loaded) {
  for (std::size_t i = 0; i < loaded.lights.size(); ++i) {
    if (is_sun(loaded, i)) return true;
  }
  return false;
}

// A sun of the file is turned off by its own entry.
void no_sun_box(const Panel& panel) {
  const cli::SceneOptions& options = panel.state.document.options;
  const render::Setup& setup = panel.status.scene->prepared.setup;
  const bool has_entry = has_suns(*panel.status.scene) && (!setup.sun_shines || setup.sun_node);
  if (!options.no_sun && has_entry) return;
  bool no_sun = options.no_sun;
  if (ImGui::Checkbox("No sun", &no_sun)) {
    cli::SceneOptions wanted = options;
    wanted.no_sun = no_sun;
    if (no_sun) wanted.sun.reset();
    take_lights(panel, std::move(wanted));
  }
  panel.widgets.mark("no sun");
  tooltip("Spots and point lamps alone light the scene (--no-sun)");
}

void lights_of_the_file(const Panel& panel, const std::vector<ShownLamp>& lamps) {
  const cli::SceneOptions& options = panel.state.document.options;
  const std::vector<std::string>& names = panel.status.scene->lights;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const LampName name{.of_file = true, .index = i};
    const bool is_lamp = std::ranges::find(lamps, name, &ShownLamp::name) != lamps.end();
    const bool put_out = options.no_sun && is_sun(*panel.status.scene, i);
    bool on = is_chosen(options, i, names) && !put_out;
    // A lamp's name opens its properties, beside the box that turns it off.
    const float room = ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeightWithSpacing();
    const std::string label = is_lamp ? std::string() : shortened(names[i], room);
    ImGui::BeginDisabled(put_out);
    if (ImGui::Checkbox(fmt::format("{}##light{}", label, i).c_str(), &on)) {
      cli::SceneOptions wanted = options;
      choose_light(wanted, i, on, names);
      take_lights(panel, std::move(wanted));
    }
    ImGui::EndDisabled();
    panel.widgets.mark(fmt::format("light={}", i));
    if (put_out) {
      tooltip("\"No sun\" puts it out");
    } else if (!is_lamp && label != names[i]) {
      tooltip(names[i]);
    }
    if (!is_lamp) continue;
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);  // where the box has its own label
    entry(panel, name, names[i]);
  }
}

void remove_button(const Panel& panel, std::size_t index) {
  if (ImGui::Button("Remove lamp")) {
    cli::SceneOptions wanted = panel.state.document.options;
    wanted.lamps.erase(wanted.lamps.begin() + static_cast<std::ptrdiff_t>(index));
    if (take_lights(panel, std::move(wanted))) panel.state.lamp.reset();
  }
  panel.widgets.mark("remove lamp");
}

// All lamps, of which one is open for changes.
void lamp_list(const Panel& panel) {
  UiState& state = panel.state;
  const std::vector<ShownLamp> lamps = shown_lamps(panel);
  lights_of_the_file(panel, lamps);
  for (const ShownLamp& lamp : lamps) {
    if (!lamp.name.of_file) entry(panel, lamp.name, fmt::format("lamp {}", lamp.light.number));
  }
  const auto open =
      std::ranges::find_if(lamps, [&](const ShownLamp& lamp) { return state.lamp && lamp.name == *state.lamp; });
  if (open == lamps.end()) return;
  if (open->name.of_file) {
    ImGui::TextWrapped("A light of the scene: with the first change, a lamp of your own takes its place.");
  } else {
    remove_button(panel, open->name.index);
  }
  if (!state.lamp) return;
  render::LampLight changed = open->light;
  lamp_rows(panel, changed);
  if (changed != open->light) state.lamp = change_lamp(panel, open->name, changed);
}

}  // namespace

void lights_panel(const Panel& panel) {
  UiState& state = panel.state;
  cli::SceneOptions& options = state.document.options;
  no_sun_box(panel);
  if (ImGui::Button("Add lamp")) {
    // Between the eye and what it looks at, a little higher.
    const CameraRig rig = present_rig(state.document, panel.status.scene->prepared);
    const glm::vec3 place = glm::mix(rig.target, rig.eye, 0.3f) + glm::vec3(0, 0.2f * rig.distance(), 0);
    const float away = glm::length(place - rig.target);
    // As bright there as the sun, if it shines, so that it can be seen; else as in a room.
    const render::Setup& setup = panel.status.scene->prepared.setup;
    const glm::vec3 lux = setup.sun_shines ? setup.sun.illuminance : glm::vec3(100);
    // A sun that only stands in for missing lights would go out.
    if (setup.sun_shines && !setup.sun_node && !options.sun) place_sun(state.document, setup.sun.to_light);
    options.lamps.push_back({.position = place,
                             .radius = std::min(0.02f * away, cli::largest_lamp),
                             .intensity = glm::min(lux * (away * away), brightest_lamp),
                             .number = free_number(options.lamps)});
    state.lamp = LampName{.of_file = false, .index = options.lamps.size() - 1};
  }
  panel.widgets.mark("add lamp");
  tooltip("A point lamp before what the camera looks at; drag its ring in the picture");
  lamp_list(panel);
}

}  // namespace penumbra::viewer
