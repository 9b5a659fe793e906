// A scene is read on a thread of its own while the context is made, as the commands do.
#include <future>

#include "gl/debug.h"
#include "gpu/gpu_test.h"
#include "image/read.h"
#include "scene/gpu_scene.h"
#include "session/prepared_scene.h"

namespace penumbra::test {
namespace {

TEST(Loading, ASceneIsReadWhileAContextIsMade) {
  cli::SceneOptions options;
  options.scene = PENUMBRA_ROOT "/scenes/foliage.glb";
  std::future<session::PreparedScene> loading = std::async(std::launch::async, [&options] {
    return session::load_scene(options, image::image_decoder(cli::limits_of(options.reading)));
  });
  const auto context = gl::make_context(backend_name(), {});
  gl::Device device({}, gl::Timers::Mode::off);
  const session::PreparedScene prepared = loading.get();
  const scene::GpuScene scene(device, prepared.scene);
  EXPECT_FALSE(prepared.bounds.empty);
  EXPECT_NO_THROW(gl::check_errors("loading"));
}

}  // namespace
}  // namespace penumbra::test
