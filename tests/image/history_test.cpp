// How much history improves the mask, and where it must be rejected; measured against brute_force.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"
#include "lib/packed_texel.glsl"

namespace penumbra::test {
namespace {

class ShadowHistory : public GpuTest {};

TEST_F(ShadowHistory, AStillPictureGetsNoWorse) {
  SceneRun run("thesis", 240, 135);
  run.choose("thesis");
  run.params().set("cascades.size", 1024);
  const Visibility reference = run.draw_reference();
  const std::vector<std::size_t> penumbra = penumbra_of(reference);
  for (const std::string sequence : {"set", "shift"}) {
    run.params().set("sampling.filter_sequence", sequence);
    double best = 0;
    double flicker = 0;
    Visibility last;
    std::printf("thesis.glb 240x135, maps of 1024, filter sequence %s:", sequence.c_str());
    for (int frame = 1; frame <= 64; ++frame) {
      const Visibility picture = run.draw(/*cut=*/frame == 1);
      if (frame > 32) flicker += mean_error(picture, last, penumbra) / 32;
      last = picture;
      if (frame != 1 && frame != 4 && frame != 16 && frame != 64) continue;
      const double quality = decibels(rmse(picture, reference, penumbra));
      std::printf(" %d: %.2f dB", frame, quality);
      EXPECT_GE(quality, best - (sequence == "shift" ? 0.1 : 0.5)) << sequence << ", frame " << frame;
      best = std::max(best, quality);
    }
    std::printf(", flicker %.5f\n", flicker);
  }
}

// Each frame has other samples, and all count equally, so that noise goes; the filter narrows, so that blur goes too.
TEST_F(ShadowHistory, AStillSequenceOfSlicesNeverGetsWorse) {
  SceneRun run("thesis", 160, 90);
  run.choose("slices_history");
  run.params().set("maps.jitter", false);  // frames of other maps are not equally good: see the next test
  run.params().set("cascades.size", 1024);
  const Visibility truth = run.draw_truth(256);
  const std::vector<std::size_t> penumbra = penumbra_of(truth);
  double first = 0, best = 0, flicker = 0;
  Visibility last;
  const int frames = 64, settled = 32;
  for (int frame = 1; frame <= frames; ++frame) {
    const Visibility picture = run.draw(/*cut=*/frame == 1);
    const double quality = decibels(rmse(picture, truth, penumbra));
    if (frame == 1) first = quality;
    EXPECT_GE(quality, best - 0.02) << "frame " << frame;
    best = std::max(best, quality);
    if (frame > settled) flicker += mean_error(picture, last, penumbra) / (frames - settled);
    last = picture;
    if (frame == frames) {
      std::printf("thesis.glb 160x90, slices_history: %.2f dB, after 64 frames %.2f dB, ", first, quality);
      EXPECT_GE(quality, first + 2);
    }
  }
  std::printf("flicker %.5f\n", flicker);
  EXPECT_GT(flicker, 0);
  EXPECT_LE(flicker, 0.0015);
}

// Under the real sun most penumbrae are narrower than a texel, so that one map limits what samples and filters reach.
TEST_F(ShadowHistory, AStillSequenceSeesWhatOneMapDoesNotResolve) {
  SceneRun run("courtyard", 160, 90);
  run.choose("slices_history");
  run.params().set("cascades.size", 1024);
  const Visibility truth = run.draw_truth(256);
  const std::vector<std::size_t> penumbra = penumbra_of(truth);
  std::array<Visibility, 2> first;
  std::array<double, 2> after{};
  for (const std::size_t moves : {0, 1}) {
    run.params().set("maps.jitter", moves == 1);
    first.at(moves) = run.draw(/*cut=*/true);
    double best = 0;
    for (int frame = 2; frame <= 16; ++frame) {
      after.at(moves) = decibels(rmse(run.draw(), truth, penumbra));
      EXPECT_GE(after.at(moves), best - 0.2) << "frame " << frame;
      best = std::max(best, after.at(moves));
    }
  }
  std::printf("courtyard.glb 160x90, maps of 1024, slices_history, frame 16: %.2f dB, moved maps %.2f dB\n", after[0],
              after[1]);
  EXPECT_EQ(first[0], first[1]);
  EXPECT_GE(after[1], after[0] + 2);
}

// Shadows of the last frames, and where they were and are no more.
class Trail {
 public:
  std::vector<std::size_t> behind(const Visibility& reference) {
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      bool was = false;
      for (const Visibility& last : last_) was = was || (last[i] >= 0 && last[i] < reference[i] - 0.05f);
      if (was) pixels.push_back(i);
    }
    last_.push_back(reference);
    if (last_.size() > 8) last_.erase(last_.begin());
    return pixels;
  }

