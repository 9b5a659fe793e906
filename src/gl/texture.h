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

// A labelled texture with immutable storage. Throws Error when it is larger than the device allows or memory ends.
// Sampled with nearest filtering and clamp-to-edge unless a Sampler says otherwise.
class Texture {
 public:
  Texture() = default;
  Texture(std::string_view label, const TextureDesc& desc);
  // A texture that somebody else made and will delete, as `desc` describes it (see describe()): to attach, bind or read
  // like one of our own. Nothing of it is changed but what passes draw into it.
  static Texture wrap(GLuint id, const TextureDesc& desc);

  // Tightly packed pixels of one level and layer, given in `format`/`type` (GL_RGBA, GL_UNSIGNED_BYTE…).
  // `pixels` must be exactly the level's size.
  void upload(GLenum format, GLenum type, std::span<const std::byte> pixels, int level = 0, int layer = 0) const;
  void generate_mipmaps() const;
  void bind(GLuint unit) const;
  void bind_image(GLuint unit, GLenum access, int level = 0) const;

  GLuint id() const { return handle_.id(); }
  bool is_foreign() const { return !handle_.is_owned(); }
  // Differs for every texture ever made, while the driver gives a deleted texture's id out again; 0 of foreign ones.
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

// What OpenGL says of a texture that somebody else made. Throws Error when `id` is no texture, or one of a target or
// format that Penumbra does not use; `name` stands in the message.
TextureDesc describe(std::string_view name, GLuint id);

// Pixels of a level and layer, rows bottom to top, tightly packed as floats with `channels` (1 to 4) per pixel;
// not for integer formats; read_uints is for unsigned ones. Waits for the GPU.
std::vector<float> read_floats(const Texture& texture, int channels, int level = 0, int layer = 0);
std::vector<unsigned> read_uints(const Texture& texture, int channels, int level = 0, int layer = 0);
// The stencil values of a format that has some, likewise.
std::vector<std::uint8_t> read_stencil(const Texture& texture, int level = 0, int layer = 0);
// The colours or depth of one texel, of level and layer 0; y counts from the bottom.
std::vector<float> read_float_texel(const Texture& texture, int channels, int x, int y);
std::vector<unsigned> read_uint_texel(const Texture& texture, int channels, int x, int y);

}  // namespace penumbra::gl
