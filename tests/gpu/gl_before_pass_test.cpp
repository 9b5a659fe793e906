// What a program does before each pass of a frame changes nothing in the frame.
#include <cstdint>
#include <ctime>
#include <functional>
#include <vector>

#include "gl/api.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

class BeforePass : public RenderTest {
 protected:
  BeforePass() {
    add_node(scene_, square(), glm::mat4(1));
    add_node(scene_, square(), glm::scale(glm::translate(glm::mat4(1), {0, 0, 1}), glm::vec3(0.25f)));
    scene_.materials = {{.name = "glass", .alpha_mode = scene::AlphaMode::blend}};
    scene::Primitive pane = square();
    pane.material = 0;
    add_node(scene_, pane, glm::scale(glm::translate(glm::mat4(1), {0.5f, 0, 1.5f}), glm::vec3(0.25f)));
    params.set("cascades.size", 64);
    params.set("sun.angle", 4.0f);
    inputs.samples = 2;
  }

  // The second of two frames, so that there is a history.
  std::vector<std::uint8_t> picture(const std::function<void()>& before_pass) {
    renderer.forget_view(inputs.view);
    draw(scene_);
    device.before_pass = before_pass;
    renderer.draw(*gpu_scene, inputs, params);
    device.before_pass = nullptr;
    return renderer.read_display();
  }

  scene::Scene scene_;
};

// Everything that drawing an interface sets, and more.
void draw_something_else() {
  gl::leave_initial_state();
  gl::glEnable(GL_BLEND);
  gl::glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl::glEnable(GL_SCISSOR_TEST);
  gl::glScissor(1, 2, 3, 4);
  gl::glViewport(0, 0, 5, 6);
  gl::glClearColor(1, 0, 1, 1);
  gl::glActiveTexture(GL_TEXTURE0);
}

TEST_F(BeforePass, WhatItLeavesBehindIsNotSeenInTheFrame) {
  for (const std::string& name : renderer.registry().names()) {
    SCOPED_TRACE(name);
    renderer.registry().select(params, name);
    int calls = 0;
    const std::vector<std::uint8_t> disturbed = picture([&] {
      ++calls;
      draw_something_else();
    });
    EXPECT_GT(calls, 5);
    EXPECT_TRUE(disturbed == picture(nullptr));
  }
}

TEST_F(BeforePass, ALargeMaskIsDrawnInBandsThatJoin) {
  inputs.width = 640;
  inputs.height = 1000;
  inputs.samples = 1;
  for (const char* name : {"pcf", "slices_denoised"}) {
    SCOPED_TRACE(name);
    renderer.registry().select(params, name);
    for (const bool tiles : {false, true}) {
      params.set("mask.tiles", tiles);
      const std::vector<std::uint8_t> joined = picture([] {});
      EXPECT_TRUE(joined == picture(nullptr));
    }
  }
}

TEST_F(BeforePass, APassOfItsOwnDoesNotCallItAgain) {
  int calls = 0, inner = 0;
  const gl::Texture target("own", {.width = 4, .height = 4});
  picture([&] {
    ++calls;
    const gl::Pass own(device, {.name = "own", .colors = {{.texture = &target, .clear = glm::vec4(1)}}});
    inner = calls;
  });
  EXPECT_GT(calls, 5);
  EXPECT_EQ(inner, calls);
}

TEST_F(BeforePass, AFrameThatItEndsLeavesTheNextOneAsItWouldHaveBeen) {
  struct Enough {};
  renderer.registry().select(params, "thesis");
  const std::vector<std::uint8_t> wanted = picture(nullptr);
  bool ended = true;
  for (int last = 1; ended; ++last) {
    SCOPED_TRACE(last);
    int calls = 0;
    ended = false;
    try {
      picture([&] {
        if (++calls == last) throw Enough();
      });
    } catch (const Enough&) {
      ended = true;
    }
    device.before_pass = nullptr;
    // What the view keeps from frame to frame is not forgotten, but a cut ends its history.
    inputs.cut = true;
    renderer.draw(*gpu_scene, inputs, params);
    inputs.cut = false;
    renderer.draw(*gpu_scene, inputs, params);
    EXPECT_TRUE(renderer.read_display() == wanted);
    EXPECT_TRUE(ended || last > 9);
  }
}

class BreakOfTimers : public GpuTest {};

TEST_F(BreakOfTimers, NeitherItsTimeNorItsWorkIsTheFrames) {
  gl::Device device{gl::ShaderFiles(), gl::Timers::Mode::finish};
  const auto waste = [] {
    timespec time{.tv_sec = 0, .tv_nsec = 500'000'000};
    nanosleep(&time, nullptr);
  };
  device.before_pass = [&] {
    const gl::Pass own(device, {.name = "own"});
    device.timers.count({.draws = 7});
    waste();
  };
  device.timers.begin_frame();
  {
    const gl::Pass outer(device, {.name = "outer"});
    const gl::Pass inner(device, {.name = "inner"});
  }
  device.timers.end_frame();
  device.before_pass = nullptr;
  for (const gl::Timers::Row& row : device.timers.rows()) {
    EXPECT_NE(row.name, "own");
    EXPECT_LT(row.milliseconds.at(0), 500) << row.name;
  }
  EXPECT_TRUE(device.timers.work().empty());
}

}  // namespace
}  // namespace penumbra::test
