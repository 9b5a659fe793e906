#include "texture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "../core/error.h"
#include "debug.h"
#include "texture_format.h"

namespace penumbra::gl {

void delete_texture(GLuint id) { glDeleteTextures(1, &id); }
void delete_sampler(GLuint id) { glDeleteSamplers(1, &id); }

namespace {

bool is_array(const TextureDesc& desc) { return desc.target == GL_TEXTURE_2D_ARRAY; }

int level_size(int size, int level) { return std::max(1, size >> level); }

int limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

void check_size(std::string_view name, const TextureDesc& desc) {
  assert(desc.target == GL_TEXTURE_2D || is_array(desc));
  assert(desc.width > 0 && desc.height > 0 && desc.layers > 0 && desc.levels > 0);
  const int max_size = limit(GL_MAX_TEXTURE_SIZE);
  if (desc.width > max_size || desc.height > max_size) {
    fail("texture '{}': {} x {} is over this device's limit of {}", name, desc.width, desc.height, max_size);
  }
  const int max_layers = limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
  if (desc.layers > max_layers) {
    fail("texture '{}': {} layers are over this device's limit of {}", name, desc.layers, max_layers);
  }
}

std::size_t texels(const TextureDesc& desc) {
  std::size_t count = 0;
  for (int level = 0; level < desc.levels; ++level) {
    count += static_cast<std::size_t>(level_size(desc.width, level)) *
             static_cast<std::size_t>(level_size(desc.height, level)) * static_cast<std::size_t>(desc.layers);
  }
  return count;
}

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

// Client memory is packed tightly, whatever the state the caller's program left.
void set_tight_unpacking() {
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT,
                            GL_UNPACK_SKIP_IMAGES}) {
    glPixelStorei(name, 0);
  }
}

void set_tight_packing() {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (const GLenum name :
       {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES}) {
    glPixelStorei(name, 0);
  }
}

// Of a level and layer.
struct Block {
  int x = 0, y = 0, width = 1, height = 1;
  int level = 0, layer = 0;
};

Block whole(const Texture& texture, int level, int layer) {
  const TextureDesc& desc = texture.desc();
  assert(level >= 0 && level < desc.levels && layer >= 0 && layer < desc.layers);
  return {0, 0, level_size(desc.width, level), level_size(desc.height, level), level, layer};
}

Block texel([[maybe_unused]] const Texture& texture, int x, int y) {
  assert(x >= 0 && x < texture.width() && y >= 0 && y < texture.height());
  return {.x = x, .y = y};
}

template <class Value>
std::vector<Value> read_pixels(const Texture& texture, GLenum format, GLenum type, int channels, const Block& block) {
  std::vector<Value> pixels(static_cast<std::size_t>(block.width) * static_cast<std::size_t>(block.height) *
                            static_cast<std::size_t>(channels));
  set_tight_packing();
  glGetTextureSubImage(texture.id(), block.level, block.x, block.y, block.layer, block.width, block.height, 1, format,
                       type, static_cast<GLsizei>(pixels.size() * sizeof(Value)), pixels.data());
  return pixels;
}

std::vector<float> read_floats(const Texture& texture, int channels, const Block& block) {
  static constexpr std::array<GLenum, 4> formats{GL_RED, GL_RG, GL_RGB, GL_RGBA};
  const ChannelKind kind = format_info(texture.desc().format).kind;
  const bool is_depth = kind == ChannelKind::depth || kind == ChannelKind::depth_stencil;
  assert(kind == ChannelKind::real || (is_depth && channels == 1));
  const GLenum format = is_depth ? GL_DEPTH_COMPONENT : formats.at(static_cast<std::size_t>(channels - 1));
  return read_pixels<float>(texture, format, GL_FLOAT, channels, block);
}

std::vector<unsigned> read_uints(const Texture& texture, int channels, const Block& block) {
  static constexpr std::array<GLenum, 4> formats{GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER, GL_RGBA_INTEGER};
  assert(format_info(texture.desc().format).kind == ChannelKind::unsigned_integer);
  return read_pixels<unsigned>(texture, formats.at(static_cast<std::size_t>(channels - 1)), GL_UNSIGNED_INT, channels,
                               block);
}

}  // namespace

