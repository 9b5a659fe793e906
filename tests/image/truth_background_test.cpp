// The ray-traced truth that frames don't wait for: the picture comes later and is the same.

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <glm/glm.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/pose.h"
#include "support/temp_folder.h"
#include "truth/technique.h"

namespace penumbra::test {
namespace {

using TruthInTheBackground = GpuTest;

constexpr int width = 160, height = 90;
constexpr int few = 64, endless = 16384;  // rays a pixel: the latter take many seconds

// Progress that is held up until the gate is opened, and remembered.
class Gate {
 public:
  explicit Gate(bool open) : open_(open) {}

  bool pass(double share) {
    std::unique_lock lock(mutex_);
    ++calls_;
    finished_ += share == 1 ? 1 : 0;
    changed_.notify_all();
    changed_.wait(lock, [&] { return open_; });
    return true;
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void wait_for_call() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return calls_ > 0; });
  }
  int calls() {
    const std::lock_guard lock(mutex_);
    return calls_;
  }
  int finished() {
    const std::lock_guard lock(mutex_);
    return finished_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_;
  int calls_ = 0, finished_ = 0;
};

truth::TechniqueOptions in_background(Gate& gate) {
  return {.cache = {}, .progress = [&gate](double share) { return gate.pass(share); }, .background = true};
}

// A scene that renderers draw by `truth`.
class Stage {
 public:
  Stage() {
    scene_ = scene::read_gltf(std::filesystem::path(PENUMBRA_ROOT) / "scenes/posts.glb", image::image_decoder());
    setup_ = render::choose_setup(scene_, scene::pose_at(scene_, 0),
                                  {"", render::GroundChoice::automatic, static_cast<float>(width) / height});
    gpu_scene_.emplace(device_, scene_);
  }

  render::Renderer renderer(const truth::TruthTechnique& truth) { return render::Renderer(device_, truth.registry()); }
  render::SunLight& sun() { return setup_.sun; }

  // Draws with a second sun, from another direction, from now on.
  void add_sun() {
    second_ = render::SunLight{.to_light = render::direction_to(2.0f, 0.9f), .illuminance = glm::vec3(2e4f)};
  }

