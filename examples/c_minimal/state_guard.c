#include "state_guard.h"

static const GLenum capabilities[8] = {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST,     GL_BLEND,
                                       GL_CULL_FACE,  GL_DEPTH_CLAMP,  GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL};

void save_state(state_guard* guard) {
  for (int i = 0; i < 8; ++i) guard->capabilities[i] = glIsEnabled(capabilities[i]);
  glGetBooleanv(GL_COLOR_WRITEMASK, guard->color_mask);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &guard->depth_mask);
  glGetIntegerv(GL_DEPTH_FUNC, &guard->depth_function);
  glGetIntegerv(GL_CULL_FACE_MODE, &guard->cull_face);
  glGetIntegerv(GL_FRONT_FACE, &guard->front_face);
  glGetIntegerv(GL_CLIP_ORIGIN, &guard->clip_origin);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &guard->clip_depth);
  glGetIntegerv(GL_BLEND_SRC_RGB, &guard->blend[0]);
  glGetIntegerv(GL_BLEND_DST_RGB, &guard->blend[1]);
  glGetIntegerv(GL_BLEND_SRC_ALPHA, &guard->blend[2]);
  glGetIntegerv(GL_BLEND_DST_ALPHA, &guard->blend[3]);
  glGetIntegerv(GL_VIEWPORT, guard->viewport);
  glGetIntegerv(GL_CURRENT_PROGRAM, &guard->program);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &guard->vertex_array);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &guard->draw_framebuffer);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &guard->read_framebuffer);
}

void restore_state(const state_guard* guard) {
  for (int i = 0; i < 8; ++i) {
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
  glBlendFuncSeparate((GLenum)guard->blend[0], (GLenum)guard->blend[1], (GLenum)guard->blend[2],
                      (GLenum)guard->blend[3]);
  glViewport(guard->viewport[0], guard->viewport[1], guard->viewport[2], guard->viewport[3]);
  glUseProgram((GLuint)guard->program);
  glBindVertexArray((GLuint)guard->vertex_array);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)guard->draw_framebuffer);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)guard->read_framebuffer);
}
