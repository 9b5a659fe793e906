// What is drawn of A and B, and what is seen of it.
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "metrics/flip.h"
#include "render/receivers.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

namespace {

bool is_traced(const Document& document) {
  return !document.params.rows().empty() && document.params.get_word("technique") == "truth";
}

}  // namespace

// Camera, time and all of the light that is no shadow are A's.
Document Viewer::document_b() const {
  Document document = state_.document;
  document.params = state_.comparison.params;
  for (const Param& row : document.params.rows()) {
    const bool shared =
        row.name.starts_with("sun.") || row.name.starts_with("exposure.") || row.name.starts_with("render.");
    if (shared) document.params.set(row.name, state_.document.params.value(row.name));
  }
  return document;
}

Situation Viewer::situation_of(const Document& b, const PictureArea& area, double now) {
  const auto state_of = [](Side& side, const Document& document) {
    PictureState state{.current = side.painter.shows(document),
                       .frames = side.painter.frames(),
                       .wanted = warmup_of(document) + 1,
                       .traced = is_traced(document)};
    if (state.missing() > 0) side.measured = false;
    state.measured = side.measured;
    return state;
  };
  const std::string inspected = fmt::format("{} {} {} {}", state_.inspection.what, state_.inspection.layer,
                                            state_.inspection.level, state_.inspection.part);
  const bool chosen = std::exchange(inspected_, inspected) != inspected;
  Situation situation{.now = now,
                      .a = state_of(a_, state_.document),
                      .pending = truth_.pending().has_value(),
                      .looks = chosen || (last_is_b_ && probes(area)),
                      .last_is_b = last_is_b_,
                      .busy = ImGui::IsAnyItemActive() && !area.busy};
  // Of two pictures that are traced in turn none is ever finished.
  facts_.both_traced = state_.comparison.on && situation.a.traced && is_traced(b);
  if (state_.comparison.on && !b.params.rows().empty() && !facts_.both_traced) situation.b = state_of(b_, b);
  if (situation.a.missing() > 0 || !situation.b || situation.b->missing() > 0) facts_.distance.reset();
  facts_.b_waits = situation.b && !situation.b->current;
  return situation;
}

// A truth that was waited for is there now: its picture is drawn once more.
void Viewer::take_traced(const Document& b) {
  const std::optional<truth::TruthTechnique::Pending> pending = truth_.pending();
  if (facts_.tracing && !pending) {
    if (is_traced(state_.document)) a_.painter.again();
    if (is_traced(b)) b_.painter.again();
  }
  facts_.tracing = pending ? std::optional(pending->share_done) : std::nullopt;
}

void Viewer::draw_pictures(const PictureArea& area, double now) {
  if (scene_ == nullptr) return;
  if (!state_.comparison.on) forget_b();
  const Document b = document_b();
  take_traced(b);
  const Situation situation = situation_of(b, area, now);
  const Plan plan = plan_frame(pace_, situation);
  if (plan.cancel) truth_.cancel();
  facts_.at_rest = plan.at_rest && facts_.loading.empty();
  if (plan.measure_a && !plan.draw_a) guarded([&] { measure(a_); });
  if (plan.measure_b && !plan.draw_b) guarded([&] { measure(b_); });
  if (plan.inspect && a_.painter.has_picture()) guarded([&] { inspect(a_); });
  if (plan.cut_a) a_.painter.cut();
  if (plan.cut_b) b_.painter.cut();
  if (plan.draw_a || plan.draw_b) draw_sides(plan, b, now);
  if (situation.b && a_.measured && b_.measured && !facts_.distance) measure_distance();
}

void Viewer::draw_sides(const Plan& plan, const Document& b, double now) {
  last_draw_ = now;
  double milliseconds = 0;
  bool drawn = true;
  if (plan.draw_b) {
    drawn = draw_side(b_, b, plan.divisor, plan.measure_b);
    milliseconds += b_.painter.milliseconds();
  }
  if (plan.draw_a) {
    drawn = draw_side(a_, state_.document, plan.divisor, plan.measure_a) && drawn;
    milliseconds += a_.painter.milliseconds();
  }
  readable_ = drawn;
  last_is_b_ = !plan.draw_a;
  if (!drawn) return;
  pace_.drew(plan.divisor, milliseconds);
  facts_.drawn_size = {a_.painter.picture().width(), a_.painter.picture().height()};
  facts_.frames = a_.painter.frames();
}

bool Viewer::draw_side(Side& side, const Document& document, int divisor, bool measures) {
  bool drawn = false;
  guarded([&] {
    // Times of pictures of another size say nothing of these.
    if (std::exchange(side.divisor, divisor) != divisor) side.costs.clear();
    cost_reader_.start(device_.timers, side.costs);
    side.painter.draw(*scene_, document, divisor);
    side.costs.set_work(device_.timers.work());
    const bool is_there = !is_traced(document) || !truth_.pending();
    if (measures && is_there) measure(side);
    inspect(side);
    drawn = true;
  });
  return drawn;
}

// Of the renderer's last frame, which is its.
void Viewer::measure(Side& side) {
  side.measured = true;  // or can't be
  side.visibility = renderer_.read_aov("shadow");
}

// It keeps maps, masks and histories of its own.
void Viewer::forget_b() {
  if (!b_.painter.has_picture()) return;
  b_.painter.forget();
  b_.seen = nullptr;
  b_.measured = false;
  renderer_.forget_view(1);
}

// Over what faces the sun, and from what is shown at full size.
void Viewer::measure_distance() {
  const glm::ivec2 size = facts_.drawn_size;
  const metrics::Picture a{size.x, size.y, a_.visibility}, b{size.x, size.y, b_.visibility};
  if (a.pixels.size() != a.pixel_count() || b.pixels.size() != b.pixel_count()) return;
  const std::vector<std::uint8_t> receivers =
      render::receivers_of(renderer_, session::setup_at(scene_->prepared, state_.document.seconds()).sun.to_light,
                           state_.document.params.get_float("sun.angle"));
  facts_.distance =
      Distance{.figures = metrics::error_figures(a, b, receivers), .flip = metrics::flip(a, b, receivers).mean};
}

}  // namespace penumbra::viewer
