#include "texture_format.h"

#include "../core/error.h"

namespace penumbra::gl {
namespace {

std::size_t channel_count(GLenum format) {
  switch (format) {
    case GL_RED:
    case GL_RED_INTEGER:
    case GL_DEPTH_COMPONENT:
      return 1;
    case GL_RG:
    case GL_RG_INTEGER:
      return 2;
    case GL_RGB:
    case GL_RGB_INTEGER:
      return 3;
    case GL_RGBA:
    case GL_RGBA_INTEGER:
      return 4;
    default:
      fail("pixel format {:#x} is not supported", format);
  }
}

std::size_t channel_bytes(GLenum type) {
  switch (type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
      return 1;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_HALF_FLOAT:
      return 2;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
      return 4;
    default:
      fail("pixel type {:#x} is not supported", type);
  }
}

}  // namespace

std::size_t pixel_bytes(GLenum format, GLenum type) { return channel_count(format) * channel_bytes(type); }

FormatInfo format_info(GLenum sized_format) {
  using enum ChannelKind;
  switch (sized_format) {
    case GL_R8:
    case GL_R8_SNORM:
      return {1, real};
    case GL_RG8:
    case GL_RG8_SNORM:
    case GL_R16:
    case GL_R16_SNORM:
    case GL_R16F:
      return {2, real};
    case GL_RGB8:
    case GL_SRGB8:
      return {3, real};
    case GL_RGBA8:
    case GL_RGBA8_SNORM:
    case GL_SRGB8_ALPHA8:
    case GL_RGB10_A2:
    case GL_R11F_G11F_B10F:
    case GL_RGB9_E5:
    case GL_RG16:
    case GL_RG16_SNORM:
    case GL_RG16F:
    case GL_R32F:
      return {4, real};
    case GL_RGB16F:
      return {6, real};
    case GL_RGBA16:
    case GL_RGBA16_SNORM:
    case GL_RGBA16F:
    case GL_RG32F:
      return {8, real};
    case GL_RGB32F:
      return {12, real};
    case GL_RGBA32F:
      return {16, real};
    case GL_R8I:
      return {1, signed_integer};
    case GL_R16I:
    case GL_RG8I:
      return {2, signed_integer};
    case GL_R32I:
    case GL_RG16I:
    case GL_RGBA8I:
      return {4, signed_integer};
    case GL_RG32I:
    case GL_RGBA16I:
      return {8, signed_integer};
    case GL_RGBA32I:
      return {16, signed_integer};
    case GL_R8UI:
      return {1, unsigned_integer};
    case GL_R16UI:
    case GL_RG8UI:
      return {2, unsigned_integer};
    case GL_R32UI:
    case GL_RG16UI:
    case GL_RGBA8UI:
      return {4, unsigned_integer};
    case GL_RG32UI:
    case GL_RGBA16UI:
      return {8, unsigned_integer};
    case GL_RGBA32UI:
      return {16, unsigned_integer};
    case GL_DEPTH_COMPONENT16:
      return {2, depth};
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32F:
      return {4, depth};
    case GL_DEPTH24_STENCIL8:
      return {4, depth_stencil};
    case GL_DEPTH32F_STENCIL8:
      return {8, depth_stencil};
    default:
      fail("texture format {:#x} is not supported", sized_format);
  }
}

}  // namespace penumbra::gl
