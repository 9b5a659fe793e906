// Textures of the caller's, to which the visibility of lights is written.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/log.h"
#include "gpu/gl_calls.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

using shadow::OutputTexture;

constexpr int side = 48;
constexpr float before = 0.25f;  // in all channels, before a frame

// A texture as an engine makes it.
class Own {
 public:
  explicit Own(const gl::TextureDesc& desc) : desc_(desc) {
    const bool array = desc.target == GL_TEXTURE_2D_ARRAY;
    gl::glCreateTextures(desc.target, 1, &id_);
    if (array) {
      gl::glTextureStorage3D(id_, desc.levels, desc.format, desc.width, desc.height, desc.layers);
    } else {
      gl::glTextureStorage2D(id_, desc.levels, desc.format, desc.width, desc.height);
    }
    constexpr std::array<float, 4> value{before, before, before, before};
    for (int level = 0; level < desc.levels; ++level) gl::glClearTexImage(id_, level, GL_RGBA, GL_FLOAT, value.data());
  }
  ~Own() { gl::glDeleteTextures(1, &id_); }
  Own(const Own&) = delete;
  Own& operator=(const Own&) = delete;

  OutputTexture channel(int channel, int layer = 0, int level = 0) const {
    return {.id = id_, .level = level, .layer = layer, .channel = channel};
  }
  // One channel of a layer.
  std::vector<float> values(int channel, int layer = 0, int level = 0) const {
    const std::vector<float> all = gl::read_floats(gl::Texture::wrap(id_, desc_), 4, level, layer);
    std::vector<float> one;
    for (auto i = static_cast<std::size_t>(channel); i < all.size(); i += 4) one.push_back(all[i]);
    return one;
  }
  GLuint id() const { return id_; }

 private:
  gl::TextureDesc desc_;
  GLuint id_ = 0;
};

gl::TextureDesc flat(GLenum format, int size = side) { return {.format = format, .width = size, .height = size}; }

// A texture whose levels may be made and limited one by one.
struct MutableTexture {
  GLuint id = 0;

  MutableTexture(std::initializer_list<int> sizes) {
    gl::glGenTextures(1, &id);
    gl::glBindTexture(GL_TEXTURE_2D, id);
    int level = 0;
    for (const int size : sizes)
      gl::glTexImage2D(GL_TEXTURE_2D, level++, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl::glBindTexture(GL_TEXTURE_2D, 0);
  }
  ~MutableTexture() { gl::glDeleteTextures(1, &id); }
  MutableTexture(const MutableTexture&) = delete;
  MutableTexture& operator=(const MutableTexture&) = delete;
};

// The nearest value that the format holds.
float rounded(float value, GLenum format) {
  const bool eight_bits = format == GL_R8 || format == GL_RG8 || format == GL_RGBA8;
  return eight_bits ? std::floor(value * 255 + 0.5f) / 255 : value;
}

class ShadowOutput : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params = renderer_->params();
    params.set("sun.angle", 8.0f);
    params.set("cascades.size", 256);
  }

  // Renders with suns in different directions, one for each output.
  void render(const std::vector<std::optional<OutputTexture>>& outputs, const TriangleRenderer::Adjust& adjust = {}) {
    std::vector<shadow::Light> lights;
    for (const std::optional<OutputTexture>& output : outputs) {
      const int id = static_cast<int>(lights.size());
      lights.push_back({.id = id,
                        .source = shadow::Sun{sun_direction(60.0f + 70.0f * static_cast<float>(id), 40)},
                        .overrides = {},
                        .maps = {},
                        .output = output});
    }
    renderer_->render(scene, params, [&](shadow::Inputs& in) {
      in.lights = lights;
      in.view.last_view = in.view.view;
      in.view.last_projection = in.view.projection;
      in.mask_details = false;
      if (adjust) adjust(in);
    });
  }
  std::vector<float> mask(int layer) const { return gl::read_floats(*renderer_->mask().texture, 1, 0, layer); }

  void expect_holds(const Own& texture, GLenum format, const OutputTexture& output, int light) const {
    const std::vector<float> expected = mask(light);
    const std::vector<float> values = texture.values(output.channel, output.layer, output.level);
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      // The read-back of an 8-bit value divides by 255, too, perhaps in another way.
      ASSERT_NEAR(values[i], rounded(expected[i], format), 1e-6f) << "pixel " << i << " mask " << expected[i];
    }
    EXPECT_EQ(std::ranges::count(values, 1.0f),
              std::ranges::count_if(expected, [&](float value) { return rounded(value, format) == 1.0f; }));
    EXPECT_GT(std::ranges::count(values, 1.0f), 100);
    EXPECT_GT(std::ranges::count(values, 0.0f), 10);
    EXPECT_GT(std::ranges::count_if(values, [](float value) { return value > 0.1f && value < 0.9f; }), 10);
  }
  static bool is_untouched(const std::vector<float>& values) {
    return std::ranges::all_of(values, [](float value) { return std::abs(value - before) < 0.5f / 255; });
  }
  void expect_refusal(const std::string& says, const std::vector<std::optional<OutputTexture>>& outputs) {
    const std::string message = message_of([&] { render(outputs); });
    EXPECT_NE(message.find(says), std::string::npos) << message << "\nshould say: " << says;
    EXPECT_EQ(message.find("soft shadows: "), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }

  TriangleScene scene = box_on_ground(side);
  ParamSet params;
};

