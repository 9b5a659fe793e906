// When the viewer draws, and at what size: small while the user moves something, at full size once idle, and no more
// frames than are wanted.
#include "viewer/frame_pacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace penumbra {
namespace {

using viewer::Detail;
using viewer::FramePacing;

// Simulates a viewer on a machine that draws the full-size picture in `full_ms` milliseconds.
class Machine {
 public:
  explicit Machine(double full_ms, bool software = true, double beside = 0)
      : pacing(software), full_ms_(full_ms), beside_(beside) {}

  // One turn of the viewer's loop, a fraction of a second after the last.
  FramePacing::Step turn(bool changed, int frames = 0, int wanted = 32, bool ui_active = false) {
    now_ += 0.02;
    const FramePacing::Step step = pacing.next(now_, changed, ui_active, frames, wanted);
    if (step.draw) pacing.drew(step.detail, took(step.detail.picture), beside_);
    return step;
  }
  double took(int divisor) const { return full_ms_ / divisor / divisor; }
  void becomes(double full_ms) { full_ms_ = full_ms; }

  // The divisor of the resolution after a motion of one second.
  int in_motion() {
    int divisor = 0;
    for (int i = 0; i < 50; ++i) divisor = turn(/*changed=*/true).detail.picture;
    return divisor;
  }

  FramePacing pacing;

 private:
  double full_ms_, beside_, now_ = 10;
};

TEST(ViewerPace, AGpuDrawsEveryFrameInFull) {
  Machine machine(500, /*software=*/false);
  for (const bool changed : {true, false, true, false, false}) {
    const FramePacing::Step step = machine.turn(changed, /*frames=*/100, /*wanted=*/1, /*ui_active=*/true);
    EXPECT_TRUE(step.draw);
    EXPECT_TRUE(step.detail.is_full());
  }
}

TEST(ViewerPace, WhatChangesIsDrawnAtOnceAndSmall) {
  Machine machine(800);
  EXPECT_GT(machine.turn(true).detail.picture, 1) << "before anything is known of the machine";
  for (int i = 0; i < 20; ++i) {
    const FramePacing::Step step = machine.turn(true, 0, 1, /*ui_active=*/true);
    EXPECT_TRUE(step.draw);
    EXPECT_GT(step.detail.picture, 1);
  }
}

TEST(ViewerPace, AtRestThePictureIsFullAndDrawnAsOftenAsWanted) {
  Machine machine(300);
  machine.turn(true);
  int waited = 0, frames = 0, drawn = 0;
  while (!machine.turn(false).draw) ASSERT_LT(++waited, 100);
  EXPECT_GT(waited, 3) << "a short pause is not idle";
  EXPECT_LE(0.02 * waited, 0.15) << "seconds from the last change to the full picture";
  for (int i = 0; i < 100; ++i) {
    const FramePacing::Step step = machine.turn(false, frames, 31);
    if (!step.draw) continue;
    EXPECT_TRUE(step.detail.is_full());
    ++frames;
    ++drawn;
  }
  EXPECT_EQ(drawn, 31);
}

TEST(ViewerPace, APictureAtRestBeginsAnewOnceWhateverTheSizeInMotion) {
  for (const double full : {1.0, 300.0}) {
    Machine machine(full);
    machine.in_motion();
    std::vector<bool> restarts;
    for (int i = 0; i < 100; ++i) {
      const FramePacing::Step step = machine.turn(false, static_cast<int>(restarts.size()), 31);
      if (step.draw) restarts.push_back(step.restart);
    }
    ASSERT_EQ(restarts.size(), 31u) << full;
    EXPECT_TRUE(restarts.front());
    EXPECT_EQ(std::count(restarts.begin(), restarts.end(), true), 1);
    EXPECT_FALSE(machine.turn(true).restart);
  }
}

TEST(ViewerPace, AGpuGoesOnWhenMotionEndsAndSaysWhenItRests) {
  Machine machine(1, /*software=*/false);
  int turns = 0;
  EXPECT_FALSE(machine.turn(true).idle);
  for (FramePacing::Step step; !step.idle; ++turns) {
    step = machine.turn(false);
    EXPECT_FALSE(step.restart);
    ASSERT_LT(turns, 100);
  }
  EXPECT_GT(turns, 3);
  EXPECT_FALSE(machine.turn(true).idle);
}

TEST(ViewerPace, AHandAtThePanelIsNotKeptWaitingForFullPictures) {
  Machine machine(300);
  machine.turn(true);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(machine.turn(false, 0, 31, /*ui_active=*/true).draw);
  EXPECT_TRUE(machine.turn(false).draw) << "once no widget is held";
}

TEST(ViewerPace, AChangeEndsTheRest) {
  Machine machine(300);
  machine.turn(true);
  for (int i = 0; i < 50; ++i) machine.turn(false);
  machine.turn(true);
  EXPECT_FALSE(machine.turn(false).draw);
}

TEST(ViewerPace, SlowMachinesDrawSmallerAndFastOnesLarger) {
  int last = 1;
  for (const double full : {1.0, 30.0, 150.0, 600.0, 3000.0, 100000.0}) {
    Machine machine(full);
    const int divisor = machine.in_motion();
    EXPECT_GE(divisor, last) << full;
    EXPECT_LE(divisor, 8);
    last = divisor;
    if (full < 3000) {
      EXPECT_LE(machine.took(divisor), 100) << "too slow to follow the mouse";
    }
    if (divisor > 1) {
      EXPECT_GT(machine.took(divisor / 2), 50) << "smaller than need be";
    }
  }
  EXPECT_EQ(last, 8);
}

TEST(ViewerPace, TheSizeSettles) {
  for (const double beside : {0.0, 30.0, 70.0}) {
    for (double full = 1; full < 20000; full *= 1.1) {
      Machine machine(full, /*software=*/true, beside);
      const int settled = machine.in_motion();
      for (int i = 0; i < 10; ++i) EXPECT_EQ(machine.turn(true).detail.picture, settled) << full;
      // Full-size pictures show the machine's speed as well.
      for (int i = 0; i < 40; ++i) machine.turn(false);
      EXPECT_EQ(machine.turn(true).detail.picture, settled) << full << " beside " << beside;
    }
  }
}

TEST(ViewerPace, AnotherSceneOrTechniqueIsAnotherPace) {
  Machine machine(10);
  EXPECT_EQ(machine.in_motion(), 1);
  machine.becomes(5000);
  EXPECT_EQ(machine.in_motion(), 8);
  machine.becomes(10);
  EXPECT_EQ(machine.in_motion(), 1);
}

// A camera that orbits on a machine that takes some milliseconds for the maps, for what pixels read of them and for the
// rest of a picture, all in full.
class Orbit {
 public:
  Orbit(double maps, double reads, double rest, double beside = 0)
      : maps_(maps), reads_(reads), rest_(rest), beside_(beside) {}

