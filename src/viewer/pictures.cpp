// Draws A and B, and compares them.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "metrics/flip.h"
#include "render/receivers.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

namespace {

// A field that takes text stays active until the user clicks elsewhere, so it does not count.
bool holds_widget() { return ImGui::IsAnyItemActive() && !ImGui::GetIO().WantTextInput; }

bool is_traced(const Document& document) {
  return !document.params.rows().empty() && document.params.get_word("technique") == "truth";
}

// Each light's mask is a picture of its own, as for `compare`: FLIP's filters must not reach from one into another.
double mean_flip(const metrics::ImageView& a, const metrics::ImageView& b, const std::vector<std::uint8_t>& receivers,
                 std::size_t lights) {
  const std::size_t pixels = a.pixel_count() / lights;
  const int height = a.height / static_cast<int>(lights);
  double sum = 0;
  int measured = 0;
  for (std::size_t light = 0; light < lights; ++light) {
    const auto mask = [&](std::span<const float> all) { return all.subspan(light * pixels, pixels); };
    const double flip = metrics::flip({a.width, height, mask(a.pixels)}, {b.width, height, mask(b.pixels)},
                                      std::span(receivers).subspan(light * pixels, pixels))
                            .mean;
    if (std::isnan(flip)) continue;  // a light that shines on nothing
    sum += flip;
    ++measured;
  }
  return measured == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / measured;
}

}  // namespace

FrameState Viewer::frame_state(const Document& b, const PictureArea& area, double now) {
  const auto state_of = [this](Side& side, const Document& document) {
    PictureState state{.current = side.renderer.shows(document),
                       .frames = side.renderer.frames(),
                       .wanted = frames_of(document, pacing_.software()),
                       .traced = is_traced(document),
                       .settles = !changes_once_drawn(document)};
    if (state.missing() > 0) side.measured = false;
    state.measured = side.measured;
    return state;
  };
  const std::string inspected = fmt::format("{} {} {} {}", state_.inspection.what, state_.inspection.layer,
                                            state_.inspection.level, state_.inspection.part);
  const bool chosen = std::exchange(inspected_, inspected) != inspected;
  FrameState frame{.now = now,
                   .a = state_of(a_, state_.document),
                   .truth_pending = status_.tracing.has_value(),
                   .values_wanted = chosen || (last_is_b_ && probes(area)),
                   .last_is_b = last_is_b_,
                   .unreadable = !readable_,
                   .ui_active = holds_widget() && !area.dragging,
                   .travels = a_.renderer.has_params_of(state_.document)};
  // The background traces one picture at a time: two would stop each other in every frame.
  status_.both_traced = state_.comparison.on && frame.a.traced && is_traced(b);
  if (state_.comparison.on && !b.params.rows().empty() && !status_.both_traced) frame.b = state_of(b_, b);
  if (frame.b) frame.travels = frame.travels && b_.renderer.has_params_of(b);
  if (frame.a.missing() > 0 || !frame.b || frame.b->missing() > 0) status_.difference.reset();
  status_.b_is_old = state_.comparison.on && !b.params.rows().empty() && !b_.renderer.shows(b);
  return frame;
}

// Once the background has traced a picture, it is drawn again from the result.
void Viewer::take_traced(const Document& b) {
  const std::optional<truth::TruthTechnique::Pending> pending = truth_.pending();
  if (!pending) {
    if (is_traced(state_.document) && a_.untraced) a_.renderer.again();
    if (is_traced(b) && b_.untraced) b_.renderer.again();
  }
  status_.tracing = pending ? std::optional(pending->share_done) : std::nullopt;
}

std::optional<Viewer::PictureWork> Viewer::plan_pictures(const PictureArea& area, double now) {
  if (scene_ == nullptr) return {};
  if (!state_.comparison.on) forget_b();
  PictureWork work{.b = state_.document_b(), .plan = {}};
  take_traced(work.b);
  const FrameState frame = frame_state(work.b, area, now);
  note_progress();
  work.b_shown = frame.b.has_value();
  work.plan = plan_frame(pacing_, frame);
  if (work.plan.cancel_truth) truth_.cancel();
  status_.idle = work.plan.idle && status_.loading.empty();
  if (work.plan.a.restart) a_.renderer.restart();
  if (work.plan.b.restart) b_.renderer.restart();
  if (work.plan.at_rest && (unsettled_ > 0 || state_.requests != Requests())) {
    work.plan.a = work.plan.b = {};
    work.plan.at_rest = false;
  }
  mind_failures(work);
  return work;
}

