// What the viewer draws next: the frames that a picture lacks, and no others.
#include "viewer/frame_plan.h"

#include <gtest/gtest.h>

#include <optional>

namespace penumbra {
namespace {

using viewer::FramePlan;
using viewer::FrameState;
using viewer::PictureState;

// Simulates a viewer: two pictures, a truth that takes a given number of turns to trace, and a clock.
class Desk {
 public:
  explicit Desk(bool software) : pacing_(software) {}

  FramePlan turn() {
    now_ += 0.05;
    FrameState state{.now = now_,
                     .a = a,
                     .b = b,
                     .truth_pending = tracing > 0,
                     .values_wanted = values_wanted,
                     .last_is_b = last_is_b_,
                     .unreadable = unreadable_};
    const FramePlan plan = plan_frame(pacing_, state);
    EXPECT_FALSE(unreadable_ && plan.inspect);
    EXPECT_FALSE(unreadable_ && (plan.a.measure && !plan.a.draw));
    EXPECT_FALSE(unreadable_ && (plan.b.measure && !plan.b.draw));
    if (gives_up) {
      EXPECT_TRUE(plan.at_rest) << "only then the user can end what is drawn";
      gives_up = false;
      unreadable_ = true;
      (plan.b.draw ? *b : a).frames = frames_kept;
      return plan;
    }
    values_wanted = false;
    if (plan.cancel_truth) tracing = 0;
    if (tracing > 0 && --tracing == 0) {  // the traced picture is finished, so it is drawn once more
      if (a.traced) a.frames = 0;
      if (b && b->traced) b->frames = 0;
    }
    if (plan.a.measure && !plan.a.draw) {
      EXPECT_TRUE(!last_is_b_ && a.missing() == 0);
      a.measured = true;
    }
    if (b && plan.b.measure && !plan.b.draw) {
      EXPECT_TRUE(last_is_b_ && b->missing() == 0);
      b->measured = true;
    }
    if (b && plan.b.draw) draw(*b, plan.b.restart, plan.b.measure, plan.detail, drawn_b);
    if (plan.a.draw) draw(a, plan.a.restart, plan.a.measure, plan.detail, drawn_a);
    if (plan.a.draw || plan.b.draw) last_is_b_ = !plan.a.draw;
    if (plan.a.draw || plan.b.draw) unreadable_ = false;
    if (plan.a.draw || plan.b.draw) pacing_.drew(plan.detail, 50);
    return plan;
  }
  // Runs until the viewer is idle, and some turns longer. Returns the last turn.
  FramePlan rest(int turns = 200) {
    FramePlan plan;
    for (int i = 0; i < turns; ++i) plan = turn();
    return plan;
  }
  // Simulates that the user moves the camera.
  void move(int turns) {
    for (int i = 0; i < turns; ++i) {
      change(a);
      if (b) change(*b);
      turn();
    }
  }
  static void change(PictureState& picture) {
    picture.current = picture.measured = false;
    picture.frames = 0;
  }

  PictureState a;
  std::optional<PictureState> b;
  bool values_wanted = false;
  bool gives_up = false;         // the user ends the next drawing
  int frames_kept = 0;           // then
  int tracing = 0;               // turns until the truth is traced
  int drawn_a = 0, drawn_b = 0;  // frames since the last cut

 private:
  void draw(PictureState& picture, bool cut, bool measure, const viewer::Detail& detail, int& drawn) {
    drawn = cut || !picture.current ? 1 : drawn + 1;
    if (cut) picture.frames = 0;
    if (picture.traced && !picture.current) tracing = 20;
    picture.current = true;
    picture.frames = detail.is_full() ? picture.frames + 1 : 0;
    picture.measured |= measure && !(picture.traced && tracing > 0);
  }