  FramePacing::Step turn(bool changed) {
    now_ += 0.02;
    const FramePacing::Step step = pacing_.next(now_, changed, /*ui_active=*/false, frames_, 1, /*travels=*/true);
    frames_ = changed ? 0 : frames_ + (step.draw ? 1 : 0);
    if (step.draw) pacing_.drew(step.detail, took(step.detail), beside_);
    return step;
  }
  double took(const Detail& detail) const {
    const double pixels = 1.0 / (detail.picture * detail.picture);
    // Fewer cascades, of half the size.
    const double texels = detail.maps == 1 ? 1.0 : 0.25 / detail.maps;
    return maps_ * texels + pixels * (reads_ / detail.reads + rest_);
  }
  void becomes(double maps, double reads, double rest) {
    maps_ = maps;
    reads_ = reads;
    rest_ = rest;
  }
  Detail in_motion() {
    Detail detail;
    for (int i = 0; i < 50; ++i) detail = turn(/*changed=*/true).detail;
    return detail;
  }
  void end_motion() { pacing_.end_motion(); }
  void wait(double seconds) { now_ += seconds; }

 private:
  double maps_, reads_, rest_, beside_, now_ = 10;
  int frames_ = 0;
  FramePacing pacing_{/*software=*/true};
};

TEST(ViewerTravel, MapsShrinkBeforeReadsAndReadsBeforeThePicture) {
  EXPECT_EQ(Orbit(2, 3, 5).in_motion(), Detail{});
  EXPECT_EQ(Orbit(150, 5, 5).in_motion(), (Detail{.maps = 2}));
  EXPECT_EQ(Orbit(100, 20, 2).in_motion(), (Detail{.maps = 4}));
  EXPECT_EQ(Orbit(400, 150, 10).in_motion(), (Detail{.maps = 4, .reads = 4}));
  EXPECT_EQ(Orbit(400, 150, 100).in_motion(), (Detail{.picture = 2, .maps = 4, .reads = 4}));
  EXPECT_EQ(Orbit(0, 0, 1000).in_motion(), (Detail{.picture = 4, .maps = 4, .reads = 4}));
}

TEST(ViewerTravel, TheFullPictureDoesNotWaitOnceTheUserHasEndedTheMotion) {
  for (int i = 0; i < 100; ++i) {
    const bool in_last_step = i % 2 == 1;
    Orbit orbit(0, 0, 500);
    orbit.wait(0.377 * i);  // at any reading of the clock: differences of times are rounded
    orbit.in_motion();
    orbit.end_motion();
    if (in_last_step) {
      EXPECT_FALSE(orbit.turn(/*changed=*/true).detail.is_full());
    }
    const FramePacing::Step full = orbit.turn(/*changed=*/false);
    EXPECT_TRUE(full.draw && full.idle && full.restart && full.detail.is_full());
    orbit.turn(/*changed=*/true);
    EXPECT_FALSE(orbit.turn(/*changed=*/false).idle) << "that was the end of one motion alone";
  }
}

// As where other work runs on the machine for a moment.
TEST(ViewerTravel, ASlowFrameNowAndThenChangesNothing) {
  Orbit orbit(400, 150, 25);
  const Detail settled = orbit.in_motion();
  EXPECT_EQ(settled, (Detail{.maps = 4, .reads = 4}));
  for (int i = 0; i < 50; ++i) {
    i % 5 == 0 ? orbit.becomes(800, 300, 50) : orbit.becomes(400, 150, 25);
    EXPECT_EQ(orbit.turn(/*changed=*/true).detail, settled) << i;
  }
}

TEST(ViewerTravel, TheLargerPictureComesBackAfterASlowWhile) {
  Orbit orbit(400, 150, 15);
  const Detail settled = orbit.in_motion();
  orbit.becomes(800, 300, 30);
  EXPECT_GT(orbit.in_motion().picture, settled.picture);
  orbit.becomes(400, 150, 15);
  EXPECT_EQ(orbit.in_motion(), settled);
}

// Not only divisors that are powers of two.
TEST(ViewerTravel, ThePictureIsTheLargestThatIsQuickEnough) {
  for (double rest = 110; rest < 6000; rest *= 1.07) {
    Orbit orbit(0, 0, rest);
    const Detail settled = orbit.in_motion();
    EXPECT_LE(orbit.took(settled), 100) << rest;
    int larger = 0;
    for (const int divisor : {1, 2, 3, 4, 6, 8}) {
      if (divisor < settled.picture) larger = divisor;
    }
    Detail before = settled;
    before.picture = larger;
    ASSERT_GT(larger, 0);
    EXPECT_GT(orbit.took(before), 90) << rest << ": " << settled.picture << " is smaller than need be";
  }
}

// Other work slowed the machine down just while the viewer found its level, so the levels seem to differ by more than
// they do.
TEST(ViewerTravel, WhatWasMeasuredUnderLoadDoesNotKeepThePictureSmall) {
  Orbit orbit(0, 0, 900);
  orbit.in_motion();
  orbit.becomes(0, 0, 2600);
  int turns = 0;
  while (orbit.turn(/*changed=*/true).detail.picture < 6) ASSERT_LT(++turns, 1000);
  orbit.becomes(0, 0, 500);
  EXPECT_LE(orbit.in_motion().picture, 4);
  EXPECT_EQ(orbit.in_motion().picture, 3);
}

// What the user waits for is the window.
TEST(ViewerTravel, WhatTheWindowTakesBesideThePictureCounts) {
  const Detail whole{.maps = 4, .reads = 4};
  EXPECT_EQ(Orbit(400, 100, 30, /*beside=*/5).in_motion(), whole);
  EXPECT_EQ(Orbit(400, 100, 30, /*beside=*/40).in_motion(), (Detail{.picture = 2, .maps = 4, .reads = 4}));
  // Panels that take a while are no reason to draw the picture smaller than helps.
  EXPECT_EQ(Orbit(1200, 2, 2, /*beside=*/200).in_motion(), whole);
}

TEST(ViewerTravel, NothingAlternatesWhateverTheWindowTakes) {
  for (const double beside : {0.0, 20.0, 40.0, 60.0, 80.0}) {
    for (double full = 1; full < 20000; full *= 1.1) {
      Orbit maps(0.95 * full, 0.02 * full, 0.03 * full, beside), pixels(0.1 * full, 0.2 * full, 0.7 * full, beside);
      for (Orbit* orbit : {&maps, &pixels}) {
        const Detail settled = orbit->in_motion();
        for (int i = 0; i < 60; ++i) ASSERT_EQ(orbit->turn(true).detail, settled) << full << " beside " << beside;
      }
    }
  }
}

// A level that was quick in another view is not tried over and over.
TEST(ViewerTravel, WhatIsTooSlowInThisViewIsLeftAlone) {
  Orbit orbit(400, 100, 20);
  EXPECT_EQ(orbit.in_motion().picture, 1);
  orbit.becomes(400, 300, 80);
  const Detail settled = orbit.in_motion();
  EXPECT_EQ(settled.picture, 2);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(orbit.turn(true).detail, settled) << i;
}

TEST(ViewerTravel, NothingShrinksFurtherThanItsLimit) {
  EXPECT_EQ(Orbit(1e5, 1e6, 1e6).in_motion(), (Detail{.picture = 8, .maps = 4, .reads = 4}));
}

TEST(ViewerTravel, ThePictureDoesNotShrinkWhereThatSavesNothing) {
  EXPECT_EQ(Orbit(8000, 10, 10).in_motion(), (Detail{.maps = 4, .reads = 4}));
  EXPECT_EQ(Orbit(3000, 150, 300).in_motion(), (Detail{.picture = 2, .maps = 4, .reads = 4}));
}

TEST(ViewerTravel, AnotherViewIsJudgedAnew) {
  Orbit orbit(8000, 10, 10);
  EXPECT_EQ(orbit.in_motion().picture, 1);
  orbit.becomes(160, 400, 3000);
  EXPECT_EQ(orbit.in_motion().picture, 6);
  orbit.becomes(8000, 10, 10);
  EXPECT_EQ(orbit.in_motion().picture, 1);
}

TEST(ViewerTravel, TheDetailSettlesAndIsTheSameAfterARest) {
  for (double full = 1; full < 20000; full *= 1.1) {
    Orbit orbit(0.5 * full, 0.3 * full, 0.2 * full);
    const Detail settled = orbit.in_motion();
    for (int i = 0; i < 10; ++i) EXPECT_EQ(orbit.turn(true).detail, settled) << full;
    for (int i = 0; i < 40; ++i) orbit.turn(false);
    EXPECT_EQ(orbit.turn(true).detail, settled) << full;
  }
}

TEST(ViewerTravel, AtRestThePictureIsFull) {
  Orbit orbit(500, 300, 200);
  orbit.in_motion();
  int drawn = 0;
  for (int i = 0; i < 100; ++i) {
    const FramePacing::Step step = orbit.turn(/*changed=*/false);
    if (!step.draw) continue;
    EXPECT_TRUE(step.detail.is_full());
    EXPECT_TRUE(step.restart);
    ++drawn;
  }
  EXPECT_EQ(drawn, 1);
}

TEST(ViewerTravel, AParameterThatChangesIsSeenInFullEffect) {
  Orbit orbit(500, 300, 200);
  orbit.in_motion();
  FramePacing pacing(/*software=*/true);
  for (int i = 0; i < 20; ++i) {
    const FramePacing::Step step = pacing.next(i, /*changed=*/true, /*ui_active=*/true, 0, 1, /*travels=*/false);
    EXPECT_EQ(step.detail.maps, 1);
    EXPECT_EQ(step.detail.reads, 1);
    pacing.drew(step.detail, 1000);
  }
}

TEST(ViewerTravel, AGpuDrawsInFullDetail) {
  FramePacing pacing(/*software=*/false);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(pacing.next(i, /*changed=*/true, /*ui_active=*/false, 0, 1, /*travels=*/true).detail.is_full());
    pacing.drew({}, 1000);
  }
}

}  // namespace
}  // namespace penumbra
