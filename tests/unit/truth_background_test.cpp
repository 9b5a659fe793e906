// Background tracing: which pictures are finished, and what cancels them.

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "truth/background_tracer.h"
#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using truth::BackgroundTracer;
using truth::PictureRequest;
using truth::PictureTracer;
using truth::TracedPicture;

constexpr int few = 64, endless = 1 << 14;  // rays a pixel: the latter take many seconds

// A request for a picture of boxes over the ground; `number` serves as its key.
class Pictures {
 public:
  Pictures() {
    for (int i = -5; i < 5; ++i) scene_.add_box({i, 0.5, -3}, {i + 0.5, 1, 3});
  }

  PictureRequest request(std::uint64_t number, int samples) const {
    constexpr int width = 64;
    PictureRequest request{.scene = &scene_.scene,
                           .casters = {1, 1},
                           .width = width,
                           .light = truth::TracedSun{.to_light = {0.3, 1, 0.2}, .angle = 0.1},
                           .options = {.samples = samples},
                           .key = {number, number}};
    request.geometry.surfaces = scene_.geometry().surfaces;
    for (int x = 0; x < width; ++x) {
      for (int z = 0; z < width; ++z)
        request.receivers.push_back(receiver_at({0.1 * x - 3.2, 0, 0.1 * z - 3.2}, {0, 1, 0}));
    }
    return request;
  }

 private:
  TruthScene scene_;
};

std::optional<TracedPicture> wait(BackgroundTracer& tracer) {
  while (tracer.share_done()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return tracer.take();
}

TEST(TruthBackground, FinishesThePictureThatWasAskedForLast) {
  const Pictures pictures;
  PictureTracer kept;
  BackgroundTracer tracer(kept);
  for (std::uint64_t i = 1; i < 20; ++i) tracer.start(pictures.request(i, endless));
  tracer.start(pictures.request(20, few));
  const std::optional<TracedPicture> picture = wait(tracer);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->key.low, 20);
  const PictureRequest same = pictures.request(20, few);
  EXPECT_EQ(picture->traced.visibility, PictureTracer().trace(same).traced.visibility);
  EXPECT_FALSE(tracer.take());
}

TEST(TruthBackground, LaysTrianglesOutOnce) {
  const Pictures pictures;
  PictureTracer kept;
  BackgroundTracer tracer(kept);
  tracer.start(pictures.request(1, few));
  EXPECT_TRUE(wait(tracer).value().build);
  tracer.stop();
  tracer.start(pictures.request(2, few));
  EXPECT_FALSE(wait(tracer).value().build);
}

TEST(TruthBackground, CancelsAndStopsWithoutAnError) {
  const Pictures pictures;
  PictureTracer kept;
  BackgroundTracer tracer(kept);
  for (int i = 0; i < 10; ++i) {
    tracer.start(pictures.request(1, endless));
    std::this_thread::sleep_for(std::chrono::milliseconds(20 * i % 70));
    if (i % 2 == 0) {
      tracer.cancel();
    } else {
      tracer.stop();
    }
    EXPECT_FALSE(tracer.share_done());
    EXPECT_FALSE(tracer.take());
  }
  tracer.start(pictures.request(1, endless));  // cancelled by the destructor
}

TEST(TruthBackground, ThrowsOnceWhatTracingThrew) {
  const Pictures pictures;
  PictureTracer kept;
  BackgroundTracer tracer(kept);
  PictureRequest request = pictures.request(1, few);
  request.options.progress = [](double) -> bool { throw std::runtime_error("from outside"); };
  tracer.start(std::move(request));
  EXPECT_THROW(wait(tracer), std::runtime_error);
  EXPECT_FALSE(tracer.take());
  request = pictures.request(1, few);
  request.options.progress = [](double) { return false; };
  tracer.start(std::move(request));
  EXPECT_THROW(wait(tracer), truth::Interrupted);
  tracer.start(pictures.request(2, few));
  EXPECT_TRUE(wait(tracer));
}

TEST(TruthBackground, LayingOutOfTrianglesStops) {
  TruthScene scene;
  scene.add_box({-1, 1, -1}, {1, 2, 1});
  std::stop_source stop;
  EXPECT_EQ(scene.tracer({.stop = stop.get_token()}).stats().triangles, 12);
  stop.request_stop();
  EXPECT_THROW(scene.tracer({.stop = stop.get_token()}), truth::Interrupted);
}

}  // namespace
}  // namespace penumbra::test