TEST_F(ShadowOutput, EveryFormatHoldsTheMasksValuesRoundedToTheNearest) {
  for (const auto& [format, channels] :
       {std::pair{GL_R8, 1}, {GL_RG8, 2}, {GL_RGBA8, 4}, {GL_R16F, 1}, {GL_RG16F, 2}, {GL_RGBA16F, 4}}) {
    for (int channel = 0; channel < channels; ++channel) {
      SCOPED_TRACE(testing::Message() << std::hex << format << " channel " << channel);
      const auto sized = static_cast<GLenum>(format);
      const Own texture(flat(sized));
      render({texture.channel(channel)});
      expect_holds(texture, sized, texture.channel(channel), 0);
      for (int other = 0; other < channels; ++other) {
        EXPECT_TRUE(other == channel || is_untouched(texture.values(other))) << other;
      }
    }
  }
}

TEST_F(ShadowOutput, OtherChannelsLayersLevelsAndTexelsOutsideOfTheViewportStay) {
  const Own texture({.target = GL_TEXTURE_2D_ARRAY,
                     .format = GL_RGBA8,
                     .width = 2 * side,
                     .height = 2 * side,
                     .layers = 3,
                     .levels = 3});
  const shadow::Rect viewport{5, 9, 31, 24};
  render({texture.channel(2, 1, 1)}, [&](shadow::Inputs& in) { in.viewport = viewport; });
  const std::vector<float> expected = mask(0);
  for (int level = 0; level < 3; ++level) {
    for (int layer = 0; layer < 3; ++layer) {
      for (int channel = 0; channel < 4; ++channel) {
        if (level == 1 && layer == 1 && channel == 2) continue;
        EXPECT_TRUE(is_untouched(texture.values(channel, layer, level))) << level << " " << layer << " " << channel;
      }
    }
  }
  const std::vector<float> values = texture.values(2, 1, 1);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto i = static_cast<std::size_t>(y * side + x);
      const bool inside =
          x >= viewport.x && x < viewport.x + viewport.width && y >= viewport.y && y < viewport.y + viewport.height;
      ASSERT_NEAR(values[i], inside ? rounded(expected[i], GL_RGBA8) : before, inside ? 1e-6 : 0.5 / 255)
          << x << ", " << y;
    }
  }
}

TEST_F(ShadowOutput, LightsShareATextureByChannelsAndLayers) {
  const Own colors(flat(GL_RGBA8));
  const Own array({.target = GL_TEXTURE_2D_ARRAY, .format = GL_R16F, .width = side, .height = side, .layers = 2});
  render({colors.channel(3), array.channel(0, 1), std::nullopt, colors.channel(0), colors.channel(2),
          array.channel(0, 0)});
  expect_holds(colors, GL_RGBA8, colors.channel(3), 0);
  expect_holds(array, GL_R16F, array.channel(0, 1), 1);
  expect_holds(colors, GL_RGBA8, colors.channel(0), 3);
  expect_holds(colors, GL_RGBA8, colors.channel(2), 4);
  expect_holds(array, GL_R16F, array.channel(0, 0), 5);
  EXPECT_TRUE(is_untouched(colors.values(1)));
  EXPECT_NE(mask(0), mask(3));
}

