#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "debug.h"
#include "device.h"
#include "pass_desc.h"

namespace penumbra::gl {

// Commands in a buffer, as OpenGL lays them out: written by the CPU or by a shader of an earlier pass.
struct DrawArraysCommand {
  std::uint32_t vertex_count = 0, instance_count = 1, first_vertex = 0, base_instance = 0;
};
struct DrawElementsCommand {
  std::uint32_t index_count = 0, instance_count = 1, first_index = 0;
  std::int32_t base_vertex = 0;
  std::uint32_t base_instance = 0;
};
struct DispatchCommand {
  std::uint32_t groups_x = 1, groups_y = 1, groups_z = 1;
};

// `count` commands, one after the other, from an offset in bytes (a multiple of 4).
struct IndirectCommands {
  const Buffer& buffer;
  std::size_t offset = 0;
  std::size_t count = 1;
};

// A render or compute pass that lasts for a scope. With attachments it binds a framebuffer, the viewport of the first
// attachment's level, and the described state; without any (compute) it is a debug group and a timer. In a debug
// context every step throws Error for the GL errors so far. Errors of the caller's own draw calls after the last step
// are thrown by the next pass's first step, with this pass's name.
class Pass {
 public:
  // Throws Error when the driver refuses the attachments, or a stencil is described and the depth texture has none.
  Pass(Device& device, const PassDesc& desc);
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  const Program& use(const ProgramDesc& desc);  // compiles on first use (see ShaderLibrary::get), makes current
  void draw_full_screen();                      // one triangle, for vertex shaders as shared/full_screen.vert is
  void set_cull_back(bool cull);                // double-sided materials
  void set_front_clockwise(bool clockwise);     // mirrored instances
  void set_viewport(int x, int y, int width, int height);
  void set_point_size(float pixels);  // else 1

  // Runs the draw commands in a buffer, with the vertex array that is bound. `mode`: GL_TRIANGLES…; `index_type`:
  // GL_UNSIGNED_INT, GL_UNSIGNED_SHORT. The timers count the draws, but not their triangles, whose number only the
  // GPU's buffer contains.
  void draw_arrays_indirect(GLenum mode, const IndirectCommands& draws);
  void draw_elements_indirect(GLenum mode, GLenum index_type, const IndirectCommands& draws);
  // Groups of the current compute program that cover width × height × layers invocations; then a barrier().
  void dispatch(int width, int height, int layers = 1);
  // Dispatches the number of groups in the DispatchCommand at an offset in bytes (a multiple of 4); then a barrier().
  void dispatch_indirect(const Buffer& command, std::size_t offset = 0);
  // Makes what shaders have written to images and storage buffers visible to all later commands: texture and image
  // reads, storage and uniform buffers, vertices and indices, indirect commands, copies and read-backs, attachments. To
  // be called after draws whose shaders write to these; dispatches do it themselves.
  void barrier();

  // Adds the caller's own draw calls to the timers' counts.
  void count_draws(std::size_t draws, std::size_t triangles) { device_.timers.count({draws, triangles, 0}); }

 private:
  // The attachment points of a framebuffer that hold textures which Penumbra did not make. They are detached at the
  // end, so that no framebuffer keeps a foreign texture's memory beyond the pass; also when the pass throws while it
  // begins.
  struct ForeignAttachments {
    ForeignAttachments() = default;
    ~ForeignAttachments();
    ForeignAttachments(const ForeignAttachments&) = delete;
    ForeignAttachments& operator=(const ForeignAttachments&) = delete;

    GLuint framebuffer = 0;
    std::vector<GLenum> points;
  };

  void bind(const PassDesc& desc);
  void check() const;

  Device& device_;
  DebugGroup group_;
  Timers::Scope timer_;
  bool debug_;
  const Program* program_ = nullptr;
  ForeignAttachments foreign_;
};

// Unbinds textures and samplers from the first `count` units.
void unbind_textures(GLuint count);

// Sets the state that passes change to OpenGL's initial values, for engines that expect them, and unbinds what passes
// bind: program, vertex array, framebuffers, textures and samplers of units 0 to 15, images of units 0 to 7, buffers of
// indirect commands. Viewport, blend function and other buffer bindings stay as passes left them.
void leave_initial_state();

}  // namespace penumbra::gl
