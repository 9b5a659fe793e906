// What the status line says of a picture that is not finished.
#include "viewer/progress.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

using viewer::text_of;

TEST(ViewerProgress, APictureOfOneFrameIsDrawn) {
  EXPECT_EQ(text_of({.frames = 0, .wanted = 1}), "drawing");
  EXPECT_EQ(text_of({.frames = 0, .wanted = 1, .began = true}), "drawing");
}

TEST(ViewerProgress, ShadowsOfAllSamplesComeLast) {
  EXPECT_EQ(text_of({.frames = 0, .wanted = 1, .refines = true}), "drawing");
  EXPECT_EQ(text_of({.frames = 1, .wanted = 1, .refines = true}), "smoothing shadows");
  EXPECT_EQ(text_of({.frames = 2, .wanted = 1, .refines = true}), "drawing") << "the other picture";
}

TEST(ViewerProgress, AHistoryThatBeginsAnewSaysSoAndThenCounts) {
  EXPECT_EQ(text_of({.frames = 0, .wanted = 32}), "history reset");
  EXPECT_EQ(text_of({.frames = 0, .wanted = 32, .began = true}), "history reset");
  EXPECT_EQ(text_of({.frames = 1, .wanted = 32, .began = true}), "history reset, accumulating 1/32");
  EXPECT_EQ(text_of({.frames = 1, .wanted = 32}), "accumulating 1/32");
  EXPECT_EQ(text_of({.frames = 40, .wanted = 32}), "accumulating 32/32");
}

}  // namespace
}  // namespace penumbra
