// The viewer runs for hours: what it holds does not grow with frames, scenes or sizes.
#include <unistd.h>

#include <fstream>
#include <memory>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "viewer/picture_renderer.h"

namespace penumbra::test {
namespace {

// Bytes of this process in memory.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t whole = 0, pages = 0;
  file >> whole >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Not checked with the address sanitizer, which keeps freed memory for a while; it reports leaks when the process ends.
void expect_no_more_than([[maybe_unused]] std::size_t bytes) {
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(resident(), bytes);
#endif
}

class ViewerMemory : public GpuTest {
 protected:
  ViewerMemory() : renderer_(device_), renderer_of_a_(device_, renderer_, 0) {
    document_.options.size = {64, 36};
    document_.params = ParamSet(render::Renderer::params(renderer_.registry()));
    renderer_.registry().select(document_.params, "thesis");
    // All of its passes, each as cheap as can be: what a frame leaves behind has nothing to do with its size.
    document_.params.set("cascades.size", 128);
    document_.params.set("cascades.count", 1);
    document_.params.set("pcss.blocker_taps", 1);
    document_.params.set("pcss.filter_taps", 1);
    document_.params.set("pcss.disocclusion_taps", 1);
    document_.params.set("filter.taps", 1);
  }

  std::unique_ptr<viewer::LoadedScene> load(const char* name) {
    document_.options.scene = std::string(PENUMBRA_ROOT) + "/scenes/" + name;
    return std::make_unique<viewer::LoadedScene>(device_,
                                                 session::load_scene(document_.options, image::image_decoder()));
  }

  void draw(viewer::LoadedScene& scene, int frames, const viewer::Detail& detail = {}) {
    for (int i = 0; i < frames; ++i) {
      document_.params.set("sampling.seed", i % 2);  // changes the document, as a user would
      renderer_of_a_.draw(scene, document_, detail, /*refined=*/false);
      device_.timers.take();
    }
  }

  static constexpr std::size_t mebibyte = 1 << 20;

  gl::Device device_{gl::ShaderFiles{}, gl::Timers::Mode::finish};
  render::Renderer renderer_;
  viewer::PictureRenderer renderer_of_a_;
  viewer::Document document_;
};

TEST_F(ViewerMemory, IsFlatOverTwoThousandFramesWithAHistory) {
  const auto scene = load("steps.glb");
  draw(*scene, 200);
  const std::size_t targets = device_.target_bytes(), programs = device_.shaders.size(), before = resident();
  draw(*scene, 2000);
  EXPECT_EQ(device_.target_bytes(), targets);
  EXPECT_EQ(device_.shaders.size(), programs);
  expect_no_more_than(before + 4 * mebibyte);
}

TEST_F(ViewerMemory, IsFlatOverFiftyScenesAndTheirSizes) {
  const auto show = [&](int number) {
    const auto scene = load(number % 2 == 0 ? "steps.glb" : "posts.glb");
    document_.options.size = {64 + 16 * (number % 3), 48};
    renderer_of_a_.cut();
    draw(*scene, 2, number % 2 == 0 ? viewer::Detail{} : viewer::Detail{.picture = 2});
  };
  for (int i = 0; i < 12; ++i) show(i);
  const std::size_t before = resident();
  for (int i = 0; i < 50; ++i) show(i);
  expect_no_more_than(before + 8 * mebibyte);
}

}  // namespace
}  // namespace penumbra::test
