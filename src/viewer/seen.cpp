// What is shown of the two pictures: themselves or values in false colour, and the values under the cursor.
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
  side.shown = &side.renderer.smoothed_picture();
  side.colors = nullptr;
  side.values = {};
  ++side.reads;
  if (state_.inspection.what.empty()) return;
  Inspection inspection = state_.inspection;
  inspection.what = target_of_view(inspection.what, side.renderer.view());  // the list has those of view 0
  if (is_target(inspection.what) && !inspected_target(inspection, device_.device)) {
    // A filter that is off has no textures; and other views can lack some of view 0's.
    if (side.renderer.view() != 0) return;
    tell(state_, fmt::format("{} is no longer drawn", title_of(inspection, device_.device, scene_.get())),
         ImGui::GetTime());
    state_.inspection = {};
    return;
  }
  side.values = read_values(inspection, renderer_, device_.device);
}

// Reading a value back waits for the GPU, so it is done only while the values are on screen.
bool Viewer::probes(const PictureArea& area) const {
  return state_.probe && state_.panel && state_.open_tab == "Inspect" &&
         (area.cursor.has_value() || state_.locked_pixel.has_value());
}

// The pixel whose values are shown.
std::optional<glm::ivec2> Viewer::probed_pixel(const PictureArea& area) {
  const PresentInputs inputs = present_inputs(window_size_);
  std::optional<glm::ivec2>& locked = state_.locked_pixel;
  if (locked && glm::any(glm::greaterThanEqual(*locked, inputs.picture_size))) locked.reset();  // a smaller window
  status_.locked_at.reset();
  if (locked) {
    status_.locked_at = place_of(inputs, *locked) * area.size / glm::vec2(window_size_);
    return locked;
  }
  if (!area.cursor) return {};
  return pixel_at(inputs, *area.cursor * glm::vec2(window_size_) / area.size);
}

void Viewer::probe(const PictureArea& area) {
  std::optional<glm::ivec2> pixel;
  if (!state_.locked_pixel || !probes(area)) status_.locked_at.reset();
  status_.texture_alone = shows_texture_alone();
  if (status_.texture_alone) {
    // Its texels are no pixels of the picture.
    status_.locked_at.reset();
  } else if (probes(area) && readable_ && !last_is_b_ && a_.shown != nullptr && status_.drawn_size.x > 0) {
    pixel = probed_pixel(area);
  }
  status_.probed = pixel;
  if (!pixel || (pixel == status_.last_probed && !probe_is_old_)) return;
  probe_is_old_ = false;
  status_.last_probed = pixel;
  // Pictures are smaller while the camera moves.
  const glm::ivec2 full(state_.document.options.size.width, state_.document.options.size.height);
  const glm::ivec2 drawn = glm::min(*pixel * status_.drawn_size / full, status_.drawn_size - 1);
  status_.probe.clear();
  for (const render::Aov& aov : render::aovs())
    status_.probe.push_back({aov.name, number_text(renderer_.read_aov(aov.name, drawn), mapping_of(aov.name).unit)});
  if (!status_.difference) return;
  const auto index =
      static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(full.x) + static_cast<std::size_t>(pixel->x);
  status_.probe.push_back({"shadow of B", number_text({b_.visibility[index]}, "")});
}

// Whether a texture of another size than the picture's takes its place.
bool Viewer::shows_texture_alone() const {
  const bool alone = is_target(state_.inspection.what) && !state_.inspection.over && !a_.values.numbers.empty();
  return alone && glm::ivec2(a_.values.width, a_.values.height) != status_.drawn_size;
}

