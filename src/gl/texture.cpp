#include "texture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <utility>

#include "../core/error.h"
#include "compatibility.h"
#include "debug.h"
#include "texture_format.h"

namespace penumbra::gl {

void delete_texture(GLuint id) { glDeleteTextures(1, &id); }
void delete_sampler(GLuint id) { glDeleteSamplers(1, &id); }

namespace {

bool is_array(const TextureDesc& desc) { return desc.target == GL_TEXTURE_2D_ARRAY; }

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

int level_size(int size, int level) { return std::max(1, size >> level); }

void check_size(std::string_view name, const TextureDesc& desc) {
  assert(desc.target == GL_TEXTURE_2D || is_array(desc));
  assert(desc.width > 0 && desc.height > 0 && desc.layers > 0 && desc.levels > 0);
  const int max_size = integer(GL_MAX_TEXTURE_SIZE);
  if (desc.width > max_size || desc.height > max_size) {
    fail("texture '{}': {} x {} is over this device's limit of {}", name, desc.width, desc.height, max_size);
  }
  const int max_layers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
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

// How client memory is laid out for uploads or for read-backs.
struct PixelStore {
  GLenum buffer, binding;        // target of the buffer that replaces client memory while one is bound, and its query
  std::array<GLenum, 7> layout;  // the first is the alignment
};

constexpr PixelStore unpacking{GL_PIXEL_UNPACK_BUFFER,
                               GL_PIXEL_UNPACK_BUFFER_BINDING,
                               {GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                                GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SWAP_BYTES}};
constexpr PixelStore packing{GL_PIXEL_PACK_BUFFER,
                             GL_PIXEL_PACK_BUFFER_BINDING,
                             {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
                              GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES}};

// Client memory is packed tightly in this scope, and as the caller's program had it afterwards.
class TightPixels {
 public:
  explicit TightPixels(const PixelStore& store)
      : store_(store), buffer_(static_cast<GLuint>(integer(store.binding))), values_() {
    glBindBuffer(store_.buffer, 0);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i] = integer(store_.layout[i]);
      glPixelStorei(store_.layout[i], i == 0 ? 1 : 0);
    }
  }
  ~TightPixels() {
    for (std::size_t i = 0; i < values_.size(); ++i) glPixelStorei(store_.layout[i], values_[i]);
    glBindBuffer(store_.buffer, buffer_);
  }
  TightPixels(const TightPixels&) = delete;
  TightPixels& operator=(const TightPixels&) = delete;

 private:
  const PixelStore& store_;
  GLuint buffer_;
  std::array<GLint, 7> values_;
};

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
  const TightPixels tight(packing);
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

void set_sampling(GLuint id, int levels) {
  const GLenum min_filter = levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST;
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(min_filter));
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

Texture::Texture(std::string_view label, const TextureDesc& desc) : desc_(desc), serial_(next_serial()) {
  const FormatInfo format = format_info(desc.format);
  check_size(label, desc);
  GLuint id = 0;
  glCreateTextures(desc.target, 1, &id);
  handle_ = Handle<delete_texture>(id);
  gl::label(GL_TEXTURE, id, label);
  const std::string what = fmt::format("texture '{}'", label);
  StorageCheck check(what);
  if (is_array(desc)) {
    glTextureStorage3D(id, desc.levels, desc.format, desc.width, desc.height, desc.layers);
  } else {
    glTextureStorage2D(id, desc.levels, desc.format, desc.width, desc.height);
  }
  if (check.ran_out()) {
    fail("{}: out of memory for {} x {} x {}, {} bytes a texel", what, desc.width, desc.height, desc.layers,
         format.bytes);
  }
  set_sampling(id, desc.levels);
}

Texture Texture::view(std::string_view label, const Texture& of, GLenum format) {
  Texture texture;
  texture.desc_ = of.desc();
  texture.desc_.format = format;
  texture.serial_ = next_serial();
  GLuint id = 0;
  glGenTextures(1, &id);
  texture.handle_ = Handle<delete_texture>(id);
  glTextureView(id, of.desc().target, of.id(), format, 0, static_cast<GLuint>(of.desc().levels), 0,
                static_cast<GLuint>(of.desc().layers));
  gl::label(GL_TEXTURE, id, label);
  set_sampling(id, of.desc().levels);
  return texture;
}

Texture Texture::wrap(GLuint id, const TextureDesc& desc) {
  Texture texture;
  texture.handle_ = Handle<delete_texture>(id, /*owned=*/false);
  texture.desc_ = desc;
  return texture;
}

void Texture::upload(GLenum format, GLenum type, std::span<const std::byte> pixels, int level, int layer) const {
  const int width = level_size(desc_.width, level);
  const int height = level_size(desc_.height, level);
  assert(level >= 0 && level < desc_.levels && layer >= 0 && layer < desc_.layers);
  assert(pixels.size() ==
         static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * pixel_bytes(format, type));
  const TightPixels tight(unpacking);
  if (is_array(desc_)) {
    glTextureSubImage3D(id(), level, 0, 0, layer, width, height, 1, format, type, pixels.data());
  } else {
    glTextureSubImage2D(id(), level, 0, 0, width, height, format, type, pixels.data());
  }
}

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
  glSamplerParameterf(id, GL_TEXTURE_LOD_BIAS, desc.lod_bias);
  if (desc.max_anisotropy > 1.0f) glSamplerParameterf(id, texture_max_anisotropy, desc.max_anisotropy);
}

