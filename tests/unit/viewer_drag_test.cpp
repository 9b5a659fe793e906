// What a held mouse button moves: nothing while it is a click, and no more than the pointer from then on.
#include "viewer/drag.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

constexpr glm::vec2 none(0), press(300, 200);

viewer::Drag pressed() {
  viewer::Drag drag;
  drag.press(press);
  return drag;
}

TEST(ViewerDrag, AHandThatTremblesWhileItClicksMovesNothing) {
  viewer::Drag drag = pressed();
  for (const glm::vec2 by : {glm::vec2(0, 0), glm::vec2(3, 1), glm::vec2(-2, 3), glm::vec2(0, -4), glm::vec2(1, 1)})
    EXPECT_EQ(drag.move(press + by), none);
}

TEST(ViewerDrag, ItBeginsWithoutAJumpHoweverFarThePointerHasGone) {
  for (const float far : {5.0f, 90.0f}) {
    viewer::Drag drag = pressed();
    EXPECT_EQ(drag.move(press + glm::vec2(far, 0)), none);
    EXPECT_EQ(drag.move(press + glm::vec2(far + 7, -2)), glm::vec2(7, -2));
    EXPECT_EQ(drag.move(press), glm::vec2(-far - 7, 2)) << "back to where it began is a drag too";
  }
}

TEST(ViewerDrag, MotionCountsOnlyWhileTheButtonIsDown) {
  viewer::Drag drag;
  EXPECT_EQ(drag.move({10, 10}), none);
  EXPECT_EQ(drag.move({90, 10}), none);
  drag.press(press);
  drag.move({0, 0});
  drag.release();
  EXPECT_EQ(drag.move({50, 50}), none);
  drag.press(press);
  EXPECT_EQ(drag.move(press + glm::vec2(2, 0)), none) << "the next press is a click again";
}

}  // namespace
}  // namespace penumbra