  viewer::FramePacing pacing_;
  double now_ = 10;
  bool last_is_b_ = false;
  bool unreadable_ = true;
};

PictureState wanting(int frames) { return {.wanted = frames}; }
PictureState truth() { return {.wanted = 1, .traced = true}; }

TEST(ViewerPlan, InSoftwareEachPictureAtRestHasItsFrames) {
  for (const bool two : {false, true}) {
    Desk desk(/*software=*/true);
    desk.a = wanting(32);
    if (two) desk.b = wanting(5);
    desk.move(20);
    const FramePlan last = desk.rest();
    EXPECT_TRUE(last.idle);
    EXPECT_FALSE(last.a.draw || last.b.draw);
    EXPECT_EQ(desk.drawn_a, 32);
    EXPECT_EQ(desk.drawn_b, two ? 5 : 0);
  }
}

// Of a picture of two frames, the second one was given up before it was drawn, or when only its values were missing.
TEST(ViewerPlan, AfterASecondFrameWasGivenUpThePictureIsFinishedAndCanBeRead) {
  for (const int kept : {1, 2}) {
    Desk desk(/*software=*/true);
    desk.a = wanting(2);
    desk.move(5);
    while (desk.a.frames < 1) desk.turn();
    desk.gives_up = true;
    desk.frames_kept = kept;
    desk.turn();
    ASSERT_FALSE(desk.gives_up);
    EXPECT_TRUE(desk.turn().a.draw) << kept;
    EXPECT_TRUE(desk.rest().idle) << kept;
    EXPECT_EQ(desk.a.frames, 2) << kept;
    desk.values_wanted = true;
    EXPECT_TRUE(desk.turn().inspect) << kept;
  }
}

TEST(ViewerPlan, OnlyPicturesAtRestInSoftwareMayBeInterrupted) {
  for (const bool software : {true, false}) {
    Desk desk(software);
    desk.a = wanting(4);
    for (int i = 0; i < 10; ++i) {
      Desk::change(desk.a);
      EXPECT_FALSE(desk.turn().at_rest) << "in motion";
    }
    int drawn = 0, at_rest = 0;
    for (int i = 0; i < 60; ++i) {
      const FramePlan plan = desk.turn();
      drawn += plan.a.draw;
      at_rest += plan.at_rest;
    }
    EXPECT_EQ(at_rest, software ? 4 : 0);
    EXPECT_GE(drawn, 4);
  }
}

TEST(ViewerPlan, APictureThatWasGivenUpIsBegunAgainAndMeasured) {
  for (const bool two : {false, true}) {
    Desk desk(/*software=*/true);
    desk.a = wanting(3);
    if (two) desk.b = wanting(1);
    desk.move(5);
    FramePlan plan = desk.turn();
    while (!plan.a.draw) plan = desk.turn();
    desk.gives_up = true;
    desk.values_wanted = true;
    desk.turn();
    EXPECT_TRUE(desk.rest().idle);
    EXPECT_EQ(desk.a.frames, 3);
    EXPECT_EQ(desk.a.measured, two);
  }
}

TEST(ViewerPlan, InSoftwareAIsWhatItWasWhateverHappensToB) {
  Desk desk(/*software=*/true);
  desk.a = wanting(32);
  desk.move(5);
  desk.rest();
  for (const PictureState& b : {wanting(1), wanting(32), truth()}) {
    desk.b = b;
    EXPECT_TRUE(desk.rest().idle);
    EXPECT_EQ(desk.drawn_a, 32);
    EXPECT_TRUE(desk.a.measured && desk.b->measured);
    EXPECT_TRUE(b.traced || desk.drawn_b == b.wanted) << desk.drawn_b;
    desk.b.reset();
    desk.rest();
    EXPECT_EQ(desk.drawn_a, 32);
  }
}

TEST(ViewerPlan, ValuesThatAreLookedAtAreReadAnewOrAreThoseOfTheCommand) {
  Desk desk(/*software=*/true);
  desk.a = wanting(32);
  desk.rest();
  desk.values_wanted = true;
  FramePlan plan = desk.turn();
  EXPECT_TRUE(plan.inspect);
  EXPECT_FALSE(plan.a.draw);
  desk.b = wanting(32);
  desk.rest();
  desk.values_wanted = true;
  plan = desk.turn();
  EXPECT_TRUE(plan.a.draw && plan.b.draw);
  EXPECT_TRUE(desk.rest().idle);
  EXPECT_EQ(desk.drawn_a, 32);
  EXPECT_EQ(desk.drawn_b, 32);
}

TEST(ViewerPlan, DistancesAreMeasuredOnceAtRest) {
  for (const bool software : {true, false}) {
    for (const int wanted : {1, 32}) {
      Desk desk(software);
      desk.a = wanting(wanted);
      desk.b = wanting(wanted);
      for (int i = 0; i < 30; ++i) {
        Desk::change(desk.a);
        Desk::change(*desk.b);
        const FramePlan plan = desk.turn();
        EXPECT_FALSE(plan.a.measure || plan.b.measure) << "in motion";
      }
      int a = 0, b = 0;
      for (int i = 0; i < 200; ++i) {
        const FramePlan plan = desk.turn();
        a += plan.a.measure;
        b += plan.b.measure;
      }
      EXPECT_EQ(a, 1) << software << wanted;
      EXPECT_EQ(b, 1) << software << wanted;
    }
  }
}

TEST(ViewerPlan, ATruthIsTracedAtRestAndItsPictureStays) {
  for (const bool software : {true, false}) {
    Desk desk(software);
    desk.a = wanting(1);
    desk.b = truth();
    for (int i = 0; i < 20; ++i) {
      Desk::change(desk.a);
      Desk::change(*desk.b);
      EXPECT_FALSE(desk.turn().b.draw) << "in motion";
    }
    desk.rest();
    EXPECT_TRUE(desk.b->current);
    EXPECT_TRUE(desk.b->measured) << software;
    int drawn = 0;
    for (int i = 0; i < 50; ++i) drawn += desk.turn().b.draw;
    EXPECT_EQ(drawn, 0);
  }
}

TEST(ViewerPlan, OnAGpuATracedAFollowsTheHandAndThenStays) {
  Desk desk(/*software=*/false);
  desk.a = truth();
  for (int i = 0; i < 10; ++i) {
    Desk::change(desk.a);
    EXPECT_TRUE(desk.turn().a.draw);
  }
  desk.rest();
  int drawn = 0;
  for (int i = 0; i < 50; ++i) drawn += desk.turn().a.draw;
  EXPECT_EQ(drawn, 0);
  EXPECT_TRUE(desk.turn().idle);
}

TEST(ViewerPlan, APictureWhoseShadowsAreRefinedIsDrawnTwiceAtRestAndThenStays) {
  for (const bool software : {true, false}) {
    Desk desk(software);
    desk.a = wanting(2);
    desk.a.settles = true;
    for (int i = 0; i < 10; ++i) {
      Desk::change(desk.a);
      EXPECT_TRUE(desk.turn().a.draw);
    }
    EXPECT_TRUE(desk.rest().idle);
    EXPECT_EQ(desk.a.frames, 2) << software;
    int drawn = 0;
    for (int i = 0; i < 50; ++i) drawn += desk.turn().a.draw;
    EXPECT_EQ(drawn, 0) << software;
  }
}

TEST(ViewerPlan, ATruthThatNobodyWaitsForIsCancelled) {
  for (const bool software : {true, false}) {
    Desk desk(software);
    desk.a = wanting(1);
    desk.b = truth();
    for (int i = 0; i < 12; ++i) desk.turn();
    ASSERT_GT(desk.tracing, 0);
    EXPECT_FALSE(desk.turn().cancel_truth);
    Desk::change(*desk.b);
    Desk::change(desk.a);
    EXPECT_TRUE(desk.turn().cancel_truth) << "the camera moves";
    for (int i = 0; i < 12; ++i) desk.turn();
    ASSERT_GT(desk.tracing, 0);
    desk.b = wanting(1);
    EXPECT_TRUE(desk.turn().cancel_truth) << "B is another technique";
    EXPECT_TRUE(desk.rest().idle);
  }
}

TEST(ViewerPlan, AGpuDrawsEveryFrame) {
  Desk desk(/*software=*/false);
  desk.a = wanting(1);
  desk.b = wanting(1);
  for (int i = 0; i < 50; ++i) {
    const FramePlan plan = desk.turn();
    EXPECT_TRUE(plan.a.draw && plan.b.draw);
    EXPECT_TRUE(plan.detail.is_full());
  }
}

}  // namespace
}  // namespace penumbra
