#pragma once

#include <compare>
#include <optional>

#include "truth/picture_request.h"
#include "truth/technique.h"

namespace penumbra::truth {

// A light of a view, by their ids.
struct LightId {
  int view = 0, light = 0;
  auto operator<=>(const LightId&) const = default;
};

// The pictures of a light in a view.
struct LightPictures {
  TruthTechnique::Last last;
  std::optional<Key> shown;               // the picture in `last`
  std::optional<Key> awaited;             // the picture that the last frame requested
  std::optional<TracedPicture> finished;  // traced in the background, not yet shown
  std::optional<Key> failed;
  long long turn = 0;  // when it was last drawn
};

}  // namespace penumbra::truth
