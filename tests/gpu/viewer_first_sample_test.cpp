// Which pictures of the viewer have one sample of each pixel, so that their edges are smoothed when they are shown.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "viewer/picture_renderer.h"

namespace penumbra::test {
namespace {

class ViewerFirstSample : public GpuTest {
 protected:
  ViewerFirstSample() {
    document_.options.scene = PENUMBRA_ROOT "/scenes/steps.glb";
    document_.options.size = {64, 36};
    document_.params = ParamSet(render::Renderer::params(renderer_.registry()));
    choose("hard");
    scene_ =
        std::make_unique<viewer::LoadedScene>(device_, session::load_scene(document_.options, image::image_decoder()));
  }

  void choose(const char* technique) {
    renderer_.registry().select(document_.params, technique);
    document_.params.set("cascades.size", 256);
  }

  void draw(int samples, const viewer::Detail& detail = {}) {
    document_.options.samples = samples;
    picture_.draw(*scene_, document_, detail, /*refined=*/false, [this] {
      ++calls_;
      EXPECT_TRUE(picture_.is_rough());
      first_ = shown();
    });
  }

  void refine() { picture_.draw(*scene_, document_, {}, /*refined=*/true); }

  // Gives a drawing up before one of its passes.
  void give_up(const std::function<void()>& drawing) {
    int passes = 0;
    device_.before_pass = [&] {
      if (++passes == 6) throw viewer::GivenUp();
    };
    EXPECT_THROW(drawing(), viewer::GivenUp);
    device_.before_pass = nullptr;
  }

  std::vector<float> shown() const { return gl::read_floats(picture_.picture(), 3); }

  gl::Device device_{gl::ShaderFiles{}, gl::Timers::Mode::off};
  render::Renderer renderer_{device_};
  viewer::PictureRenderer picture_{device_, renderer_, 0};
  viewer::Document document_;
  std::unique_ptr<viewer::LoadedScene> scene_;
  int calls_ = 0;
  std::vector<float> first_;  // what could be seen when the first sample was drawn
};

TEST_F(ViewerFirstSample, IsSeenBeforeTheOthersWhichMakeEdgesSmooth) {
  draw(1);
  EXPECT_FALSE(picture_.is_rough()) << "one sample is what the user asks for";
  EXPECT_EQ(calls_, 0);
  const std::vector<float> once = shown();
  draw(4);
  EXPECT_EQ(calls_, 1);
  EXPECT_EQ(first_, once);
  EXPECT_FALSE(picture_.is_rough());
  EXPECT_NE(shown(), once);
}

TEST_F(ViewerFirstSample, InMotionThereIsNoOther) {
  draw(4, {.picture = 2});
  EXPECT_TRUE(picture_.is_rough());
  draw(4, {.maps = 4});
  EXPECT_TRUE(picture_.is_rough());
  EXPECT_EQ(calls_, 0);
}

TEST_F(ViewerFirstSample, WhileAHistoryGrowsThereIsNoOther) {
  choose("thesis");
  draw(4);
  EXPECT_TRUE(picture_.is_rough());
  for (int frame = 0; frame < 100 && picture_.is_rough(); ++frame) draw(4);
  EXPECT_FALSE(picture_.is_rough()) << "the last frame has all samples";
  EXPECT_GT(picture_.frames(), 2);
  EXPECT_EQ(calls_, 1);
}

TEST_F(ViewerFirstSample, IsNotDrawnAgainWhereOnlySmoothShadowsWereGivenUp) {
  draw(4);
  const std::vector<float> full = shown();
  refine();
  const std::vector<float> refined = shown();
  EXPECT_NE(refined, full);
  picture_.restart();
  draw(4);
  give_up([this] { refine(); });
  EXPECT_EQ(picture_.frames(), 1);
  EXPECT_TRUE(picture_.shows(document_));
  EXPECT_EQ(shown(), full);
  refine();
  EXPECT_EQ(shown(), refined);
}

TEST_F(ViewerFirstSample, IsDrawnAgainWhereThePictureWasGivenUp) {
  draw(4);
  document_.options.samples = 2;
  give_up([this] { picture_.draw(*scene_, document_, {}, /*refined=*/false); });
  EXPECT_EQ(picture_.frames(), 0);
}

}  // namespace
}  // namespace penumbra::test
