#include "viewer/plan.h"

#include <algorithm>

namespace penumbra::viewer {

namespace {

bool is_awaited(const PictureState& picture) { return picture.traced && picture.current; }

bool is_to_be_measured(const PictureState& picture, const Situation& situation, const Pace::Step& step) {
  const bool there = !picture.traced || !situation.pending;
  return situation.b && step.rests && there && picture.missing() <= 1 && !picture.measured;
}

// A hand on the camera has to be followed by A, whatever it is; a traced B would only be begun.
enum class InMotion { follows, waits };

InMotion in_motion_of_b(const PictureState& b) { return b.traced ? InMotion::waits : InMotion::follows; }

// Where the CPU draws: what lacks frames.
bool draws_in_software(const PictureState& picture, InMotion how, const Pace::Step& step, bool moves, bool asked) {
  if (moves) return step.draw && !picture.current && how == InMotion::follows;
  return asked || (step.draw && picture.missing() > 0);
}

// On a GPU: always, but that the truth does not change at rest.
bool draws_live(const PictureState& picture, InMotion how, const Pace::Step& step, bool asked) {
  if (!picture.traced || (!picture.current && how == InMotion::follows)) return true;
  return step.rests && (picture.missing() > 0 || asked);
}

}  // namespace

int PictureState::missing() const { return current ? std::max(wanted - frames, 0) : wanted; }

Plan plan_frame(Pace& pace, const Situation& situation) {
  const PictureState& a = situation.a;
  const PictureState b = situation.b.value_or(PictureState{.current = true, .frames = 1});
  const InMotion how_b = in_motion_of_b(b);
  const bool moves = !a.current || (!b.current && how_b == InMotion::follows);
  const int wanted = std::max(a.wanted, b.wanted), missing = std::max(a.missing(), b.missing());
  const Pace::Step step = pace.next(situation.now, moves, situation.busy, wanted - missing, wanted);

  Plan plan{.divisor = step.divisor, .at_rest = missing == 0 && !situation.pending};
  plan.cancel = situation.pending && !is_awaited(a) && !is_awaited(b);
  plan.measure_a = is_to_be_measured(a, situation, step);
  plan.measure_b = is_to_be_measured(b, situation, step);
  if (pace.software()) {
    // What is complete is read of the renderer's last frame, or begins once more.
    const bool again = situation.looks && !moves && (situation.b || situation.last_is_b);
    const bool lost_a = plan.measure_a && a.missing() == 0 && situation.last_is_b;
    const bool lost_b = plan.measure_b && b.missing() == 0 && !situation.last_is_b;
    plan.cut_a = again || lost_a || (step.anew && a.missing() > 0);
    plan.cut_b = situation.b && (again || lost_b || (step.anew && b.missing() > 0));
    plan.draw_a = draws_in_software(a, InMotion::follows, step, moves, plan.cut_a);
    plan.draw_b = situation.b && draws_in_software(b, how_b, step, moves, plan.cut_b);
    plan.measure_a = plan.measure_a && (plan.draw_a ? a.wanted == 1 || !plan.cut_a : a.missing() == 0);
    plan.measure_b = plan.measure_b && (plan.draw_b ? b.wanted == 1 || !plan.cut_b : b.missing() == 0);
  } else {
    plan.draw_a = draws_live(a, InMotion::follows, step, situation.looks || plan.measure_a);
    plan.draw_b = situation.b && draws_live(b, how_b, step, situation.looks || plan.measure_b);
  }
  plan.inspect = situation.looks && !plan.draw_a && !situation.last_is_b;
  return plan;
}

}  // namespace penumbra::viewer
