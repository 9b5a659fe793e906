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
}

}  // namespace
}  // namespace penumbra
