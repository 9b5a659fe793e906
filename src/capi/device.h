#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
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
  std::uint64_t id = 0;  // from 1; the same for the same texts
};

}  // namespace penumbra::capi

// The object behind the C interface's pointer to a device.
struct penumbra_device {
  penumbra::LogSink log;                                   // empty: none of its own
  std::unique_ptr<penumbra::capi::DeviceObjects> objects;  // null: abandoned
  std::map<int, penumbra::shadow::Mask> masks;             // of the last frame, by view
  std::map<penumbra::gl::ProgramDesc, penumbra::capi::CasterProgram> caster_programs;
  std::atomic_flag in_use;  // by a call
};

namespace penumbra::capi {

// The scope of any call with a device: refuses to begin within another one of this thread, as from a callback, which
// would change the state that the other device draws with. Messages go to the device's callback.
class ThreadCall {
 public:
  explicit ThreadCall(const penumbra_device& device);
  ~ThreadCall();
  ThreadCall(const ThreadCall&) = delete;
  ThreadCall& operator=(const ThreadCall&) = delete;

 private:
  std::optional<ThreadLogSink> sink_;
};

// The scope of a call with a device that exists: refuses the same, and calls while another thread uses the device.
class OneCall {
 public:
  explicit OneCall(penumbra_device& device);
  ~OneCall();
  OneCall(const OneCall&) = delete;
  OneCall& operator=(const OneCall&) = delete;

 private:
  ThreadCall thread_;
  penumbra_device& device_;
};

// The scope of a call that uses what a device has made: refuses the same, null, abandoned devices and, where that can
// be told at no cost, threads on which the device's context is not current. OpenGL's entry points are those of the
// device's driver.
class DeviceCall {
 public:
  explicit DeviceCall(penumbra_device* device);
  DeviceCall(penumbra_device& device, const OneCall& one);  // within that scope

  shadow::SoftShadows& shadows() const { return device_.objects->shadows; }
  // Refuses where OpenGL says that the device's context is not current.
  void look_for_context();

 private:
  void begin();

  penumbra_device& device_;
  std::optional<OneCall> one_;
  std::optional<gl::DeviceScope> scope_;
};

// Settings whose values `device` can use.
const ParamSet& params_of(const penumbra_settings* settings);

}  // namespace penumbra::capi
