// The state that a raster pass sets, and the initial values that are left behind.
#include "pass_state.h"

#include <array>
#include <glm/gtc/type_ptr.hpp>

#include "../core/error.h"
#include "compatibility.h"
#include "pass.h"
#include "texture_format.h"

namespace penumbra::gl {
namespace {

constexpr GLuint all_bits = ~0u;

void set_enabled(GLenum capability, bool enabled) {
  if (enabled) {
    glEnable(capability);
  } else {
    glDisable(capability);
  }
}

// Capabilities that no pass uses and that an engine may have left on. Initially all but dithering are off.
constexpr std::array unwanted{GL_SCISSOR_TEST,        GL_DITHER,
                              GL_FRAMEBUFFER_SRGB,  // shaders encode
                              GL_COLOR_LOGIC_OP,      GL_RASTERIZER_DISCARD,
                              GL_SAMPLE_MASK,         GL_SAMPLE_COVERAGE,
                              GL_SAMPLE_SHADING,      GL_SAMPLE_ALPHA_TO_COVERAGE,
                              GL_SAMPLE_ALPHA_TO_ONE, GL_LINE_SMOOTH,
                              GL_POLYGON_SMOOTH,      GL_POLYGON_OFFSET_FILL,
                              GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT,  // some drivers apply them to all faces
                              GL_PRIMITIVE_RESTART,   GL_PRIMITIVE_RESTART_FIXED_INDEX,
                              GL_PROGRAM_POINT_SIZE};

// Capabilities that a PassDesc turns on and off.
constexpr std::array described{GL_DEPTH_TEST, GL_STENCIL_TEST, GL_DEPTH_CLAMP, GL_BLEND, GL_CULL_FACE};

// State that passes share, at OpenGL's initial values but for the range of clip-space depth.
void set_fixed_state(GLenum clip_depth) {
  for (const auto capability : unwanted) glDisable(static_cast<GLenum>(capability));
  constexpr GLenum clip_distances = 8;  // that every driver has
  for (GLenum i = 0; i < clip_distances; ++i) glDisable(GL_CLIP_DISTANCE0 + i);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glClipControl(GL_LOWER_LEFT, clip_depth);
  glDepthRange(0.0, 1.0);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  glPointSize(1.0f);
  glLineWidth(1.0f);
  // Clears obey the write masks.
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glStencilMask(all_bits);
}

GLenum function_of(DepthTest test) {
  switch (test) {
    case DepthTest::off:
      break;
    case DepthTest::less:
      return GL_LESS;
    case DepthTest::less_equal:
      return GL_LEQUAL;
    case DepthTest::equal:
      return GL_EQUAL;
    case DepthTest::greater_equal:
      return GL_GEQUAL;
    case DepthTest::greater:
      return GL_GREATER;
  }
  return GL_ALWAYS;
}

void set_depth(const PassDesc& desc) {
  set_enabled(GL_DEPTH_CLAMP, desc.depth_clamp);
  if (desc.depth_reversed) glDepthRange(1.0, 0.0);
  // GL writes depth only while the test is on.
  set_enabled(GL_DEPTH_TEST, desc.depth_test != DepthTest::off || desc.depth_write);
  glDepthMask(desc.depth_write ? GL_TRUE : GL_FALSE);
  glDepthFunc(function_of(desc.depth_test));
}

// The enumerators are in the order of these.
GLenum function_of(StencilTest test) {
  static constexpr std::array<GLenum, 8> functions{GL_ALWAYS, GL_NEVER,    GL_LESS,   GL_LEQUAL,
                                                   GL_EQUAL,  GL_NOTEQUAL, GL_GEQUAL, GL_GREATER};
  return functions.at(static_cast<std::size_t>(test));
}

GLenum operation_of(StencilOp op) {
  static constexpr std::array<GLenum, 8> operations{GL_KEEP,      GL_ZERO, GL_REPLACE,   GL_INCR,
                                                    GL_INCR_WRAP, GL_DECR, GL_DECR_WRAP, GL_INVERT};
  return operations.at(static_cast<std::size_t>(op));
}

void set_stencil_face(GLenum side, const StencilFace& face, const Stencil& stencil) {
  glStencilFuncSeparate(side, function_of(face.test), static_cast<GLint>(stencil.reference), stencil.read_mask);
  glStencilOpSeparate(side, operation_of(face.fail), operation_of(face.depth_fail), operation_of(face.pass));
}

void set_stencil(const std::optional<Stencil>& stencil) {
  set_enabled(GL_STENCIL_TEST, stencil.has_value());
  if (!stencil) return;
  set_stencil_face(GL_FRONT, stencil->front, *stencil);
  set_stencil_face(GL_BACK, stencil->back, *stencil);
  glStencilMask(stencil->write_mask);
}

void set_blend(Blend blend) {
  set_enabled(GL_BLEND, blend != Blend::off);
  switch (blend) {
    case Blend::off:
      break;
    case Blend::premultiplied_over:
      glBlendEquation(GL_FUNC_ADD);
      glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      break;
    case Blend::min:
      glBlendEquation(GL_MIN);
      break;
    case Blend::max:
      glBlendEquation(GL_MAX);
      break;
    case Blend::add:
      glBlendEquation(GL_FUNC_ADD);
      glBlendFunc(GL_ONE, GL_ONE);
      break;
  }
}

void set_channels(unsigned channels) {
  const auto writes = [&](unsigned bit) { return static_cast<GLboolean>((channels >> bit & 1u) != 0); };
  glColorMask(writes(0), writes(1), writes(2), writes(3));
}

void clear_color(GLuint framebuffer, GLint index, const Attachment& attachment) {
  const glm::vec4& value = *attachment.clear;
  switch (format_info(attachment.texture->desc().format).kind) {
    case ChannelKind::unsigned_integer:
      glClearNamedFramebufferuiv(framebuffer, GL_COLOR, index, glm::value_ptr(glm::uvec4(value)));
      break;
    case ChannelKind::signed_integer:
      glClearNamedFramebufferiv(framebuffer, GL_COLOR, index, glm::value_ptr(glm::ivec4(value)));
      break;
    default:
      glClearNamedFramebufferfv(framebuffer, GL_COLOR, index, glm::value_ptr(value));
      break;
  }
}

void clear(GLuint framebuffer, const PassDesc& desc) {
  for (std::size_t i = 0; i < desc.colors.size(); ++i) {
    if (desc.colors[i].clear) clear_color(framebuffer, static_cast<GLint>(i), desc.colors[i]);
  }
  if (desc.depth && desc.depth->clear) glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &desc.depth->clear->x);
  if (desc.stencil && desc.stencil->clear) {
    const auto value = static_cast<GLint>(*desc.stencil->clear);
    glClearNamedFramebufferiv(framebuffer, GL_STENCIL, 0, &value);
  }
}

void invalidate(GLuint framebuffer, const PassDesc& desc) {
  std::vector<GLenum> points;
  for (std::size_t i = 0; i < desc.colors.size(); ++i) {
    if (desc.colors[i].dont_care) points.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
  }
  if (desc.depth && desc.depth->dont_care) points.push_back(GL_DEPTH_ATTACHMENT);
  if (desc.stencil && desc.stencil->dont_care) points.push_back(GL_STENCIL_ATTACHMENT);
  if (points.empty()) return;
  glInvalidateNamedFramebufferData(framebuffer, static_cast<GLsizei>(points.size()), points.data());
}

bool has_stencil(const Texture& texture) {
  return format_info(texture.desc().format).kind == ChannelKind::depth_stencil;
}

}  // namespace

