#ifndef PENUMBRA_MEDIAN_GLSL
#define PENUMBRA_MEDIAN_GLSL

#include "shared/language.h"

GLSL_BEGIN

GLSL_FUNCTION uint median_of_three(uint a, uint b, uint c) { return max(min(a, b), min(max(a, b), c)); }

// Of the nine values of three rows, in exchanges of minima and maxima (Smith 1996, "Implementing median filters in
// XC4000E FPGAs"): sort each column; the median is that of the greatest minimum, the middle median and the least
// maximum.
GLSL_FUNCTION uint median_of_nine(uvec3 a, uvec3 b, uvec3 c) {
  uvec3 low = min(a, b);
  uvec3 high = max(a, b);
  uvec3 least = min(low, c);
  uvec3 middle = max(low, min(high, c));
  uvec3 most = max(high, c);
  return median_of_three(max(max(least.x, least.y), least.z), median_of_three(middle.x, middle.y, middle.z),
                         min(min(most.x, most.y), most.z));
}

GLSL_END

#endif
