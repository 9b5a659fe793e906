/* Saves the OpenGL state that penumbra_render() changes and that engines usually expect to be as it was, and restores
 * it. Engines that set all state of each of their passes need none of it. What is not here, penumbra.h lists under
 * "State". */
#ifndef STATE_GUARD_H
#define STATE_GUARD_H

#include "gl.h"

/* What one side of triangles does in the stencil test. */
typedef struct stencil_side {
  GLint function, reference, value_mask, write_mask;
  GLint fail, depth_fail, pass;
} stencil_side;

typedef struct state_guard {
  GLboolean capabilities[9];
  GLboolean color_mask[4], depth_mask;
  GLint depth_function, cull_face, front_face, clip_origin, clip_depth;
  GLint polygon_mode[2]; /* of both sides; a core context fills the first alone */
  GLfloat depth_range[2], polygon_offset[2];
  stencil_side stencil[2]; /* front, back */
  GLint blend[4];          /* source and target factors of colour, then of alpha */
  GLint viewport[4], scissor_box[4];
  GLint program, vertex_array, draw_framebuffer, read_framebuffer;
} state_guard;

void save_state(state_guard* guard);
void restore_state(const state_guard* guard);

#endif
