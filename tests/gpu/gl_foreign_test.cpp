// Attachments that the library does not own, and those whose contents a pass does not need.
#include "gl/api.h"
#include "gl/pass.h"
#include "gl_pass.h"

namespace penumbra {
namespace {

using test::message_of;

class GlForeign : public test::GlPassTest {
 protected:
  // Creates a texture of 4 × 4 texels with two levels, as an engine would.
  GLuint make(GLenum target, GLenum format, int layers) {
    GLuint id = 0;
    gl::glCreateTextures(target, 1, &id);
    if (target == GL_TEXTURE_2D) {
      gl::glTextureStorage2D(id, 2, format, 4, 4);
    } else {
      gl::glTextureStorage3D(id, 2, format, 4, 4, layers);
    }
    return id;
  }

  // How many framebuffers have the texture attached, as colour or as depth.
  static int framebuffers_with(GLuint id) {
    int count = 0;
    for (GLuint framebuffer = 1; framebuffer < 1000; ++framebuffer) {
      if (gl::glIsFramebuffer(framebuffer) == GL_FALSE) continue;
      for (const GLenum point : {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_DEPTH_ATTACHMENT}) {
        GLint type = 0, name = 0;
        gl::glGetNamedFramebufferAttachmentParameteriv(framebuffer, point, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE,
                                                       &type);
        if (type != GL_TEXTURE) continue;
        gl::glGetNamedFramebufferAttachmentParameteriv(framebuffer, point, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME,
                                                       &name);
        if (static_cast<GLuint>(name) == id) ++count;
      }
    }
    return count;
  }
};

TEST_F(GlForeign, TheCallersDepthTextureIsTestedAgainstAtItsLevelAndLayer) {
  const GLuint id = make(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT24, 3);
  const gl::Texture engine = gl::Texture::wrap(id, gl::describe("depth", id));
  EXPECT_EQ(engine.desc().target, GLenum{GL_TEXTURE_2D_ARRAY});
  EXPECT_EQ(engine.desc().layers, 3);
  EXPECT_EQ(engine.desc().levels, 2);
  for (int layer = 0; layer < 3; ++layer) {
    const glm::vec4 stored(layer == 1 ? 0.75f : 0.25f);
    test::clear(device, {.name = "clear",
                         .depth = gl::Attachment{.texture = &engine, .level = 1, .layer = layer, .clear = stored}});
  }
  for (int layer = 0; layer < 3; ++layer) {
    draw({.name = "p",
          .colors = {{.texture = &color, .clear = glm::vec4(0)}},
          .depth = gl::Attachment{.texture = &engine, .level = 1, .layer = layer},
          .depth_test = gl::DepthTest::less_equal},
         glm::vec4(1));
    EXPECT_EQ(gl::read_floats(color, 4).front(), layer == 1 ? 1.0f : 0.0f) << layer;
  }
  EXPECT_NEAR(gl::read_floats(engine, 1, 1, 1).front(), 0.75f, 1e-6f) << "tested, not written";
  gl::glDeleteTextures(1, &id);
}

TEST_F(GlForeign, ItOutlivesItsWrapperAndNoFramebufferKeepsIt) {
  const GLuint id = make(GL_TEXTURE_2D, GL_R32F, 1);
  {
    const gl::Texture engine = gl::Texture::wrap(id, gl::describe("engine", id));
    draw({.name = "p", .colors = {{.texture = &engine}}}, glm::vec4(3));
  }
  EXPECT_TRUE(gl::glIsTexture(id));
  EXPECT_EQ(framebuffers_with(id), 0);
  gl::glDeleteTextures(1, &id);
}

TEST_F(GlForeign, APassThatThrowsWhileItBeginsKeepsNone) {
  const GLuint color_id = make(GL_TEXTURE_2D, GL_R32F, 1), depth_id = make(GL_TEXTURE_2D, GL_DEPTH_COMPONENT24, 1);
  const gl::Texture engine_color = gl::Texture::wrap(color_id, gl::describe("color", color_id));
  const gl::Texture engine_depth = gl::Texture::wrap(depth_id, gl::describe("depth", depth_id));
  const gl::PassDesc desc{
      .name = "p", .colors = {{.texture = &engine_color}}, .depth = gl::Attachment{.texture = &engine_depth}};
  {
    const gl::Pass pass(device, desc);
    EXPECT_EQ(framebuffers_with(color_id), 1);
    EXPECT_EQ(framebuffers_with(depth_id), 1);
  }
  gl::PassDesc without_stencil = desc;
  without_stencil.stencil = gl::Stencil{};
  EXPECT_EQ(message_of([&] { test::clear(device, without_stencil); }),
            "pass 'p': it tests stencil, and its depth texture has none");
  EXPECT_EQ(framebuffers_with(color_id), 0) << "refused by the pass";
  EXPECT_EQ(framebuffers_with(depth_id), 0) << "refused by the pass";
  gl::glEnable(GL_TEXTURE_2D_ARRAY);  // an error of the caller's, which the pass finds while it begins
  EXPECT_NE(message_of([&] { test::clear(device, desc); }), "");
  EXPECT_EQ(framebuffers_with(color_id), 0) << "an earlier error";
  EXPECT_EQ(framebuffers_with(depth_id), 0) << "an earlier error";
  gl::glDeleteTextures(1, &color_id);
  gl::glDeleteTextures(1, &depth_id);
}

TEST_F(GlForeign, ATextureThatReusesTheIdIsDrawnTo) {
  for (float value = 1; value < 4; ++value) {
    const GLuint id = make(GL_TEXTURE_2D, GL_R32F, 1);
    const gl::Texture engine = gl::Texture::wrap(id, gl::describe("engine", id));
    draw({.name = "p", .colors = {{.texture = &engine}}}, glm::vec4(value));
    EXPECT_EQ(gl::read_floats(engine, 1).front(), value);
    gl::glDeleteTextures(1, &id);
  }
}

TEST_F(GlForeign, TheCallersStencilIsUsed) {
  const GLuint id = make(GL_TEXTURE_2D, GL_DEPTH24_STENCIL8, 1);
  const gl::Texture engine = gl::Texture::wrap(id, gl::describe("depth", id));
  draw({.name = "p",
        .depth = gl::Attachment{.texture = &engine, .clear = glm::vec4(1)},
        .stencil = gl::Stencil{.front = {.pass = gl::StencilOp::increment}, .clear = 8}},
       glm::vec4(1));
  EXPECT_EQ(gl::read_stencil(engine).front(), 9);
  gl::glDeleteTextures(1, &id);
}

TEST_F(GlForeign, UnusableTexturesAreRefusedByName) {
  EXPECT_EQ(message_of([] { gl::describe("depth", 0); }), "texture 'depth': 0 is not the name of a texture");
  EXPECT_EQ(message_of([] { gl::describe("depth", 98765); }), "texture 'depth': 98765 is not the name of a texture");
  GLuint id = 0;
  gl::glCreateTextures(GL_TEXTURE_3D, 1, &id);
  EXPECT_NE(message_of([&] { gl::describe("depth", id); }).find("is not a GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY"),
            std::string::npos);
  gl::glDeleteTextures(1, &id);
  gl::glCreateTextures(GL_TEXTURE_2D, 1, &id);
  EXPECT_NE(message_of([&] { gl::describe("depth", id); }).find("has no level 0"), std::string::npos);
  gl::glDeleteTextures(1, &id);
  gl::glCreateTextures(GL_TEXTURE_2D, 1, &id);
  gl::glTextureStorage2D(id, 1, GL_COMPRESSED_RG_RGTC2, 4, 4);
  EXPECT_EQ(message_of([&] { gl::describe("depth", id); }), "texture 'depth': texture format 0x8dbd is not supported");
  gl::glDeleteTextures(1, &id);
}

TEST_F(GlForeign, DontCareContentsAreInvalidatedAndOthersKept) {
  static int invalidated = 0;
  static PFNGLINVALIDATENAMEDFRAMEBUFFERDATAPROC real = nullptr;
  invalidated = 0;
  real = gl::current_api->glInvalidateNamedFramebufferData;
  gl::current_api->glInvalidateNamedFramebufferData = [](GLuint framebuffer, GLsizei count, const GLenum* points) {
    invalidated += count;
    real(framebuffer, count, points);
  };
  const gl::Texture& kept = device.target("kept", {.format = GL_RGBA32F, .width = 2, .height = 2});
  test::clear(device, {.name = "clear", .colors = {{.texture = &kept, .clear = glm::vec4(7)}}});
  EXPECT_EQ(invalidated, 0);
  draw({.name = "p", .colors = {{.texture = &color, .dont_care = true}}}, glm::vec4(2));
  test::clear(device, {.name = "keep", .colors = {{.texture = &color, .dont_care = true}, {.texture = &kept}}});
  EXPECT_EQ(invalidated, 2);
  EXPECT_EQ(gl::read_floats(kept, 4).front(), 7.0f);
  const gl::Texture& both = device.target("both", {.format = GL_DEPTH24_STENCIL8, .width = 2, .height = 2});
  test::clear(device, {.name = "both",
                       .depth = gl::Attachment{.texture = &both, .dont_care = true},
                       .stencil = gl::Stencil{.dont_care = true}});
  EXPECT_EQ(invalidated, 4);
  gl::current_api->glInvalidateNamedFramebufferData = real;
}

}  // namespace
}  // namespace penumbra