// The values that were read back to be shown, at the cursor: A's, and B's where it is shown too.
void Viewer::read_texel(const PictureArea& area) {
  status_.texel.reset();
  const Values& values = a_.values;
  const bool inspects = !state_.inspection.what.empty() && !values.numbers.empty();
  status_.shown_size = inspects ? glm::ivec2(values.width, values.height) : glm::ivec2(0);
  if (!inspects || !area.cursor) return;
  const glm::vec2 window = *area.cursor * glm::vec2(window_size_) / area.size;
  const std::optional<glm::ivec2> at = texel_at(present_inputs(window_size_), window, status_.shown_size);
  if (!at) return;
  const ColorMapping mapping = mapping_of(state_.inspection, device_.device);
  const auto text = [&](const Values& of) {
    const float* first = of.at(at->x, at->y);
    // Of values below 0, such as the sky's, there are none; nor of NaN.
    if (*first >= 0 && *first < static_cast<float>(mapping.labels.size()))
      return mapping.labels[static_cast<std::size_t>(*first)];
    return number_text({first, first + of.channels}, mapping.unit);
  };
  const bool texture = is_target(state_.inspection.what);
  status_.texel = ShownTexel{.at = {at->x, texture ? values.height - 1 - at->y : at->y}, .value = text(values)};
  const bool both = state_.comparison.on && b_.values.width == values.width && b_.values.height == values.height &&
                    b_.values.channels == values.channels;
  if (both) status_.texel->value = "A " + status_.texel->value + ", B " + text(b_.values);
}

// A number that goes up whenever a texture that can be shown has other content.
std::uint64_t Viewer::contents() const { return a_.renderer.version() + b_.renderer.version() + colorings_; }

void Viewer::show_pictures() {
  if (a_.shown == nullptr) return;
  const bool values = !state_.inspection.what.empty();
  const bool differ = values && state_.comparison.on && state_.comparison.how == CompareMode::difference &&
                      !a_.values.numbers.empty() && a_.values.numbers.size() == b_.values.numbers.size();
  if (values) color_values(differ);
  for (Side* side : {&a_, &b_}) {
    if (!side->renderer.has_picture()) continue;
    const bool colored = values && side->colors != nullptr && (!state_.inspection.over || differ);
    side->shown = colored ? side->colors : &side->renderer.smoothed_picture();
  }
  PresentInputs inputs = present_inputs(window_size_);
  status_.fitted = glm::vec2(inputs.picture_size) / glm::vec2(window_size_);
  if (differ) inputs.b = nullptr;
  const bool is_presented = presented_ != nullptr && presented_->serial() == presented_texture_ &&
                            contents() == presented_contents_ && inputs == presented_inputs_;
  if (is_presented) return;
  presented_texture_ = present(device_.device, inputs).serial();
  presented_contents_ = contents();
  presented_inputs_ = std::move(inputs);
  ++presents_;
}

// Computes colours only if the values or their range have changed.
void Viewer::color_values(bool differ) {
  status_.mapping = mapping_of(state_.inspection, device_.device);
  status_.values = status_.range = range_of(state_.inspection, status_.mapping, a_.values);
  if (differ) {
    status_.mapping = {.scale = ColorScale::heat, .unit = status_.mapping.unit, .labels = {}};
    status_.range = {0, (status_.values.high - status_.values.low) / state_.comparison.gain};
  }
  const std::string colored =
      fmt::format("{} {} {} {} {}", a_.reads, b_.reads, differ, status_.range.low, status_.range.high);
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
  const std::vector<std::uint8_t> colors = colors_of(values, status_.mapping, status_.range);
  const gl::Texture& texture =
      device_.device.target(fmt::format("viewer/colors {}", number), {.width = values.width, .height = values.height});
  texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(colors)));
  side.colors = &texture;
  ++colorings_;
}

PresentInputs Viewer::present_inputs(const glm::ivec2& window_size) const {
  const cli::Size size = state_.document.options.size;
  const bool values = !state_.inspection.what.empty(), tints = values && state_.inspection.over;
  const glm::ivec2 whole = shows_texture_alone() ? fitted({a_.values.width, a_.values.height}, window_size)
                                                 : glm::ivec2(size.width, size.height);
  const auto tint_of = [&](const Side& side) { return tints && side.shown != side.colors ? side.colors : nullptr; };
  return {.a = a_.shown,
          .b = state_.comparison.on ? b_.shown : nullptr,
          .tint_a = tint_of(a_),
          .tint_b = state_.comparison.on ? tint_of(b_) : nullptr,
          .picture_size = whole,
          .window_size = window_size,
          .comparison = state_.comparison,
          .zoom = state_.zoom,
          .values = values && !tints};
}

}  // namespace penumbra::viewer
