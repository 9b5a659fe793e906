/* Saves the OpenGL state that penumbra_render() changes and that engines usually expect to be as it was, and restores
 * it. Engines that set all state of each of their passes need none of it. Not here are textures, samplers and images,
 * which engines bind for each pass, and rare switches: penumbra.h lists all under "State". Nor is what an engine has
 * set for one draw buffer or viewport alone: restore_state() gives all of them the first one's. */
#ifndef STATE_GUARD_H
#define STATE_GUARD_H

#include "gl.h"

/* What one side of triangles does in the stencil test. */
typedef struct stencil_side {
  GLint function, reference, value_mask, write_mask;
  GLint fail, depth_fail, pass;
} stencil_side;

/* A binding of a uniform or storage buffer. */
typedef struct buffer_range {
  GLint buffer;
  GLint64 start, size; /* size 0: the whole buffer */
} buffer_range;

typedef struct state_guard {
  GLboolean capabilities[14];
  GLboolean color_mask[4], depth_mask;
  GLint depth_function, cull_face, front_face, clip_origin, clip_depth;
  GLint polygon_mode[2]; /* of both sides; a core context fills the first alone */
  GLfloat depth_range[2], polygon_offset[2], point_size;
  stencil_side stencil[2]; /* front, back */
  GLint blend[4];          /* source and target factors of colour, then of alpha */
  GLint blend_equation[2]; /* of colour, of alpha */
  GLint viewport[4], scissor_box[4];
  GLint program, vertex_array, draw_framebuffer, read_framebuffer;
  buffer_range uniforms[3], storage; /* of the bindings 0 to 2, and 7 */
  GLint uniform_buffer, storage_buffer;
} state_guard;

void save_state(state_guard* guard);
void restore_state(const state_guard* guard);

#endif
