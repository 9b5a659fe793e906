#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "context_base.h"
#include "shared_library.h"

namespace penumbra::gl {
namespace {

// The functions of libglfw, loaded at run time: a server without a display need not have it.
struct Glfw {
  decltype(&glfwInit) init = nullptr;
  decltype(&glfwGetError) get_error = nullptr;
  decltype(&glfwWindowHint) window_hint = nullptr;
  decltype(&glfwCreateWindow) create_window = nullptr;
  decltype(&glfwDestroyWindow) destroy_window = nullptr;
  decltype(&glfwMakeContextCurrent) make_context_current = nullptr;
  decltype(&glfwGetProcAddress) get_proc_address = nullptr;
  decltype(&glfwSwapInterval) swap_interval = nullptr;

  Glfw() {
    const SharedLibrary library("window", {"libglfw.so.3", "libglfw.so"});
    library.require(init, "glfwInit");
    library.require(get_error, "glfwGetError");
    library.require(window_hint, "glfwWindowHint");
    library.require(create_window, "glfwCreateWindow");
    library.require(destroy_window, "glfwDestroyWindow");
    library.require(make_context_current, "glfwMakeContextCurrent");
    library.require(get_proc_address, "glfwGetProcAddress");
    library.require(swap_interval, "glfwSwapInterval");
  }

  std::string cause() const {
    const char* text = nullptr;
    get_error(&text);
    return text == nullptr ? "GLFW gives no cause" : text;
  }
};

const Glfw& glfw() {
  static const Glfw functions;
  return functions;
}

void* glfw_proc_address(const char* name) { return reinterpret_cast<void*>(glfw().get_proc_address(name)); }

class WindowContext final : public ContextBase {
 public:
  explicit WindowContext(const ContextOptions& options) : ContextBase(options.debug), vsync_(options.vsync) {
    // Never terminated: another user of GLFW in the process may rely on it.
    if (glfw().init() == GLFW_FALSE) fail("window: {}", glfw().cause());
    glfw().window_hint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfw().window_hint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfw().window_hint(GLFW_OPENGL_PROFILE,
                       options.compatibility ? GLFW_OPENGL_COMPAT_PROFILE : GLFW_OPENGL_CORE_PROFILE);
    glfw().window_hint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    glfw().window_hint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    glfw().window_hint(GLFW_DEPTH_BITS, 0);
    glfw().window_hint(GLFW_STENCIL_BITS, 0);
    window_ = glfw().create_window(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) fail("window: no window with an OpenGL 4.5 context ({})", glfw().cause());
  }
  ~WindowContext() override {
    release();
    glfw().destroy_window(window_);
  }
  WindowContext(const WindowContext&) = delete;
  WindowContext& operator=(const WindowContext&) = delete;

  Backend backend() const override { return Backend::window; }
  GetProcAddress get_proc_address() const override { return glfw_proc_address; }
  GLFWwindow* window() const { return window_; }

 private:
  void bind() override {
    glfw().make_context_current(window_);
    glfw().swap_interval(vsync_ ? 1 : 0);
  }
  void unbind() noexcept override { glfw().make_context_current(nullptr); }

  bool vsync_;
  GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_window_context(const ContextOptions& options) {
  auto context = std::make_unique<WindowContext>(options);
  context->make_current();
  return context;
}

GLFWwindow* window_of(const Context& context) {
  return context.backend() == Backend::window ? static_cast<const WindowContext&>(context).window() : nullptr;
}

}  // namespace penumbra::gl
