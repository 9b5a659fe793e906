/* Saves the OpenGL state that penumbra_render() changes and that engines usually expect to be as it was, and restores
 * it. Engines that set all state of each of their passes need none of it. What is not here, penumbra.h lists under
 * "State". */
#ifndef STATE_GUARD_H
#define STATE_GUARD_H

#include "gl.h"

typedef struct state_guard {
  GLboolean capabilities[8];
  GLboolean color_mask[4], depth_mask;
  GLint depth_function, cull_face, front_face, clip_origin, clip_depth;
  GLint blend[4]; /* source and target factors of colour, then of alpha */
  GLint viewport[4];
  GLint program, vertex_array, draw_framebuffer, read_framebuffer;
} state_guard;

void save_state(state_guard* guard);
void restore_state(const state_guard* guard);

#endif
