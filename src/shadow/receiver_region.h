#pragma once

#include <limits>

#include "cascades.h"

namespace penumbra::shadow {

struct ReadMargins {
  double texels = 0;  // by which receivers may read beyond their discs
  double ndc = 0;     // by which receivers may lie beyond the view's sides
  // Light-space depth, metres, of what receivers look for, if that is nearer to the light than all casters.
  double nearest = std::numeric_limits<double>::max();
};

// The bounds in light space of what the view may see of a box in the world; empty for an empty box. `cascades`: only
// their light space is read.
LightBounds seen_bounds(const Box& box, const CascadeInputs& inputs, const Cascades& cascades);

// Narrows the part of each cascade that is drawn (Cascade::drawn) to what receivers of the view can read: the part of
// the receivers' box that the view sees, as far as the cascade contains it, widened by the discs of the light and by
// what a pyramid reads beside them; and of that to what the casters' box covers, since the rest is empty. `inputs`:
// those that the cascades were fitted to. Only for techniques and products that read the map nowhere else
// (Technique::reads_light_discs).
void narrow_to_receivers(Cascades& cascades, const CascadeInputs& inputs, const ReadMargins& margins);

}  // namespace penumbra::shadow
