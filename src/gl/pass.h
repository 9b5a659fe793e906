#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "buffer.h"
#include "debug.h"
#include "shader_library.h"
#include "texture.h"
#include "timer.h"

namespace penumbra::gl {

struct Attachment {
  const Texture* texture = nullptr;
  int level = 0;
  int layer = 0;
  std::optional<glm::vec4> clear;  // nullopt: load. For depth, .x is the depth. Integer colour: converted to integers
};

// What passes draw with: programs, timers, and targets that persist from frame to frame so that nothing is allocated
// after warm-up. One per context; handed to every pass, never global.
class Device {
 public:
  Device(ShaderFiles files, Timers::Mode timing);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  ShaderLibrary shaders;
  Timers timers;

  // The texture of that name, made again when the description changes. The reference stays valid; contents persist
  // until then.
  const Texture& target(std::string_view name, const TextureDesc& desc);
  // A buffer of at least `bytes`, likewise (grows, never shrinks).
  const Buffer& scratch(std::string_view name, std::size_t bytes);
  const Sampler& sampler(const SamplerDesc& desc);
  // Gives back the targets and buffers whose name starts with `prefix`; references to them end.
  void drop(std::string_view prefix);
  // All of them, in the order of their names; the pointers end as the references do.
  struct NamedTarget {
    std::string_view name;
    const Texture* texture = nullptr;
  };
  std::vector<NamedTarget> targets() const;
  // Bytes of all targets whose name starts with `prefix`.
  std::size_t target_bytes(std::string_view prefix = "") const;

 private:
  friend class Pass;
  GLuint framebuffer(std::string_view name, std::span<const Attachment> colors, const Attachment* depth);
  GLuint empty_vertex_array();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

enum class DepthTest { off, less_equal, greater_equal, equal };
enum class Blend { off, premultiplied_over, min, max, add };

// State that a raster pass sets whole: nothing is inherited, so passes can be reordered.
struct PassDesc {
  std::string_view name;  // debug group, timer row and bench row
  std::vector<Attachment> colors;
  std::optional<Attachment> depth;
  DepthTest depth_test = DepthTest::off;
  bool depth_write = false;
  Blend blend = Blend::off;
  bool cull_back = false;  // counter-clockwise is front
  bool depth_clamp = false;
};

// A pass in a scope. With attachments it binds a framebuffer, the viewport of the first attachment's level, and the
// state above; without any (compute) it is a debug group and a timer. In a debug context every step throws Error for
// the GL errors so far; those of the caller's own draws at the end of a scope come with the next step, under this
// pass's name.
class Pass {
 public:
  Pass(Device& device, const PassDesc& desc);
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  const Program& use(const ProgramDesc& desc);  // compile on first use, and make current
  void draw_full_screen();                      // one triangle, for the vertex shader "shared/full_screen.vert"
  void set_cull_back(bool cull);                // double-sided materials
  void set_front_clockwise(bool clockwise);     // mirrored instances
  void set_viewport(int x, int y, int width, int height);
  // Groups of the current compute program that cover width × height × layers invocations; then a barrier for all that
  // later commands may read: textures, images, storage, vertices, commands, read-backs.
  void dispatch(int width, int height, int layers = 1);
  // Says of the caller's own draw calls what the timers are to count.
  void count_draws(std::size_t draws, std::size_t triangles) { device_.timers.count({draws, triangles, 0}); }

 private:
  void check() const;

  Device& device_;
  DebugGroup group_;
  Timers::Scope timer_;
  bool debug_;
  const Program* program_ = nullptr;
};

// Frees the first texture units of textures and samplers.
void unbind_textures(GLuint count);

// For an engine's sake: what passes change goes back to OpenGL's initial values, and nothing stays bound to draw with
// (program, vertex array, framebuffers, textures and samplers of units 0 to 15, images of units 0 to 7). Viewport,
// blend function and buffer bindings stay as they are.
void leave_initial_state();

}  // namespace penumbra::gl
