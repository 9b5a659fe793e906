#include "buffer.h"

#include <cassert>
#include <string>

#include "../core/error.h"
#include "debug.h"

namespace penumbra::gl {

void delete_buffer(GLuint id) { glDeleteBuffers(1, &id); }

namespace {

Handle<delete_buffer> make_storage(std::string_view name, std::size_t bytes, const void* contents) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  Handle<delete_buffer> handle(id);
  label(GL_BUFFER, id, name);
  // A buffer of no bytes is not valid storage, while an empty list is a valid thing to upload.
  const std::size_t storage = bytes == 0 ? 1 : bytes;
  const std::string what = fmt::format("buffer '{}'", name);
  StorageCheck check(what);
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(storage), bytes == 0 ? nullptr : contents, GL_DYNAMIC_STORAGE_BIT);
  if (check.ran_out()) fail("{}: out of memory for {} bytes", what, bytes);
  return handle;
}

}  // namespace

Buffer::Buffer(std::string_view label, std::size_t bytes)
    : handle_(make_storage(label, bytes, nullptr)), size_(bytes) {}

Buffer::Buffer(std::string_view label, std::span<const std::byte> contents)
    : handle_(make_storage(label, contents.size(), contents.data())), size_(contents.size()) {}

void Buffer::write(std::span<const std::byte> bytes, std::size_t offset) const {
  assert(offset + bytes.size() <= size_);
  if (bytes.empty()) return;
  glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::bind_uniform(GLuint binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, id()); }

void Buffer::bind_uniform(GLuint binding, std::size_t offset, std::size_t bytes) const {
  assert(offset + bytes <= size_);
  glBindBufferRange(GL_UNIFORM_BUFFER, binding, id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes));
}

void Buffer::bind_storage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id()); }

void Buffer::bind_storage(GLuint binding, std::size_t offset, std::size_t bytes) const {
  assert(offset + bytes <= size_);
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, id(), static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes));
}

}  // namespace penumbra::gl
