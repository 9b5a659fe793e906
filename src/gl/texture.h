#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "handle.h"

namespace penumbra::gl {

void delete_texture(GLuint id);
void delete_sampler(GLuint id);

struct TextureDesc {
  GLenum target = GL_TEXTURE_2D;  // GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY
  GLenum format = GL_RGBA8;       // sized internal format
  int width = 1;
  int height = 1;
  int layers = 1;  // of an array
  int levels = 1;

  bool operator==(const TextureDesc&) const = default;
};

// A labelled texture with immutable storage. Throws Error when it is larger than the device allows or memory runs out.
// Sampled with nearest filtering and clamp-to-edge unless a Sampler is bound.
class Texture {
 public:
  Texture() = default;
  Texture(std::string_view label, const TextureDesc& desc);
  // Refers to a texture that the caller made and will delete, and that `desc` describes (see describe()). It can be
  // attached, bound and read like Penumbra's own; its sampling parameters stay as they are.
  static Texture wrap(GLuint id, const TextureDesc& desc);

  // Another texture on the same storage, read in another format of the same size (glTextureView). The storage lives as
  // long as one of both.
  static Texture view(std::string_view label, const Texture& of, GLenum format);

  // Tightly packed pixels of one level and layer, given in `format`/`type` (GL_RGBA, GL_UNSIGNED_BYTE…).
  // `pixels` must be exactly the level's size, else it is a bug. Throws Error for a pair that Penumbra does not use.
  void upload(GLenum format, GLenum type, std::span<const std::byte> pixels, int level = 0, int layer = 0) const;
  void bind(GLuint unit) const;
  void bind_image(GLuint unit, GLenum access, int level = 0) const;

  GLuint id() const { return handle_.id(); }
  bool is_foreign() const { return !handle_.is_owned(); }
  // Unique to each texture that Penumbra makes; ids are not, as drivers reuse those of deleted textures. 0 if foreign.
  std::uint64_t serial() const { return serial_; }
  const TextureDesc& desc() const { return desc_; }
  int width() const { return desc_.width; }
  int height() const { return desc_.height; }
  // Bytes of storage, all levels and layers, as the format defines them.
  std::size_t bytes() const;
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<delete_texture> handle_;
  TextureDesc desc_;
  std::uint64_t serial_ = 0;
};

struct SamplerDesc {
  GLenum min_filter = GL_NEAREST;
  GLenum mag_filter = GL_NEAREST;
  GLenum wrap_s = GL_CLAMP_TO_EDGE;
  GLenum wrap_t = GL_CLAMP_TO_EDGE;
  bool compare = false;  // GL_COMPARE_REF_TO_TEXTURE with GL_LEQUAL
  float max_anisotropy = 1.0f;
  float lod_bias = 0.0f;  // added to the mip level that is read

  bool operator==(const SamplerDesc&) const = default;
};

class Sampler {
 public:
  Sampler() = default;
  Sampler(std::string_view label, const SamplerDesc& desc);
  void bind(GLuint unit) const;
  GLuint id() const { return handle_.id(); }

 private:
  Handle<delete_sampler> handle_;
};

// The target of a texture that the caller made, or 0 if it is neither GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY nor one of
// these with samples, and the context has the compatibility profile. May unbind the textures of unit 0.
GLenum target_of(GLuint id);

// Asks OpenGL for the description of a texture that the caller made. Throws Error, with `name` in its message, when
// `id` is not a texture, or has a target or format that Penumbra does not use.
TextureDesc describe(std::string_view name, GLuint id);

// Reads a level and layer, rows from bottom to top, `channels` (1 to 4) values a pixel. read_floats() is for all
// formats but those of integers, read_uints() for unsigned integers. They wait for the GPU.
std::vector<float> read_floats(const Texture& texture, int channels, int level = 0, int layer = 0);
std::vector<unsigned> read_uints(const Texture& texture, int channels, int level = 0, int layer = 0);
// The same for the stencil values of a depth and stencil format.
std::vector<std::uint8_t> read_stencil(const Texture& texture, int level = 0, int layer = 0);
// The same for one texel of level and layer 0; y counts from the bottom.
std::vector<float> read_float_texel(const Texture& texture, int channels, int x, int y);
std::vector<unsigned> read_uint_texel(const Texture& texture, int channels, int x, int y);

}  // namespace penumbra::gl
