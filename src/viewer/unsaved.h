#pragma once

#include <string>

#include "viewer/edit.h"

namespace penumbra::viewer {

// What was last saved or opened.
struct SavedState {
  Edit view;           // as beside the scene, or as the scene was opened
  std::string preset;  // the file of the preset that was opened or saved last; empty if there is none
  ParamSet params;     // its values
  ParamSet before;     // the values from before it was opened; without rows if that changed none
  std::string undone;  // the file whose opening was undone last
};

// What closing the window would lose.
struct Unsaved {
  bool view = false;     // sun, lights, lamps or bookmarks
  bool preset = false;   // values that differ from the preset's
  bool picture = false;  // or a sequence that is still being written

  bool changes() const { return view || preset; }
  bool any() const { return changes() || picture; }
};

// The camera alone is no change: everyone moves it to look around. Parameters are kept for the next run, and so are
// lost only for a preset.
Unsaved unsaved(const SavedState& saved, const Edit& now);

}  // namespace penumbra::viewer
