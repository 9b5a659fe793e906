#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "context_base.h"
#include "shared_library.h"

namespace penumbra::gl {
namespace {

// The functions of libOSMesa, which newer Mesa no longer ships.
struct OsMesa {
  decltype(&OSMesaCreateContextAttribs) create_context_attribs = nullptr;
  decltype(&OSMesaDestroyContext) destroy_context = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;

  OsMesa() {
    const SharedLibrary library("OSMesa", {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
    library.require(create_context_attribs, "OSMesaCreateContextAttribs");
    library.require(destroy_context, "OSMesaDestroyContext");
    library.require(make_current, "OSMesaMakeCurrent");
    library.require(get_proc_address, "OSMesaGetProcAddress");
  }
};

const OsMesa& osmesa() {
  static const OsMesa functions;
  return functions;
}

// OSMesa crashes where this names a driver that it does not have.
void check_driver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (driver == nullptr || *driver == '\0') return;
  const std::string_view name = driver;
  if (name != "llvmpipe" && name != "softpipe")
    fail("OSMesa: the environment variable GALLIUM_DRIVER is '{}'; it must be llvmpipe, softpipe or unset", name);
}

void* osmesa_proc_address(const char* name) { return reinterpret_cast<void*>(osmesa().get_proc_address(name)); }

class OsMesaContext final : public ContextBase {
 public:
  explicit OsMesaContext(const ContextOptions& options) : ContextBase(options.debug) {
    const std::array attributes{OSMESA_FORMAT,
                                static_cast<int>(OSMESA_RGBA),
                                OSMESA_PROFILE,
                                options.compatibility ? OSMESA_COMPAT_PROFILE : OSMESA_CORE_PROFILE,
                                OSMESA_CONTEXT_MAJOR_VERSION,
                                4,
                                OSMESA_CONTEXT_MINOR_VERSION,
                                5,
                                0};
    check_driver();
    context_ = osmesa().create_context_attribs(attributes.data(), nullptr);
    if (context_ == nullptr) fail("OSMesa: no OpenGL 4.5 context");
  }
  ~OsMesaContext() override {
    release();
    osmesa().destroy_context(context_);
  }
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;

  Backend backend() const override { return Backend::osmesa; }
  GetProcAddress get_proc_address() const override { return osmesa_proc_address; }

 private:
  void bind() override {
    if (osmesa().make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, size, size) == GL_FALSE) {
      fail("OSMesa: the context cannot be made current");
    }
  }
  void unbind() noexcept override { osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  // The default framebuffer, which OSMesa cannot do without and Penumbra never draws to.
  static constexpr int size = 8;
  std::array<std::uint32_t, std::size_t{size} * size> pixels_{};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context(const ContextOptions& options) {
  auto context = std::make_unique<OsMesaContext>(options);
  context->make_current();
  return context;
}

}  // namespace penumbra::gl
