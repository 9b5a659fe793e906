#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "../core/log.h"
#include "../gl/device.h"
#include "../shadow/soft_shadows.h"
#include "call.h"

namespace penumbra::capi {

// What a device has made in its context.
struct DeviceObjects {
  gl::Device device{gl::ShaderFiles(), gl::Timers::Mode::off};
  shadow::SoftShadows shadows{device};
};

// Texts for a program of the engine's: see penumbra_caster_pass::geometry_shader. A text is empty if there is no such
// shader.
struct CasterProgram {
  std::string geometry, fragment;
  std::uint64_t id = 0;
};

}  // namespace penumbra::capi

// The object behind the C interface's pointer to a device.
struct penumbra_device {
  std::function<void*(const char*)> get_proc;
  penumbra::LogSink log;                                   // empty: none of its own
  std::unique_ptr<penumbra::capi::DeviceObjects> objects;  // null: abandoned
  std::map<int, penumbra::shadow::Mask> masks;             // of the last frame, by view
  std::map<penumbra::gl::ProgramDesc, penumbra::capi::CasterProgram> caster_programs;
};

namespace penumbra::capi {

// The scope of any call with a device: refuses to begin within another one, as from a callback. Calls with different
// devices don't mix either, because OpenGL's entry points belong to the process.
class OneCall {
 public:
  OneCall();
  ~OneCall();
  OneCall(const OneCall&) = delete;
  OneCall& operator=(const OneCall&) = delete;
};

// The scope of a call with a device: refuses null, abandoned devices and calls from within a callback; OpenGL's entry
// points are those of the device's driver, and messages go to its callback.
class DeviceCall {
 public:
  explicit DeviceCall(penumbra_device* device);

  shadow::SoftShadows& shadows() const { return device_.objects->shadows; }
  gl::Device& gl() const { return device_.objects->device; }

 private:
  penumbra_device& device_;
  OneCall one_;
  std::optional<ThreadLogSink> sink_;
};

// Settings whose values `device` can use.
const ParamSet& params_of(const penumbra_settings* settings);

}  // namespace penumbra::capi