TEST_F(ShadowOutput, ItFollowsTheFramesOfAnotherTextureAndOfAnotherLevel) {
  const Own first(flat(GL_R8)), second(flat(GL_R8));
  render({first.channel(0)});
  render({second.channel(0)});
  EXPECT_EQ(first.values(0), second.values(0));
  const Own larger({.format = GL_R8, .width = 2 * side, .height = 2 * side, .levels = 2});
  render({larger.channel(0, 0, 1)});
  EXPECT_EQ(first.values(0), larger.values(0, 0, 1));
  expect_refusal("level 0 of texture", {larger.channel(0)});
}

TEST_F(ShadowOutput, TexturesWhoseLevelsAreMadeOneByOneAreTakenIfTheyCanBeDrawnTo) {
  const MutableTexture one_level({side});  // incomplete for its own filter, which is that of mipmaps
  render({OutputTexture{.id = one_level.id}});
  const MutableTexture limited({2 * side, side, side / 2});
  gl::glTextureParameteri(limited.id, GL_TEXTURE_MAX_LEVEL, 0);
  // Drivers differ in whether they draw to a level above the maximum.
  try {
    render({OutputTexture{.id = limited.id, .level = 1}});
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("is incomplete, or its level 1 is outside of its base and maximum level"),
              std::string::npos)
        << error.what();
  }
  expect_refusal("level 1 of texture", {OutputTexture{.id = one_level.id, .level = 1}});
}

TEST_F(ShadowOutput, ChannelsThatAreReadAreRefused) {
  const Own normals(flat(GL_RGBA16F)), motion(flat(GL_RG16F));
  const std::vector<float> encoded(2 * side * side, 0.5f);
  gl::glTextureSubImage2D(normals.id(), 0, 0, 0, side, side, GL_RG, GL_FLOAT, encoded.data());
  const auto with_both = [&](shadow::Inputs& in) {
    in.normals = {.id = normals.id(), .width = side, .height = side};
    in.motion = {.id = motion.id(), .width = side, .height = side};
  };
  const auto refusal = [&](const OutputTexture& output) {
    return message_of([&] { render({std::nullopt, output}, with_both); });
  };
  EXPECT_EQ(refusal(normals.channel(1)), "soft shadows: the output of light 1: channel 1 of texture " +
                                             std::to_string(normals.id()) + " has the normals");
  EXPECT_NE(refusal(motion.channel(0)).find("has the motion vectors"), std::string::npos);
  EXPECT_NO_THROW(render({normals.channel(3)}, with_both)) << "normals have two channels";
}

TEST_F(ShadowOutput, WhatDoesNotSuitIsRefusedInOneLine) {
  const Own r8(flat(GL_R8)), small(flat(GL_R8, side - 1)), srgb(flat(GL_SRGB8_ALPHA8)), wide(flat(GL_RGBA16));
  const Own array({.target = GL_TEXTURE_2D_ARRAY, .format = GL_RG8, .width = side, .height = side, .layers = 2});
  expect_refusal("the output of light 0: 4242 is not the name of a texture", {OutputTexture{.id = 4242}});
  expect_refusal("is 47×47, depth is 48×48", {std::nullopt, small.channel(0)});
  expect_refusal("the output of light 1: ", {std::nullopt, small.channel(0)});
  expect_refusal("has the format 0x8c43; it must be R8, RG8, RGBA8, R16F, RG16F or RGBA16F", {srgb.channel(0)});
  expect_refusal("has the format 0x805b", {wide.channel(0)});
  expect_refusal("has no channel 1", {r8.channel(1)});
  expect_refusal("has no channel 2", {array.channel(2)});
  expect_refusal("has no channel -1", {r8.channel(-1)});
  expect_refusal("has no layer 1", {r8.channel(0, 1)});
  expect_refusal("has no layer 2", {array.channel(0, 2)});
  expect_refusal("has no layer -1", {array.channel(0, -1)});
  expect_refusal("has no level 31", {r8.channel(0, 0, 31)});
  expect_refusal("has no level -1", {r8.channel(0, 0, -1)});
  expect_refusal("lights 0 and 1 have the same output", {r8.channel(0), r8.channel(0)});
  GLuint cube = 0;
  gl::glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
  gl::glTextureStorage2D(cube, 1, GL_R8, side, side);
  expect_refusal("is neither a GL_TEXTURE_2D nor a GL_TEXTURE_2D_ARRAY", {OutputTexture{.id = cube}});
  gl::glDeleteTextures(1, &cube);
  EXPECT_NO_THROW(render({r8.channel(0), array.channel(1, 1)}));
}

