#include "viewer/unsaved.h"

namespace penumbra::viewer {

Unsaved unsaved(const SavedState& saved, const Edit& now) {
  return {.view = !same_lights(saved.view, now), .preset = !saved.preset.empty() && saved.params != now.a};
}

}  // namespace penumbra::viewer
