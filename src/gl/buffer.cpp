#include "buffer.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <string>
#include <vector>

#include "../core/error.h"
#include "debug.h"

namespace penumbra::gl {

void delete_buffer(GLuint id) { glDeleteBuffers(1, &id); }

namespace {

Handle<delete_buffer> make_storage(std::string_view name, std::size_t bytes, const void* contents,
                                   GLbitfield flags = GL_DYNAMIC_STORAGE_BIT) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  Handle<delete_buffer> handle(id);
  label(GL_BUFFER, id, name);
  // A shader's block must not be larger than its buffer, and one that ends in an array has room for one element: of the
  // lists that may be empty a matrix is the largest. Drivers round blocks up to 16 bytes.
  constexpr std::size_t unit = 16, least = 64;
  const std::size_t storage = std::max((bytes + unit - 1) / unit * unit, least);
  const std::string what = fmt::format("buffer '{}'", name);
  StorageCheck check(what);
  const bool whole = contents != nullptr && bytes == storage;
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(storage), whole ? contents : nullptr, flags);
  if (check.ran_out()) fail("{}: out of memory for {} bytes", what, bytes);
  if (contents == nullptr || whole || bytes == 0) return handle;
  StorageCheck upload(what);
  glNamedBufferSubData(id, 0, static_cast<GLsizeiptr>(bytes), contents);
  if (upload.ran_out()) fail("{}: out of memory for {} bytes", what, bytes);
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

ReadableBuffer::ReadableBuffer(std::string_view label, std::size_t words) {
  constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  const std::vector<std::uint32_t> zeros(words);
  const std::size_t bytes = words * sizeof(std::uint32_t);
  handle_ = make_storage(label, bytes, zeros.data(), access | GL_DYNAMIC_STORAGE_BIT);
  void* mapped = glMapNamedBufferRange(handle_.id(), 0, static_cast<GLsizeiptr>(bytes), access);
  if (mapped == nullptr) fail("buffer '{}' can't be mapped", label);
  words_ = static_cast<std::uint32_t*>(mapped);
}

std::uint32_t ReadableBuffer::word(std::size_t index) const {
  // Words that are read after this one are at least as new.
  return std::atomic_ref(words_[index]).load(std::memory_order_acquire);
}

// Not by glClearNamedBufferSubData(), to which Mesa applies the engine's pixel storage modes.
void ReadableBuffer::write(std::size_t index, std::uint32_t value) const {
  glNamedBufferSubData(handle_.id(), static_cast<GLintptr>(index * sizeof value), sizeof value, &value);
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
