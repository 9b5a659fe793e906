#include "image/scene_run.h"

#include <cmath>
#include <utility>

#include "image/read.h"
#include "render/receivers.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::test {

SceneRun::SceneRun(const std::string& scene, int width, int height, const std::string& camera)
    : width_(width), height_(height) {
  scene_ = scene::read_gltf(std::filesystem::path(PENUMBRA_ROOT) / "scenes" / (scene + ".glb"), image::image_decoder());
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  setup_ = render::choose_setup(scene_, scene::pose_at(scene_, 0), {camera, render::GroundChoice::automatic, aspect});
  gpu_scene_.emplace(device_, scene_);
}

void SceneRun::choose(const std::string& technique) {
  params_ = ParamSet(render::Renderer::params(renderer_.registry()));
  renderer_.registry().select(params_, technique);
}

render::FrameInputs SceneRun::inputs(bool cut) const {
  return {.width = width_,
          .height = height_,
          .camera = setup_.camera,
          .last_camera = drawn_ ? last_camera_ : setup_.camera,
          .lights = {light_.value_or(setup_.sun)},
          .time = time_,
          .last_time = drawn_ ? last_time_ : time_,
          .cut = cut,
          .mask_details = details_};
}

Visibility SceneRun::draw(bool cut) {
  renderer_.draw(*gpu_scene_, inputs(cut), params_);
  last_camera_ = setup_.camera;
  last_time_ = time_;
  drawn_ = true;
  return picture_of(renderer_);
}

ParamSet SceneRun::reference_params() const {
  ParamSet params = params_;
  for (const Param& row : params.rows()) {
    const bool of_scene =
        row.name.starts_with("sun.") || row.name.starts_with("casters.") || row.name.starts_with("cascades.");
    if (!of_scene) params.reset(row.name);
  }
  return params;
}

Visibility SceneRun::draw_by(const char* technique, const ParamSet& params) {
  ParamSet chosen = params;
  renderer_.registry().select(chosen, technique);
  reference_.draw(*gpu_scene_, inputs(/*cut=*/true), chosen);
  return picture_of(reference_);
}

Visibility SceneRun::draw_reference() { return draw_by("brute_force", reference_params()); }

Visibility SceneRun::draw_truth(int rays) {
  ParamSet params = reference_params();
  params.set("truth.samples", rays);
  return draw_by("truth", params);
}

std::vector<std::uint8_t> SceneRun::receivers() const { return render::receivers_of(reference_, setup_.sun, params_); }

Visibility SceneRun::picture_of(const render::Renderer& renderer) const {
  Visibility picture = renderer.read_aov("shadow");
  const std::vector<float> depth = renderer.read_aov("depth");
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (depth[i] == 0) picture[i] = -1;
  }
  return picture;
}

std::vector<std::size_t> penumbra_of(const Visibility& reference) {
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (reference[i] > 0.02f && reference[i] < 0.98f) pixels.push_back(i);
  }
  return pixels;
}

double rmse(const Visibility& picture, const Visibility& reference, const std::vector<std::size_t>& pixels) {
  double sum = 0;
  for (const std::size_t i : pixels) sum += std::pow(picture[i] - reference[i], 2);
  return std::sqrt(sum / static_cast<double>(pixels.size()));
}

double mean_error(const Visibility& picture, const Visibility& reference, const std::vector<std::size_t>& pixels) {
  double sum = 0;
  for (const std::size_t i : pixels) sum += std::abs(picture[i] - reference[i]);
  return sum / static_cast<double>(pixels.size());
}

double decibels(double rmse) { return -20 * std::log10(rmse); }

}  // namespace penumbra::test