void Sampler::bind(GLuint unit) const { glBindSampler(unit, id()); }

GLenum target_of(GLuint id) {
  if (!has_legacy_state()) {
    GLint target = 0;
    glGetTextureParameteriv(id, GL_TEXTURE_TARGET, &target);
    return static_cast<GLenum>(target);
  }
  // Mesa (22.3) refuses that query in contexts of the compatibility profile. A texture that is bound to a unit is bound
  // to its target there.
  const auto active = static_cast<GLenum>(integer(GL_ACTIVE_TEXTURE));
  glActiveTexture(GL_TEXTURE0);
  glBindTextureUnit(0, id);
  GLenum target = GL_NONE;
  constexpr std::pair<GLenum, GLenum> bindings[] = {
      {GL_TEXTURE_BINDING_2D, GL_TEXTURE_2D},
      {GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_2D_ARRAY},
      {GL_TEXTURE_BINDING_2D_MULTISAMPLE, GL_TEXTURE_2D_MULTISAMPLE},
      {GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_2D_MULTISAMPLE_ARRAY}};
  for (const auto& [binding, of] : bindings) {
    if (static_cast<GLuint>(integer(binding)) == id) target = of;
  }
  glBindTextureUnit(0, 0);
  glActiveTexture(active);
  return target;
}

TextureDesc describe(std::string_view name, GLuint id) {
  if (id == 0 || glIsTexture(id) == GL_FALSE) fail("texture '{}': {} is not the name of a texture", name, id);
  const GLenum target = target_of(id);
  if (target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_ARRAY) {
    fail("texture '{}': {} is not a GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY", name, id);
  }
  const auto level_parameter = [&](GLenum parameter) {
    GLint value = 0;
    glGetTextureLevelParameteriv(id, 0, parameter, &value);
    return value;
  };
  TextureDesc desc{.target = target,
                   .format = static_cast<GLenum>(level_parameter(GL_TEXTURE_INTERNAL_FORMAT)),
                   .width = level_parameter(GL_TEXTURE_WIDTH),
                   .height = level_parameter(GL_TEXTURE_HEIGHT),
                   .layers = level_parameter(GL_TEXTURE_DEPTH)};
  if (desc.width < 1) fail("texture '{}': {} has no level 0", name, id);
  try {
    format_info(desc.format);
  } catch (const Error& error) {
    fail("texture '{}': {}", name, error.what());
  }
  GLint levels = 0;
  glGetTextureParameteriv(id, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
  desc.levels = std::max(1, levels);
  return desc;
}

std::vector<float> read_floats(const Texture& texture, int channels, int level, int layer) {
  return read_floats(texture, channels, whole(texture, level, layer));
}

std::vector<unsigned> read_uints(const Texture& texture, int channels, int level, int layer) {
  return read_uints(texture, channels, whole(texture, level, layer));
}

std::vector<std::uint8_t> read_stencil(const Texture& texture, int level, int layer) {
  assert(format_info(texture.desc().format).kind == ChannelKind::depth_stencil);
  return read_pixels<std::uint8_t>(texture, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1, whole(texture, level, layer));
}

std::vector<float> read_float_texel(const Texture& texture, int channels, int x, int y) {
  return read_floats(texture, channels, texel(texture, x, y));
}

std::vector<unsigned> read_uint_texel(const Texture& texture, int channels, int x, int y) {
  return read_uints(texture, channels, texel(texture, x, y));
}

}  // namespace penumbra::gl
