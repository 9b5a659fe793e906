#pragma once

#include "core/params.h"

namespace penumbra::viewer {

// What a frame draws, as divisors of what the document asks for.
struct Detail {
  int picture = 1;  // of both sides of the picture
  int maps = 1;     // of the number of the sun's cascades, or of both sides of its maps: see reduced()
  int reads = 1;    // of what a pixel reads to find its shadow: taps, rays, texels of slices

  bool is_full() const { return *this == Detail{}; }
  bool operator==(const Detail&) const = default;
};

// The parameters with fewer and smaller maps and fewer reads of their technique; never below what still looks like its
// shadows, nor above what they ask for. Each cascade costs a pass over all casters, whatever its size is, so there are
// fewer of them, of half the size; a single one is smaller. The technique `truth` stays as it is.
ParamSet reduced(const ParamSet& params, const Detail& detail);
// The detail without what leaves these parameters as they are.
Detail effective(const ParamSet& params, const Detail& detail);

}  // namespace penumbra::viewer
