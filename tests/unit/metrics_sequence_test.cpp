// Flicker, ghosts and recovery on sequences for which the results are known.

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "metrics/sequence.h"
#include "support/pictures.h"

namespace penumbra::metrics {
namespace {

using test::Grey;

constexpr int side = 10;
const Grey lit(side, side, 1.0f), dark(side, side, 0.0f);

Grey even(float value) { return {side, side, value}; }

TEST(Flicker, IsTheChangeOfTheError) {
  SequenceMetrics metrics;
  for (int frame = 0; frame < 10; ++frame) metrics.add(even(frame % 2 == 0 ? 0.5f : 0.75f), even(0.5f));
  EXPECT_NEAR(metrics.figures().flicker, 0.25, 1e-6);
  EXPECT_EQ(metrics.figures().flicker_pixels, 9u * side * side);
  EXPECT_EQ(metrics.figures().frames, 10u);
}

TEST(Flicker, IsNeitherAnErrorThatStaysNorAChangeThatTheReferenceMakes) {
  SequenceMetrics metrics;
  for (int frame = 0; frame < 10; ++frame)
    metrics.add(even(0.0625f * static_cast<float>(frame) + 0.25f), even(0.0625f * static_cast<float>(frame)));
  EXPECT_EQ(metrics.figures().flicker, 0);
}

TEST(Flicker, SkipsCutsAndPixelsThatWereNoReceivers) {
  SequenceMetrics cut;
  cut.add(lit, lit);
  cut.add(dark, lit, {}, Event::cut);
  EXPECT_EQ(cut.figures().flicker_pixels, 0u);
  EXPECT_TRUE(std::isnan(cut.figures().flicker));

  SequenceMetrics moving;
  std::vector<std::uint8_t> left(side * side, 1), right(side * side, 1);
  left[0] = right[1] = 0;
  moving.add(lit, lit, left);
  moving.add(dark, lit, right);
  EXPECT_EQ(moving.figures().flicker_pixels, side * side - 2u);
}

TEST(Ghost, IsTheErrorWhereTheShadowWasWithinEightFrames) {
  // A column in shadow in frame 0; the test keeps it dark for ever.
  Grey shadow = lit;
  for (int y = 0; y < side; ++y) shadow.at(3, y) = 0;
  for (const int frames : {1, 8, 20}) {
    SequenceMetrics metrics;
    metrics.add(shadow, shadow);
    for (int frame = 0; frame < frames; ++frame) metrics.add(shadow, lit);
    EXPECT_EQ(metrics.figures().ghost, 1) << frames;
    EXPECT_EQ(metrics.figures().ghost_pixels, static_cast<std::size_t>(side * std::min(frames, 8))) << frames;
  }
}

TEST(Ghost, IsNoneWhereTheTestFollows) {
  SequenceMetrics metrics;
  for (const Grey& now : {dark, lit, lit, dark, lit}) metrics.add(now, now);
  EXPECT_EQ(metrics.figures().ghost, 0);
  EXPECT_EQ(metrics.figures().ghost_pixels, 3u * side * side);
}

TEST(Ghost, NeedsAShadowBeforeAndFullLightNow) {
  SequenceMetrics metrics;
  metrics.add(even(0.5f), even(0.5f));  // a penumbra's middle is no shadow yet
  metrics.add(dark, lit);
  EXPECT_EQ(metrics.figures().ghost_pixels, 0u);
  EXPECT_TRUE(std::isnan(metrics.figures().ghost));
  metrics.add(dark, dark);
  metrics.add(dark, even(0.98f));
  EXPECT_EQ(metrics.figures().ghost_pixels, 0u);
  metrics.add(dark, lit, {}, Event::cut);
  EXPECT_EQ(metrics.figures().ghost_pixels, 0u) << "what was before a cut leaves no ghost";
}

TEST(Recovery, IsTheFramesUntilTheErrorStaysNearTheOneAtRest) {
  const std::vector<double> errors{0.5, 0.25, 0.02, 0.3, 0.013, 0.01, 0.01};
  EXPECT_EQ(recovery_frames(errors, 0.01), 4u);
  EXPECT_EQ(recovery_frames(errors, 0.3, 0.1), 1u);
  EXPECT_EQ(recovery_frames(errors, 0.6), 0u);
  EXPECT_EQ(recovery_frames(errors, 0.001), std::nullopt);
  EXPECT_EQ(recovery_frames({}, 0), std::nullopt);
}

TEST(Recovery, AfterACut) {
  // The error halves with each frame down to 0.125: 1/2 + 1/8, 1/4 + 1/8 …; within 1/255 once 2^-k is.
  SequenceMetrics metrics;
  for (int frame = 0; frame < 5; ++frame) metrics.add(lit, lit);
  for (int frame = 0; frame < 30; ++frame)
    metrics.add(even(0.125f + std::ldexp(0.5f, -frame)), dark, {}, frame == 0 ? Event::cut : Event::none);
  const SequenceFigures figures = metrics.figures();
  ASSERT_EQ(figures.recoveries.size(), 1u);
  EXPECT_EQ(figures.recoveries[0].frame, 5u);
  EXPECT_EQ(figures.recoveries[0].event, Event::cut);
  EXPECT_EQ(figures.recoveries[0].frames, 7u) << "2^-8 is under 1/255";
  EXPECT_NEAR(figures.recoveries[0].static_error, 0.125, 1e-6);
}

TEST(Recovery, AfterAStopLooksWhereTheShadowMoved) {
  // A shadow's edge moves by one column per frame; columns that it has left stay dark for 3 more frames. Column 0 is
  // wrong
  // in every frame.
  SequenceMetrics metrics;
  const auto shadow = [](int edge) { return Grey(40, 10, [=](int x, int) { return x < edge ? 0 : 1; }); };
  const auto shown = [&](int edge) {
    Grey picture = shadow(edge);
    for (int y = 0; y < 10; ++y) picture.at(0, y) = 1;
    return picture;
  };
  for (int frame = 0; frame <= 12; ++frame)
    metrics.add(shown(30 - std::max(frame - 3, 0)), shadow(30 - frame), {}, frame == 12 ? Event::stop : Event::none);
  for (int frame = 1; frame <= 20; ++frame) metrics.add(shown(18 + std::max(3 - frame, 0)), shadow(18));
  metrics.add(shown(18), shadow(18), {}, Event::start);
  for (int frame = 0; frame < 20; ++frame) metrics.add(shown(10), shadow(18));
  const SequenceFigures figures = metrics.figures();
  ASSERT_EQ(figures.recoveries.size(), 1u);
  EXPECT_EQ(figures.recoveries[0].frame, 12u);
  EXPECT_EQ(figures.recoveries[0].event, Event::stop);
  EXPECT_EQ(figures.recoveries[0].frames, 3u);
  EXPECT_EQ(figures.recoveries[0].static_error, 0) << "of the region alone";
}

// Each column of the picture changes at another frame, and has an error of its own from then on.
TEST(Recovery, AfterAStopLooksEightFramesBackAndTheStopIsOneOfThem) {
  for (const int ago : {0, 7, 8}) {
    SequenceMetrics metrics;
    const int changes = 12 - ago;
    for (int frame = 0; frame <= 12 + 20; ++frame) {
      // Column 0 changes at the frame of the stop and is right; column 1 changes `ago` frames before.
      const auto reference = [=](int x, int /*y*/) {
        return (x == 0 && frame >= 12) || (x == 1 && frame >= changes) ? 0 : 1;
      };
      Grey shown(side, side, reference);
      for (int y = 0; y < side; ++y) shown.at(1, y) = 0.5f;
      metrics.add(shown, Grey(side, side, reference), {}, frame == 12 ? Event::stop : Event::none);
    }
    EXPECT_EQ(metrics.figures().recoveries.at(0).static_error, ago < 8 ? 0.25 : 0.0) << ago;
  }
}

TEST(Recovery, AfterAStopLooksAtPixelsThatBecameReceivers) {
  SequenceMetrics metrics;
  std::vector<std::uint8_t> receivers(side * side, 1);
  for (const bool there : {false, true}) {
    receivers[0] = there ? 1 : 0;
    for (int frame = 0; frame < (there ? 17 : 3); ++frame)
      metrics.add(lit, dark, receivers, there && frame == 1 ? Event::stop : Event::none);
  }
  EXPECT_EQ(metrics.figures().recoveries.at(0).static_error, 1) << "as dark as what is no receiver, but a change";
}

TEST(Recovery, TheFirstFrameAndThatOfACutAreNoChange) {
  for (const bool cut : {false, true}) {
    SequenceMetrics metrics;
    if (cut) metrics.add(dark, dark);
    metrics.add(lit, lit, {}, cut ? Event::cut : Event::none);
    for (int frame = 0; frame < 20; ++frame) metrics.add(dark, lit, {}, frame == 0 ? Event::stop : Event::none);
    EXPECT_TRUE(std::isnan(metrics.figures().recoveries.back().static_error)) << "nothing moved before the stop";
  }
}

TEST(Recovery, IsToldFromSixteenFramesThatOfTheEventIncluded) {
  for (const auto event : {Event::cut, Event::stop}) {
    for (const int frames : {15, 16}) {
      SequenceMetrics metrics;
      metrics.add(dark, dark);
      for (int frame = 0; frame < frames; ++frame) metrics.add(lit, lit, {}, frame == 0 ? event : Event::none);
      EXPECT_EQ(metrics.figures().recoveries.at(0).frames.has_value(), frames == 16) << frames;
    }
  }
}

TEST(Recovery, IsNotToldFromTooFewFramesOrAnEmptyRegion) {
  SequenceMetrics metrics;
  metrics.add(lit, lit);
  for (int frame = 0; frame < 15; ++frame) metrics.add(lit, dark, {}, frame == 0 ? Event::cut : Event::none);
  EXPECT_EQ(metrics.figures().recoveries.at(0).frames, std::nullopt);
  for (int frame = 0; frame < 20; ++frame) metrics.add(lit, dark, {}, frame == 0 ? Event::stop : Event::none);
  EXPECT_EQ(metrics.figures().recoveries.at(1).frames, std::nullopt) << "nothing had moved";
}

TEST(Sequence, CountsValuesThatAreNoNumbers) {
  SequenceMetrics metrics;
  metrics.add(dark, dark);
  metrics.add(even(std::numeric_limits<float>::quiet_NaN()), dark);
  EXPECT_EQ(metrics.figures().not_finite, side * side + 0u);
  EXPECT_EQ(metrics.figures().flicker, 1);
}

TEST(Sequence, RefusesAnotherSizeAndColours) {
  SequenceMetrics metrics;
  metrics.add(lit, lit);
  const Grey small(2, 2, 0.0f), empty(0, 0, 0.0f);
  EXPECT_THROW(metrics.add(small, small), Error);
  const std::vector<float> rgb(3);
  EXPECT_THROW(metrics.add({1, 1, rgb, 3}, {1, 1, rgb, 3}), Error);
  EXPECT_EQ(metrics.figures().frames, 1u) << "a frame that is refused leaves no trace";
  SequenceMetrics nothing;
  nothing.add(empty, empty);
  nothing.add(empty, empty);
  EXPECT_TRUE(std::isnan(nothing.figures().flicker));
}

}  // namespace
}  // namespace penumbra::metrics
