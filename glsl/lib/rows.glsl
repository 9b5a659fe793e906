#ifndef PENUMBRA_ROWS_GLSL
#define PENUMBRA_ROWS_GLSL

// The place that follows `at` in a rectangle, row by row. Places are `stride` apart along both axes; a row begins at
// `first` and has none beyond `last`.
ivec2 next_in_rows(ivec2 at, int first, int last, int stride) {
  return at.x + stride <= last ? ivec2(at.x + stride, at.y) : ivec2(first, at.y + stride);
}

#endif
