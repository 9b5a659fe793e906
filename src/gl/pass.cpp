#include "pass.h"

#include <algorithm>
#include <cassert>

#include "pass_state.h"

namespace penumbra::gl {
namespace {

// OpenGL takes offsets into the bound buffer of commands as pointers.
const void* as_pointer(std::size_t offset) { return reinterpret_cast<const void*>(offset); }  // NOLINT: GL's way

template <class Command>
void bind_commands(GLenum target, const IndirectCommands& commands) {
  assert(commands.offset % sizeof(std::uint32_t) == 0);
  assert(commands.offset + commands.count * sizeof(Command) <= commands.buffer.size());
  glBindBuffer(target, commands.buffer.id());
}

}  // namespace

Pass::Pass(Device& device, const PassDesc& desc)
    : device_(device.interrupted()), group_(desc.name), timer_(device.timers, desc.name), debug_(device.is_debugged()) {
  if (!desc.colors.empty() || desc.depth) bind(desc);
  check();
}

Pass::ForeignAttachments::~ForeignAttachments() {
  if (framebuffer == 0 || points.empty()) return;
  // Without attachments it would be an incomplete one for what follows, which drivers warn of.
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  for (const GLenum point : points) glNamedFramebufferTexture(framebuffer, point, 0, 0);
}

void Pass::bind(const PassDesc& desc) {
  for (std::size_t i = 0; i < desc.colors.size(); ++i) {
    if (desc.colors[i].texture->is_foreign()) foreign_.points.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
  }
  if (desc.depth && desc.depth->texture->is_foreign()) {
    foreign_.points.push_back(depth_attachment_point(*desc.depth->texture));
  }
  const GLuint framebuffer = device_.framebuffer(desc.name, desc.colors, desc.depth ? &*desc.depth : nullptr);
  foreign_.framebuffer = framebuffer;
  const Attachment& first = desc.colors.empty() ? *desc.depth : desc.colors.front();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  set_viewport(0, 0, std::max(1, first.texture->width() >> first.level),
               std::max(1, first.texture->height() >> first.level));
  begin_raster_state(framebuffer, desc);
  glBindVertexArray(device_.empty_vertex_array());
}

const Program& Pass::use(const ProgramDesc& desc) {
  program_ = &device_.shaders.get(desc);
  program_->use();
  check();
  return *program_;
}

void Pass::draw_full_screen() {
  assert(program_ != nullptr);
  glBindVertexArray(device_.empty_vertex_array());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  count_draws(1, 1);
  check();
}

void Pass::set_cull_back(bool cull) {
  if (cull) {
    glEnable(GL_CULL_FACE);
  } else {
    glDisable(GL_CULL_FACE);
  }
}

void Pass::set_front_clockwise(bool clockwise) { glFrontFace(clockwise ? GL_CW : GL_CCW); }

void Pass::set_viewport(int x, int y, int width, int height) { glViewport(x, y, width, height); }

void Pass::set_point_size(float pixels) { glPointSize(pixels); }

void Pass::draw_arrays_indirect(GLenum mode, const IndirectCommands& draws) {
  bind_commands<DrawArraysCommand>(GL_DRAW_INDIRECT_BUFFER, draws);
  glMultiDrawArraysIndirect(mode, as_pointer(draws.offset), static_cast<GLsizei>(draws.count), 0);
  count_draws(draws.count, 0);
  check();
}

void Pass::draw_elements_indirect(GLenum mode, GLenum index_type, const IndirectCommands& draws) {
  bind_commands<DrawElementsCommand>(GL_DRAW_INDIRECT_BUFFER, draws);
  glMultiDrawElementsIndirect(mode, index_type, as_pointer(draws.offset), static_cast<GLsizei>(draws.count), 0);
  count_draws(draws.count, 0);
  check();
}

void Pass::dispatch(int width, int height, int layers) {
  assert(program_ != nullptr && width > 0 && height > 0 && layers > 0);
  const glm::ivec3 size(width, height, layers);
  const glm::uvec3 groups((size + program_->group_size() - 1) / program_->group_size());
  glDispatchCompute(groups.x, groups.y, groups.z);
  device_.timers.count({0, 0, 1});
  barrier();
}

void Pass::dispatch_indirect(const Buffer& command, std::size_t offset) {
  assert(program_ != nullptr);
  bind_commands<DispatchCommand>(GL_DISPATCH_INDIRECT_BUFFER, {command, offset});
  glDispatchComputeIndirect(static_cast<GLintptr>(offset));
  device_.timers.count({0, 0, 1});
  barrier();
}

void Pass::barrier() {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                  GL_UNIFORM_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                  GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_PIXEL_BUFFER_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
  check();
}

void Pass::check() const {
  if (debug_) check_errors("");
}

}  // namespace penumbra::gl
