#include "gl/texture.h"

#include <array>
#include <cstdint>
#include <numeric>

#include "core/log.h"
#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra {
namespace {

using test::message_of;

class GlTexture : public test::GpuTest {};

// The numbers 0, 1, 2, … scaled.
std::vector<float> ramp(std::size_t count, float scale) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 0.0f);
  for (float& value : values) value *= scale;
  return values;
}

TEST_F(GlTexture, EveryLevelAndLayerReadsBackWhatWasUploaded) {
  const gl::Texture texture(
      "t", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RG32F, .width = 5, .height = 3, .layers = 3, .levels = 2});
  for (int layer = 0; layer < 3; ++layer) {
    texture.upload(GL_RG, GL_FLOAT, std::as_bytes(std::span<const float>(ramp(30, 1.0f + static_cast<float>(layer)))),
                   0, layer);
    texture.upload(GL_RG, GL_FLOAT, std::as_bytes(std::span<const float>(ramp(4, -1.0f - static_cast<float>(layer)))),
                   1, layer);
  }
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_EQ(gl::read_floats(texture, 2, 0, layer), ramp(30, 1.0f + static_cast<float>(layer)));
    EXPECT_EQ(gl::read_floats(texture, 2, 1, layer), ramp(4, -1.0f - static_cast<float>(layer)));
  }
}

// Pixel-store state that an engine may have set: each value differs from the initial one and from tight packing.
struct Layout {
  GLenum name;
  GLint value, initial;
};
constexpr std::array layouts{
    Layout{GL_UNPACK_ALIGNMENT, 8, 4},   Layout{GL_UNPACK_ROW_LENGTH, 17, 0}, Layout{GL_UNPACK_SKIP_ROWS, 2, 0},
    Layout{GL_UNPACK_SKIP_PIXELS, 3, 0}, Layout{GL_UNPACK_SKIP_IMAGES, 1, 0}, Layout{GL_UNPACK_IMAGE_HEIGHT, 19, 0},
    Layout{GL_UNPACK_SWAP_BYTES, 1, 0},  Layout{GL_PACK_ALIGNMENT, 8, 4},     Layout{GL_PACK_ROW_LENGTH, 23, 0},
    Layout{GL_PACK_SKIP_ROWS, 4, 0},     Layout{GL_PACK_SKIP_PIXELS, 5, 0},   Layout{GL_PACK_SKIP_IMAGES, 6, 0},
    Layout{GL_PACK_IMAGE_HEIGHT, 29, 0}, Layout{GL_PACK_SWAP_BYTES, 1, 0}};

GLint integer(GLenum name) {
  GLint value = 0;
  gl::glGetIntegerv(name, &value);
  return value;
}

TEST_F(GlTexture, UploadsAndReadsIgnoreAndKeepPixelStoreState) {
  const gl::Buffer other("an engine's", 4);
  for (const Layout& layout : layouts) gl::glPixelStorei(layout.name, layout.value);
  gl::glBindBuffer(GL_PIXEL_UNPACK_BUFFER, other.id());
  gl::glBindBuffer(GL_PIXEL_PACK_BUFFER, other.id());
  const gl::Texture texture("t", {.format = GL_R16, .width = 3, .height = 3});
  const std::array<std::uint16_t, 9> pixels{0, 65535, 51, 102, 0, 255, 20400, 153, 51};
  texture.upload(GL_RED, GL_UNSIGNED_SHORT, std::as_bytes(std::span(pixels)));
  const std::vector<float> read = gl::read_floats(texture, 1);
  for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_FLOAT_EQ(read[i], static_cast<float>(pixels[i]) / 65535.0f);
  EXPECT_EQ(integer(GL_PIXEL_UNPACK_BUFFER_BINDING), static_cast<GLint>(other.id()));
  EXPECT_EQ(integer(GL_PIXEL_PACK_BUFFER_BINDING), static_cast<GLint>(other.id()));
  for (const Layout& layout : layouts) {
    EXPECT_EQ(integer(layout.name), layout.value) << std::hex << layout.name;
    gl::glPixelStorei(layout.name, layout.initial);
  }
}

TEST_F(GlTexture, IntegersAndDepthReadBack) {
  const gl::Texture integers("t", {.format = GL_RG32UI, .width = 2});
  const std::array<unsigned, 4> values{0u, 0xffffffffu, 0x80000001u, 7u};
  integers.upload(GL_RG_INTEGER, GL_UNSIGNED_INT, std::as_bytes(std::span(values)));
  EXPECT_EQ(gl::read_uints(integers, 2), std::vector<unsigned>(values.begin(), values.end()));

  const gl::Texture depth("d", {.format = GL_DEPTH_COMPONENT32F, .width = 2});
  const std::array<float, 2> depths{0.25f, 0.75f};
  depth.upload(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_bytes(std::span(depths)));
  EXPECT_EQ(gl::read_floats(depth, 1), std::vector<float>(depths.begin(), depths.end()));
}

