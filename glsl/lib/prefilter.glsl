#ifndef PENUMBRA_PREFILTER_GLSL
#define PENUMBRA_PREFILTER_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Level of a filtered map at which it holds its kernel, whose radius is that many texels of level 0: there the radius
// is 4 to 8 texels, or less at level 0.
GLSL_FUNCTION int kernel_level(float radius, int levels) {
  return clamp(int(floor(log2(max(radius / 4.0f, 1.0f)))), 0, levels - 1);
}

// The radius of a kernel in texels of a level, of a light whose texels vary with depth. There that level holds the
// kernel at the largest texels, where its radius is so many texels of level 0, and each coarser level one that is twice
// as wide as the level before holds. Less than two texels would be lost among what texels and their interpolation blur.
GLSL_FUNCTION float kernel_texels(float radius, int level, bool coarser) {
  float texels = radius / exp2(float(level));
  return coarser ? max(texels, 2.0f) : texels;
}

// The level, as a fraction, at which the kernel's radius is so many texels of level 0, if it is `largest` of them where
// texels are largest. A mixture of the kernels of two levels, of which one is twice as wide, is from 10 to 90 % of an
// edge as wide as a kernel of the mean radius, within 2 %.
GLSL_FUNCTION float level_of_kernel(float radius, float largest, int levels) {
  int first = kernel_level(largest, levels);
  float coarse = kernel_texels(largest, first, true);
  int level = max(int(floor(log2(max(radius / coarse, 1.0f)))), first);
  float low = level == first ? largest : coarse * exp2(float(level)), high = coarse * exp2(float(level + 1));
  float share = (radius - low) / max(high - low, 1e-6f);
  return min(float(level) + clamp(share, 0.0f, 1.0f), float(levels - 1));
}

// Weight of a texel at a distance from the kernel's centre in radii, up to a factor: a Gaussian whose standard
// deviation is half the radius, lowered so that it ends in 0 at the radius.
GLSL_FUNCTION float kernel_weight(float distance_in_radii) {
  float squared = distance_in_radii * distance_in_radii;
  return max(exp(-2.0f * squared) - exp(-2.0f), 0.0f);
}

// Warps of a depth, -1 to 1, for exponential variance maps (Lauritzen and McCool 2008): both grow with the depth, x
// most at its far end and y most at its near end.
GLSL_FUNCTION vec2 exponential_warp(float depth, vec2 exponents) {
  return vec2(exp(exponents.x * depth), -exp(-exponents.y * depth));
}

// Largest exponent whose warp has a square that a float of so many bits can hold. With 16 bits that is half the
// logarithm of the largest number; with 32 bits it is less, so that also a sum of 100 squares is finite: compilers may
// add texels before they multiply by a common weight.
GLSL_FUNCTION float largest_exponent(int bits) { return bits == 16 ? 5.54f : 42.0f; }

// Four moments of depths in -1..1, as 16 bits hold them with the least loss: two pairs, each turned so that the moments
// of every distribution fill 0..1 (Peters and Klein 2015, for depths in 0..1). Of the even ones, b4 is at
// least b2² and at most b2; the odd ones lie in the hull of the curve (x, x³).
GLSL_FUNCTION vec4 packed_moments(vec4 moments) {
  return vec4(1.5f * moments.x - 2.0f * moments.z + 0.5f,
              0.86602540f * moments.x - 0.38490018f * moments.z + 0.5f,
              4.0f * (moments.y - moments.w),
              0.5f * (moments.y + moments.w));
}
GLSL_FUNCTION vec4 unpacked_moments(vec4 stored) {
  float a = stored.x - 0.5f, b = stored.y - 0.5f;
  // The inverse of ((1.5, -2), (√3/2, -2/(3√3))): its determinant is 2/√3.
  float first = 0.86602540f * (2.0f * b - 0.38490018f * a);
  float third = 0.86602540f * (1.5f * b - 0.86602540f * a);
  float half_difference = 0.125f * stored.z;
  return vec4(first, stored.w + half_difference, third, stored.w - half_difference);
}

// Upper bound of the share of a distribution that lies above a value, from the mean and the variance of the
// distribution: Chebyshev's inequality on one side (Donnelly and Lauritzen 2006).
GLSL_FUNCTION float chebyshev_bound(float value, float mean, float variance) {
  float above = value - mean;
  // The same as variance / (variance + above²), also if the variance is too large for a float, or both are 0 in it.
  return above <= 0.0f ? 1.0f : 1.0f / (1.0f + above * above / max(variance, 1e-37f));
}

// What remains of a bound of visibility if all that is darker than `cut` becomes 0 (Lauritzen 2007, Summed-area
// variance shadow maps).
GLSL_FUNCTION float without_bleeding(float bound, float cut) {
  return clamp((bound - cut) / max(1.0f - cut, 1e-4f), 0.0f, 1.0f);
}

// Upper bound of the share of a distribution in -1..1 that lies above a value, from its four moments: the distribution
// with these moments that has the most above it has three points, of which one is the value (Peters and Klein 2015,
// "Hamburger").
GLSL_FUNCTION float hamburger_bound(float value, vec4 b) {
  // Cholesky decomposition of the matrix of moments ((1, b1, b2), (b1, b2, b3), (b2, b3, b4)): unit lower triangle
  // (b1; b2, l32) with the diagonal (1, d2, d3).
  float d2 = max(b.y - b.x * b.x, 1e-9f);
  float l32 = (b.z - b.x * b.y) / d2;
  float d3 = max(b.w - b.y * b.y - l32 * l32 * d2, 1e-12f);
  // The quadratic polynomial whose roots are the two other points.
  float c1 = value - b.x;
  float c2 = value * value - b.y - l32 * c1;
  c2 /= d3;
  c1 = c1 / d2 - l32 * c2;
  float c0 = 1.0f - b.x * c1 - b.y * c2;
  if (abs(c2) < 1e-20f) return value <= b.x ? 1.0f : chebyshev_bound(value, b.x, d2);
  float p = c1 / c2, q = c0 / c2;
  float root = sqrt(max(0.25f * p * p - q, 0.0f));
  float low = -0.5f * p - root, high = -0.5f * p + root;
  if (value <= low) return 1.0f;
  // The weights of the points at or above the value.
  if (value <= high) {
    float below = (value * high - b.x * (value + high) + b.y) / ((high - low) * (value - low));
    return clamp(1.0f - below, 0.0f, 1.0f);
  }
  float at = (low * high - b.x * (low + high) + b.y) / ((value - low) * (value - high));
  return clamp(at, 0.0f, 1.0f);
}

GLSL_END

#endif
