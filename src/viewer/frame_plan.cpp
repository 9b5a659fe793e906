#include "viewer/frame_plan.h"

#include <algorithm>
#include <array>

namespace penumbra::viewer {

namespace {

// One of the two pictures while the frame is planned.
struct Side {
  const PictureState& picture;
  PicturePlan& plan;
  bool follows_motion;  // is drawn while the camera moves
  bool is_last;         // the renderer's last frame is this picture's
};

bool waits_for_truth(const PictureState& picture) { return picture.traced && picture.current; }

bool needs_measuring(const PictureState& picture, const FrameState& state, const FramePacing::Step& step) {
  const bool finished = !picture.traced || !state.truth_pending;
  return state.b && step.idle && finished && picture.missing() <= 1 && !picture.measured;
}

// A software rasteriser draws only the frames that are missing. A finished picture whose values are wanted, but which
// the renderer did not draw last, starts again.
void plan_software(const Side& side, const FrameState& state, const FramePacing::Step& step, bool moves) {
  const PictureState& picture = side.picture;
  PicturePlan& plan = side.plan;
  const bool read_again = state.values_wanted && !moves && (state.b || state.last_is_b);
  // The user gave up the frame when it was drawn and its values were not read yet.
  const bool unread = state.unreadable && !state.b && !moves;
  const bool lost = picture.missing() == 0 && (unread || (plan.measure && !side.is_last));
  plan.restart = read_again || lost || (step.restart && picture.missing() > 0);
  plan.draw = moves ? step.draw && !picture.current && side.follows_motion
                    : plan.restart || (step.draw && picture.missing() > 0);
  plan.measure = plan.measure && (plan.draw ? picture.wanted == 1 || !plan.restart : picture.missing() == 0);
}

// A GPU draws every frame. A picture that is ray traced or has no history does not change once it is finished.
bool draws_on_gpu(const Side& side, const FrameState& state, const FramePacing::Step& step) {
  const PictureState& picture = side.picture;
  const bool ends = picture.traced || picture.settles;
  if (!ends || (!picture.current && side.follows_motion)) return true;
  return step.idle && (picture.missing() > 0 || state.values_wanted || side.plan.measure);
}

}  // namespace

int PictureState::missing() const { return current ? std::max(wanted - frames, 0) : wanted; }

FramePlan plan_frame(FramePacing& pacing, const FrameState& state) {
  const PictureState& a = state.a;
  const PictureState b = state.b.value_or(PictureState{.current = true, .frames = 1});
  // A follows the camera with any technique. A ray-traced B would only be started over and over.
  const bool b_follows = !b.traced;
  const bool moves = !a.current || (!b.current && b_follows);
  const int wanted = std::max(a.wanted, b.wanted), missing = std::max(a.missing(), b.missing());
  const FramePacing::Step step =
      pacing.next(state.now, moves, state.ui_active, wanted - missing, wanted, state.travels);

  FramePlan plan{.detail = step.detail, .idle = missing == 0 && !state.truth_pending};
  plan.cancel_truth = state.truth_pending && !waits_for_truth(a) && !waits_for_truth(b);
  const std::array<Side, 2> sides{
      {{a, plan.a, /* follows_motion= */ true, /* is_last= */ !state.unreadable && !state.last_is_b},
       {b, plan.b, b_follows, !state.unreadable && state.last_is_b}}};
  for (const Side& side : sides) {
    if (&side.plan == &plan.b && !state.b) continue;
    side.plan.measure = needs_measuring(side.picture, state, step);
    if (pacing.software()) {
      plan_software(side, state, step, moves);
    } else {
      side.plan.draw = draws_on_gpu(side, state, step);
    }
  }
  plan.at_rest = pacing.software() && !moves && (plan.a.draw || plan.b.draw);
  plan.inspect = state.values_wanted && !plan.a.draw && !state.last_is_b && !state.unreadable;
  return plan;
}

}  // namespace penumbra::viewer
