#include "state_guard.h"

enum { capability_count = 14, uniform_count = 3, storage_binding = 7 };

static const GLenum capabilities[capability_count] = {GL_DEPTH_TEST,
                                                      GL_STENCIL_TEST,
                                                      GL_SCISSOR_TEST,
                                                      GL_BLEND,
                                                      GL_CULL_FACE,
                                                      GL_DEPTH_CLAMP,
                                                      GL_FRAMEBUFFER_SRGB,
                                                      GL_POLYGON_OFFSET_FILL,
                                                      GL_POLYGON_OFFSET_LINE,
                                                      GL_POLYGON_OFFSET_POINT,
                                                      GL_DITHER,
                                                      GL_PRIMITIVE_RESTART,
                                                      GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                                      GL_PROGRAM_POINT_SIZE};

static const GLenum stencil_names[2][7] = {
    {GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_WRITEMASK, GL_STENCIL_FAIL,
     GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS},
    {GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK, GL_STENCIL_BACK_WRITEMASK,
     GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_PASS}};

static void save_stencil(stencil_side* side, const GLenum* names) {
  glGetIntegerv(names[0], &side->function);
  glGetIntegerv(names[1], &side->reference);
  glGetIntegerv(names[2], &side->value_mask);
  glGetIntegerv(names[3], &side->write_mask);
  glGetIntegerv(names[4], &side->fail);
  glGetIntegerv(names[5], &side->depth_fail);
  glGetIntegerv(names[6], &side->pass);
}

static void restore_stencil(const stencil_side* side, GLenum face) {
  glStencilFuncSeparate(face, (GLenum)side->function, side->reference, (GLuint)side->value_mask);
  glStencilMaskSeparate(face, (GLuint)side->write_mask);
  glStencilOpSeparate(face, (GLenum)side->fail, (GLenum)side->depth_fail, (GLenum)side->pass);
}

static void save_range(buffer_range* range, GLuint index, GLenum buffer, GLenum start, GLenum size) {
  glGetIntegeri_v(buffer, index, &range->buffer);
  glGetInteger64i_v(start, index, &range->start);
  glGetInteger64i_v(size, index, &range->size);
}

static void restore_range(const buffer_range* range, GLenum target, GLuint index) {
  if (range->size == 0) {
    glBindBufferBase(target, index, (GLuint)range->buffer);
  } else {
    glBindBufferRange(target, index, (GLuint)range->buffer, (GLintptr)range->start, (GLsizeiptr)range->size);
  }
}

void save_state(state_guard* guard) {
  for (int i = 0; i < capability_count; ++i) guard->capabilities[i] = glIsEnabled(capabilities[i]);
  glGetBooleanv(GL_COLOR_WRITEMASK, guard->color_mask);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &guard->depth_mask);
  glGetIntegerv(GL_DEPTH_FUNC, &guard->depth_function);
  glGetIntegerv(GL_CULL_FACE_MODE, &guard->cull_face);
  glGetIntegerv(GL_FRONT_FACE, &guard->front_face);
  glGetIntegerv(GL_CLIP_ORIGIN, &guard->clip_origin);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &guard->clip_depth);
  glGetIntegerv(GL_POLYGON_MODE, guard->polygon_mode);
  glGetFloatv(GL_DEPTH_RANGE, guard->depth_range);
  glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &guard->polygon_offset[0]);
  glGetFloatv(GL_POLYGON_OFFSET_UNITS, &guard->polygon_offset[1]);
  glGetFloatv(GL_POINT_SIZE, &guard->point_size);
  for (int i = 0; i < 2; ++i) save_stencil(&guard->stencil[i], stencil_names[i]);
  glGetIntegerv(GL_BLEND_SRC_RGB, &guard->blend[0]);
  glGetIntegerv(GL_BLEND_DST_RGB, &guard->blend[1]);
  glGetIntegerv(GL_BLEND_SRC_ALPHA, &guard->blend[2]);
  glGetIntegerv(GL_BLEND_DST_ALPHA, &guard->blend[3]);
  glGetIntegerv(GL_BLEND_EQUATION_RGB, &guard->blend_equation[0]);
  glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &guard->blend_equation[1]);
  glGetIntegerv(GL_VIEWPORT, guard->viewport);
  glGetIntegerv(GL_SCISSOR_BOX, guard->scissor_box);
  glGetIntegerv(GL_CURRENT_PROGRAM, &guard->program);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &guard->vertex_array);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &guard->draw_framebuffer);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &guard->read_framebuffer);
  for (GLuint i = 0; i < uniform_count; ++i)
    save_range(&guard->uniforms[i], i, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE);
  save_range(&guard->storage, storage_binding, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
             GL_SHADER_STORAGE_BUFFER_SIZE);
  glGetIntegerv(GL_UNIFORM_BUFFER_BINDING, &guard->uniform_buffer);
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &guard->storage_buffer);
}

void restore_state(const state_guard* guard) {
  for (int i = 0; i < capability_count; ++i) {
    if (guard->capabilities[i]) {
      glEnable(capabilities[i]);
    } else {
      glDisable(capabilities[i]);
    }
  }
  glColorMask(guard->color_mask[0], guard->color_mask[1], guard->color_mask[2], guard->color_mask[3]);
  glDepthMask(guard->depth_mask);
  glDepthFunc((GLenum)guard->depth_function);
  glCullFace((GLenum)guard->cull_face);
  glFrontFace((GLenum)guard->front_face);
  glClipControl((GLenum)guard->clip_origin, (GLenum)guard->clip_depth);
  glPolygonMode(GL_FRONT_AND_BACK, (GLenum)guard->polygon_mode[0]);
  glDepthRangef(guard->depth_range[0], guard->depth_range[1]);
  glPolygonOffset(guard->polygon_offset[0], guard->polygon_offset[1]);
  glPointSize(guard->point_size);
  restore_stencil(&guard->stencil[0], GL_FRONT);
  restore_stencil(&guard->stencil[1], GL_BACK);
  glBlendFuncSeparate((GLenum)guard->blend[0], (GLenum)guard->blend[1], (GLenum)guard->blend[2],
                      (GLenum)guard->blend[3]);
  glBlendEquationSeparate((GLenum)guard->blend_equation[0], (GLenum)guard->blend_equation[1]);
  glViewport(guard->viewport[0], guard->viewport[1], guard->viewport[2], guard->viewport[3]);
  glScissorIndexed(0, guard->scissor_box[0], guard->scissor_box[1], guard->scissor_box[2], guard->scissor_box[3]);
  glUseProgram((GLuint)guard->program);
  glBindVertexArray((GLuint)guard->vertex_array);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)guard->draw_framebuffer);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)guard->read_framebuffer);
  for (GLuint i = 0; i < uniform_count; ++i) restore_range(&guard->uniforms[i], GL_UNIFORM_BUFFER, i);
  restore_range(&guard->storage, GL_SHADER_STORAGE_BUFFER, storage_binding);
  glBindBuffer(GL_UNIFORM_BUFFER, (GLuint)guard->uniform_buffer);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, (GLuint)guard->storage_buffer);
}
