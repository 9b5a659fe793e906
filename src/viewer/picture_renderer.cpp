#include "viewer/picture_renderer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "gl/api.h"
#include "scene/animation.h"
#include "viewer/present.h"

namespace penumbra::viewer {

namespace {

// Whether the time has moved as it does in a playing animation, and not jumped.
bool continues(const session::PreparedScene& prepared, double last, double now) {
  constexpr double longest_step = 1.0;  // seconds
  return now >= last && now - last < longest_step && !scene::jumps_between(prepared.scene, last, now);
}

// The options that choose the lights, without those of the camera.
std::vector<std::string> light_arguments(const Document& document) {
  cli::SceneOptions options = document.options;
  options.camera.reset();
  options.eye.reset();
  options.fov.reset();
  return view_arguments(options);
}

// Whether parameters differ that shadows depend on.
bool differ_in_shadows(const ParamSet& one, const ParamSet& other) {
  return std::ranges::any_of(one.rows(), [&](const Param& row) {
    const bool of_display = row.name.starts_with("exposure.") || row.name.starts_with("render.");
    return !of_display && one.value(row.name) != other.value(row.name);
  });
}

std::vector<DrawnMaps> maps_of(const shadow::Mask& mask) {
  std::vector<DrawnMaps> maps;
  for (const shadow::LightFrame& light : mask.lights)
    maps.push_back(light.depth == 0 ? DrawnMaps{} : DrawnMaps{light.projection.layers(), light.projection.size()});
  return maps;
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

void PictureRenderer::draw(LoadedScene& scene, const Document& document, const Detail& detail, bool refined,
                           const std::function<void()>& first_drawn) {
  const auto start = std::chrono::steady_clock::now();
  const double time = document.seconds();
  std::string text = text_of(document);
  frames_ = detail == detail_ && shows(document) ? frames_ : 0;
  const cli::Size& size = document.options.size;
  const bool small_maps = effective(document.params, detail).maps > 1;
  bool& to_cut = cut_.at(small_maps ? 1 : 0);
  restart_ = restart_ || small_maps != small_maps_;
  const bool cut = to_cut || !continues(scene.prepared, last_time_, time);
  const cli::Size pixels{.width = std::max(size.width / detail.picture, 1),
                         .height = std::max(size.height / detail.picture, 1)};
  // The first frame of a picture has no motion, as in `penumbra render`.
  const bool still = cut || restart_;
  render::FrameInputs inputs =
      session::frame_inputs(scene.prepared, pixels, {.time = time, .last_time = still ? time : last_time_, .cut = cut});
  inputs.view = small_maps ? view_of_small_maps(view_) : view_;
  inputs.restart = restart_;
  inputs.mask_details = true;  // any AOV can be inspected once the picture is drawn
  // As `penumbra render` finishes it.
  if (detail.is_full() && frames_ >= warmup_of(document)) inputs.samples = document.options.samples;
  inputs.own_shadows = refined;
  if (first_drawn) {
    inputs.show_first = [&](const gl::Texture& display) {
      keep(display, /*rough=*/true);
      first_drawn();
    };
  }
  if (!still) inputs.last_camera = last_camera_;  // the user moves the camera too
  std::vector<std::string> lights = light_arguments(document);
  // What a drag has left is of no use for a picture of other lights, parameters or size.
  const bool other =
      to_cut || lights != lights_ || params_ != document.params || glm::ivec2(size.width, size.height) != size_;
  if (!small_maps && other) renderer_.forget_view(view_of_small_maps(view_));
  const bool same_size =
      picture_ != nullptr && picture_->width() == pixels.width && picture_->height() == pixels.height;
  const bool begins = still || detail != detail_ || !same_size || lights != lights_ || params_.rows().empty() ||
                      differ_in_shadows(params_, document.params);
  to_cut = true;  // until the frame is drawn: after one that throws there is no history
  const std::string before = std::exchange(drawn_, "");
  try {
    const render::Frame& frame = renderer_.draw(scene.gpu, inputs, reduced(document.params, detail));
    keep(*frame.display, inputs.samples < document.options.samples);
    maps_ = maps_of(frame.mask);
  } catch (const GivenUp&) {
    drawn_ = before;
    if (!refined) frames_ = 0;
    throw;
  }
  to_cut = restart_ = false;
  small_maps_ = small_maps;
  began_history_ = begins;
  lights_ = std::move(lights);
  drawn_ = std::move(text);
  params_ = document.params;
  size_ = {size.width, size.height};
  detail_ = detail;
  ++frames_;
  last_time_ = time;
  last_camera_ = inputs.camera;
  milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void PictureRenderer::forget() {
  device_.drop(fmt::format("viewer/picture {}", view_));
  device_.drop(fmt::format("viewer/smooth {}", view_));
  for (const int view : {view_, view_of_small_maps(view_)}) renderer_.forget_view(view);
  picture_ = smooth_ = nullptr;
  drawn_.clear();
  cut();
}

void PictureRenderer::keep(const gl::Texture& display, bool rough) {
  picture_ = &device_.target(fmt::format("viewer/picture {}", view_), display.desc());
  gl::glCopyImageSubData(display.id(), GL_TEXTURE_2D, 0, 0, 0, 0, picture_->id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                         display.width(), display.height(), 1);
  ++version_;
  smooth_ = nullptr;
  rough_ = rough;
  if (!rough) return;
  const gl::Texture& smooth = device_.target(fmt::format("viewer/smooth {}", view_), display.desc());
  try {
    device_.aside([&] { smooth_edges(device_, *picture_, smooth); });
    smooth_ = &smooth;
  } catch (const Error&) {
    // The user is changing its shader, and reads among the shaders' errors what is wrong with it.
  }
}

}  // namespace penumbra::viewer
