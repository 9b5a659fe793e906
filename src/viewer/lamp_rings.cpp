#include "viewer/lamp_rings.h"

#include <imgui.h>

#include <algorithm>
#include <optional>

#include "viewer/lamps.h"

namespace penumbra::viewer {

namespace {

// The radius of a ring, pixels: about 9 at 100 %.
float ring_radius() { return 0.6f * ImGui::GetFontSize(); }

// A lamp as the picture shows it.
struct Shown {
  glm::vec2 at{0};  // pixels from the window's upper left
  float metre = 1;  // pixels, at the lamp's distance
};

render::Camera camera_of(const Panel& panel) {
  return session::setup_at(panel.status.scene->prepared, panel.state.document.seconds()).camera;
}

bool shows_rings(const Panel& panel) {
  const Comparison& comparison = panel.state.comparison;
  const bool halves = comparison.on && comparison.how == CompareMode::side_by_side;
  return panel.status.scene != nullptr && !panel.status.texture_alone && panel.state.zoom.factor == 1 && !halves;
}

std::optional<Shown> shown(const render::Camera& camera, const glm::vec3& place, const PictureArea& area) {
  const glm::mat4 projection = render::projection_of(camera, area.size.x / area.size.y);
  const glm::vec4 clip = projection * camera.view * glm::vec4(place, 1);
  if (!(clip.w > 0)) return {};
  const glm::vec2 ndc = glm::vec2(clip) / clip.w;
  return Shown{.at = area.corner + glm::vec2(0.5f + 0.5f * ndc.x, 0.5f - 0.5f * ndc.y) * area.size,
               .metre = 0.5f * area.size.y * projection[1][1] / clip.w};
}

}  // namespace

bool drag_lamp(const Panel& panel, const PictureArea& area, bool active) {
  UiState& state = panel.state;
  if (!active || !ImGui::IsMouseDown(ImGuiMouseButton_Left)) state.dragged_lamp.reset();
  if (!shows_rings(panel)) return false;
  const render::Camera camera = camera_of(panel);
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const float ring = ring_radius();
  const std::vector<ShownLamp> lamps = shown_lamps(panel);
  for (const ShownLamp& lamp : lamps) {
    const std::optional<Shown> at = shown(camera, lamp.light.position, area);
    if (!ImGui::IsItemClicked() || !at || glm::distance(at->at, glm::vec2(pointer.x, pointer.y)) > ring) continue;
    state.dragged_lamp = state.lamp = lamp.name;
  }
  const auto dragged = std::ranges::find_if(
      lamps, [&](const ShownLamp& lamp) { return state.dragged_lamp && lamp.name == *state.dragged_lamp; });
  if (dragged == lamps.end()) return false;
  render::LampLight moved = dragged->light;
  const std::optional<Shown> lamp = shown(camera, moved.position, area);
  if (lamp && area.dragged != glm::vec2(0)) {
    const glm::vec3 by = glm::vec3(area.dragged.x, -area.dragged.y, 0) / lamp->metre;
    moved.position += glm::transpose(glm::mat3(camera.view)) * by;
    state.dragged_lamp = state.lamp = change_lamp(panel, dragged->name, moved);
  }
  return true;
}

void draw_lamp_rings(const Panel& panel, const PictureArea& area) {
  if (!shows_rings(panel)) return;
  const UiState& state = panel.state;
  const render::Camera camera = camera_of(panel);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float ring = ring_radius();
  for (const ShownLamp& shining : shown_lamps(panel)) {
    const std::optional<Shown> lamp = shown(camera, shining.light.position, area);
    if (!lamp) continue;
    const bool chosen = state.lamp && *state.lamp == shining.name;
    list.AddCircle({lamp->at.x, lamp->at.y}, ring + 1, IM_COL32(20, 20, 20, 200), 0, 4);
    list.AddCircle({lamp->at.x, lamp->at.y}, ring, chosen ? IM_COL32(255, 200, 80, 255) : IM_COL32(255, 255, 255, 255),
                   0, 2);
    panel.widgets.mark("ring of " + text_of(shining.name), {lamp->at.x - ring, lamp->at.y - ring},
                       {lamp->at.x + ring, lamp->at.y + ring});
  }
}

}  // namespace penumbra::viewer
