#include "gl/pass.h"

#include "gl/api.h"
#include "gl_calls.h"
#include "gl_pass.h"

namespace penumbra {
namespace {

using test::fill_program;

class GlDevice : public test::GlPassTest {
 protected:
  // Objects of every kind, with ids up to a bound far above what the tests make.
  static int live_objects() {
    int live = 0;
    for (GLuint id = 1; id < 2000; ++id) {
      live += gl::glIsTexture(id) + gl::glIsBuffer(id) + gl::glIsFramebuffer(id) + gl::glIsVertexArray(id) +
              gl::glIsSampler(id) + gl::glIsProgram(id) + gl::glIsShader(id) + gl::glIsQuery(id);
    }
    return live;
  }
};

TEST_F(GlDevice, AFrameMakesNoObjectsAfterTheFirst) {
  const auto frame = [&] {
    const gl::TextureDesc desc{
        .target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 16, .height = 16, .layers = 4};
    const gl::Texture& maps = device.target("maps", desc);
    for (int layer = 0; layer < 4; ++layer) {
      draw({.name = "map", .colors = {{.texture = &maps, .layer = layer, .clear = glm::vec4(1)}}}, glm::vec4(1));
    }
    device.scratch("lists", 256);
    device.sampler({.min_filter = GL_LINEAR}).bind(0);
    gl::Pass pass(device, {.name = "fill"});
    pass.use(fill_program);
    maps.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch(16, 16, 4);
  };
  frame();
  const int live = live_objects();
  const test::GlCalls creations(test::GlCalls::Kind::creations);
  for (int i = 0; i < 5; ++i) frame();
  EXPECT_EQ(live_objects(), live);
  EXPECT_TRUE(creations.counts().empty()) << creations.counts().begin()->first << ": made and deleted again";
}

TEST_F(GlDevice, SamplersOfOneDescriptionAreShared) {
  const gl::SamplerDesc plain{.min_filter = GL_LINEAR_MIPMAP_NEAREST};
  gl::SamplerDesc sharper = plain;
  sharper.lod_bias = -1.5f;
  const GLuint first = device.sampler(plain).id();
  EXPECT_NE(device.sampler(sharper).id(), first);
  EXPECT_EQ(device.sampler(plain).id(), first);
}

TEST_F(GlDevice, DropTakesWhatBeginsWithThePrefixAndNothingElse) {
  for (const char* name : {"a", "b", "b/1", "b/1/x", "b/10", "b0", "c"}) {
    device.target(name, {.format = GL_R8, .width = 4});
    device.scratch(name, 4);
  }
  device.drop("b/1");
  device.drop("none of that name");
  std::vector<std::string> left;
  for (const auto& target : device.targets()) left.emplace_back(target.name);
  EXPECT_EQ(left, (std::vector<std::string>{"a", "b", "b0", "c", "color", "depth"}));
  device.drop("");
  EXPECT_TRUE(device.targets().empty());
}

TEST_F(GlDevice, ATargetIsMadeAgainWhenItsDescriptionChanges) {
  const int live = live_objects();
  for (const int size : {4, 8, 16, 8}) {
    const gl::Texture& target = device.target("t", {.format = GL_R32F, .width = size, .height = size});
    EXPECT_EQ(target.width(), size);
    draw({.name = "p", .colors = {{.texture = &target}}}, glm::vec4(static_cast<float>(size)));
    EXPECT_EQ(gl::read_floats(target, 1), std::vector<float>(static_cast<std::size_t>(size * size), size));
  }
  constexpr int one_of_each = 5;  // texture, framebuffer, vertex array, program; the program's shaders are deleted
  EXPECT_LE(live_objects(), live + one_of_each);
}

TEST_F(GlDevice, AFramebufferIsNotReusedForATextureWithADeletedOnesId) {
  for (float value = 1; value < 5; ++value) {
    const gl::Texture own("own", {.format = GL_R32F});
    draw({.name = "p", .colors = {{.texture = &own}}}, glm::vec4(value));
    EXPECT_EQ(gl::read_floats(own, 1).front(), value);
  }
}

TEST_F(GlDevice, ScratchGrowsAndTargetsAreCounted) {
  EXPECT_GE(device.scratch("s", 100).size(), 100u);
  EXPECT_GE(device.scratch("s", 300).size(), 300u);
  EXPECT_GE(device.scratch("s", 10).size(), 300u);
  device.target("shadow/a", {.format = GL_R32F, .width = 8});
  device.target("shadow/b", {.format = GL_R8, .width = 8});
  EXPECT_EQ(device.target_bytes("shadow/"), 32u + 8u);
  EXPECT_EQ(device.target_bytes(), 32u + 8u + color.bytes() + depth.bytes());
}

}  // namespace
}  // namespace penumbra
