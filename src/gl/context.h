#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../core/error.h"

struct GLFWwindow;

namespace penumbra::gl {

using GetProcAddress = void* (*)(const char* name);

// There is no current context, or it can't be used as it is.
class ContextError : public Error {
 public:
  using Error::Error;
};

// Loads the OpenGL entry points that the calling thread uses, from the driver of the context that is current on it. The
// contexts below do this themselves; an engine with its own context, of the core or the compatibility profile, calls it
// on each thread that uses Penumbra's C++, before anything else here. `get_proc_address` is not kept. Throws
// ContextError that names what OpenGL 4.5 lacks here, a function, the version, or a current context; the thread's entry
// points are then as before.
void load_api(const std::function<void*(const char* name)>& get_proc_address);

enum class Backend { egl, osmesa, window };

// Whether the library was built with assertions (NDEBUG not defined).
bool debug_by_default();

struct ContextOptions {
  bool debug = debug_by_default();  // KHR_debug on, synchronous: an error throws from the call that made it
  std::optional<int>
      egl_device;              // EGL device platform, by index; without it the surfaceless Mesa platform, then devices
  bool compatibility = false;  // the compatibility profile, as engines may have it, instead of the core profile
  int width = 1280, height = 720;  // window only, in pixels
  std::string title = "Penumbra";
  bool visible = true;  // window only
  bool vsync = true;    // window only
};

// An OpenGL 4.5 context. Making it current also loads the calling thread's entry points from its driver. GL objects
// must be destroyed before their context, while it is current. A context is current on one thread at a time; several
// can take turns on a thread, or be used on a thread each.
class Context {
 public:
  virtual ~Context() = default;
  virtual void make_current() = 0;
  virtual Backend backend() const = 0;
  virtual GetProcAddress get_proc_address() const = 0;
};

// Each throws Error with the cause when the backend does not work here. The new context is current.
std::unique_ptr<Context> make_egl_context(const ContextOptions& options = {});
std::unique_ptr<Context> make_osmesa_context(const ContextOptions& options = {});  // loads libOSMesa at run time
std::unique_ptr<Context> make_window_context(const ContextOptions& options = {});  // GLFW

// The window of a context that make_window_context() made, with which the caller polls events and swaps buffers; null
// for other backends. It is destroyed with its context.
GLFWwindow* window_of(const Context& context);

// "auto" tries EGL, then OSMesa; else "egl", "osmesa" or "window". Throws Error listing each backend tried and why
// it failed.
std::unique_ptr<Context> make_context(std::string_view backend, const ContextOptions& options = {});

// The names of the EGL devices that EGL_EXT_device_enumeration lists; empty when unsupported.
std::vector<std::string> egl_devices();

// The driver of the current context and its limits, as `doctor`, --stats and `bench` print them.
struct DeviceInfo {
  std::string vendor, renderer, version, glsl_version;
  bool software = false;  // llvmpipe, softpipe, swr, SwiftShader
  struct Limit {
    std::string name;
    long long value;
  };
  std::vector<Limit> limits;
};
DeviceInfo device_info();

std::string_view to_string(Backend backend);

}  // namespace penumbra::gl