GLenum depth_attachment_point(const Texture& depth) {
  return has_stencil(depth) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

void begin_raster_state(GLuint framebuffer, const PassDesc& desc) {
  if (desc.stencil && (!desc.depth || !has_stencil(*desc.depth->texture))) {
    fail("pass '{}': it tests stencil, and its depth texture has none", desc.name);
  }
  set_initial_legacy_state();
  set_fixed_state(GL_ZERO_TO_ONE);
  invalidate(framebuffer, desc);
  clear(framebuffer, desc);
  set_depth(desc);
  set_stencil(desc.stencil);
  set_blend(desc.blend);
  set_channels(desc.channels);
  set_enabled(GL_CULL_FACE, desc.cull_back);
  if (!desc.scissor) return;
  glEnable(GL_SCISSOR_TEST);
  // Not glScissor(), which changes the boxes of all viewports.
  glScissorIndexed(0, desc.scissor->x, desc.scissor->y, desc.scissor->width, desc.scissor->height);
}

void unbind_textures(GLuint count) {
  glBindTextures(0, static_cast<GLsizei>(count), nullptr);
  glBindSamplers(0, static_cast<GLsizei>(count), nullptr);
}

void leave_initial_state() {
  set_fixed_state(GL_NEGATIVE_ONE_TO_ONE);
  for (const auto capability : described) glDisable(static_cast<GLenum>(capability));
  glEnable(GL_DITHER);
  glDepthFunc(GL_LESS);
  glStencilFunc(GL_ALWAYS, 0, all_bits);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  glBlendEquation(GL_FUNC_ADD);
  constexpr GLuint texture_units = 16;
  constexpr GLsizei image_units = 8;
  unbind_textures(texture_units);
  glBindImageTextures(0, image_units, nullptr);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glUseProgram(0);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace penumbra::gl
