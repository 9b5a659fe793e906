#include "viewer/picture_renderer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "gl/api.h"
#include "scene/animation.h"

namespace penumbra::viewer {

namespace {

// Whether the time has moved as it does in a playing animation, and not jumped.
bool continues(const session::PreparedScene& prepared, double last, double now) {
  constexpr double longest_step = 1.0;  // seconds
  return now >= last && now - last < longest_step && !scene::jumps_between(prepared.scene, last, now);
}

}  // namespace

PictureRenderer::PictureRenderer(gl::Device& device, render::Renderer& renderer, int view)
    : device_(device), renderer_(renderer), view_(view) {}

bool PictureRenderer::shows(const Document& document) const {
  return picture_ != nullptr && drawn_ == text_of(document);
}

bool PictureRenderer::has_params_of(const Document& document) const {
  return picture_ != nullptr && params_ == document.params;
}

void PictureRenderer::draw(LoadedScene& scene, const Document& document, const Detail& detail) {
  const auto start = std::chrono::steady_clock::now();
  const double time = document.seconds();
  std::string text = text_of(document);
  frames_ = detail == detail_ && shows(document) ? frames_ : 0;
  const cli::Size& size = document.options.size;
  const bool cut = cut_ || !continues(scene.prepared, last_time_, time);
  const cli::Size pixels{.width = std::max(size.width / detail.picture, 1),
                         .height = std::max(size.height / detail.picture, 1)};
  // The first frame of a picture has no motion, as in `penumbra render`.
  const bool still = cut || restart_;
  render::FrameInputs inputs =
      session::frame_inputs(scene.prepared, pixels, {.time = time, .last_time = still ? time : last_time_, .cut = cut});
  inputs.view = view_;
  inputs.restart = restart_;
  inputs.mask_details = true;  // any AOV can be inspected once the picture is drawn
  // As `penumbra render` finishes it.
  if (detail.is_full() && frames_ >= warmup_of(document)) inputs.samples = document.options.samples;
  if (!still) inputs.last_camera = last_camera_;  // the user moves the camera too
  cut_ = true;                                    // until the frame is drawn: after one that throws there is no history
  const std::string before = std::exchange(drawn_, "");
  try {
    keep(*renderer_.draw(scene.gpu, inputs, reduced(document.params, detail)).display);
  } catch (const GivenUp&) {
    drawn_ = before;
    frames_ = 0;
    throw;
  }
  cut_ = restart_ = false;
  drawn_ = std::move(text);
  params_ = document.params;
  detail_ = detail;
  ++frames_;
  last_time_ = time;
  last_camera_ = inputs.camera;
  milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void PictureRenderer::forget() {
  device_.drop(fmt::format("viewer/picture {}", view_));
  picture_ = nullptr;
  drawn_.clear();
  cut();
}

void PictureRenderer::keep(const gl::Texture& display) {
  picture_ = &device_.target(fmt::format("viewer/picture {}", view_), display.desc());
  gl::glCopyImageSubData(display.id(), GL_TEXTURE_2D, 0, 0, 0, 0, picture_->id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                         display.width(), display.height(), 1);
}

}  // namespace penumbra::viewer
