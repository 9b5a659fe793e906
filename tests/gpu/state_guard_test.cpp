// What the C example's state guard saves, it restores, whatever a frame leaves.
#include <array>
#include <map>
#include <vector>

#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra::test {
namespace {

using namespace gl;  // in place of the example's own loader
#define GL_H
#include "c_minimal/state_guard.c"  // NOLINT(bugprone-suspicious-include)

using State = std::map<GLenum, std::vector<double>>;

// The state that engines set for their own passes.
State present_state() {
  State state;
  for (const GLenum name :
       {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_BLEND, GL_CULL_FACE, GL_DEPTH_CLAMP, GL_FRAMEBUFFER_SRGB,
        GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT, GL_DITHER, GL_PRIMITIVE_RESTART,
        GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_PROGRAM_POINT_SIZE})
    state[name] = {glIsEnabled(name) != 0 ? 1.0 : 0.0};
  const std::map<GLenum, std::size_t> values{{GL_SCISSOR_BOX, 4},
                                             {GL_VIEWPORT, 4},
                                             {GL_COLOR_WRITEMASK, 4},
                                             {GL_DEPTH_RANGE, 2},
                                             {GL_DEPTH_WRITEMASK, 1},
                                             {GL_DEPTH_FUNC, 1},
                                             {GL_CULL_FACE_MODE, 1},
                                             {GL_FRONT_FACE, 1},
                                             {GL_POLYGON_MODE, 1},
                                             {GL_POLYGON_OFFSET_FACTOR, 1},
                                             {GL_POLYGON_OFFSET_UNITS, 1},
                                             {GL_STENCIL_FUNC, 1},
                                             {GL_STENCIL_REF, 1},
                                             {GL_STENCIL_VALUE_MASK, 1},
                                             {GL_STENCIL_WRITEMASK, 1},
                                             {GL_STENCIL_FAIL, 1},
                                             {GL_STENCIL_PASS_DEPTH_FAIL, 1},
                                             {GL_STENCIL_PASS_DEPTH_PASS, 1},
                                             {GL_STENCIL_BACK_FUNC, 1},
                                             {GL_STENCIL_BACK_REF, 1},
                                             {GL_STENCIL_BACK_WRITEMASK, 1},
                                             {GL_STENCIL_BACK_FAIL, 1},
                                             {GL_CLIP_ORIGIN, 1},
                                             {GL_CLIP_DEPTH_MODE, 1},
                                             {GL_BLEND_SRC_RGB, 1},
                                             {GL_BLEND_DST_ALPHA, 1},
                                             {GL_BLEND_EQUATION_RGB, 1},
                                             {GL_BLEND_EQUATION_ALPHA, 1},
                                             {GL_POINT_SIZE, 1}};
  for (const auto& [name, count] : values) {
    std::array<GLfloat, 4> numbers{};
    glGetFloatv(name, numbers.data());
    state[name].assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count));
  }
  const auto add_range = [&](GLenum buffer, GLenum start, GLenum size, GLuint index) {
    GLint bound = 0;
    GLint64 first = 0, bytes = 0;
    glGetIntegeri_v(buffer, index, &bound);
    glGetInteger64i_v(start, index, &first);
    glGetInteger64i_v(size, index, &bytes);
    state[buffer].insert(state[buffer].end(),
                         {static_cast<double>(bound), static_cast<double>(first), static_cast<double>(bytes)});
  };
  for (const GLuint index : {0U, 1U, 2U})
    add_range(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, index);
  add_range(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE, 7);
  return state;
}

// `buffer`: one of the engine's.
void set_state_of_an_engine(GLuint buffer) {
  for (const GLenum name : {GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_PROGRAM_POINT_SIZE}) glEnable(name);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer);
  glBindBufferRange(GL_UNIFORM_BUFFER, 1, buffer, 256, 64);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, buffer);
  for (const GLenum name : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE}) glEnable(name);
  glDisable(GL_DITHER);
  glScissor(3, 5, 7, 11);
  glViewport(1, 2, 30, 40);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glDepthRangef(0.25F, 0.75F);
  glDepthFunc(GL_GREATER);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glPolygonOffset(2, 3);
  glStencilFuncSeparate(GL_FRONT, GL_EQUAL, 5, 0x0f);
  glStencilFuncSeparate(GL_BACK, GL_NOTEQUAL, 6, 0xf0);
  glStencilOpSeparate(GL_FRONT, GL_ZERO, GL_INCR, GL_REPLACE);
  glStencilOpSeparate(GL_BACK, GL_INVERT, GL_DECR, GL_KEEP);
  glStencilMask(0x3c);
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glBlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MIN);
  glPointSize(5);
}

void set_state_of_a_frame() {
  for (const GLenum name : {GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_PROGRAM_POINT_SIZE}) glDisable(name);
  for (const GLuint index : {0U, 1U, 2U}) glBindBufferBase(GL_UNIFORM_BUFFER, index, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, 0);
  for (const GLenum name : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE}) glDisable(name);
  glEnable(GL_DITHER);
  glScissor(0, 0, 256, 256);
  glViewport(0, 0, 64, 64);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthRangef(0, 1);
  glDepthFunc(GL_LESS);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glPolygonOffset(0, 0);
  glStencilFunc(GL_ALWAYS, 0, ~0U);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  glStencilMask(~0U);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glBlendEquation(GL_FUNC_ADD);
  glPointSize(1);
}

class StateGuard : public GpuTest {};

TEST_F(StateGuard, RestoresWhatAnEngineHadSet) {
  set_state_of_a_frame();
  const State of_frame = present_state();
  GLuint buffer = 0;
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, 1024, nullptr, 0);
  set_state_of_an_engine(buffer);
  const State of_engine = present_state();
  state_guard guard;
  save_state(&guard);
  set_state_of_a_frame();
  restore_state(&guard);
  EXPECT_EQ(present_state(), of_engine);
  int differing = 0;
  for (const auto& [name, values] : of_frame) differing += values != of_engine.at(name) ? 1 : 0;
  EXPECT_GE(differing, 27);
  set_state_of_a_frame();
  glDeleteBuffers(1, &buffer);
}

}  // namespace
}  // namespace penumbra::test
