#include "gl/pass.h"

#include <algorithm>
#include <numeric>

#include "gl/api.h"
#include "gl_pass.h"

namespace penumbra {
namespace {

using test::color_program;

class GlTimers : public test::GlPassTest {
 protected:
  static double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

  void frames(gl::Device& timed, int count) {
    for (int i = 0; i < count; ++i) {
      timed.timers.begin_frame();
      for (const char* name : {"first", "second", "first"}) {
        const gl::Pass outer(timed, {.name = name});
        const gl::Texture& target = timed.target("t", {.format = GL_RGBA32F, .width = 256, .height = 256});
        gl::Pass pass(timed, {.name = "inner", .colors = {{.texture = &target}}});
        pass.use(color_program);
        pass.draw_full_screen();
      }
      timed.timers.end_frame();
    }
  }
};

TEST_F(GlTimers, RowsNestInOrderAndPassesFillTheFrameWithoutExceedingIt) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    frames(timed, 4);
    const auto rows = timed.timers.rows();
    std::vector<std::string> names(rows.size());
    std::ranges::transform(rows, names.begin(), &gl::Timers::Row::name);
    ASSERT_EQ(names, (std::vector<std::string>{"first", "first/inner", "second", "second/inner", "frame"}));
    for (const auto& row : rows) EXPECT_EQ(row.milliseconds.size(), 4u) << row.name;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LE(rows[1].milliseconds[i], rows[0].milliseconds[i]);
      EXPECT_LE(rows[0].milliseconds[i] + rows[2].milliseconds[i], rows[4].milliseconds[i]);
    }
    EXPECT_GT(sum(rows[1].milliseconds), 0.0);
  }
}

TEST_F(GlTimers, WhereOnlyFramesAreFinishedNoPassHasATime) {
  gl::Device timed(test::pass_files(), gl::Timers::Mode::finish_frames);
  static PFNGLFINISHPROC real = nullptr;
  static int finishes = 0;
  real = gl::current_api->glFinish;
  finishes = 0;
  gl::current_api->glFinish = [] {
    ++finishes;
    real();
  };
  frames(timed, 3);
  gl::current_api->glFinish = real;
  const auto rows = timed.timers.rows();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].name, "frame");
  EXPECT_EQ(rows[0].milliseconds.size(), 3u);
  EXPECT_GT(sum(rows[0].milliseconds), 0.0);
  EXPECT_EQ(finishes, 6);
}

TEST_F(GlTimers, TheCpusTimeOfAFrameIsThatOfTheThreadAndLeavesOutWaiting) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    frames(timed, 1);     // compiles the shaders
    timed.timers.rows();  // waits for its times, so that take() removes this frame
    timed.timers.take();
    static PFNGLFINISHPROC real = nullptr;
    real = gl::current_api->glFinish;
    gl::current_api->glFinish = [] {
      volatile double waste = 1;
      for (int i = 0; i < 1000000; ++i) waste = waste * 1.0000001;
      real();
    };
    frames(timed, 3);
    gl::current_api->glFinish = real;
    const std::vector<double> cpu = timed.timers.cpu_milliseconds();
    const auto rows = timed.timers.rows();
    ASSERT_EQ(cpu.size(), 3u);
    for (const double milliseconds : cpu) EXPECT_GT(milliseconds, 0.0);
    if (mode != gl::Timers::Mode::finish) continue;
    // A frame has a dozen calls of glFinish(), which take most of its time.
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(cpu[i], 0.5 * rows.back().milliseconds[i]);
  }
}

TEST_F(GlTimers, TakenFramesTakeTheirTimesOfTheCpuAlong) {
  gl::Device timed(test::pass_files(), gl::Timers::Mode::finish);
  frames(timed, 3);
  EXPECT_EQ(timed.timers.take().cpu.size(), 3u);
  EXPECT_TRUE(timed.timers.cpu_milliseconds().empty());
  frames(timed, 2);
  EXPECT_EQ(timed.timers.cpu_milliseconds().size(), 2u);
}

TEST_F(GlTimers, WhatIsDrawnOutsideOfAFrameIsNotRecorded) {
  gl::Device timed(test::pass_files(), gl::Timers::Mode::finish);
  test::clear(timed, {.name = "warm-up"});
  frames(timed, 1);
  for (const auto& row : timed.timers.rows()) EXPECT_NE(row.name, "warm-up");
}

TEST_F(GlTimers, AFrameThatAnExceptionLeftOpenIsDropped) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    frames(timed, 1);
    timed.timers.begin_frame();
    test::clear(timed, {.name = "aborted"});
    frames(timed, 2);
    for (const auto& row : timed.timers.rows()) {
      EXPECT_EQ(row.milliseconds.size(), 3u) << row.name;
      EXPECT_EQ(sum(row.milliseconds) > 0.0, row.name != "aborted") << row.name;
    }
  }
}

TEST_F(GlTimers, OffRecordsNothing) {
  frames(device, 2);
  EXPECT_TRUE(device.timers.rows().empty());
  EXPECT_TRUE(device.timers.take().rows.empty());
}

