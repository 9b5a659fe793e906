#include "pass.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>

#include "texture_format.h"

namespace penumbra::gl {
namespace {

void set_enabled(GLenum capability, bool enabled) {
  if (enabled) {
    glEnable(capability);
  } else {
    glDisable(capability);
  }
}

// What no pass wants, and what an engine around us may have left on. All but dithering are off at first.
constexpr std::array unwanted{GL_SCISSOR_TEST,        GL_STENCIL_TEST,       GL_DITHER,
                              GL_FRAMEBUFFER_SRGB,  // shaders encode
                              GL_COLOR_LOGIC_OP,      GL_RASTERIZER_DISCARD, GL_SAMPLE_MASK,
                              GL_SAMPLE_COVERAGE,     GL_SAMPLE_SHADING,     GL_SAMPLE_ALPHA_TO_COVERAGE,
                              GL_SAMPLE_ALPHA_TO_ONE, GL_LINE_SMOOTH,        GL_POLYGON_SMOOTH,
                              GL_POLYGON_OFFSET_FILL, GL_PRIMITIVE_RESTART,  GL_PRIMITIVE_RESTART_FIXED_INDEX,
                              GL_PROGRAM_POINT_SIZE};

// What passes turn on and off as they are described.
constexpr std::array described{GL_DEPTH_TEST, GL_DEPTH_CLAMP, GL_BLEND, GL_CULL_FACE};

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
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void set_depth(const PassDesc& desc) {
  set_enabled(GL_DEPTH_CLAMP, desc.depth_clamp);
  // GL writes depth only while the test is on.
  set_enabled(GL_DEPTH_TEST, desc.depth_test != DepthTest::off || desc.depth_write);
  glDepthMask(desc.depth_write ? GL_TRUE : GL_FALSE);
  switch (desc.depth_test) {
    case DepthTest::off:
      glDepthFunc(GL_ALWAYS);
      break;
    case DepthTest::less_equal:
      glDepthFunc(GL_LEQUAL);
      break;
    case DepthTest::greater_equal:
      glDepthFunc(GL_GEQUAL);
      break;
    case DepthTest::equal:
      glDepthFunc(GL_EQUAL);
      break;
  }
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

// Clears obey the write masks, which set_fixed_state() has opened for colour.
void clear(GLuint framebuffer, const PassDesc& desc) {
  for (std::size_t i = 0; i < desc.colors.size(); ++i) {
    if (desc.colors[i].clear) clear_color(framebuffer, static_cast<GLint>(i), desc.colors[i]);
  }
  if (desc.depth && desc.depth->clear) {
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &desc.depth->clear->x);
  }
}

}  // namespace

Pass::Pass(Device& device, const PassDesc& desc)
    : device_(device), group_(desc.name), timer_(device.timers, desc.name), debug_(debug_enabled()) {
  if (!desc.colors.empty() || desc.depth) {
    const GLuint framebuffer = device.framebuffer(desc.name, desc.colors, desc.depth ? &*desc.depth : nullptr);
    const Attachment& first = desc.colors.empty() ? *desc.depth : desc.colors.front();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    set_viewport(0, 0, std::max(1, first.texture->width() >> first.level),
                 std::max(1, first.texture->height() >> first.level));
    set_fixed_state(GL_ZERO_TO_ONE);
    clear(framebuffer, desc);
    set_depth(desc);
    set_blend(desc.blend);
    set_cull_back(desc.cull_back);
    glBindVertexArray(device.empty_vertex_array());
  }
  check();
}

const Program& Pass::use(const ProgramDesc& desc) {
  program_ = &device_.shaders.get(desc);
  program_->use();
  check();
  return *program_;
}

void Pass::draw_full_screen() {
  assert(program_ != nullptr);
  glBindVertexArray(device_.empty_vertex_array());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  count_draws(1, 1);
  check();
}

void Pass::set_cull_back(bool cull) { set_enabled(GL_CULL_FACE, cull); }

void Pass::set_front_clockwise(bool clockwise) { glFrontFace(clockwise ? GL_CW : GL_CCW); }

void Pass::set_viewport(int x, int y, int width, int height) { glViewport(x, y, width, height); }

void Pass::dispatch(int width, int height, int layers) {
  assert(program_ != nullptr && width > 0 && height > 0 && layers > 0);
  const glm::ivec3 size(width, height, layers);
  const glm::uvec3 groups((size + program_->group_size() - 1) / program_->group_size());
  glDispatchCompute(groups.x, groups.y, groups.z);
  device_.timers.count({0, 0, 1});
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                  GL_UNIFORM_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                  GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_PIXEL_BUFFER_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
  check();
}

void Pass::check() const {
  if (debug_) check_errors("");
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
  glDepthMask(GL_TRUE);
  constexpr GLuint texture_units = 16;
  constexpr GLsizei image_units = 8;
  unbind_textures(texture_units);
  glBindImageTextures(0, image_units, nullptr);
  glUseProgram(0);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace penumbra::gl