Texture::Texture(std::string_view label, const TextureDesc& desc) : desc_(desc), serial_(next_serial()) {
  const FormatInfo format = format_info(desc.format);
  check_size(label, desc);
  GLuint id = 0;
  glCreateTextures(desc.target, 1, &id);
  handle_ = Handle<delete_texture>(id);
  gl::label(GL_TEXTURE, id, label);
  if (is_array(desc)) {
    glTextureStorage3D(id, desc.levels, desc.format, desc.width, desc.height, desc.layers);
  } else {
    glTextureStorage2D(id, desc.levels, desc.format, desc.width, desc.height);
  }
  if (glGetError() == GL_OUT_OF_MEMORY) {
    forget_errors();
    fail("texture '{}': out of memory for {} x {} x {}, {} bytes a texel", label, desc.width, desc.height, desc.layers,
         format.bytes);
  }
  const GLenum min_filter = desc.levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST;
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(min_filter));
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Texture::upload(GLenum format, GLenum type, std::span<const std::byte> pixels, int level, int layer) const {
  const int width = level_size(desc_.width, level);
  const int height = level_size(desc_.height, level);
  assert(level >= 0 && level < desc_.levels && layer >= 0 && layer < desc_.layers);
  assert(pixels.size() ==
         static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * pixel_bytes(format, type));
  set_tight_unpacking();
  if (is_array(desc_)) {
    glTextureSubImage3D(id(), level, 0, 0, layer, width, height, 1, format, type, pixels.data());
  } else {
    glTextureSubImage2D(id(), level, 0, 0, width, height, format, type, pixels.data());
  }
}

void Texture::generate_mipmaps() const { glGenerateTextureMipmap(id()); }

void Texture::bind(GLuint unit) const { glBindTextureUnit(unit, id()); }

void Texture::bind_image(GLuint unit, GLenum access, int level) const {
  glBindImageTexture(unit, id(), level, is_array(desc_) ? GL_TRUE : GL_FALSE, 0, access, desc_.format);
}

std::size_t Texture::bytes() const { return *this ? texels(desc_) * format_info(desc_.format).bytes : 0; }

Sampler::Sampler(std::string_view label, const SamplerDesc& desc) {
  GLuint id = 0;
  glCreateSamplers(1, &id);
  handle_ = Handle<delete_sampler>(id);
  gl::label(GL_SAMPLER, id, label);
  glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(desc.min_filter));
  glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(desc.mag_filter));
  glSamplerParameteri(id, GL_TEXTURE_WRAP_S, static_cast<GLint>(desc.wrap_s));
  glSamplerParameteri(id, GL_TEXTURE_WRAP_T, static_cast<GLint>(desc.wrap_t));
  constexpr GLfloat border[] = {1, 1, 1, 1};  // of GL_CLAMP_TO_BORDER: the far end of a depth map
  glSamplerParameterfv(id, GL_TEXTURE_BORDER_COLOR, border);
  if (desc.compare) {
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  // Anisotropic filtering is core in 4.6 only; its name is that of the extension, which nearly every driver has.
  constexpr GLenum texture_max_anisotropy = 0x84FE;
  if (desc.max_anisotropy > 1.0f) glSamplerParameterf(id, texture_max_anisotropy, desc.max_anisotropy);
}

void Sampler::bind(GLuint unit) const { glBindSampler(unit, id()); }

std::vector<float> read_floats(const Texture& texture, int channels, int level, int layer) {
  return read_floats(texture, channels, whole(texture, level, layer));
}

std::vector<unsigned> read_uints(const Texture& texture, int channels, int level, int layer) {
  return read_uints(texture, channels, whole(texture, level, layer));
}

std::vector<float> read_float_texel(const Texture& texture, int channels, int x, int y) {
  return read_floats(texture, channels, texel(texture, x, y));
}

std::vector<unsigned> read_uint_texel(const Texture& texture, int channels, int x, int y) {
  return read_uints(texture, channels, texel(texture, x, y));
}

}  // namespace penumbra::gl