TEST_F(GlTimers, FramesAreTakenOnceAndInOrder) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    EXPECT_TRUE(timed.timers.take().rows.empty());
    std::size_t taken = 0;
    for (const int count : {1, 3, 2}) {
      EXPECT_EQ(timed.timers.next_frame(), taken);
      frames(timed, count);
      gl::glFinish();  // so that nothing is outstanding
      const gl::Timers::Taken next = timed.timers.take();
      EXPECT_EQ(next.first, taken);
      ASSERT_EQ(next.rows.size(), 5u);
      EXPECT_EQ(next.rows.front().name, "first");
      EXPECT_EQ(next.rows.back().name, "frame");
      for (const auto& row : next.rows) EXPECT_EQ(row.milliseconds.size(), static_cast<std::size_t>(count)) << row.name;
      EXPECT_GT(sum(next.rows.back().milliseconds), 0.0);
      taken += static_cast<std::size_t>(count);
      EXPECT_TRUE(timed.timers.take().rows.empty()) << "taken twice";
    }
  }
}

TEST_F(GlTimers, TakenTimesAreThoseOfTheirFrames) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    for (const char* name : {"early", "late", "early"}) {
      timed.timers.begin_frame();
      const gl::Texture& target = timed.target("t", {.format = GL_RGBA32F, .width = 256, .height = 256});
      test::clear(timed, {.name = name, .colors = {{.texture = &target, .clear = glm::vec4(1)}}});
      timed.timers.end_frame();
    }
    gl::glFinish();
    const gl::Timers::Taken taken = timed.timers.take();
    ASSERT_EQ(taken.rows.size(), 3u);
    const std::vector<double>&early = taken.rows[0].milliseconds, &late = taken.rows[1].milliseconds;
    EXPECT_EQ((std::vector{early[0] > 0, early[1] > 0, early[2] > 0}), (std::vector{true, false, true}));
    EXPECT_EQ((std::vector{late[0] > 0, late[1] > 0, late[2] > 0}), (std::vector{false, true, false}));
  }
}

TEST_F(GlTimers, RowsHaveOnlyWhatWasNotTaken) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    frames(timed, 3);
    gl::glFinish();
    EXPECT_EQ(timed.timers.take().rows.front().milliseconds.size(), 3u);
    for (const auto& row : timed.timers.rows()) EXPECT_TRUE(row.milliseconds.empty()) << row.name;
    frames(timed, 2);
    for (const auto& row : timed.timers.rows()) EXPECT_EQ(row.milliseconds.size(), 2u) << row.name;
    EXPECT_EQ(timed.timers.take().first, 3u) << "rows() takes nothing";
    EXPECT_EQ(timed.timers.next_frame(), 5u);
  }
}

TEST_F(GlTimers, WorkIsThatOfTheLastFrameByPass) {
  gl::Device timed(test::pass_files(), gl::Timers::Mode::query);
  const gl::Texture& drawn = timed.target("c", {.format = GL_RGBA32F, .width = 4, .height = 4});
  const gl::Texture& filled =
      timed.target("f", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 8, .height = 8, .layers = 2});
  const auto frame = [&](int draws, int dispatches) {
    timed.timers.begin_frame();
    {
      gl::Pass outer(timed, {.name = "outer", .colors = {{.texture = &drawn}}});
      outer.use(test::color_program).set("value", glm::vec4(1));
      for (int i = 0; i < draws; ++i) outer.draw_full_screen();
      outer.count_draws(3, 500);
      gl::Pass inner(timed, {.name = "inner"});
      inner.use(test::fill_program);
      gl::glBindImageTexture(0, filled.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
      for (int i = 0; i < dispatches; ++i) inner.dispatch(8, 8, 2);
    }
    test::clear(timed, {.name = "idle"});
    timed.timers.end_frame();
  };
  frame(7, 7);
  frame(2, 1);
  const auto& work = timed.timers.work();
  ASSERT_EQ(work.size(), 3u);
  EXPECT_EQ(work.at("outer").draws, 5u);
  EXPECT_EQ(work.at("outer").triangles, 502u);
  EXPECT_EQ(work.at("outer").dispatches, 1u) << "work of the pass within it";
  EXPECT_EQ(work.at("outer/inner").draws, 0u);
  EXPECT_EQ(work.at("outer/inner").dispatches, 1u);
  EXPECT_EQ(work.at("frame").draws, 5u);
  EXPECT_EQ(work.at("frame").dispatches, 1u);
}

TEST_F(GlTimers, AnOpenFrameIsNotTaken) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    frames(timed, 1);
    timed.timers.begin_frame();
    test::clear(timed, {.name = "first"});
    gl::glFinish();
    const gl::Timers::Taken before = timed.timers.take();
    EXPECT_EQ(before.rows.front().milliseconds.size(), 1u);
    test::clear(timed, {.name = "second"});
    timed.timers.end_frame();
    gl::glFinish();
    const gl::Timers::Taken open = timed.timers.take();
    EXPECT_EQ(open.first, 1u);
    for (const auto& row : open.rows) {
      ASSERT_EQ(row.milliseconds.size(), 1u) << row.name;
      EXPECT_EQ(row.milliseconds[0] > 0, row.name.find('/') == std::string::npos) << row.name;
    }
  }
}

}  // namespace
}  // namespace penumbra
