#include "image/tiles_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "image/read.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::test {

namespace {

// A technique that marks the pixels that it is asked for: 0.5 is no decision.
constexpr const char* marks_text = R"(
#include "shadow/search.glsl"
float read_radius(Receiver receiver, Light light) { return search_radius(receiver, light); }
Visibility visibility(Receiver receiver, Light light) { return Visibility(0.5, 0.0, 0.0, false, false); }
)";

shadow::Registry registry_of_marks() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  for (shadow::Technique& technique : contents.techniques) {
    if (technique.decides_tiles) technique.glsl = "test/marks.glsl";
  }
  return shadow::Registry(std::move(contents));
}

}  // namespace

TilesTest::TilesTest() : marks_renderer_(device_, registry_of_marks()) {
  device_.shaders.files().put("test/marks.glsl", marks_text);
}

void TilesTest::load(const std::string& name, int width, int height) {
  gpu_scene_.reset();
  width_ = width;
  height_ = height;
  const auto file = std::filesystem::path(PENUMBRA_ROOT) / "scenes" / (name + ".glb");
  scene_ = scene::read_gltf(file, image::image_decoder());
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  setup_ = render::choose_setup(scene_, scene::pose_at(scene_, 0), {.aspect = aspect});
  gpu_scene_.emplace(device_, scene_);
}

std::vector<float> TilesTest::mask(render::Renderer& renderer, const std::string& technique, float angle, bool tiles) {
  ParamSet params(render::Renderer::params(renderer.registry()));
  renderer.registry().select(params, technique);
  params.set("sun.angle", angle);
  params.set("mask.tiles", tiles);
  for (const std::string& assignment : settings_) params.assign(assignment);
  drawn_ = renderer.draw(*gpu_scene_,
                         {.width = width_,
                          .height = height_,
                          .camera = setup_.camera,
                          .last_camera = setup_.camera,
                          .lights = lights_.empty() ? std::vector<render::FrameLight>{setup_.sun} : lights_,
                          .cut = true,
                          .mask_details = true},
                         params);
  return renderer.read_aov("shadow");
}

std::vector<std::vector<float>> TilesTest::read_all(std::span<const char* const> names) const {
  std::vector<std::vector<float>> all;
  for (const char* name : names) all.push_back(renderer_.read_aov(name));
  return all;
}

std::vector<std::vector<float>> TilesTest::layers() const {
  std::vector<std::vector<float>> all;
  for (int layer = 0; layer < drawn_.mask.texture->desc().layers; ++layer)
    all.push_back(gl::read_floats(*drawn_.mask.texture, 4, 0, layer));
  return all;
}

double TilesTest::expect_no_penumbra_is_missed(const std::string& technique, float angle) {
  SCOPED_TRACE(fmt::format("{}, {} degrees", technique, angle));
  const std::vector<float> with = mask(renderer_, technique, angle, true);
  const std::vector<float> without = mask(renderer_, technique, angle, false);
  const std::vector<float> marks = mask(marks_renderer_, technique, angle, true);
  std::size_t decided = 0, apart = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == 0.5f) {
      EXPECT_EQ(with[i], without[i]) << "a pixel of a listed tile differs: " << i;
      continue;
    }
    ++decided;
    apart += with[i] != without[i] ? 1 : 0;
    EXPECT_NEAR(with[i], without[i], 0.25f) << i;
  }
  EXPECT_LE(apart, marks.size() / 1000) << "of " << marks.size();
  return static_cast<double>(decided) / static_cast<double>(marks.size());
}

}  // namespace penumbra::test
