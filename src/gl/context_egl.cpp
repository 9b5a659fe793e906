#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string>
#include <string_view>

#include "context_base.h"
#include "shared_library.h"

namespace penumbra::gl {
namespace {

// The functions of libEGL, loaded at run time. The two of device enumeration are null without the extension.
struct Egl {
  decltype(&eglGetProcAddress) get_proc_address = nullptr;
  decltype(&eglGetError) get_error = nullptr;
  decltype(&eglQueryString) query_string = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
  std::string client_extensions;

  Egl() {
    const SharedLibrary library("EGL", {"libEGL.so.1", "libEGL.so"});
    library.require(get_proc_address, "eglGetProcAddress");
    library.require(get_error, "eglGetError");
    library.require(query_string, "eglQueryString");
    library.require(initialize, "eglInitialize");
    library.require(bind_api, "eglBindAPI");
    library.require(choose_config, "eglChooseConfig");
    library.require(create_context, "eglCreateContext");
    library.require(destroy_context, "eglDestroyContext");
    library.require(make_current, "eglMakeCurrent");
    extension(get_platform_display, "eglGetPlatformDisplayEXT");
    extension(query_devices, "eglQueryDevicesEXT");
    extension(query_device_string, "eglQueryDeviceStringEXT");
    const char* extensions = query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (extensions == nullptr || get_platform_display == nullptr) {
      fail("EGL: the library has no EGL_EXT_platform_base, so it can only draw to a display");
    }
    client_extensions = extensions;
  }