// Of the pictures alone: what else is asked for does not change whether they can be drawn.
Viewer::Wishes Viewer::drawn_wishes() const {
  Wishes wanted = wishes();
  wanted.requests = {};
  return wanted;
}

bool Viewer::is_undrawable(const Side& side) const {
  return side.failed.shaders == device_.device.shaders.changes() && side.failed.full == drawn_wishes();
}

// What could not be drawn is not tried again until it changes, or a shader does: each try would compile the shader that
// fails.
void Viewer::mind_failures(PictureWork& work) {
  FramePlan& plan = work.plan;
  status_.undrawable = false;
  for (Side* side : {&a_, &b_}) {
    if (side == &b_ && !work.b_shown) continue;
    // A shader that was saved with an error has a last good version in full detail alone.
    const bool failed = side->failed.shaders == device_.device.shaders.changes();
    if (failed && side->failed.reduced) plan.detail = {};
    if (!is_undrawable(*side)) continue;
    status_.undrawable = true;
    (side == &a_ ? plan.a : plan.b) = {};
  }
  plan.at_rest = plan.at_rest && (plan.a.draw || plan.b.draw);
}

void Viewer::note_failure(Side& side, const Detail& detail) {
  const std::uint64_t shaders = device_.device.shaders.changes();
  if (side.failed.shaders != shaders) side.failed = {.shaders = shaders};
  if (detail == Detail{}) {
    side.failed.full = drawn_wishes();
  } else {
    side.failed.reduced = side.failed.reduced || !status_.shader_errors.empty();
  }
}

void Viewer::draw_pictures(const PictureWork& work) {
  const FramePlan& plan = work.plan;
  // B before A, so that what is read of the renderer afterwards is A's.
  const std::array<SideWork, 2> sides{{{b_, work.b, plan.b}, {a_, state_.document, plan.a}}};
  for (const SideWork& each : sides) {
    if (each.plan.measure && !each.plan.draw) guarded([&] { measure(each.side); });
  }
  if (plan.inspect && a_.renderer.has_picture()) guarded([&] { inspect(a_); });
  if (plan.a.draw || plan.b.draw) draw_sides(sides, plan.detail);
  if (work.b_shown && a_.measured && b_.measured && !status_.difference) measure_difference();
}

Viewer::Wishes Viewer::wishes() const {
  return {.picture = text_of(state_.document),
          .comparison = state_.comparison,
          .zoom = state_.zoom,
          .requests = state_.requests,
          .size = window_size_,
          .playing = state_.playback.playing};
}

// Draws so many frames of the interface, and more while there is input.
void Viewer::answer(int frames) {
  attending_ = true;
  for (int left = frames; left > 0; left = window_.has_input() ? settling : left - 1) {
    begin_interface();
    build_interface();
    widgets_.mark_drawing();
    show_interface();
    if (wishes() != begun_) throw GivenUp();
  }
  attending_ = false;
}

// A picture at rest is seen as soon as it has one sample of each pixel. Values are those of finished pictures.
void Viewer::show_first_sample(Side& side) {
  if (!state_.inspection.what.empty()) return;
  side.shown = &side.renderer.smoothed_picture();
  status_.detail = {};
  status_.drawn_size = {side.shown->width(), side.shown->height()};
  show_pictures();
  answer(1);
}

// Draws pictures in full on a software rasteriser, which takes long: before each pass the user is answered.
void Viewer::draw_at_rest(const PictureWork& work) {
  struct Attendance {
    explicit Attendance(Viewer& of) : viewer(of) {
      viewer.begun_ = viewer.wishes();
      viewer.device_.device.before_pass = [this] { viewer.attend(); };
    }
    ~Attendance() {
      viewer.device_.device.before_pass = nullptr;
      viewer.begun_.reset();
      viewer.attending_ = false;
    }
    Attendance(const Attendance&) = delete;
    Attendance& operator=(const Attendance&) = delete;
    Viewer& viewer;
  };
  const Attendance attendance(*this);
  try {
    guarded([&] { draw_pictures(work); });
  } catch (const GivenUp&) {
    // Values of two pictures are read from the renderer's last frame, which is to be A's again.
    if (work.b_shown) a_.renderer.restart();
    readable_ = false;
    unsettled_ = settling;
  }
  last_draw_ = ImGui::GetTime();
}

