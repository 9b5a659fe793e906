#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>

#include "core/error.h"
#include "scene/pose.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

// Whether the light of that index shines by the options; without a choice all of them do.
bool is_chosen(const cli::SceneOptions& options, std::size_t index) {
  return !options.lights || std::ranges::find(*options.lights, std::to_string(index)) != options.lights->end();
}

// Chooses by index, since names may be equal or contain a comma. All of them are the same as no choice.
void choose(cli::SceneOptions& options, std::size_t index, bool on, std::size_t count) {
  std::vector<std::string> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == index ? on : is_chosen(options, i)) chosen.push_back(std::to_string(i));
  }
  options.lights = std::move(chosen);
  if (options.lights->size() == count) options.lights.reset();
}

// The lights that the options choose; nothing where none would shine.
std::optional<render::Setup> lit_by(const Panel& panel, const cli::SceneOptions& options) {
  const scene::Scene& scene = panel.status.scene->prepared.scene;
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

// Takes other lights, unless nothing would light the scene. A direction that the user gave to the file's sun goes with
// it: alone it would call for a sun that the file does not have.
void take_lights(const Panel& panel, cli::SceneOptions wanted) {
  cli::SceneOptions& options = panel.state.document.options;
  if (has_sun_of_file(panel, options) && !has_sun_of_file(panel, wanted)) wanted.sun.reset();
  if (lit_by(panel, wanted)) {
    options = std::move(wanted);
  } else {
    tell(panel.state, "the last light stays on: without it nothing would light the scene", ImGui::GetTime());
  }
}

void lights_of_the_file(const Panel& panel) {
  const cli::SceneOptions& options = panel.state.document.options;
  const std::vector<std::string>& names = panel.status.scene->lights;
  for (std::size_t i = 0; i < names.size(); ++i) {
    bool on = is_chosen(options, i);
    if (ImGui::Checkbox(fmt::format("{}##light{}", names[i], i).c_str(), &on)) {
      cli::SceneOptions wanted = options;
      choose(wanted, i, on, names.size());
      take_lights(panel, std::move(wanted));
    }
    panel.widgets.mark(fmt::format("light={}", i));
  }
}

bool slider(const char* id, float& value, float least, float most, const char* format) {
  return ImGui::SliderFloat(id, &value, least, most, format,
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
}

// Brightness and hue apart: intensity is their product.
void emission(const Panel& panel, render::LampLight& lamp) {
  float candela = std::max({lamp.intensity.r, lamp.intensity.g, lamp.intensity.b, 1e-3f});
  glm::vec3 color = lamp.intensity / candela;
  row("intensity", "Candela, of the strongest of red, green and blue.");
  const bool brighter = slider("##intensity", candela, 0.1f, 1e8f, "%.4g cd");
  panel.widgets.mark("lamp intensity");
  row("colour", "Linear.");
  const bool other = ImGui::ColorEdit3("##colour", &color.x, ImGuiColorEditFlags_Float);
  panel.widgets.mark("lamp colour");
  if (brighter || other) lamp.intensity = candela * color;
}

void spot(const Panel& panel, render::LampLight& lamp) {
  bool is_spot = lamp.axis != glm::vec3(0);
  row("spot", "Shines within a cone, not in all directions.");
  if (ImGui::Checkbox("##spot", &is_spot)) {
    lamp.axis = is_spot ? glm::vec3(0, -1, 0) : glm::vec3(0);
    if (is_spot) lamp.outer_cone = glm::radians(40.0f);
    lamp.inner_cone = 0.8f * lamp.outer_cone;
  }
  panel.widgets.mark("lamp spot");
  if (!is_spot) return;
  row("axis", "Where it shines.");
  glm::vec3 axis = lamp.axis;
  if (ImGui::DragFloat3("##axis", &axis.x, 0.01f, -1, 1, "%.2f") && glm::length(axis) > 1e-3f)
    lamp.axis = glm::normalize(axis);
  panel.widgets.mark("lamp axis");
  row("cone", "From its axis to its rim.");
  float degrees = glm::degrees(lamp.outer_cone);
  if (ImGui::SliderFloat("##cone", &degrees, 1, 90, "%.1f°", ImGuiSliderFlags_AlwaysClamp)) {
    lamp.outer_cone = std::min(glm::radians(degrees), 1.5707f);
    lamp.inner_cone = 0.8f * lamp.outer_cone;
  }
  panel.widgets.mark("lamp cone");
}

void lamp_rows(const Panel& panel, render::LampLight& lamp) {
  begin_rows("lamp");
  row("place", "Metres. The left mouse button drags the lamp's ring in the picture.");
  ImGui::DragFloat3("##place", &lamp.position.x, 0.01f, -1e6f, 1e6f, "%.2f");
  panel.widgets.mark("lamp place");
  row("radius", "Of the sphere that emits light: the larger, the softer its shadows.");
  slider("##radius", lamp.radius, 0.001f, 2, "%.3g m");
  panel.widgets.mark("lamp radius");
  emission(panel, lamp);
  spot(panel, lamp);
  end_rows();
}

// The user's lamps, of which one is open for changes.
void own_lamps(const Panel& panel) {
  UiState& state = panel.state;
  std::vector<render::LampLight>& lamps = state.document.options.lamps;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const bool open = state.lamp == static_cast<int>(i);
    if (ImGui::Selectable(fmt::format("lamp {}##lamp{}", i, i).c_str(), open))
      state.lamp = open ? -1 : static_cast<int>(i);
    panel.widgets.mark(fmt::format("lamp={}", i));
  }
  if (state.lamp < 0 || state.lamp >= static_cast<int>(lamps.size())) return;
  const auto chosen = lamps.begin() + state.lamp;
  if (ImGui::Button("Remove lamp")) {
    cli::SceneOptions wanted = state.document.options;
    wanted.lamps.erase(wanted.lamps.begin() + state.lamp);
    state.lamp = -1;
    take_lights(panel, std::move(wanted));
    return;
  }
  panel.widgets.mark("remove lamp");
  lamp_rows(panel, *chosen);
}

}  // namespace

void lights_panel(const Panel& panel) {
  UiState& state = panel.state;
  cli::SceneOptions& options = state.document.options;
  bool no_sun = options.no_sun;
  if (ImGui::Checkbox("No sun", &no_sun)) {
    cli::SceneOptions wanted = options;
    wanted.no_sun = no_sun;
    if (no_sun) wanted.sun.reset();
    take_lights(panel, std::move(wanted));
  }
  panel.widgets.mark("no sun");
  tooltip("Spots and point lamps alone light the scene (--no-sun)");
  lights_of_the_file(panel);
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
    options.lamps.push_back({.position = place, .radius = 0.02f * away, .intensity = lux * (away * away)});
    state.lamp = static_cast<int>(options.lamps.size()) - 1;
  }
  panel.widgets.mark("add lamp");
  tooltip("A point lamp before what the camera looks at; drag its ring in the picture");
  own_lamps(panel);
}

}  // namespace penumbra::viewer