 private:
  std::vector<Visibility> last_;
};

// A caster that moves and stops, under a movement map.
struct Stop {
  double moving = 0;   // mean error of the trail while it moves
  double at_rest = 0;  // mean error of the same pixels in a run without motion
  int recovered = -1;  // frames after the motion stops until the error is within 1/255 of `at_rest`
};

// The references are drawn once for all movement maps, on which brute_force does not depend.
class MovingAndStopping {
 public:
  explicit MovingAndStopping(std::string preset) : preset_(std::move(preset)) {
    at_rest_.choose(preset_);
    at_rest_.params().set("cascades.size", 1024);
    for (int frame = begin; frame <= stop; ++frame) {
      at_rest_.time() = frame * step;
      references_.push_back(at_rest_.draw_reference());
    }
  }

  Stop under(const std::string& map, const std::string& present) {
    SceneRun run(scene, width, height);
    for (SceneRun* each : {&run, &at_rest_}) {
      each->choose(preset_);
      each->params().set("cascades.size", 1024);
      each->params().set("movement.map", map);
      each->params().set("movement.present", present);
    }
    Trail trail;
    std::vector<std::size_t> behind;
    Stop result;
    for (int frame = begin; frame <= stop; ++frame) {
      run.time() = frame * step;
      const Visibility picture = run.draw(/*cut=*/frame == begin);
      const Visibility& reference = references_[static_cast<std::size_t>(frame - begin)];
      behind = trail.behind(reference);
      if (frame >= begin + 8) result.moving += mean_error(picture, reference, behind) / (stop - begin - 7);
    }
    const Visibility& reference = references_.back();
    for (int frame = 0; frame < 16; ++frame)
      result.at_rest = mean_error(at_rest_.draw(/*cut=*/frame == 0), reference, behind);
    for (int frame = stop; frame < end && result.recovered < 0; ++frame) {
      if (mean_error(run.draw(), reference, behind) <= result.at_rest + 1 / 255.0) result.recovered = frame - stop + 1;
    }
    std::printf(
        "moving.glb %dx%d, %s, movement map %s, %s: mean error of the trail %.4f, at rest %.4f, recovered after %d\n",
        width, height, preset_.c_str(), map.c_str(), present.c_str(), result.moving, result.at_rest, result.recovered);
    return result;
  }

 private:
  static constexpr const char* scene = "moving";
  static constexpr int width = 240, height = 135;
  static constexpr double step = 1 / 30.0;
  static constexpr int begin = 44, stop = 60, end = 120;  // at 2 s everything stops

  std::string preset_;
  SceneRun at_rest_{scene, width, height};
  std::vector<Visibility> references_;  // of the frames from `begin` to `stop`
};

TEST_F(ShadowHistory, NoGhostFollowsACasterWithAMovementMap) {
  MovingAndStopping caster("thesis");
  const Stop without = caster.under("none", "own_pass");
  EXPECT_GT(without.moving, 0.1) << "there is no ghost to be avoided";
  EXPECT_GT(without.recovered, 10);
  for (const char* map : {"average", "maximum"}) {
    for (const char* present : {"own_pass", "shadow_pass"}) {
      const Stop with = caster.under(map, present);
      EXPECT_LE(with.moving, with.at_rest + 1 / 255.0);
      EXPECT_EQ(with.recovered, 1);
    }
  }
}

TEST_F(ShadowHistory, NoGhostFollowsACasterInASequenceOfSlices) {
  const Stop stop = MovingAndStopping("slices_history").under("maximum", "own_pass");
  EXPECT_LE(stop.moving, stop.at_rest + 1 / 255.0);
  EXPECT_GE(stop.recovered, 0);
  EXPECT_LE(stop.recovered, 2);
}

// A step along the path: a turn of at most 1 degree and a way of at most 5 cm.
void walk(render::Camera& camera) {
  const glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(0.8f), glm::vec3(0, 1, 0));
  camera.view = turn * glm::translate(glm::mat4(1), glm::vec3(0.03f, 0, 0.03f)) * camera.view;
}

