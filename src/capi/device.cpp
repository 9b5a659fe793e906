#include "device.h"

#include "../gl/compatibility.h"
#include "../gl/context.h"
#include "settings.h"
#include "structs.h"

namespace penumbra::capi {

namespace {

// The device whose driver's entry points are loaded; null: none.
const penumbra_device* loaded = nullptr;

void load(const penumbra_device& device) {
  if (loaded == &device) return;
  loaded = nullptr;
  gl::load_api(device.get_proc);
  loaded = &device;
}

bool in_call = false;

// Messages of a call go to its device's callback.
void set_sink(std::optional<penumbra::ThreadLogSink>& sink, const penumbra_device& device) {
  if (device.log) sink.emplace(device.log);
}

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
  device->get_proc = [get_proc = &required(desc.get_proc, "penumbra_device_desc.get_proc"), user = desc.get_proc_user](
                         const char* name) { return reinterpret_cast<void*>(get_proc(user, name)); };
  if (desc.log != nullptr) {
    device->log = [log = desc.log, user = desc.log_user](LogLevel level, std::string_view message) {
      log(user, level_of(level), std::string(message).c_str());
    };
  }
  return device;
}

// Frees all that the device has made, without OpenGL calls where its context is not there.
void release(penumbra_device& device, bool context_is_lost) {
  std::optional<gl::LostContext> lost;
  if (context_is_lost) lost.emplace();
  device.masks.clear();
  device.objects.reset();
}

}  // namespace

OneCall::OneCall() {
  if (in_call) fail_with(PENUMBRA_ERROR_ARGUMENT, "called from within a callback of a device");
  in_call = true;
}

OneCall::~OneCall() { in_call = false; }

DeviceCall::DeviceCall(penumbra_device* device) : device_(required(device, "device")) {
  if (device_.objects == nullptr) fail_with(PENUMBRA_ERROR_CONTEXT, "the device was abandoned");
  set_sink(sink_, device_);
  load(device_);
}

const ParamSet& params_of(const penumbra_settings* settings) { return required(settings, "settings").params; }

}  // namespace penumbra::capi

using namespace penumbra::capi;

penumbra_result penumbra_device_create(const penumbra_device_desc* desc, penumbra_device** device) {
  return run("penumbra_device_create", [&] {
    required(device, "device") = nullptr;
    std::unique_ptr<penumbra_device> made = make_device(read_struct(&required(desc, "desc")));
    const OneCall one;
    std::optional<penumbra::ThreadLogSink> sink;
    set_sink(sink, *made);
    load(*made);
    try {
      made->objects = std::make_unique<DeviceObjects>();
    } catch (...) {
      loaded = nullptr;
      throw;
    }
    *device = made.release();
  });
}

penumbra_result penumbra_device_destroy(penumbra_device* device) {
  if (device == nullptr) return PENUMBRA_OK;
  return run("penumbra_device_destroy", [&] {
    const OneCall one;
    const std::unique_ptr<penumbra_device> owned(device);
    std::optional<penumbra::ThreadLogSink> sink;
    set_sink(sink, *device);
    std::exception_ptr no_context;
    if (device->objects != nullptr) {
      try {
        load(*device);
        penumbra::gl::check_context_is_current("penumbra_device_destroy()");
      } catch (const penumbra::gl::ContextError&) {
        no_context = std::current_exception();
      }
      release(*device, /*context_is_lost=*/no_context != nullptr);
    }
    if (loaded == device) loaded = nullptr;
    if (no_context) std::rethrow_exception(no_context);
  });
}

penumbra_result penumbra_device_abandon(penumbra_device* device) {
  return run("penumbra_device_abandon", [&] {
    required(device, "device");
    const OneCall one;
    release(*device, /*context_is_lost=*/true);
    if (loaded == device) loaded = nullptr;
  });
}
