#ifndef PENUMBRA_WIDE_GLSL
#define PENUMBRA_WIDE_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Integers modulo 2^64, as two words: x the lower one, y the higher one.

GLSL_FUNCTION uvec2 wide_add(uvec2 a, uvec2 b) {
  uint low = a.x + b.x;
  return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}

GLSL_FUNCTION uvec2 wide_subtract(uvec2 a, uvec2 b) {
  return uvec2(a.x - b.x, a.y - b.y - (a.x < b.x ? 1u : 0u));
}

GLSL_FUNCTION uvec2 wide_product(uint a, uint b) {
  uint a_low = a & 0xffffu, a_high = a >> 16;
  uint b_low = b & 0xffffu, b_high = b >> 16;
  uint low = a_low * b_low;
  uint middle = a_high * b_low + (low >> 16);
  uint other = a_low * b_high + (middle & 0xffffu);
  return uvec2((low & 0xffffu) | (other << 16), a_high * b_high + (middle >> 16) + (other >> 16));
}

GLSL_FUNCTION uvec2 wide_times(uvec2 a, uint b) {
  uvec2 product = wide_product(a.x, b);
  return uvec2(product.x, product.y + a.y * b);
}

// The nearest float, or its neighbour: of a number from 0 to 2^64, and of one from -2^63 to 2^63.
GLSL_FUNCTION float wide_unsigned(uvec2 a) { return float(a.y) * 4294967296.0f + float(a.x); }
GLSL_FUNCTION float wide_signed(uvec2 a) {
  return a.y >= 0x80000000u ? -wide_unsigned(wide_subtract(uvec2(0u), a)) : wide_unsigned(a);
}

GLSL_END

#endif