// Quality in the penumbra, and the mean change of the error from frame to frame of all receivers.
struct OnPath {
  double decibels = 0, flicker = 0;
};

struct Path {
  std::string scene;
  float sun_angle = 0;             // degrees
  std::vector<Visibility> truths;  // of each frame's receivers, -1 elsewhere; none at first
};

// The camera circles about the scene.
OnPath on_path(Path& path, const std::string& preset, const std::vector<std::string>& settings = {}) {
  constexpr int frames = 16;
  std::vector<Visibility>& truths = path.truths;
  SceneRun run(path.scene, 320, 180);
  run.choose(preset);
  for (const std::string& setting : settings) run.params().assign(setting);
  run.params().set("sun.angle", path.sun_angle);
  Visibility last;
  OnPath result;
  for (int frame = 0; frame < frames; ++frame) {
    run.camera().view = run.camera().view * glm::rotate(glm::mat4(1), glm::radians(0.5f), glm::vec3(0, 1, 0));
    const Visibility picture = run.draw(/*cut=*/frame == 0);
    if (truths.size() < frames) {
      truths.push_back(run.draw_truth(64));
      const std::vector<std::uint8_t> receivers = run.receivers();
      for (std::size_t i = 0; i < receivers.size(); ++i) {
        if (receivers[i] == 0) truths.back()[i] = -1;
      }
    }
    const Visibility& truth = truths[static_cast<std::size_t>(frame)];
    result.decibels += decibels(rmse(picture, truth, penumbra_of(truth))) / frames;
    Visibility error(picture.size(), -2);
    int pairs = 0;
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      if (truth[i] < 0) continue;
      error[i] = picture[i] - truth[i];
      if (frame == 0 || last[i] == -2) continue;
      sum += std::abs(error[i] - last[i]);
      ++pairs;
    }
    if (frame > 0) result.flicker += sum / pairs / (frames - 1);
    last = error;
  }
  std::printf("%s.glb 320x180 under %g degrees, the camera circles, %s: %.2f dB in the penumbra, flicker %.5f\n",
              path.scene.c_str(), path.sun_angle, preset.c_str(), result.decibels, result.flicker);
  return result;
}

// The ground is seen at a grazing angle, so that penumbrae are narrower in the picture than their width makes them
// where they face the camera.
TEST_F(ShadowHistory, OnACameraPathHistoryDoesNotBlurGrazingPenumbrae) {
  Path path{.scene = "posts", .sun_angle = 8, .truths = {}};
  const OnPath with = on_path(path, "slices_history"), without = on_path(path, "slices_denoised"),
               thesis = on_path(path, "thesis");
  EXPECT_GT(with.decibels, without.decibels + 0.2);
  EXPECT_LT(with.flicker, without.flicker);
  EXPECT_LT(with.flicker, thesis.flicker);
  // A filter that leaves more noise shows what the history removes.
  const std::vector<std::string> separable{"filter.visibility=bilateral_separable", "filter.taps=6"};
  EXPECT_GT(on_path(path, "slices_history", separable).decibels,
            on_path(path, "slices_denoised", separable).decibels + 0.3);
}

