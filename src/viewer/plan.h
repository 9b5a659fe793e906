#pragma once

#include <optional>

#include "viewer/pace.h"

namespace penumbra::viewer {

// One of the two pictures before a frame.
struct PictureState {
  bool current = false;   // what was drawn last is what is to be seen, at whatever size
  int frames = 0;         // drawn since, at full size
  int wanted = 1;         // of them at rest
  bool traced = false;    // by the technique `truth`, which is slow to come and then stays
  bool measured = false;  // its visibility was read, to compare the two

  int missing() const;
};

struct Situation {
  double now = 0;  // seconds
  PictureState a;
  std::optional<PictureState> b;  // where two are compared
  bool pending = false;           // the truth is being traced
  bool looks = false;             // values are to be read that were not
  bool last_is_b = false;         // of the renderer's frames, so that values are B's
  bool busy = false;              // a hand is at the panel
};

// What the next frame of the viewer does.
struct Plan {
  bool draw_a = false, draw_b = false;        // B first: what is read of the renderer later is read of A
  bool cut_a = false, cut_b = false;          // they take up nothing of the last frames
  bool measure_a = false, measure_b = false;  // reads their visibility: as they are drawn, else of the last frame
  int divisor = 1;
  bool inspect = false;  // A's values as they are, without a frame
  bool cancel = false;   // nobody waits for the truth that is traced
  bool at_rest = false;  // nothing is to come
};

// A picture at rest has the frames of the command that draws it, neither more nor fewer, whatever happens to the other
// one; on a GPU pictures go on, but for traced ones.
Plan plan_frame(Pace& pace, const Situation& situation);

}  // namespace penumbra::viewer
