// What the viewer draws next: the frames that a picture lacks, and no others.
#include "viewer/plan.h"

#include <gtest/gtest.h>

#include <optional>

namespace penumbra {
namespace {

using viewer::PictureState;
using viewer::Plan;
using viewer::Situation;

// A viewer at work: two pictures, a truth that takes so many turns, and a clock.
class Desk {
 public:
  explicit Desk(bool software) : pace_(software) {}

  Plan turn() {
    now_ += 0.05;
    Situation situation{.now = now_, .a = a, .b = b, .pending = tracing > 0, .looks = looks, .last_is_b = last_is_b_};
    const Plan plan = plan_frame(pace_, situation);
    looks = false;
    if (plan.cancel) tracing = 0;
    if (tracing > 0 && --tracing == 0) {  // its picture is there: it is drawn once more
      if (a.traced) a.frames = 0;
      if (b && b->traced) b->frames = 0;
    }
    if (plan.measure_a && !plan.draw_a) {
      EXPECT_TRUE(!last_is_b_ && a.missing() == 0);
      a.measured = true;
    }
    if (b && plan.measure_b && !plan.draw_b) {
      EXPECT_TRUE(last_is_b_ && b->missing() == 0);
      b->measured = true;
    }
    if (b && plan.draw_b) draw(*b, plan.cut_b, plan.measure_b, plan.divisor, drawn_b);
    if (plan.draw_a) draw(a, plan.cut_a, plan.measure_a, plan.divisor, drawn_a);
    if (plan.draw_a || plan.draw_b) last_is_b_ = !plan.draw_a;
    if (plan.draw_a || plan.draw_b) pace_.drew(plan.divisor, 50);
    return plan;
  }
  // Until nothing is to come, and a while on. The last turn.
  Plan rest(int turns = 200) {
    Plan plan;
    for (int i = 0; i < turns; ++i) plan = turn();
    return plan;
  }
  // A hand moves the camera.
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
  bool looks = false;
  int tracing = 0;               // turns that are left
  int drawn_a = 0, drawn_b = 0;  // frames since the last cut

 private:
  void draw(PictureState& picture, bool cut, bool measure, int divisor, int& drawn) {
    drawn = cut || !picture.current ? 1 : drawn + 1;
    if (cut) picture.frames = 0;
    if (picture.traced && !picture.current) tracing = 20;
    picture.current = true;
    picture.frames = divisor == 1 ? picture.frames + 1 : 0;
    picture.measured |= measure && !(picture.traced && tracing > 0);
  }

  viewer::Pace pace_;
  double now_ = 10;
  bool last_is_b_ = false;
};

PictureState wanting(int frames) { return {.wanted = frames}; }
PictureState truth() { return {.wanted = 1, .traced = true}; }

TEST(ViewerPlan, InSoftwareEachPictureAtRestHasItsFrames) {
  for (const bool two : {false, true}) {
    Desk desk(/*software=*/true);
    desk.a = wanting(32);
    if (two) desk.b = wanting(5);
    desk.move(20);
    const Plan last = desk.rest();
    EXPECT_TRUE(last.at_rest);
    EXPECT_FALSE(last.draw_a || last.draw_b);
    EXPECT_EQ(desk.drawn_a, 32);
    EXPECT_EQ(desk.drawn_b, two ? 5 : 0);
  }
}

TEST(ViewerPlan, InSoftwareAIsWhatItWasWhateverHappensToB) {
  Desk desk(/*software=*/true);
  desk.a = wanting(32);
  desk.move(5);
  desk.rest();
  for (const PictureState& b : {wanting(1), wanting(32), truth()}) {
    desk.b = b;
    EXPECT_TRUE(desk.rest().at_rest);
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
  desk.looks = true;
  Plan plan = desk.turn();
  EXPECT_TRUE(plan.inspect);
  EXPECT_FALSE(plan.draw_a);
  desk.b = wanting(32);
  desk.rest();
  desk.looks = true;
  plan = desk.turn();
  EXPECT_TRUE(plan.draw_a && plan.draw_b);
  EXPECT_TRUE(desk.rest().at_rest);
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
        const Plan plan = desk.turn();
        EXPECT_FALSE(plan.measure_a || plan.measure_b) << "in motion";
      }
      int a = 0, b = 0;
      for (int i = 0; i < 200; ++i) {
        const Plan plan = desk.turn();
        a += plan.measure_a;
        b += plan.measure_b;
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
      EXPECT_FALSE(desk.turn().draw_b) << "in motion";
    }
    desk.rest();
    EXPECT_TRUE(desk.b->current);
    EXPECT_TRUE(desk.b->measured) << software;
    int drawn = 0;
    for (int i = 0; i < 50; ++i) drawn += desk.turn().draw_b;
    EXPECT_EQ(drawn, 0);
  }
}

TEST(ViewerPlan, OnAGpuATracedAFollowsTheHandAndThenStays) {
  Desk desk(/*software=*/false);
  desk.a = truth();
  for (int i = 0; i < 10; ++i) {
    Desk::change(desk.a);
    EXPECT_TRUE(desk.turn().draw_a);
  }
  desk.rest();
  int drawn = 0;
  for (int i = 0; i < 50; ++i) drawn += desk.turn().draw_a;
  EXPECT_EQ(drawn, 0);
  EXPECT_TRUE(desk.turn().at_rest);
}

TEST(ViewerPlan, ATruthThatNobodyWaitsForIsCancelled) {
  for (const bool software : {true, false}) {
    Desk desk(software);
    desk.a = wanting(1);
    desk.b = truth();
    for (int i = 0; i < 12; ++i) desk.turn();
    ASSERT_GT(desk.tracing, 0);
    EXPECT_FALSE(desk.turn().cancel);
    Desk::change(*desk.b);
    Desk::change(desk.a);
    EXPECT_TRUE(desk.turn().cancel) << "the camera moves";
    for (int i = 0; i < 12; ++i) desk.turn();
    ASSERT_GT(desk.tracing, 0);
    desk.b = wanting(1);
    EXPECT_TRUE(desk.turn().cancel) << "B is another technique";
    EXPECT_TRUE(desk.rest().at_rest);
  }
}

TEST(ViewerPlan, AGpuDrawsEveryFrame) {
  Desk desk(/*software=*/false);
  desk.a = wanting(1);
  desk.b = wanting(1);
  for (int i = 0; i < 50; ++i) {
    const Plan plan = desk.turn();
    EXPECT_TRUE(plan.draw_a && plan.draw_b);
    EXPECT_EQ(plan.divisor, 1);
  }
}

}  // namespace
}  // namespace penumbra
