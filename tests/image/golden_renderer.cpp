#include "image/golden_renderer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/read.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::test {

namespace {

constexpr double frames_a_second = 24;

render::Camera camera_of(const GoldenView& view) {
  constexpr float near = 0.05f;
  const auto vector = [](const std::array<float, 3>& v) { return glm::vec3(v[0], v[1], v[2]); };
  return render::look_at(vector(view.eye), vector(view.target), glm::radians(view.fov), near);
}

}  // namespace

ParamSet params_of(const Golden& golden, const shadow::Registry& registry) {
  ParamSet params(render::Renderer::params(registry));
  registry.select(params, golden.technique);
  for (const char* setting : golden.settings) params.assign(setting);
  return params;
}

const shadow::Denoiser* denoiser_of(const Golden& golden, const shadow::Registry& registry) {
  const ParamSet params = params_of(golden, registry);
  const shadow::Denoiser* denoiser = registry.find_denoiser(params.get_word("denoiser"));
  const bool applied = denoiser != nullptr && (!denoiser->applies || denoiser->applies(params));
  return applied ? denoiser : nullptr;
}

bool shows_history(const Golden& golden, const shadow::Registry& registry) {
  const shadow::Denoiser* denoiser = denoiser_of(golden, registry);
  if (denoiser == nullptr || !denoiser->remembers || golden.frames < 2) return false;
  const auto is_own = [&](std::string_view setting) {
    const std::string_view name = setting.substr(0, setting.find('='));
    return std::ranges::any_of(denoiser->params, [&](const Param& param) { return param.name == name; });
  };
  return !denoiser->remembers(params_of(golden, registry)).empty() && std::ranges::any_of(golden.without, is_own);
}

void GoldenRenderer::draw(const Golden& golden, const std::vector<const char*>& more) {
  Loaded& loaded = load(golden.scene);
  constexpr float aspect = static_cast<float>(golden_width) / golden_height;
  const render::Setup setup = render::choose_setup(loaded.scene, scene::pose_at(loaded.scene, 0), {.aspect = aspect});
  const render::Camera camera = golden.view == nullptr ? setup.camera : camera_of(*golden.view);
  ParamSet params = params_of(golden, registry_);
  for (const char* setting : more) params.assign(setting);
  for (int i = 0; i < golden.frames; ++i) {
    const double time = i / frames_a_second;
    renderer_.draw(*loaded.gpu,
                   {.width = golden_width,
                    .height = golden_height,
                    .camera = camera,
                    .last_camera = camera,
                    .lights = {setup.sun},
                    .time = time,
                    .last_time = i == 0 ? time : time - 1 / frames_a_second,
                    .cut = i == 0,
                    .mask_details = true},
                   params);
  }
}

GoldenPicture GoldenRenderer::picture(const Golden& golden) const {
  const std::vector<float> values = aov(golden.aov);
  const std::size_t channels = values.size() / (golden_width * golden_height);
  GoldenPicture picture{.channels = channels == 1 ? 1 : 3, .pixels = {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float share = (values[i] - golden.black) / (golden.white - golden.black);
    picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f))));
    if (channels == 2 && i % 2 == 1) picture.pixels.push_back(0);  // PNG has no two channels without alpha
  }
  return picture;
}

GoldenRenderer::Loaded& GoldenRenderer::load(const std::string& name) {
  const auto found = scenes_.find(name);
  if (found != scenes_.end()) return found->second;
  Loaded& loaded = scenes_[name];
  const std::filesystem::path file = std::filesystem::path(PENUMBRA_ROOT) / "scenes" / (name + ".glb");
  loaded.scene = scene::read_gltf(file, image::image_decoder());
  loaded.gpu.emplace(device_, loaded.scene);
  return loaded;
}

}  // namespace penumbra::test
