#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "handle.h"

namespace penumbra::gl {

void delete_buffer(GLuint id);

// A labelled buffer object of fixed size (immutable storage, updatable with write()). Its constructors throw Error when
// memory runs out. Offsets and sizes are in bytes and must lie within the buffer.
class Buffer {
 public:
  Buffer() = default;
  Buffer(std::string_view label, std::size_t bytes);  // contents undefined
  Buffer(std::string_view label, std::span<const std::byte> contents);

  template <class T>
  static Buffer of(std::string_view label, std::span<const T> contents) {
    return Buffer(label, std::as_bytes(contents));
  }

  void write(std::span<const std::byte> bytes, std::size_t offset = 0) const;
  void bind_uniform(GLuint binding) const;
  void bind_uniform(GLuint binding, std::size_t offset, std::size_t bytes) const;
  void bind_storage(GLuint binding) const;
  void bind_storage(GLuint binding, std::size_t offset, std::size_t bytes) const;

  GLuint id() const { return handle_.id(); }
  std::size_t size() const { return size_; }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<delete_buffer> handle_;
  std::size_t size_ = 0;
};

// A buffer of 32-bit words, 0 at first, that the GPU writes and the CPU reads without any call of OpenGL: it stays
// mapped.
class ReadableBuffer {
 public:
  ReadableBuffer(std::string_view label, std::size_t words);

  // What the GPU has written so far.
  std::uint32_t word(std::size_t index) const;
  // A command for the GPU, which conditional rendering does not leave out and which no state of the engine's changes.
  void write(std::size_t index, std::uint32_t value) const;
  void bind_storage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_.id()); }

 private:
  Handle<delete_buffer> handle_;
  std::uint32_t* words_ = nullptr;
};

// Writes one value's bytes; T is a std140/std430 struct shared with GLSL.
template <class T>
void write_value(const Buffer& buffer, const T& value) {
  buffer.write(std::as_bytes(std::span(&value, 1)));
}

}  // namespace penumbra::gl
