#include "compatibility.h"

#include <fmt/format.h>

#include "api.h"

namespace penumbra::gl {
namespace {

// Names that GL/glcorearb.h lacks, as of OpenGL 1.0 and 3.0.
constexpr GLenum list_index = 0x0B33;  // GL_LIST_INDEX
constexpr std::array<GLenum, InitialLegacyState::tests> tests{
    0x0BC0,  // GL_ALPHA_TEST
    0x0B42,  // GL_POLYGON_STIPPLE
    0x0B24,  // GL_LINE_STIPPLE
    0x0B10,  // GL_POINT_SMOOTH
};
constexpr GLenum clamp_fragment_color = 0x891B;  // GL_CLAMP_FRAGMENT_COLOR: if true, to 0..1 in float textures too
constexpr std::array<GLenum, 2> point_sizes{0x8126, 0x8127};  // GL_POINT_SIZE_MIN, GL_POINT_SIZE_MAX
constexpr float greatest_point = 8192;                        // pixels: more than any point of a pass
constexpr std::array<GLenum, InitialLegacyState::switches> switches{
    0x0D10,  // GL_MAP_COLOR
    0x0D11,  // GL_MAP_STENCIL
};
constexpr std::array<GLenum, InitialLegacyState::scales> scales{
    0x0D14, 0x0D15,  // GL_RED_SCALE, GL_RED_BIAS
    0x0D18, 0x0D19,  // GREEN
    0x0D1A, 0x0D1B,  // BLUE
    0x0D1C, 0x0D1D,  // ALPHA
    0x0D1E, 0x0D1F,  // DEPTH
};

constexpr float initial_scale(std::size_t i) { return i % 2 == 0 ? 1.0f : 0.0f; }

void set_enabled(GLenum capability, bool enabled) { enabled ? glEnable(capability) : glDisable(capability); }

}  // namespace

void find_legacy_state(Api& api, const std::function<void*(const char*)>& get_proc_address) {
  api.glPixelTransferf = reinterpret_cast<decltype(api.glPixelTransferf)>(get_proc_address("glPixelTransferf"));
  api.glPixelTransferi = reinterpret_cast<decltype(api.glPixelTransferi)>(get_proc_address("glPixelTransferi"));
  if (api.glPixelTransferf == nullptr || api.glPixelTransferi == nullptr)
    throw ContextError("OpenGL 4.5: the driver lacks glPixelTransfer in a context of the compatibility profile");
}

bool has_legacy_state() { return current_api->glPixelTransferf != nullptr; }

void set_initial_legacy_state() {
  if (!has_legacy_state()) return;
  for (const GLenum test : tests) glDisable(test);
  glClampColor(clamp_fragment_color, GL_FIXED_ONLY);
  glPointParameterf(point_sizes[0], 0.0f);
  glPointParameterf(point_sizes[1], greatest_point);
  for (const GLenum name : switches) current_api->glPixelTransferi(name, 0);
  for (std::size_t i = 0; i < scales.size(); ++i) current_api->glPixelTransferf(scales[i], initial_scale(i));
}

InitialLegacyState::InitialLegacyState() {
  if (!has_legacy_state()) return;
  for (std::size_t i = 0; i < tests_.size(); ++i) tests_[i] = glIsEnabled(gl::tests[i]) == GL_TRUE;
  glGetIntegerv(clamp_fragment_color, &fragment_clamp_);
  for (std::size_t i = 0; i < point_sizes_.size(); ++i) glGetFloatv(gl::point_sizes[i], &point_sizes_[i]);
  for (std::size_t i = 0; i < switches_.size(); ++i) glGetIntegerv(gl::switches[i], &switches_[i]);
  for (std::size_t i = 0; i < scales_.size(); ++i) glGetFloatv(gl::scales[i], &scales_[i]);
  set_initial_legacy_state();
}

InitialLegacyState::~InitialLegacyState() {
  if (!has_legacy_state()) return;
  for (std::size_t i = 0; i < tests_.size(); ++i) set_enabled(gl::tests[i], tests_[i]);
  glClampColor(clamp_fragment_color, static_cast<GLenum>(fragment_clamp_));
  for (std::size_t i = 0; i < point_sizes_.size(); ++i) glPointParameterf(gl::point_sizes[i], point_sizes_[i]);
  for (std::size_t i = 0; i < switches_.size(); ++i) current_api->glPixelTransferi(gl::switches[i], switches_[i]);
  for (std::size_t i = 0; i < scales_.size(); ++i) current_api->glPixelTransferf(gl::scales[i], scales_[i]);
}

void check_context_is_current(const char* subject) {
  if (current_api == nullptr)
    throw ContextError(fmt::format("{}: OpenGL's entry points are not loaded; call load_api()", subject));
  GLint major = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  if (major == 0) throw ContextError(fmt::format("{}: no OpenGL context is current", subject));
}

void check_context_is_ready(const char* subject) {
  check_context_is_current(subject);
  GLboolean active = GL_FALSE, paused = GL_FALSE;
  glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
  glGetBooleanv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
  if (active == GL_TRUE && paused == GL_FALSE)
    throw ContextError(fmt::format("{}: transform feedback is active; end or pause it before", subject));
  if (!has_legacy_state()) return;
  GLint list = 0;
  glGetIntegerv(list_index, &list);
  if (list != 0)
    throw ContextError(fmt::format("{}: OpenGL records calls for the display list {}; end it before", subject, list));
}

}  // namespace penumbra::gl
