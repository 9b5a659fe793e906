#ifndef PENUMBRA_FOURIER_GLSL
#define PENUMBRA_FOURIER_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Angular frequency of a term of the step's Fourier series of `count` terms, 0 first: a square wave has the odd ones.
// Its period is more than 2, twice the greatest difference of stored depths, since the wave falls again half a period
// beside the step, as gently as it rises there.
GLSL_FUNCTION float fourier_frequency(int term, int count) {
  return 3.14159265f * float(2 * term + 1) * (1.0f - 1.5f / float(count + 1));
}

// Weight of a term of `count`: the series' own, lowered for high frequencies, which ring (Annen et al. 2007).
GLSL_FUNCTION float fourier_weight(int term, int count, float attenuation) {
  float order = float(term) / float(count);
  return 2.0f / (3.14159265f * float(2 * term + 1)) * exp(-attenuation * order * order);
}

GLSL_END

#endif
