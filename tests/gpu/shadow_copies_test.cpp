// Receivers in layers of arrays, and with samples.

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <string>
#include <vector>

#include "gpu/gl_calls.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// A texture as an engine makes it.
class Own {
 public:
  Own(GLenum target, GLenum format, int side, int layers, int samples) {
    gl::glCreateTextures(target, 1, &id);
    if (target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY) {
      gl::glTextureStorage3DMultisample(id, samples, format, side, side, layers, GL_TRUE);
    } else if (target == GL_TEXTURE_2D_MULTISAMPLE) {
      gl::glTextureStorage2DMultisample(id, samples, format, side, side, GL_TRUE);
    } else {
      gl::glTextureStorage3D(id, 1, format, side, side, layers);
    }
  }
  ~Own() { gl::glDeleteTextures(1, &id); }
  Own(const Own&) = delete;
  Own& operator=(const Own&) = delete;

  GLuint id = 0;
};

class ReceiverCopies : public TriangleTest {
 protected:
  // Ground that a camera close above it sees at every angle up to the horizon, a box, and a low sun.
  static TriangleScene grazing(int side) {
    TriangleScene scene = box_on_ground(side);
    scene.add_quad({-40, 0, 40}, {80, 0, 0}, {0, 0, -80});
    scene.view = glm::lookAt(glm::vec3(3, 0.7f, 8), glm::vec3(0, 0.6f, 0), glm::vec3(0, 1, 0));
    scene.to_light = sun_direction(205, 35);
    return scene;
  }

  // Draws the receivers to textures with samples.
  void draw_receivers(const TriangleScene& scene, const Own& depth, const Own& normals, int layer, bool array) {
    const Geometry geometry(scene);
    const gl::Program& program = renderer_->device().shaders.get(
        {.name = "test receivers", .vertex = "test/receiver.vert", .fragment = "test/receiver.frag"});
    GLuint framebuffer = 0;
    gl::glCreateFramebuffers(1, &framebuffer);
    const auto attach = [&](GLenum to, const Own& texture) {
      array ? gl::glNamedFramebufferTextureLayer(framebuffer, to, texture.id, 0, layer)
            : gl::glNamedFramebufferTexture(framebuffer, to, texture.id, 0);
    };
    attach(GL_DEPTH_ATTACHMENT, depth);
    attach(GL_COLOR_ATTACHMENT0, normals);
    ASSERT_EQ(gl::glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER), GLenum{GL_FRAMEBUFFER_COMPLETE});
    gl::glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl::glViewport(0, 0, scene.width, scene.height);
    const float sky = 0;
    gl::glDepthMask(GL_TRUE);
    gl::glClearBufferfv(GL_DEPTH, 0, &sky);
    gl::glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl::glEnable(GL_DEPTH_TEST);
    gl::glDepthFunc(GL_GEQUAL);
    gl::glUseProgram(program.id());
    program.set("world_to_clip", scene.projection * scene.view);
    geometry.draw();
    gl::glDisable(GL_DEPTH_TEST);
    gl::glDepthFunc(GL_LESS);
    gl::glUseProgram(0);
    gl::glBindVertexArray(0);
    gl::glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl::glDeleteFramebuffers(1, &framebuffer);
  }
};

TEST_F(ReceiverCopies, LayersOfArraysGiveTheSameMask) {
  const TriangleScene scene = box_on_ground(64);
  ParamSet params = renderer_->params();
  for (const char* technique : {"pcss", "slices"}) {
    params.set("technique", std::string(technique));
    const std::vector<float> plain = renderer_->render(scene, params).mask;
    const Own depth(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, 64, 3, 0);
    const Own normals(GL_TEXTURE_2D_ARRAY, GL_RG32F, 64, 2, 0);
    const Shadowed copied = renderer_->render(scene, params, [&](shadow::Inputs& in) {
      const auto to_layer = [](shadow::TextureView& view, const Own& array, int layer) {
        gl::glCopyImageSubData(view.id, GL_TEXTURE_2D, 0, 0, 0, 0, array.id, GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, 64,
                               64, 1);
        view.id = array.id;
        view.layer = layer;
      };
      to_layer(in.depth, depth, 2);
      to_layer(in.normals, normals, 1);
    });
    EXPECT_EQ(copied.mask, plain) << technique;
  }
  EXPECT_EQ(renderer_->render(scene, params).mask, renderer_->render(scene, params).mask) << "plain ones again";
}