TEST_F(GlTexture, BytesCountLevelsAndLayers) {
  EXPECT_EQ(gl::Texture("t", {.format = GL_RGBA16F, .width = 4, .height = 2, .levels = 3}).bytes(),
            (8u + 2u + 1u) * 8u);
  EXPECT_EQ(
      gl::Texture(
          "t",
          {.target = GL_TEXTURE_2D_ARRAY, .format = GL_DEPTH_COMPONENT32F, .width = 2048, .height = 2048, .layers = 4})
          .bytes(),
      4u * 2048u * 2048u * 4u);
  EXPECT_EQ(gl::Texture().bytes(), 0u);
}

TEST_F(GlTexture, OneTooLargeForTheDeviceIsNamedWithTheLimit) {
  const std::string message = message_of([] { gl::Texture("shadow map", {.width = 1 << 20}); });
  EXPECT_NE(message.find("texture 'shadow map': 1048576 x 1 is over"), std::string::npos) << message;
}

const gl::TextureDesc huge{
    .target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA32F, .width = 16384, .height = 16384, .layers = 2048};

// Some drivers take memory only when a texture is first used.
bool driver_refuses_huge() {
  GLuint id = 0;
  gl::glCreateTextures(huge.target, 1, &id);
  gl::glTextureStorage3D(id, 1, huge.format, huge.width, huge.height, huge.layers);
  bool refused = false;
  try {
    gl::check_errors("storage");
  } catch (const Error&) {
    refused = true;
  }
  gl::glDeleteTextures(1, &id);
  return refused;
}

TEST_F(GlTexture, OneThatDoesNotFitIntoMemoryIsNamedOnce) {
  if (!driver_refuses_huge()) GTEST_SKIP() << "skipped: this driver takes memory when a texture is first used";
  const std::string message = message_of([&] { gl::Texture("mask", huge); });
  EXPECT_NE(message.find("texture 'mask': out of memory"), std::string::npos) << message;
  EXPECT_NO_THROW(gl::check_errors("afterwards"));
}

// An earlier call has set the error flag, and nobody has read it yet.
TEST_F(GlTexture, AnEarlierErrorNeitherHidesRunningOutOfMemoryNorIsLost) {
  if (!driver_refuses_huge()) GTEST_SKIP() << "skipped: this driver takes memory when a texture is first used";
  const auto make_an_error = [] { gl::glEnable(GL_TEXTURE_2D_ARRAY); };
  make_an_error();
  EXPECT_NE(message_of([&] { gl::Texture("mask", huge); }).find("texture 'mask': out of memory"), std::string::npos);
  const std::string kept = message_of([] { gl::check_errors("afterwards"); });
  EXPECT_NE(kept.find("GL_INVALID_ENUM"), std::string::npos) << kept;
  EXPECT_NO_THROW(gl::check_errors("afterwards"));

  const auto plain = gl::make_context(test::backend_name(), {.debug = false});
  std::vector<std::string> warnings;
  set_log_sink([&](LogLevel level, std::string_view message) {
    if (level == LogLevel::warning) warnings.emplace_back(message);
  });
  make_an_error();
  EXPECT_NE(message_of([&] { gl::Texture("mask", huge); }).find("texture 'mask': out of memory"), std::string::npos);
  make_an_error();
  const gl::Buffer buffer("lists", 16);
  set_log_sink({});
  EXPECT_EQ(warnings, (std::vector<std::string>{
                          "OpenGL: an earlier call raised GL_INVALID_ENUM, found when texture 'mask' was made",
                          "OpenGL: an earlier call raised GL_INVALID_ENUM, found when buffer 'lists' was made"}));
}

TEST_F(GlTexture, MovingKeepsOneOwner) {
  gl::Texture first("t", {.format = GL_R8});
  const GLuint id = first.id();
  gl::Texture second = std::move(first);
  EXPECT_EQ(second.id(), id);
  second = gl::Texture();
  EXPECT_EQ(gl::glIsTexture(id), GL_FALSE);
}

class GlBuffer : public test::GpuTest {};

TEST_F(GlBuffer, HoldsWhatWasWritten) {
  const std::array<float, 4> values{1, 2, 3, 4};
  const gl::Buffer buffer = gl::Buffer::of("b", std::span<const float>(values));
  gl::write_value(buffer, 9.0f);
  buffer.write(std::as_bytes(std::span(values).first(1)), 3 * sizeof(float));
  std::array<float, 4> read{};
  gl::glGetNamedBufferSubData(buffer.id(), 0, sizeof(read), read.data());
  EXPECT_EQ(read, (std::array<float, 4>{9, 2, 3, 1}));
  EXPECT_EQ(buffer.size(), sizeof(values));
}

TEST_F(GlBuffer, MayBeEmpty) {
  const gl::Buffer buffer("b", std::span<const std::byte>());
  EXPECT_EQ(buffer.size(), 0u);
  EXPECT_TRUE(buffer);
  buffer.bind_storage(0);
}

}  // namespace
}  // namespace penumbra
