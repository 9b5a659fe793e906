// Tuning what reads the shadow maps does not draw them again in the viewer.
#include <algorithm>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "viewer/picture_renderer.h"

namespace penumbra::test {
namespace {

class ViewerKeep : public GpuTest {
 protected:
  ViewerKeep() {
    document_.options.scene = PENUMBRA_ROOT "/scenes/steps.glb";
    document_.options.size = {64, 36};
    document_.params = ParamSet(render::Renderer::params(renderer_.registry()));
    renderer_.registry().select(document_.params, "thesis_8x8");
    document_.params.set("cascades.size", 64);
    scene_ =
        std::make_unique<viewer::LoadedScene>(device_, session::load_scene(document_.options, image::image_decoder()));
  }

  // How many maps the next frame draws.
  std::size_t maps(const viewer::Detail& detail = {}) {
    picture_.draw(*scene_, document_, detail, /*refined=*/false);
    const auto& work = device_.timers.work();
    const auto found = work.find("shadow map");
    return found == work.end() ? 0 : found->second.draws;
  }

  gl::Device device_{gl::ShaderFiles{}, gl::Timers::Mode::finish};
  render::Renderer renderer_{device_};
  viewer::PictureRenderer picture_{device_, renderer_, 0};
  viewer::Document document_;
  std::unique_ptr<viewer::LoadedScene> scene_;
};

TEST_F(ViewerKeep, TuningAFilterDrawsNoMaps) {
  EXPECT_GT(maps(), 0u);
  for (const auto& [name, value] : {std::pair("filter.width", "0.2"),
                                    {"filter.visibility", "box"},
                                    {"pcss.filter_taps", "4"},
                                    {"exposure.compensation", "1"}}) {
    document_.params.set_text(name, value);
    EXPECT_EQ(maps(), 0u) << name;
    EXPECT_EQ(maps({.picture = 2, .reads = 2}), 0u) << name << ", drawn smaller while the user drags";
    picture_.restart();
    EXPECT_EQ(maps(), 0u) << name << ", at full size again";
  }
}

// The maps of full size stay beside the smaller ones: allocating them anew takes as long as drawing them.
TEST_F(ViewerKeep, SmallerMapsWhileTheViewMovesLeaveThoseOfTheRest) {
  document_.params.set("cascades.size", 512);
  document_.params.set("history.reuse", true);
  maps();
  const std::vector<float> at_rest = renderer_.read_aov("shadow");
  const auto textures = [&] {
    std::vector<GLuint> ids;
    for (const gl::Device::NamedTarget& target : device_.targets()) {
      if (target.name.find("/view 0/") != std::string_view::npos) ids.push_back(target.texture->id());
    }
    return ids;
  };
  const std::vector<GLuint> before = textures();
  EXPECT_GT(maps({.maps = 2}), 0u);
  EXPECT_EQ(picture_.view(), 2);
  EXPECT_EQ(maps({.maps = 2}), 0u);
  EXPECT_EQ(maps(), 0u);
  EXPECT_EQ(picture_.view(), 0);
  EXPECT_EQ(textures(), before);
  EXPECT_EQ(renderer_.read_aov("shadow"), at_rest) << "the motion's history is not the rest's";
}

TEST_F(ViewerKeep, WhatMovesBesideSmallerMapsIsDrawnInThoseOfTheRest) {
  document_.options.scene = PENUMBRA_ROOT "/scenes/moving.glb";
  document_.options.frames = cli::FrameRange{};
  scene_ =
      std::make_unique<viewer::LoadedScene>(device_, session::load_scene(document_.options, image::image_decoder()));
  document_.params.set("cascades.size", 512);
  maps();
  document_.step(6);
  maps({.maps = 2});
  EXPECT_GT(maps(), 0u);
  const std::vector<float> moved = renderer_.read_aov("shadow");
  picture_.cut();
  maps({.maps = 2});
  EXPECT_GT(maps(), 0u) << "a cut is one for both";
  EXPECT_EQ(renderer_.read_aov("shadow"), moved);
}

TEST_F(ViewerKeep, MapsThatGetNoSmallerHaveNoViewOfTheirOwn) {
  document_.params.set("cascades.count", 1);
  maps();
  EXPECT_EQ(maps({.maps = 2}), 0u);  // which already has less than the least size
  EXPECT_EQ(picture_.view(), 0);
}

TEST_F(ViewerKeep, OtherParametersFreeWhatADragHasLeft) {
  document_.params.set("cascades.size", 512);
  maps();
  maps({.maps = 2});
  const auto is_there = [&] {
    return std::ranges::any_of(device_.targets(), [](const gl::Device::NamedTarget& target) {
      return target.name.find("/view 2/") != std::string_view::npos;
    });
  };
  maps();
  EXPECT_TRUE(is_there()) << "the next drag goes on with it";
  document_.params.set("pcss.filter_taps", 4);
  maps();
  EXPECT_FALSE(is_there());
}

TEST_F(ViewerKeep, ARestartGivesThePictureOfAFirstFrame) {
  maps();
  maps();
  picture_.restart();
  maps();
  const std::vector<float> restarted = renderer_.read_aov("shadow");
  picture_.cut();
  EXPECT_GT(maps(), 0u);
  EXPECT_EQ(renderer_.read_aov("shadow"), restarted);
}

TEST_F(ViewerKeep, AnotherSunOrTimeDrawsThem) {
  maps();
  document_.params.set("cascades.split", 0.2f);
  EXPECT_GT(maps(), 0u);
  EXPECT_EQ(maps(), 0u);
  document_.params.set_text("casters.faces", "front");
  EXPECT_GT(maps(), 0u);
  EXPECT_EQ(maps(), 0u);
  picture_.cut();
  EXPECT_GT(maps(), 0u);
}

}  // namespace
}  // namespace penumbra::test
