#include "device.h"

#include "../gl/compatibility.h"
#include "../gl/context.h"
#include "settings.h"
#include "structs.h"

namespace penumbra::capi {

namespace {

thread_local bool in_call = false;

int32_t level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return PENUMBRA_LOG_DEBUG;
    case LogLevel::info:
      return PENUMBRA_LOG_INFO;
    case LogLevel::warning:
      return PENUMBRA_LOG_WARNING;
    case LogLevel::error:
      break;
  }
  return PENUMBRA_LOG_ERROR;
}

std::unique_ptr<penumbra_device> make_device(const penumbra_device_desc& desc) {
  auto device = std::make_unique<penumbra_device>();
  if (desc.log != nullptr) {
    device->log = [log = desc.log, user = desc.log_user](LogLevel level, std::string_view message) {
      log(user, level_of(level), std::string(message).c_str());
    };
  }
  return device;
}

// The scope of a call that makes a device: OpenGL's entry points are those of the current context's driver.
class LoadedApi {
 public:
  LoadedApi(penumbra_get_proc get_proc, void* user) : outer_(gl::current_api) {
    gl::load_api([&](const char* name) { return reinterpret_cast<void*>(get_proc(user, name)); });
  }
  ~LoadedApi() { gl::current_api = outer_; }
  LoadedApi(const LoadedApi&) = delete;
  LoadedApi& operator=(const LoadedApi&) = delete;

 private:
  gl::Api* outer_;
};

// Frees all that the device has made, without OpenGL calls where its context is not there.
void release(penumbra_device& device, bool context_is_lost) {
  std::optional<gl::LostContext> lost;
  if (context_is_lost) lost.emplace();
  device.masks.clear();
  device.objects.reset();
}

// Whatever the engine's log function throws, the device is gone.
void warn_of_leftovers(const std::exception_ptr& no_context) noexcept {
  try {
    std::rethrow_exception(no_context);
  } catch (const std::exception& error) {
    try {
      warn("a device is destroyed, but not what it has made in OpenGL: {}", error.what());
    } catch (...) {  // NOLINT(bugprone-empty-catch)
    }
  }
}

void check_context(bool is_there) {
  if (!is_there) fail_with(PENUMBRA_ERROR_CONTEXT, "the device's OpenGL context is not current on this thread");
}

}  // namespace

ThreadCall::ThreadCall(const penumbra_device& device) {
  if (in_call) fail_with(PENUMBRA_ERROR_ARGUMENT, "called from within a callback of a device");
  if (device.log) sink_.emplace(device.log);
  in_call = true;
}

ThreadCall::~ThreadCall() { in_call = false; }

OneCall::OneCall(penumbra_device& device) : thread_(device), device_(device) {
  if (device.in_use.test_and_set()) fail_with(PENUMBRA_ERROR_ARGUMENT, "another thread is in a call with the device");
}

OneCall::~OneCall() { device_.in_use.clear(); }

DeviceCall::DeviceCall(penumbra_device* device) : device_(required(device, "device")), one_(device_) { begin(); }

DeviceCall::DeviceCall(penumbra_device& device, const OneCall& /*one*/) : device_(device) { begin(); }

void DeviceCall::begin() {
  if (device_.objects == nullptr) fail_with(PENUMBRA_ERROR_CONTEXT, "the device was abandoned");
  check_context(scope_.emplace(device_.objects->device).has_context());
}

void DeviceCall::look_for_context() { check_context(scope_->finds_context()); }

const ParamSet& params_of(const penumbra_settings* settings) { return required(settings, "settings").params; }

}  // namespace penumbra::capi

using namespace penumbra::capi;

penumbra_result penumbra_device_create(const penumbra_device_desc* desc, penumbra_device** device) {
  return run("penumbra_device_create", [&] {
    required(device, "device") = nullptr;
    const penumbra_device_desc given = read_struct(&required(desc, "desc"));
    required(given.get_proc, "penumbra_device_desc.get_proc");
    std::unique_ptr<penumbra_device> made = make_device(given);
    const ThreadCall call(*made);
    const LoadedApi api(given.get_proc, given.get_proc_user);
    made->objects = std::make_unique<DeviceObjects>();
    penumbra::gl::DeviceScope(made->objects->device).mark_context();
    *device = made.release();
  });
}

penumbra_result penumbra_device_destroy(penumbra_device* device) {
  if (device == nullptr) return PENUMBRA_OK;
  return run("penumbra_device_destroy", [&] {
    std::optional<OneCall> call(*device);
    std::exception_ptr no_context;
    if (device->objects != nullptr) {
      penumbra::gl::DeviceScope scope(device->objects->device);
      try {
        penumbra::gl::check_context_is_current("penumbra_device_destroy()");
        check_context(scope.finds_context());
      } catch (const std::exception&) {
        no_context = std::current_exception();
      }
      release(*device, /*context_is_lost=*/no_context != nullptr);
      if (no_context) warn_of_leftovers(no_context);
    }
    call.reset();
    delete device;
    if (no_context) std::rethrow_exception(no_context);
  });
}

penumbra_result penumbra_device_abandon(penumbra_device* device) {
  return run("penumbra_device_abandon", [&] {
    const OneCall call(required(device, "device"));
    release(*device, /*context_is_lost=*/true);
  });
}
