#include "viewer/painter.h"

#include <algorithm>
#include <chrono>

#include "cli/text.h"
#include "gl/api.h"
#include "scene/animation.h"

namespace penumbra::viewer {

namespace {

// Two documents with the same text have the same picture.
std::string text_of(const Document& document) {
  return cli::command_text("", render_arguments(document, "", /* warmup= */ 0, /* glsl= */ ""));
}

// A playing animation goes on; a jump of its time is none.
bool goes_on(const session::PreparedScene& prepared, double last, double now) {
  constexpr double longest = 1.0;  // second
  return now >= last && now - last < longest && !scene::jumps_between(prepared.scene, last, now);
}

}  // namespace

Painter::Painter(gl::Device& device, render::Renderer& renderer, int view)
    : device_(device), renderer_(renderer), view_(view) {}

bool Painter::shows(const Document& document) const {
  return picture_ != nullptr && !cut_ && drawn_ == text_of(document);
}

void Painter::draw(LoadedScene& scene, const Document& document, int divisor) {
  const auto start = std::chrono::steady_clock::now();
  const double time = document.seconds();
  const render::Setup setup = session::setup_at(scene.prepared, time);
  std::string text = text_of(document);
  frames_ = divisor == divisor_ && shows(document) ? frames_ : 0;
  const bool cut = cut_ || !goes_on(scene.prepared, last_time_, time);
  const double last_time = cut ? time : last_time_;
  const render::Camera last_camera = cut ? setup.camera : last_camera_;
  cut_ = true;  // until it is done: a frame that throws is no frame to go on from
  const render::Frame& frame = renderer_.draw(scene.gpu,
                                              {.width = std::max(document.options.size.width / divisor, 1),
                                               .height = std::max(document.options.size.height / divisor, 1),
                                               .view = view_,
                                               .camera = setup.camera,
                                               .last_camera = last_camera,
                                               .lights = {setup.sun},
                                               .time = time,
                                               .last_time = last_time,
                                               .cut = cut},
                                              document.params);
  keep(*frame.display);
  cut_ = false;
  drawn_ = std::move(text);
  divisor_ = divisor;
  ++frames_;
  last_time_ = time;
  last_camera_ = setup.camera;
  milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void Painter::forget() {
  device_.drop(fmt::format("viewer/picture {}", view_));
  picture_ = nullptr;
  drawn_.clear();
  cut();
}

void Painter::keep(const gl::Texture& display) {
  picture_ = &device_.target(fmt::format("viewer/picture {}", view_), display.desc());
  gl::glCopyImageSubData(display.id(), GL_TEXTURE_2D, 0, 0, 0, 0, picture_->id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                         display.width(), display.height(), 1);
}

}  // namespace penumbra::viewer