// Where some of the four pixels that are read show other surfaces, the others lie to one side of the receiver's last
// position. A history that is read from there frame after frame moves the shadow.
TEST_F(ShadowHistory, OnACameraPathPastManyEdgesHistoryCostsNothing) {
  Path path{.scene = "courtyard", .sun_angle = 0.53f, .truths = {}};
  const OnPath with = on_path(path, "slices_history"), without = on_path(path, "slices_denoised");
  EXPECT_GT(with.decibels, without.decibels - 0.05);
  EXPECT_LT(with.flicker, 1.02 * without.flicker);
}

// Receivers that keep their history within some pixels of one that shows what the last frame did not.
std::vector<std::size_t> beside_disocclusions(const std::vector<float>& refusals, const Visibility& picture,
                                              int width) {
  constexpr int reach = 8;
  const int height = static_cast<int>(refusals.size()) / width;
  std::vector<bool> near(refusals.size());
  for (int y = reach; y < height - reach; ++y) {
    for (int x = reach; x < width - reach; ++x) {
      if (refusals[static_cast<std::size_t>(y * width + x)] != HISTORY_OTHER_SURFACE) continue;
      for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) near[static_cast<std::size_t>((y + j) * width + x + i)] = true;
      }
    }
  }
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i] && refusals[i] == HISTORY_KEPT && picture[i] >= 0) pixels.push_back(i);
  }
  return pixels;
}

TEST_F(ShadowHistory, PixelsKeepTheirHistoryWhileTheCameraMovesAndDisocclusionsTrailNothing) {
  SceneRun run("courtyard", 480, 270);
  run.choose("thesis");
  run.params().set("cascades.size", 1024);
  std::array<int, 5> count{};
  Visibility picture = run.draw(/*cut=*/true);
  for (int frame = 0; frame < 12; ++frame) {
    walk(run.camera());
    picture = run.draw();
    for (const float refusal : run.read_aov("history")) {
      if (refusal >= 0) ++count.at(static_cast<std::size_t>(refusal));
    }
  }
  EXPECT_EQ(count[HISTORY_NONE], 0);
  EXPECT_EQ(count[HISTORY_CASTER_MOVED], 0);
  EXPECT_GT(count[HISTORY_OFF_SCREEN], 0);
  EXPECT_GT(count[HISTORY_OTHER_SURFACE], 0);
  const double on_screen = count[HISTORY_KEPT] + count[HISTORY_OTHER_SURFACE];
  EXPECT_GE(count[HISTORY_KEPT], 0.9 * on_screen);

  const Visibility reference = run.draw_reference();
  const std::vector<std::size_t> beside = beside_disocclusions(run.read_aov("history"), picture, run.width());
  const double moving = mean_error(picture, reference, beside);
  run.params().set("pcss.disocclusion_taps", 16);  // as many as where a history is kept
  const double fresh = mean_error(run.draw(/*cut=*/true), reference, beside);
  EXPECT_LE(moving, 1.25 * fresh);
  std::printf(
      "courtyard.glb 480x270, 0.8 degrees and 4 cm a frame: %.2f %% of the pixels that were on screen keep their ",
      100 * count[HISTORY_KEPT] / on_screen);
  std::printf("history; beside disocclusions the mean error is %.4f, without a history %.4f\n", moving, fresh);
}

TEST_F(ShadowHistory, TheFrameAfterACutIsThatOfARunThatStartsThere) {
  for (const char* preset : {"thesis", "thesis_compute"}) {
    SceneRun run("moving", 237, 131);
    run.choose(preset);
    run.params().set("cascades.size", 512);
    for (int frame = 0; frame < 5; ++frame) {
      run.time() = frame / 30.0;
      walk(run.camera());
      run.draw(/*cut=*/frame == 0);
    }
    run.time() = 1.3;
    walk(run.camera());
    SceneRun fresh("moving", 237, 131);
    fresh.choose(preset);
    fresh.params().set("cascades.size", 512);
    fresh.camera() = run.camera();
    fresh.time() = run.time();
    EXPECT_EQ(run.draw(/*cut=*/true), fresh.draw());
    run.time() = fresh.time() += 1 / 30.0;
    EXPECT_EQ(run.draw(), fresh.draw()) << "and so on";
  }
}

}  // namespace
}  // namespace penumbra::test
