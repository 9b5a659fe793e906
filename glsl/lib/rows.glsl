#ifndef PENUMBRA_ROWS_GLSL
#define PENUMBRA_ROWS_GLSL

// The place after one of a rectangle, row by row, `stride` apart along each axis: a row has its first place at x =
// first, and none beyond x = last.
ivec2 next_in_rows(ivec2 at, int first, int last, int stride) {
  return at.x + stride <= last ? ivec2(at.x + stride, at.y) : ivec2(first, at.y + stride);
}

#endif
