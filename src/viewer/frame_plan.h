#pragma once

#include <optional>

#include "viewer/frame_pacing.h"

namespace penumbra::viewer {

// One of the two pictures, A or B, before a frame of the viewer.
struct PictureState {
  bool current = false;   // the last drawing shows the present document, at full size or a smaller one
  int frames = 0;         // drawn at full size since the document changed
  int wanted = 1;         // frames at full size until the picture is finished
  bool traced = false;    // by the technique `truth`, which takes long and then does not change
  bool settles = false;   // it has no history, and so does not change once it is finished
  bool measured = false;  // its visibility was read, to compare the two pictures

  int missing() const;  // frames until it is finished
};

// What plan_frame() decides by.
struct FrameState {
  double now = 0;  // seconds
  PictureState a;
  std::optional<PictureState> b;  // set while two pictures are compared
  bool truth_pending = false;     // the background is still tracing
  bool values_wanted = false;     // the interface shows numbers that were not read back yet
  bool last_is_b = false;         // the renderer's last frame is B's, so numbers read back would be B's
  bool unreadable = false;        // the renderer has no complete frame
  bool ui_active = false;         // the user holds a widget
  bool travels = false;           // what changed since the last drawing are not the parameters
};

// What the next frame does for one picture.
struct PicturePlan {
  bool draw = false;
  bool restart = false;  // start again without history
  bool measure = false;  // read the visibility back: after drawing, or else from the last frame
};

// What the next frame of the viewer does.
struct FramePlan {
  PicturePlan a, b;
  Detail detail;
  bool inspect = false;       // read A's values back without drawing
  bool at_rest = false;       // what is drawn may take long: the user is answered meanwhile
  bool cancel_truth = false;  // neither picture needs what the background traces
  bool idle = false;          // both pictures are finished
};

// A picture is finished after exactly the frames that `penumbra render` would draw for it, whatever happens to the
// other one. A GPU continues to draw finished pictures that have a history.
FramePlan plan_frame(FramePacing& pacing, const FrameState& state);

}  // namespace penumbra::viewer