void Viewer::draw_sides(std::span<const SideWork> work, const Detail& detail) {
  double milliseconds = 0;
  readable_ = true;
  for (const SideWork& each : work) {
    if (!each.plan.draw) continue;
    const bool drawn = draw_side(each, detail);
    if (!drawn) note_failure(each.side, detail);
    readable_ = drawn && readable_;
    milliseconds += each.side.renderer.milliseconds();
    last_is_b_ = &each.side == &b_;
  }
  last_draw_ = ImGui::GetTime();
  probe_is_old_ = true;
  if (!readable_) return;
  pacing_.drew(detail, milliseconds, turn_.beside());
  turn_.drew(milliseconds);
  status_.detail = detail;
  status_.drawn_maps = a_.renderer.maps();
  status_.drawn_size = {a_.renderer.picture().width(), a_.renderer.picture().height()};
  note_progress();
}

// It says for a second that a history has begun: a GPU draws the next frame at once.
void Viewer::note_progress() {
  constexpr double seconds = 1;
  status_.progress = {.frames = a_.renderer.shows(state_.document) ? a_.renderer.frames() : 0,
                      .wanted = warmup_of(state_.document) + 1,
                      .refines = pacing_.software() && refines(state_.document),
                      .began = ImGui::GetTime() < history_began_ + seconds};
}

// Whether the side's next frame is the one with shadows of their own for all samples.
bool Viewer::is_last_of_refined(const Side& side, const Document& document) const {
  if (!refines(document) || !side.renderer.shows(document)) return false;
  return side.renderer.frames() + 1 >= frames_of(document, pacing_.software());
}

bool Viewer::draw_side(const SideWork& work, const Detail& detail) {
  Side& side = work.side;
  bool drawn = false;
  guarded([&] {
    // Costs that were measured in another detail do not apply to this one.
    if (std::exchange(side.detail, detail) != detail) side.costs.clear();
    const bool refined = is_last_of_refined(side, work.document);
    Costs& costs = refined ? unshown_costs_ : side.costs;
    cost_reader_.start(device_.device.timers, costs);
    const std::function<void()> first_drawn = [&] { show_first_sample(side); };
    // A picture that is refined has been seen with all its samples.
    side.renderer.draw(*scene_, work.document, detail, refined, begun_ && !refined ? first_drawn : nullptr);
    side.untraced = is_traced(work.document) && truth_.unfinished();
    if (&side == &a_ && side.renderer.began_history()) history_began_ = ImGui::GetTime();
    costs.set_work(device_.device.timers.work());
    if (work.plan.measure && !side.untraced) measure(side);
    inspect(side);
    drawn = true;
  });
  return drawn;
}

// Reads the visibility of the renderer's last frame, which is this picture's.
void Viewer::measure(Side& side) {
  side.measured = true;  // also if reading fails: it would fail again in every frame
  side.visibility = renderer_.read_visibilities();
}

// Frees the maps, masks and histories of B.
void Viewer::forget_b() {
  if (!b_.renderer.has_picture()) return;
  b_.renderer.forget();
  b_.shown = b_.colors = nullptr;
  b_.measured = b_.untraced = false;
}

// The figures of A against B, over the surfaces that face a light, of all lights that cast shadows.
void Viewer::measure_difference() {
  const glm::ivec2 size = status_.drawn_size;
  const std::vector<render::FrameLight> lights =
      shadowed_lights(session::setup_at(scene_->prepared, state_.document.seconds()));
  const int rows = size.y * static_cast<int>(lights.size());
  const metrics::ImageView a{size.x, rows, a_.visibility}, b{size.x, rows, b_.visibility};
  if (a.pixels.size() != a.pixel_count() || b.pixels.size() != b.pixel_count()) return;
  const std::vector<std::uint8_t> receivers = render::receivers_of(renderer_, lights, state_.document.params);
  status_.difference = PictureDifference{.figures = metrics::error_figures(a, b, receivers),
                                         .flip = mean_flip(a, b, receivers, lights.size())};
}

}  // namespace penumbra::viewer
