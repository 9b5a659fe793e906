// Each frame's times are added to the picture that it was drawn for, however late they arrive.
#include "gl/api.h"
#include "gl_pass.h"
#include "viewer/costs.h"

namespace penumbra {
namespace {

class ViewerCostReader : public test::GpuTest {
 protected:
  static void frame(gl::Device& timed, std::string_view pass) {
    timed.timers.begin_frame();
    test::clear(timed, {.name = pass});
    timed.timers.end_frame();
  }
  static std::vector<std::string> names(const viewer::Costs& costs) {
    std::vector<std::string> names;
    for (const viewer::Costs::Pass& pass : costs.passes()) names.push_back(pass.name);
    return names;
  }
};

TEST_F(ViewerCostReader, FramesGoToTheirOwnPicture) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(test::pass_files(), mode);
    viewer::Costs a, b;
    viewer::CostReader reader;
    for (int turn = 0; turn < 6; ++turn) {
      reader.start(timed.timers, b);
      frame(timed, "of b");
      reader.start(timed.timers, a);
      frame(timed, "of a");
      if (turn % 2 == 0) continue;  // the times of several turns may arrive at once
      gl::glFinish();
      reader.read(timed.timers, turn);
    }
    EXPECT_EQ(names(a), (std::vector<std::string>{"of a"}));
    EXPECT_EQ(names(b), (std::vector<std::string>{"of b"}));
    EXPECT_EQ(a.history().size(), 6u);
    EXPECT_EQ(b.history().size(), 6u);
    EXPECT_GT(a.frame(), 0);
    reader.read(timed.timers, 7);
    EXPECT_EQ(a.history().size(), 6u) << "counted twice";
  }
}

TEST_F(ViewerCostReader, OneStartIsForAllFramesUntilTheNext) {
  gl::Device timed(test::pass_files(), gl::Timers::Mode::finish);
  viewer::Costs a, b;
  viewer::CostReader reader;
  frame(timed, "nobody's");
  reader.start(timed.timers, a);
  for (int i = 0; i < 3; ++i) {
    frame(timed, "of a");
    reader.read(timed.timers, i);
  }
  reader.start(timed.timers, b);
  frame(timed, "of b");
  reader.read(timed.timers, 3);
  EXPECT_EQ(a.history().size(), 3u);
  EXPECT_EQ(b.history().size(), 1u);
}

TEST_F(ViewerCostReader, AFrameThatFailedIsNobodys) {
  gl::Device timed(test::pass_files(), gl::Timers::Mode::finish);
  viewer::Costs a, b;
  viewer::CostReader reader;
  reader.start(timed.timers, b);
  timed.timers.begin_frame();  // an exception ends it
  reader.start(timed.timers, a);
  frame(timed, "of a");
  reader.read(timed.timers, 0);
  EXPECT_EQ(a.history().size(), 1u);
  EXPECT_TRUE(b.history().empty());
}

}  // namespace
}  // namespace penumbra
