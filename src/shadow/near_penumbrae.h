#pragma once

#include <optional>
#include <vector>

#include "light_work.h"

namespace penumbra::shadow {

// The part of the visible receivers that a penumbra may reach, for cascades that are fitted to it
// (cascades.fit=penumbrae): what lies in tiles that first maps, small ones for all visible receivers, leave undecided
// (tiles.h). Absent where the parameters do not ask for it or allow one cascade alone, where the technique decides no
// tiles or the picture is smaller than one, and where there is none. Else the caller's casters are drawn into these
// maps, unless they are kept, and the CPU waits for the GPU; normals that are made from depth are made here. The first
// maps are released in the first frame that does not ask for them. `visible`: see find_visible_receivers(). `recipes`:
// those that the frame makes.
//
// With `maps.overlap` the first maps have a second layer, too, and show whether the light's need one.
struct NearPenumbrae {
  std::optional<VisibleReceivers> receivers;
  bool wide_overlap = false;  // casters overlap in penumbrae of that width
};
NearPenumbrae find_near_penumbrae(const LightWork& work, const std::optional<VisibleReceivers>& visible,
                                  const std::vector<const Recipe*>& recipes, ViewState& view);

}  // namespace penumbra::shadow
