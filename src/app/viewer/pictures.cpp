// What is drawn of A and B, and what is seen of it.
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/receivers.h"
#include "app/viewer/viewer.h"
#include "metrics/flip.h"

namespace penumbra::app {

namespace {

std::string number_text(const std::vector<float>& values, const std::string& unit) {
  std::string text;
  for (const float v : values) text += fmt::format("{}{:.4g}", text.empty() ? "" : "  ", v == 0 ? 0 : v);
  return unit.empty() ? text : text + " " + unit;
}

// That a picture at rest still lacks.
int missing_frames(const Painter& painter, const Document& document) {
  const int wanted = warmup_of(document) + 1;
  return painter.shows(document) ? std::max(wanted - painter.frames(), 0) : wanted;
}

bool is_traced(const Document& document) {
  return !document.params.rows().empty() && document.params.get_word("technique") == "truth";
}

}  // namespace

Document Viewer::document_b() const {
  Document document = state_.document;
  document.params = state_.comparison.params;
  return document;
}

void Viewer::draw_pictures(const PictureArea& area, double now) {
  if (scene_ == nullptr) return;
  const Document b = document_b();
  const bool traced_a = is_traced(state_.document), traced = is_traced(b);
  // Of two pictures that are traced in turn none is ever finished.
  facts_.both_traced = state_.comparison.on && traced_a && traced;
  const bool both = state_.comparison.on && !b.params.rows().empty() && !facts_.both_traced;
  const std::optional<truth::TruthTechnique::Pending> pending = truth_.pending();
  if (facts_.tracing && !pending) {  // the picture is there now
    a_.painter.again();
    b_.painter.again();
  }
  facts_.tracing = pending ? std::optional(pending->share_done) : std::nullopt;

  const bool same_a = a_.painter.shows(state_.document), same_b = !both || b_.painter.shows(b);
  const int wanted = std::max(warmup_of(state_.document), both ? warmup_of(b) : 0) + 1;
  const int missing = std::max(missing_frames(a_.painter, state_.document), both ? missing_frames(b_.painter, b) : 0);
  const bool busy = ImGui::IsAnyItemActive() && !area.busy;
  const Pace::Step step = pace_.next(now, !same_a || (!same_b && !traced), busy, wanted - missing, wanted);
  facts_.at_rest = missing == 0 && !pending && facts_.loading.empty();
  const std::string inspected = fmt::format("{} {} {} {}", state_.inspection.what, state_.inspection.layer,
                                            state_.inspection.level, state_.inspection.part);
  const bool looks = std::exchange(inspected_, inspected) != inspected;
  if (missing > 0) facts_.distance.reset();
  const bool measures = both && step.rests && missing <= 1 && !pending && !facts_.distance;
  if (!step.draw && !measures && !(looks && both)) {
    if (looks && a_.painter.has_picture()) guarded([&] { inspect(a_); });  // the renderer's last frame is A's
    return;
  }
  if (step.anew) {
    a_.painter.cut();
    b_.painter.cut();
  }
  const int divisor = step.draw ? step.divisor : 1;
  last_draw_ = now;
  double milliseconds = 0;
  // The truth is traced where things rest, and does not change there.
  const bool draws_b = both && (!traced || (step.rests && (!same_b || b_.painter.frames() == 0 || looks || measures)));
  // A comes last: what is read of the renderer is read of A.
  if (draws_b && draw_side(b_, b, divisor, measures)) milliseconds += b_.painter.milliseconds();
  if (!draw_side(a_, state_.document, divisor, measures)) return;
  milliseconds += a_.painter.milliseconds();
  pace_.drew(divisor, milliseconds);
  facts_.drawn_size = {a_.painter.picture().width(), a_.painter.picture().height()};
  facts_.frames = a_.painter.frames();
  if (measures && !truth_.pending()) measure_distance();
}

bool Viewer::draw_side(Side& side, const Document& document, int divisor, bool measures) {
  bool drawn = false;
  guarded([&] {
    cost_reader_.start(device_.timers, side.costs);
    side.painter.draw(*scene_, document, divisor);
    inspect(side);
    side.costs.set_work(device_.timers.work());
    if (measures) side.visibility = renderer_.read_aov("shadow");
    drawn = true;
  });
  return drawn;
}

void Viewer::inspect(Side& side) {
  side.seen = &side.painter.picture();
  if (state_.inspection.what.empty()) return;
  Inspection inspection = state_.inspection;
  // The list names A's textures; B has its own.
  const std::size_t view = inspection.what.find("/view 0/");
  if (&side == &b_ && view != std::string::npos) inspection.what.replace(view, 8, "/view 1/");
  side.values = read_values(inspection, renderer_, device_);
}

// Over what faces the sun, and from what is shown at full size.
void Viewer::measure_distance() {
  const glm::ivec2 size = facts_.drawn_size;
  const metrics::Picture a{size.x, size.y, a_.visibility}, b{size.x, size.y, b_.visibility};
  if (a.pixels.size() != a.pixel_count() || b.pixels.size() != b.pixel_count()) return;
  const std::vector<std::uint8_t> receivers =
      receivers_of(renderer_, studio::setup_at(scene_->stage, state_.document.seconds()).sun.to_light,
                   state_.document.params.get_float("sun.angle"));
  facts_.distance =
      Distance{.figures = metrics::error_figures(a, b, receivers), .flip = metrics::flip(a, b, receivers).mean};
}

void Viewer::probe(const PictureArea& area) {
  std::optional<glm::ivec2> pixel;
  if (state_.probe && area.cursor && a_.seen != nullptr && facts_.drawn_size.x > 0)
    pixel = pixel_at(present_inputs(window_size_), *area.cursor * glm::vec2(window_size_) / area.size);
  facts_.probed = pixel;
  if (!pixel || (pixel == last_probed_ && last_draw_ < ImGui::GetTime())) return;
  last_probed_ = pixel;
  // Pictures in motion are smaller.
  const glm::ivec2 full(state_.document.stage.size.width, state_.document.stage.size.height);
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
  const bool differ = state_.comparison.on && state_.comparison.how == Comparing::difference &&
                      !state_.inspection.what.empty() && a_.values.numbers.size() == b_.values.numbers.size();
  if (!state_.inspection.what.empty()) {
    facts_.look = look_of(state_.inspection, device_);
    facts_.range = range_of(state_.inspection, facts_.look, a_.values);
    if (differ) {
      facts_.look = {.scale = ColorScale::heat, .unit = facts_.look.unit, .labels = {}};
      facts_.range = {0, (facts_.range.high - facts_.range.low) / state_.comparison.gain};
      color(a_, difference(a_.values, b_.values), 0);
    } else {
      color(a_, a_.values, 0);
      if (state_.comparison.on && b_.seen != nullptr) color(b_, b_.values, 1);
    }
  } else {
    a_.seen = &a_.painter.picture();
    if (b_.painter.has_picture()) b_.seen = &b_.painter.picture();
  }
  PresentInputs inputs = present_inputs(window_size_);
  if (differ) inputs.b = nullptr;
  present(device_, inputs);
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
  const studio::Size size = state_.document.stage.size;
  return {.a = a_.seen,
          .b = state_.comparison.on ? b_.seen : nullptr,
          .picture_size = {size.width, size.height},
          .window_size = window_size,
          .comparison = state_.comparison,
          .zoom = state_.zoom,
          .values = !state_.inspection.what.empty()};
}

}  // namespace penumbra::app