// Such as those about a framebuffer that is bound and incomplete.
TEST_F(ShadowOutput, AFrameMakesTheDriverSendNoMessage) {
  const Own texture(flat(GL_R8));
  render({texture.channel(0)});  // checks the texture
  std::vector<std::string> messages;
  const LogSink keep = [&](LogLevel, std::string_view line) { messages.emplace_back(line); };
  const ThreadLogSink sink(keep);
  render({texture.channel(0)});
  EXPECT_EQ(messages, std::vector<std::string>());
}

TEST_F(ShadowOutput, AWarmUpTakesLightsWithOutputs) {
  const Own texture(flat(GL_R8));
  const std::array lights{shadow::Light{.output = texture.channel(0)}, shadow::Light{.id = 1},
                          shadow::Light{.id = 2, .output = OutputTexture{.id = 4242}}};
  renderer_->shadows().warm_up({.conventions = {}, .lights = lights}, params);
  EXPECT_TRUE(is_untouched(texture.values(0)));
}

// On a context without debugging: a debug context queries errors after every step. Frames take turns with `outputs`.
void expect_steady_frames(std::span<const OutputTexture> outputs) {
  TriangleRenderer renderer;
  const Own second(flat(GL_R16F));
  const TriangleScene scene = box_on_ground(side);
  const shadow::Light light{.source = shadow::Sun{scene.to_light}, .overrides = {}, .maps = {}};
  std::vector<shadow::Light> lights(2, light);
  lights[1] = {.id = 1, .source = light.source, .overrides = {}, .maps = {}, .output = second.channel(0)};
  ParamSet params = renderer.params();
  params.set("cascades.size", 64);
  const int first_frames = static_cast<int>(outputs.size()) + 2;
  for (const GlCalls::Kind kind : {GlCalls::Kind::creations, GlCalls::Kind::queries}) {
    std::optional<GlCalls> calls;
    for (int frame = 0; frame < 2 * first_frames; ++frame) {
      std::map<std::string, int> counts;
      lights[0].output = outputs[static_cast<std::size_t>(frame) % outputs.size()];
      renderer.render(
          scene, params,
          [&](shadow::Inputs& in) {
            in.lights = lights;
            in.view.last_view = in.view.view;
            in.view.last_projection = in.view.projection;
            calls.emplace(kind);
          },
          [&] {
            counts = calls->counts();
            calls.reset();
          });
      if (frame == 0 && kind == GlCalls::Kind::creations) {
        EXPECT_FALSE(counts.empty()) << "the counter counts";
      }
      if (frame >= first_frames) {
        EXPECT_EQ(counts, (std::map<std::string, int>())) << frame;
      }
    }
  }
}

TEST(ShadowOutputSteady, AFrameMakesNothingAndAsksNothing) {
  const auto context = gl::make_context(backend_name(), {.debug = false});
  const Own texture(flat(GL_RGBA8));
  expect_steady_frames(std::array{texture.channel(1)});
}

// As engines with two or three sets of textures do.
TEST(ShadowOutputSteady, NorDoesOneWhoseTexturesTakeTurns) {
  const auto context = gl::make_context(backend_name(), {.debug = false});
  const Own a(flat(GL_RGBA8)), b(flat(GL_RGBA8)), c(flat(GL_R8));
  expect_steady_frames(std::array{a.channel(1), b.channel(1)});
  expect_steady_frames(std::array{a.channel(1), b.channel(1), c.channel(0)});
}

}  // namespace
}  // namespace penumbra::test
