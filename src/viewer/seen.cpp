// What is seen of the two pictures: themselves or values in false colour, and those under the cursor.
#include <imgui.h>

#include <algorithm>
#include <span>
#include <utility>

#include "viewer/targets.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

namespace {

std::string number_text(const std::vector<float>& values, const std::string& unit) {
  std::string text;
  for (const float v : values) text += fmt::format("{}{:.4g}", text.empty() ? "" : "  ", v == 0 ? 0 : v);
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace

void Viewer::inspect(Side& side) {
  side.seen = &side.painter.picture();
  side.values = {};
  ++side.reads;
  if (state_.inspection.what.empty()) return;
  Inspection inspection = state_.inspection;
  if (&side == &b_) inspection.what = target_of_view(inspection.what, 1);  // the list names A's
  if (is_target(inspection.what) && !inspected_target(inspection, device_)) {
    // Filters that are off have no steps, and B need not have A's.
    if (&side == &b_) return;
    tell(state_, fmt::format("{} is not drawn any more", title_of(inspection, device_)), ImGui::GetTime());
    state_.inspection = {};
    return;
  }
  side.values = read_values(inspection, renderer_, device_);
}

// Each value that is read waits for the GPU: they are where they can be seen.
bool Viewer::probes(const PictureArea& area) const {
  return state_.probe && state_.panel && state_.open_tab == "Inspect" && area.cursor.has_value();
}

void Viewer::probe(const PictureArea& area) {
  std::optional<glm::ivec2> pixel;
  if (probes(area) && readable_ && !last_is_b_ && a_.seen != nullptr && facts_.drawn_size.x > 0)
    pixel = pixel_at(present_inputs(window_size_), *area.cursor * glm::vec2(window_size_) / area.size);
  facts_.probed = pixel;
  if (!pixel || (pixel == last_probed_ && last_draw_ < ImGui::GetTime())) return;
  last_probed_ = pixel;
  // Pictures in motion are smaller.
  const glm::ivec2 full(state_.document.options.size.width, state_.document.options.size.height);
  const glm::ivec2 drawn = glm::min(*pixel * facts_.drawn_size / full, facts_.drawn_size - 1);
  facts_.probe.clear();
  for (const render::Aov& aov : render::aovs())
    facts_.probe.push_back({aov.name, number_text(renderer_.read_aov(aov.name, drawn), look_of(aov.name).unit)});
  if (!facts_.distance) return;
  const auto index =
      static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(full.x) + static_cast<std::size_t>(pixel->x);
  facts_.probe.push_back({"shadow of B", number_text({b_.visibility[index]}, "")});
}

void Viewer::show_pictures() {
  if (a_.seen == nullptr) return;
  const bool values = !state_.inspection.what.empty();
  const bool differ = values && state_.comparison.on && state_.comparison.how == Comparing::difference &&
                      !a_.values.numbers.empty() && a_.values.numbers.size() == b_.values.numbers.size();
  if (values) {
    color_values(differ);
  } else {
    a_.seen = &a_.painter.picture();
    if (b_.painter.has_picture()) b_.seen = &b_.painter.picture();
  }
  PresentInputs inputs = present_inputs(window_size_);
  if (differ) inputs.b = nullptr;
  present(device_, inputs);
}

// What did not change has its colours.
void Viewer::color_values(bool differ) {
  facts_.look = look_of(state_.inspection, device_);
  facts_.values = facts_.range = range_of(state_.inspection, facts_.look, a_.values);
  if (differ) {
    facts_.look = {.scale = ColorScale::heat, .unit = facts_.look.unit, .labels = {}};
    facts_.range = {0, (facts_.values.high - facts_.values.low) / state_.comparison.gain};
  }
  const std::string colored =
      fmt::format("{} {} {} {} {}", a_.reads, b_.reads, differ, facts_.range.low, facts_.range.high);
  if (std::exchange(colored_, colored) == colored) return;
  if (differ) {
    color(a_, difference(a_.values, b_.values), 0);
  } else {
    color(a_, a_.values, 0);
    if (state_.comparison.on) color(b_, b_.values, 1);
  }
}

void Viewer::color(Side& side, const Values& values, int number) {
  if (values.numbers.empty()) return;
  const std::vector<std::uint8_t> colors = colors_of(values, facts_.look, facts_.range);
  const gl::Texture& texture =
      device_.target(fmt::format("viewer/colors {}", number), {.width = values.width, .height = values.height});
  texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(colors)));
  side.seen = &texture;
}

PresentInputs Viewer::present_inputs(const glm::ivec2& window_size) const {
  const cli::Size size = state_.document.options.size;
  return {.a = a_.seen,
          .b = state_.comparison.on ? b_.seen : nullptr,
          .picture_size = {size.width, size.height},
          .window_size = window_size,
          .comparison = state_.comparison,
          .zoom = state_.zoom,
          .values = !state_.inspection.what.empty()};
}

}  // namespace penumbra::viewer