 private:
  template <class Function>
  void extension(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(get_proc_address(name));
  }
};

const Egl& egl() {
  static const Egl functions;
  return functions;
}

void* egl_proc_address(const char* name) { return reinterpret_cast<void*>(egl().get_proc_address(name)); }

// Whether a list separated by spaces holds the word.
bool has_word(std::string_view list, std::string_view word) {
  return fmt::format(" {} ", list).find(fmt::format(" {} ", word)) != std::string::npos;
}

std::string error_name() {
  switch (const EGLint code = egl().get_error()) {
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    default:
      return fmt::format("EGL error {:#x}", code);
  }
}

std::vector<EGLDeviceEXT> query_devices() {
  EGLint count = 0;
  if (egl().query_devices == nullptr || egl().query_devices(0, nullptr, &count) == EGL_FALSE) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (egl().query_devices(count, devices.data(), &count) == EGL_FALSE) return {};
  return devices;
}

std::string device_name(EGLDeviceEXT device) {
  const auto query = [&](EGLint what) -> std::string {
    const char* text = egl().query_device_string == nullptr ? nullptr : egl().query_device_string(device, what);
    return text == nullptr ? "" : text;
  };
  const std::string extensions = query(EGL_EXTENSIONS);
  std::string name;
  if (has_word(extensions, "EGL_MESA_device_software")) return "Mesa software rasteriser";
  if (has_word(extensions, "EGL_EXT_device_query_name")) name = query(EGL_RENDERER_EXT);
  if (has_word(extensions, "EGL_EXT_device_drm")) {
    name += fmt::format("{}{}", name.empty() ? "" : " ", query(EGL_DRM_DEVICE_FILE_EXT));
  }
  return name.empty() ? extensions : name;
}

// What a context needs of one display, initialised; `subject` begins messages.
struct Display {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLConfig config = EGL_NO_CONFIG_KHR;
};

Display open_display(const std::string& subject, EGLenum platform, void* native) {
  Display result;
  result.display = egl().get_platform_display(platform, native, nullptr);
  if (result.display == EGL_NO_DISPLAY) fail("{}: no display ({})", subject, error_name());
  // Never terminated: all users of EGL in the process share the display.
  EGLint major = 0, minor = 0;
  if (egl().initialize(result.display, &major, &minor) == EGL_FALSE) {
    fail("{}: cannot be initialised ({})", subject, error_name());
  }
  const char* extensions = egl().query_string(result.display, EGL_EXTENSIONS);
  if (major == 1 && minor < 5) fail("{}: EGL {}.{} is too old, 1.5 is needed", subject, major, minor);
  if (!has_word(extensions, "EGL_KHR_surfaceless_context")) fail("{}: no EGL_KHR_surfaceless_context", subject);
  if (!has_word(extensions, "EGL_KHR_no_config_context")) {
    constexpr std::array attributes{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (egl().choose_config(result.display, attributes.data(), &result.config, 1, &count) == EGL_FALSE || count == 0) {
      fail("{}: no configuration for OpenGL", subject);
    }
  }
  return result;
}

class EglContext final : public ContextBase {
 public:
  EglContext(const std::string& subject, EGLenum platform, void* native, const ContextOptions& options)
      : ContextBase(options.debug), subject_(subject) {
    const Display opened = open_display(subject, platform, native);
    display_ = opened.display;
    const std::array attributes{
        EGL_CONTEXT_MAJOR_VERSION,
        4,
        EGL_CONTEXT_MINOR_VERSION,
        5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        options.compatibility ? EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT : EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_CONTEXT_OPENGL_DEBUG,
        options.debug ? EGL_TRUE : EGL_FALSE,
        EGL_NONE};
    if (egl().bind_api(EGL_OPENGL_API) == EGL_FALSE) fail("{}: no desktop OpenGL ({})", subject, error_name());
    context_ = egl().create_context(display_, opened.config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) fail("{}: no OpenGL 4.5 context ({})", subject, error_name());
  }
  ~EglContext() override {
    release();
    egl().destroy_context(display_, context_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  Backend backend() const override { return Backend::egl; }
  GetProcAddress get_proc_address() const override { return egl_proc_address; }

 private:
  void bind() override {
    if (egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      fail("{}: the context cannot be made current ({})", subject_, error_name());
    }
  }
  void unbind() noexcept override { egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  std::string subject_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::unique_ptr<Context> make_current_context(const std::string& subject, EGLenum platform, void* native,
                                              const ContextOptions& options) {
  auto context = std::make_unique<EglContext>(subject, platform, native, options);
  context->make_current();
  return context;
}

std::unique_ptr<Context> make_surfaceless_context(const ContextOptions& options) {
  if (!has_word(egl().client_extensions, "EGL_MESA_platform_surfaceless")) {
    fail("EGL: no surfaceless platform (EGL_MESA_platform_surfaceless)");
  }
  return make_current_context("EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, options);
}

std::unique_ptr<Context> make_device_context(int index, const ContextOptions& options) {
  const std::vector<EGLDeviceEXT> devices = query_devices();
  if (devices.empty()) fail("EGL: no devices (EGL_EXT_device_enumeration)");
  if (index < 0 || index >= static_cast<int>(devices.size())) {
    fail("EGL: there is no device {}; {} are listed, from 0", index, devices.size());
  }
  return make_current_context(fmt::format("EGL device {}", index), EGL_PLATFORM_DEVICE_EXT,
                              devices[static_cast<std::size_t>(index)], options);
}

}  // namespace

std::unique_ptr<Context> make_egl_context(const ContextOptions& options) {
  if (options.egl_device) return make_device_context(*options.egl_device, options);
  std::string causes;
  try {
    return make_surfaceless_context(options);
  } catch (const Error& error) {
    causes = error.what();
  }
  const int devices = static_cast<int>(query_devices().size());
  for (int index = 0; index < devices; ++index) {
    try {
      return make_device_context(index, options);
    } catch (const Error& error) {
      causes += fmt::format("; {}", error.what());
    }
  }
  fail("{}{}", causes, devices == 0 ? "; no EGL devices" : "");
}

std::vector<std::string> egl_devices() {
  std::vector<std::string> names;
  try {
    for (EGLDeviceEXT device : query_devices()) names.push_back(device_name(device));
  } catch (const Error&) {
    return {};  // no EGL at all
  }
  return names;
}

}  // namespace penumbra::gl
