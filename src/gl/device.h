#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "buffer.h"
#include "pass_desc.h"
#include "shader_library.h"
#include "texture.h"
#include "timer.h"

namespace penumbra::gl {

// What passes draw with: programs, timers, and targets (textures and buffers) that persist from frame to frame, so that
// nothing is allocated once every kind of frame has been drawn. One per context, passed to every function that draws.
class Device {
 public:
  Device(ShaderFiles files, Timers::Mode timing);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  ShaderLibrary shaders;
  Timers timers;

  // Called before each pass, if set: a program that must answer its user during a long frame does so here, in the same
  // context. It may leave any state behind but bindings of uniform and storage buffers. It must not change the targets
  // of the frame. Passes that it draws itself do not call it again. What it throws ends the frame.
  std::function<void()> before_pass;

  // Runs the action as before_pass is run: within a frame, of which what it draws is no part.
  void aside(const std::function<void()>& action);

  // The texture of that name; created on first use, and again when the description changes. The reference stays valid;
  // contents persist until the texture is created again. Throws Error as Texture's constructor does.
  const Texture& target(std::string_view name, const TextureDesc& desc);
  // A buffer of at least `bytes` of that name, kept in the same way (grows, never shrinks). Throws Error as Buffer.
  const Buffer& scratch(std::string_view name, std::size_t bytes);
  const Sampler& sampler(const SamplerDesc& desc);
  // How far beside its place the rasteriser may draw the depths of a surface, along x and along y, pixels: half a step
  // of the grid to which it rounds vertices, if it rounds to the nearest one. 0 for llvmpipe, which computes depths
  // from vertices that are not rounded.
  float vertex_rounding();
  // Replaces that value, for depths that come from elsewhere.
  void assume_vertex_rounding(float pixels);
  // Deletes the targets and buffers whose names start with `prefix`, except `kept`; references to them become invalid.
  void drop(std::string_view prefix, const std::set<std::string, std::less<>>& kept = {});
  // All textures, in the order of their names; the pointers are valid as long as references from target() are.
  struct NamedTarget {
    std::string_view name;
    const Texture* texture = nullptr;
  };
  std::vector<NamedTarget> targets() const;
  // The names of all targets and buffers that start with `prefix`.
  std::set<std::string, std::less<>> names(std::string_view prefix) const;
  // Bytes of the textures whose names start with `prefix`.
  std::size_t target_bytes(std::string_view prefix = "") const;

 private:
  friend class Pass;
  friend class DeviceScope;
  Device& interrupted();  // this device, after before_pass
  GLuint framebuffer(std::string_view name, std::span<const Attachment> colors, const Attachment* depth);
  GLuint empty_vertex_array();
  // Whether the context has the debug callback; queried from OpenGL once.
  bool is_debugged();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// In this scope the calling thread's OpenGL calls go to the entry points that were loaded when the device was made, or
// else those that were when it was first used, whatever the thread itself has loaded. Scopes may nest.
class DeviceScope {
 public:
  explicit DeviceScope(Device& device);
  ~DeviceScope();
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;

  // Makes the object by which has_context() knows the device's context: the one that is current. The device's first
  // pass makes it, too.
  void mark_context();
  // Whether the context that is current on this thread may be the device's. OpenGL is asked only where the device was
  // last used on another thread, since drivers would have to wait.
  bool has_context();
  // The same, and OpenGL is asked on every thread.
  bool finds_context();

 private:
  Device& device_;
  Api* outer_;
};

}  // namespace penumbra::gl
