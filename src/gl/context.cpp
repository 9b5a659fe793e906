#include "context.h"

#include <array>
#include <string>

#include "../core/error.h"
#include "../core/names.h"

namespace penumbra::gl {
namespace {

std::unique_ptr<Context> make_offscreen_context(const ContextOptions& options) {
  std::string causes;
  for (auto* make : {make_egl_context, make_osmesa_context}) {
    try {
      return make(options);
    } catch (const Error& error) {
      causes += (causes.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  fail("no offscreen backend works here: {}", causes);
}

}  // namespace

bool debug_by_default() {
#ifdef NDEBUG
  return false;
#else
  return true;
#endif
}

std::unique_ptr<Context> make_context(std::string_view backend, const ContextOptions& options) {
  if (backend == "auto") return make_offscreen_context(options);
  if (backend == "egl") return make_egl_context(options);
  if (backend == "osmesa") return make_osmesa_context(options);
  if (backend == "window") return make_window_context(options);
  const std::array<std::string, 4> names{"auto", "egl", "osmesa", "window"};
  fail_unknown("backend", backend, names);
}

#ifdef PENUMBRA_WITHOUT_EGL
std::unique_ptr<Context> make_egl_context(const ContextOptions&) { fail("EGL: not in this build"); }
std::vector<std::string> egl_devices() { return {}; }
#endif
#ifdef PENUMBRA_WITHOUT_OSMESA
std::unique_ptr<Context> make_osmesa_context(const ContextOptions&) { fail("OSMesa: not in this build"); }
#endif
#ifdef PENUMBRA_WITHOUT_WINDOW
std::unique_ptr<Context> make_window_context(const ContextOptions&) { fail("window: not in this build"); }
GLFWwindow* window_of(const Context&) { return nullptr; }
#endif

std::string_view to_string(Backend backend) {
  switch (backend) {
    case Backend::egl:
      return "egl";
    case Backend::osmesa:
      return "osmesa";
    case Backend::window:
      return "window";
  }
  return "";
}

}  // namespace penumbra::gl
