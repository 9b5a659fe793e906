#ifndef PENUMBRA_HASH_GLSL
#define PENUMBRA_HASH_GLSL

#include "shared/language.h"

GLSL_BEGIN

// Jarzynski and Olano 2020, "Hash functions for GPU rendering": pcg2d, two independent words from two.
GLSL_FUNCTION uvec2 pcg2d(uvec2 v) {
  v = v * 1664525u + uvec2(1013904223u);
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  v = v ^ (v >> uvec2(16u));
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  return v ^ (v >> uvec2(16u));
}

// White noise in 0..1 (1 excluded) for a pixel and a seed.
GLSL_FUNCTION vec2 white_noise(uvec2 pixel, uint seed) {
  uvec2 h = pcg2d(uvec2(pixel.x + seed * 0x9e3779b9u, pixel.y ^ (seed * 0x85ebca6bu)));
  return vec2(h >> uvec2(8u)) * (1.0f / 16777216.0f);
}

GLSL_END

#endif