  void draw(render::Renderer& renderer, int rays, int view = 0) {
    ParamSet params(render::Renderer::params(renderer.registry()));
    params.set("sun.angle", 4.0f);
    renderer.registry().select(params, "truth");
    params.set("truth.samples", rays);
    render::FrameInputs inputs{.width = width,
                               .height = height,
                               .view = view,
                               .camera = setup_.camera,
                               .last_camera = setup_.camera,
                               .lights = {setup_.sun}};
    if (second_) inputs.lights.emplace_back(*second_);
    renderer.draw(*gpu_scene_, inputs, params);
  }
  void draw_until_there(render::Renderer& renderer, int rays, const truth::TruthTechnique& truth) {
    draw(renderer, rays);
    wait(truth);
    draw(renderer, rays);
    EXPECT_FALSE(truth.pending());
  }
  static void wait(const truth::TruthTechnique& truth) {
    while (truth.pending()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void leave_scene() {
    gpu_scene_.reset();
    scene_ = {};
  }

 private:
  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  scene::Scene scene_;
  render::Setup setup_;
  std::optional<render::SunLight> second_;
  std::optional<scene::GpuScene> gpu_scene_;
};

// Draws the same frame within itself, and compares mask and figures.
void expect_the_same_as_blocking(Stage& stage, const render::Renderer& renderer, const truth::TruthTechnique& truth) {
  const truth::TruthTechnique blocking({.cache = {}});
  render::Renderer reference = stage.renderer(blocking);
  stage.draw(reference, few);
  EXPECT_FALSE(blocking.pending());
  EXPECT_EQ(renderer.read_aov("shadow"), reference.read_aov("shadow"));
  EXPECT_EQ(truth.last().traced.visibility, blocking.last().traced.visibility);
  EXPECT_EQ(truth.last().traced.standard_error, blocking.last().traced.standard_error);
  EXPECT_EQ(truth.last().traced.hard, blocking.last().traced.hard);
  EXPECT_EQ(truth.last().receiver, blocking.last().receiver);
}

TEST_F(TruthInTheBackground, ComesLaterAndIsTheSame) {
  Stage stage;
  Gate gate(/*open=*/false);
  const truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  double share = 0;
  for (int frame = 0; frame < 3; ++frame) {
    stage.draw(renderer, few);
    const auto pending = truth.pending();
    const double done = pending ? pending->share_done : -1;
    EXPECT_GE(done, share);
    EXPECT_LE(done, 1);
    share = done;
  }
  EXPECT_TRUE(truth.last().traced.visibility.empty());
  gate.open();
  stage.draw_until_there(renderer, few, truth);
  EXPECT_EQ(gate.finished(), 1);
  EXPECT_TRUE(truth.last().build);
  expect_the_same_as_blocking(stage, renderer, truth);
  stage.draw(renderer, few);  // what is there stays
  EXPECT_FALSE(truth.pending());
  EXPECT_EQ(gate.finished(), 1);
}

TEST_F(TruthInTheBackground, ShowsAllThatFacesTheSunMeanwhile) {
  Stage stage;
  Gate gate(/*open=*/true);
  truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  stage.draw(renderer, endless);
  const std::vector<float> mask = renderer.read_aov("shadow");
  const std::vector<float> depth = renderer.read_aov("depth");
  const std::vector<float> normals = renderer.read_aov("geometric_normal");
  int lit = 0, behind = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float cosine =
        glm::dot(glm::vec3(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), stage.sun().to_light);
    if (depth[i] == 0 || std::abs(cosine) < 0.01f) continue;
    EXPECT_EQ(mask[i], cosine > 0 ? 1.0f : 0.0f) << i;
    (cosine > 0 ? lit : behind) += 1;
  }
  EXPECT_GT(lit, width * height / 10);
  EXPECT_GT(behind, 20);
}

TEST_F(TruthInTheBackground, FollowsTheSunThatMovesMeanwhile) {
  Stage stage;
  Gate gate(/*open=*/false);
  const truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  stage.draw(renderer, endless);
  gate.wait_for_call();
  stage.sun().to_light = render::direction_to(glm::radians(100.0f), glm::radians(50.0f));
  stage.draw(renderer, few);
  EXPECT_TRUE(truth.pending());
  gate.open();
  stage.draw_until_there(renderer, few, truth);
  EXPECT_EQ(gate.finished(), 1);
  expect_the_same_as_blocking(stage, renderer, truth);
}

TEST_F(TruthInTheBackground, TracesTheLightsOfAFrameOneAfterTheOther) {
  Stage stage;
  stage.add_sun();
  Gate gate(/*open=*/false);
  const truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  stage.draw(renderer, few);
  for (int frame = 0; frame < 4 && truth.pending(); ++frame) {
    gate.open();
    Stage::wait(truth);
    stage.draw(renderer, few);
  }
  EXPECT_FALSE(truth.pending());
  EXPECT_EQ(gate.finished(), 2);
  const truth::TruthTechnique blocking({.cache = {}});
  render::Renderer reference = stage.renderer(blocking);
  stage.draw(reference, few);
  EXPECT_EQ(renderer.read_aov("color"), reference.read_aov("color"));
}

TEST_F(TruthInTheBackground, IsUnfinishedUntilAFrameShowsAllLights) {
  Stage stage;
  stage.add_sun();
  Gate gate(/*open=*/false);
  const truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  EXPECT_FALSE(truth.unfinished());
  for (int traced = 0; traced < 2; ++traced) {
    stage.draw(renderer, few);
    EXPECT_TRUE(truth.unfinished());
    gate.open();
    Stage::wait(truth);  // all rays are traced, but no frame has shown them
    EXPECT_TRUE(truth.unfinished());
  }
  stage.draw(renderer, few);
  EXPECT_FALSE(truth.unfinished());
}

TEST_F(TruthInTheBackground, FinishesViewsThatAreDrawnInTurn) {
  Stage stage;
  Gate gate(/*open=*/true);
  const truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  const glm::vec3 first = stage.sun().to_light, second = render::direction_to(2.0f, 0.9f);
  const auto draw_both = [&] {
    for (const glm::vec3& to_light : {first, second}) {
      stage.sun().to_light = to_light;
      stage.draw(renderer, few, to_light == first ? 0 : 1);
    }
  };
  for (int view = 0; view < 2; ++view) {
    draw_both();
    Stage::wait(truth);
  }
  draw_both();
  EXPECT_FALSE(truth.pending());
  EXPECT_EQ(gate.finished(), 2);
}

TEST_F(TruthInTheBackground, StopsBeforeItsSceneGoes) {
  Stage stage;
  Gate gate(/*open=*/true);
  truth::TruthTechnique truth(in_background(gate));
  render::Renderer renderer = stage.renderer(truth);
  stage.draw(renderer, endless);
  gate.wait_for_call();
  truth.stop();
  EXPECT_FALSE(truth.pending());
  EXPECT_EQ(gate.finished(), 0);
  stage.draw_until_there(renderer, few, truth);  // it can go on
  expect_the_same_as_blocking(stage, renderer, truth);
  stage.draw(renderer, endless);
  truth.stop();  // while triangles are looked at, or the first rays traced
  stage.leave_scene();
  EXPECT_FALSE(truth.pending());
}

TEST_F(TruthInTheBackground, StopsWhenItGoes) {
  Stage stage;
  Gate gate(/*open=*/true);
  auto truth = std::make_optional<truth::TruthTechnique>(in_background(gate));
  render::Renderer renderer = stage.renderer(*truth);
  stage.draw(renderer, endless);
  gate.wait_for_call();
  truth.reset();
  const int calls = gate.calls();
  EXPECT_EQ(gate.finished(), 0);
  stage.draw(renderer, few);  // traces within the frame
  EXPECT_EQ(gate.finished(), 1);
  EXPECT_GT(gate.calls(), calls);
}

TEST_F(TruthInTheBackground, TellsTheNextFrameOnceWhatWentWrong) {
  Stage stage;
  int calls = 0;  // read only while nothing is traced
  truth::TruthTechnique truth({.cache = {},
                               .progress =
                                   [&](double) {
                                     if (++calls == 1) fail("it is broken");
                                     return true;
                                   },
                               .background = true});
  render::Renderer renderer = stage.renderer(truth);
  stage.draw(renderer, few);
  Stage::wait(truth);
  EXPECT_EQ(message_of([&] { stage.draw(renderer, few); }), "it is broken");
  stage.draw(renderer, few);
  EXPECT_FALSE(truth.pending());
  EXPECT_EQ(calls, 1);
  truth.stop();
  stage.draw_until_there(renderer, few, truth);
  expect_the_same_as_blocking(stage, renderer, truth);
}

TEST_F(TruthInTheBackground, IsKeptInTheCache) {
  const TempFolder folder;
  Stage stage;
  for (const bool first : {true, false}) {
    const truth::TruthTechnique truth({.cache = folder.path(), .background = true});
    render::Renderer renderer = stage.renderer(truth);
    if (first) {
      stage.draw_until_there(renderer, few, truth);
    } else {
      stage.draw(renderer, few);
    }
    EXPECT_EQ(truth.last().from_cache, !first);
    expect_the_same_as_blocking(stage, renderer, truth);
  }
}

}  // namespace
}  // namespace penumbra::test
