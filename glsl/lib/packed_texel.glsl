// A pixel's shadow in 32 bits (Deligiannis 2019, section 3.3): bits 0 to 14 mean blocker distance, half precision, 0
// for none; 15 set if it has no noise, so that filters of visibility keep it; 16 to 30 visibility; 31 history invalid.
// For integer textures: float ones may change bit patterns.
#ifndef PENUMBRA_PACKED_TEXEL_GLSL
#define PENUMBRA_PACKED_TEXEL_GLSL

#include "shared/language.h"

GLSL_BEGIN

// The nearest half to a float that is not negative, ties to even; 65504 for all larger values, 0 for NaN. In integers,
// since the rounding of packHalf2x16 differs from driver to driver.
GLSL_FUNCTION uint half_bits(float value) {
  float v = value > 0.0f ? min(value, 65504.0f) : 0.0f;
  if (v < 6.103515625e-5f) return uint(roundEven(v * 16777216.0f));
  uint bits = floatBitsToUint(v);
  return (bits + 0xfffu + ((bits >> 13) & 1u) - 0x38000000u) >> 13;
}

GLSL_FUNCTION float half_value(uint bits) {
  return bits < 0x400u ? float(bits) / 16777216.0f : uintBitsToFloat((bits << 13) + 0x38000000u);
}

GLSL_FUNCTION uint pack_texel(float distance_to, float visibility, bool invalid) {
  float v = visibility > 0.0f ? min(visibility, 1.0f) : 0.0f;
  return half_bits(distance_to) | (uint(v * 32767.0f + 0.5f) << 16) | (invalid ? 0x80000000u : 0u);
}

const uint distance_bits = 0x7fffu;
const uint noise_free_bit = 0x8000u;
const uint visibility_bits = 0x7fff0000u;

GLSL_FUNCTION float texel_distance(uint texel) { return half_value(texel & distance_bits); }
GLSL_FUNCTION float texel_visibility(uint texel) { return float((texel >> 16) & 0x7fffu) / 32767.0f; }
GLSL_FUNCTION bool texel_noise_free(uint texel) { return (texel & noise_free_bit) != 0u; }
GLSL_FUNCTION bool texel_invalid(uint texel) { return (texel & 0x80000000u) != 0u; }

// With history.mean each texel holds, after the blend, how many frames it averages instead, in bits 15 and 0 to 3. Its
// distance then has bits 4 to 14 alone: see blended_distance().
const uint most_frames = 31u;

GLSL_FUNCTION uint with_frames(uint texel, uint frames) {
  return (texel & 0xffff7ff0u) | (frames & 15u) | ((frames & 16u) << 11);
}

GLSL_FUNCTION uint texel_frames(uint texel) { return (texel & 15u) | ((texel >> 11) & 16u); }

// The note stored with each packed texel, eight bits: bits 0 to 2 the layer of the shadow map that was read; bit 3 set
// if the shadow is narrow (see Shadowed); bit 4 set if the kernel is smaller than a texel of the map; bits 5 to 7
// whether the history was used, or why it was rejected.
#define HISTORY_KEPT 0u
#define HISTORY_NONE 1u            // there is no history: a first frame, a cut, a new size
#define HISTORY_OFF_SCREEN 2u      // the surface was outside of the picture
#define HISTORY_OTHER_SURFACE 3u   // another surface was visible there
#define HISTORY_CASTER_MOVED 4u    // a caster moved that may block the light

GLSL_FUNCTION uint pack_notes(int layer, bool under_texel, bool narrow, uint refusal) {
  return uint(layer) | (narrow ? 8u : 0u) | (under_texel ? 16u : 0u) | (refusal << 5);
}

GLSL_FUNCTION int notes_layer(uint notes) { return int(notes & 7u); }
GLSL_FUNCTION bool notes_narrow(uint notes) { return (notes & 8u) != 0u; }
GLSL_FUNCTION bool notes_under_texel(uint notes) { return (notes & 16u) != 0u; }
GLSL_FUNCTION uint notes_refusal(uint notes) { return notes >> 5; }

// What a mask holds of a pixel's visibility: the visibility, or -1 to -2 where the shadow is narrow.
GLSL_FUNCTION float stored_visibility(float visibility, bool narrow) {
  return narrow ? -1.0f - visibility : visibility;
}

GLSL_END

#endif
