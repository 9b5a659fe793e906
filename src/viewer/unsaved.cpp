#include "viewer/unsaved.h"

namespace penumbra::viewer {

Unsaved unsaved(const SavedState& saved, const Edit& now) {
  const bool same_view = same_lights(saved.view, now) && saved.view.bookmarks == now.bookmarks;
  return {.view = !same_view, .preset = !saved.preset.empty() && saved.params != now.a};
}

}  // namespace penumbra::viewer