// Surfaces without a shadow, and surfaces in the umbra, are not speckled, however oblique they are; edges of surfaces
// and of shadows may lie half a pixel elsewhere.
TEST_F(ReceiverCopies, OneSampleOfEachPixelIsEnough) {
  constexpr int side = 160;
  const TriangleScene scene = grazing(side);
  const ParamSet params = renderer_->params();
  const Shadowed plain = renderer_->render(scene, params);
  for (const bool array : {false, true}) {
    const GLenum target = array ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_MULTISAMPLE;
    const Own depth(target, GL_DEPTH_COMPONENT32F, side, 2, 4), normals(target, GL_RG32F, side, 2, 4);
    const Shadowed sampled = renderer_->render(scene, params, [&](shadow::Inputs& in) {
      draw_receivers(scene, depth, normals, 1, array);
      in.depth = {.id = depth.id, .width = side, .height = side, .layer = array ? 1 : 0};
      in.normals = {.id = normals.id, .width = side, .height = side, .layer = array ? 1 : 0};
    });
    int lit = 0, dark = 0;
    for (int y = 2; y < side - 2; ++y) {
      for (int x = 2; x < side - 2; ++x) {
        float least = 1, most = 0;
        bool sky = false;
        for (int j = -2; j <= 2; ++j) {
          for (int i = -2; i <= 2; ++i) {
            least = std::min(least, plain.visibility(x + i, y + j));
            most = std::max(most, plain.visibility(x + i, y + j));
            sky = sky || plain.sky(x + i, y + j);
          }
        }
        if (sky) continue;
        if (least == 1) {
          ++lit;
          ASSERT_EQ(sampled.visibility(x, y), 1.0f) << x << ", " << y;
        } else if (most == 0) {
          ++dark;
          ASSERT_EQ(sampled.visibility(x, y), 0.0f) << x << ", " << y;
        } else {
          ASSERT_GE(sampled.visibility(x, y), least - 0.5f);
        }
      }
    }
    EXPECT_GT(lit, 4000);
    EXPECT_GT(dark, 300);
  }
}

TEST_F(ReceiverCopies, WhatCantBeReadIsRefused) {
  const TriangleScene scene = box_on_ground(64);
  const ParamSet params = renderer_->params();
  const auto refusal = [&](const TriangleRenderer::Adjust& change) {
    return message_of([&] { renderer_->render(scene, params, change); });
  };
  const Own layers(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, 64, 3, 0);
  const Own volume(GL_TEXTURE_3D, GL_R32F, 64, 2, 0);
  for (const int layer : {-1, 3}) {
    EXPECT_NE(refusal([&](auto& in) { in.depth.id = layers.id, in.depth.layer = layer; }).find("has no layer"),
              std::string::npos);
  }
  EXPECT_NE(refusal([](auto& in) { in.depth.layer = 1; }).find("has no layer 1"), std::string::npos);
  EXPECT_NE(refusal([&](auto& in) { in.depth.id = volume.id; }).find("is not a GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY"),
            std::string::npos);
}

// As in a frame of plain textures, nothing is asked of OpenGL, and nothing is made.
TEST_F(ReceiverCopies, SteadyFramesMakeNothing) {
  const TriangleScene scene = box_on_ground(64);
  const ParamSet params = renderer_->params();
  const Own depth(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, 64, 2, 0);
  GlCalls queries(GlCalls::Kind::queries);
  std::map<std::string, int> asked;
  const auto frame = [&] {
    const auto take_layer = [&](shadow::Inputs& in) {
      gl::glCopyImageSubData(in.depth.id, GL_TEXTURE_2D, 0, 0, 0, 0, depth.id, GL_TEXTURE_2D_ARRAY, 0, 0, 0, 1, 64, 64,
                             1);
      in.depth.id = depth.id;
      in.depth.layer = 1;
      queries.reset();
    };
    renderer_->render(scene, params, take_layer, [&] { asked = queries.counts(), asked.erase("glGetError"); });
  };
  frame();
  EXPECT_FALSE(asked.empty());
  frame();
  EXPECT_EQ(asked, (std::map<std::string, int>{}));
  const std::size_t targets = renderer_->device().targets().size();
  frame();
  EXPECT_EQ(renderer_->device().targets().size(), targets);
  renderer_->render(scene, params);
  EXPECT_LT(renderer_->device().targets().size(), targets) << "copies are released when they are needed no more";
}

}  // namespace
}  // namespace penumbra::test
