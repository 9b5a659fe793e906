// What an engine may have begun when it calls the library: each is right, or one clear error that leaves it as it was.
#include <gtest/gtest.h>

#include <array>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

class ShadowContext : public TriangleTest {
 protected:
  // The mask of a view, whose first frame it is if the id is new. `begin` is called just before the library, `end`
  // after.
  std::vector<float> mask(
      int view, const std::function<void()>& begin = [] {}, const std::function<void()>& end = [] {}) {
    ParamSet params = renderer_->params();
    params.set("cascades.size", 128);
    return renderer_
        ->render(
            box_on_ground(32), params,
            [&](shadow::Inputs& inputs) {
              inputs.view.id = view;
              begin();
            },
            end)
        .mask;
  }
};

// A query that no sample passes: draws that depend on it are left out.
class NoSamples {
 public:
  NoSamples() {
    gl::glCreateQueries(GL_SAMPLES_PASSED, 1, &id_);
    gl::glBeginQuery(GL_SAMPLES_PASSED, id_);
    gl::glEndQuery(GL_SAMPLES_PASSED);
  }
  ~NoSamples() { gl::glDeleteQueries(1, &id_); }
  NoSamples(const NoSamples&) = delete;
  NoSamples& operator=(const NoSamples&) = delete;
  void begin(GLenum mode = GL_QUERY_WAIT) const { gl::glBeginConditionalRender(id_, mode); }

 private:
  GLuint id_ = 0;
};

TEST_F(ShadowContext, ConditionalRenderingIsOneClearError) {
  const NoSamples query;
  const std::vector<float> expected = mask(0);
  EXPECT_EQ(message_of([&] { mask(1, [&] { query.begin(); }); }),
            "soft shadows: conditional rendering is active; end it before");
  gl::glEndConditionalRender();  // it is still the engine's: no error
  EXPECT_EQ(gl::glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(mask(1), expected);
  query.begin();
  EXPECT_EQ(message_of([&] { renderer_->shadows().warm_up({}, renderer_->params()); }),
            "soft shadows: conditional rendering is active; end it before");
  gl::glEndConditionalRender();
}

// Views whose frames follow each other without motion, so that they keep what the last frame drew.
class Follows {
 public:
  explicit Follows(TriangleRenderer& renderer) : renderer_(renderer) {
    renderer.shadows().registry().select(params_, "slices_denoised");
    params_.set("cascades.size", 128);
  }
  std::vector<float> mask(
      int view, float azimuth, const std::function<void()>& begin = [] {}, const std::function<void()>& end = [] {}) {
    TriangleScene scene = box_on_ground(32);
    scene.to_light = sun_direction(azimuth, 40);
    return renderer_
        .render(
            scene, params_,
            [&](shadow::Inputs& inputs) {
              inputs.view.id = view;
              inputs.view.last_view = inputs.view.view;
              inputs.view.last_projection = inputs.view.projection;
              begin();
            },
            end)
        .mask;
  }
  // The masks of a frame under another sun than that of the last one, in which `begin` has draws left out, and
  // of the frames after it: the second one is an error, and the next one right.
  void expect_error_afterwards(const std::function<void()>& begin, const std::function<void()>& end) {
    const std::vector<float> expected = mask(0, 200);
    mask(1, 60);
    EXPECT_NE(mask(1, 200, begin, end), expected);
    mask(1, 200);
    gl::glFinish();
    EXPECT_EQ(
        message_of([&] { mask(1, 200); }),
        "soft shadows: OpenGL left out what an earlier frame drew: conditional rendering or transform feedback was "
        "active, or the device's context was not current");
    EXPECT_EQ(mask(1, 200), expected);
    EXPECT_EQ(mask(1, 200), expected) << "said once";
    EXPECT_EQ(mask(0, 200), expected) << "another view";
  }

 private:
  TriangleRenderer& renderer_;
  ParamSet params_ = renderer_.params();
};

TEST_F(ShadowContext, ConditionalRenderingInALaterFrameIsAnErrorSoonAfter) {
  const NoSamples query;
  Follows(*renderer_).expect_error_afterwards([&] { query.begin(); }, [] { gl::glEndConditionalRender(); });
}

TEST_F(ShadowContext, ConditionalRenderingThatGoesOnIsNamed) {
  const NoSamples query;
  const std::vector<float> expected = mask(0);
  mask(0, [&] { query.begin(); });
  mask(0);
  EXPECT_EQ(message_of([&] { mask(0); }), "soft shadows: conditional rendering is active; end it before");
  gl::glEndConditionalRender();
  EXPECT_EQ(mask(0), expected);
}

TEST_F(ShadowContext, ConditionalRenderingThatLeavesNothingOutIsNoError) {
  const NoSamples query;
  const std::vector<float> expected = mask(0);
  for (int frame = 0; frame < 3; ++frame) {
    const auto begin = [&] { query.begin(GL_QUERY_WAIT_INVERTED); };
    EXPECT_EQ(mask(0, begin, [] { gl::glEndConditionalRender(); }), expected);
  }
  EXPECT_EQ(mask(0), expected);
}

// A program whose positions are written to a buffer while feedback is active.
class Feedback {
 public:
  Feedback() : program_(gl::glCreateProgram()) {
    const GLuint shader = gl::glCreateShader(GL_VERTEX_SHADER);
    const char* text = "#version 450 core\nvoid main() { gl_Position = vec4(gl_VertexID, 2, 3, 4); }";
    gl::glShaderSource(shader, 1, &text, nullptr);
    gl::glCompileShader(shader);
    gl::glAttachShader(program_, shader);
    gl::glDeleteShader(shader);
    const char* written = "gl_Position";
    gl::glTransformFeedbackVaryings(program_, 1, &written, GL_INTERLEAVED_ATTRIBS);
    gl::glLinkProgram(program_);
    gl::glCreateVertexArrays(1, &vertices_);
    gl::glCreateFramebuffers(1, &framebuffer_);
    gl::glNamedFramebufferParameteri(framebuffer_, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    gl::glNamedFramebufferParameteri(framebuffer_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
  }
  ~Feedback() {
    gl::glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    gl::glDeleteFramebuffers(1, &framebuffer_);
    gl::glDeleteVertexArrays(1, &vertices_);
    gl::glDeleteProgram(program_);
  }
  Feedback(const Feedback&) = delete;
  Feedback& operator=(const Feedback&) = delete;

  void use() const {
    gl::glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl::glUseProgram(program_);
    gl::glBindVertexArray(vertices_);
  }
  void begin() const {
    use();
    gl::glEnable(GL_RASTERIZER_DISCARD);
    gl::glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer_.id());
    gl::glBeginTransformFeedback(GL_POINTS);
    gl::glDrawArrays(GL_POINTS, 0, 1);
  }
  static void end() {
    gl::glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::glEndTransformFeedback();
    gl::glUseProgram(0);
    gl::glBindVertexArray(0);
    gl::glDisable(GL_RASTERIZER_DISCARD);
  }
  std::array<float, 8> written() const {
    std::array<float, 8> values{};
    gl::glGetNamedBufferSubData(buffer_.id(), 0, sizeof values, values.data());
    return values;
  }

 private:
  GLuint program_ = 0, vertices_ = 0, framebuffer_ = 0;
  gl::Buffer buffer_{"feedback", 256};
};

TEST_F(ShadowContext, ActiveTransformFeedbackIsOneClearError) {
  const Feedback feedback;
  const std::vector<float> expected = mask(0);
  EXPECT_EQ(message_of([&] { mask(1, [&] { feedback.begin(); }); }),
            "soft shadows: transform feedback is active; end or pause it before");
  Feedback::end();
  EXPECT_EQ(mask(1), expected);
}

// In a context without debugging, as applications use: a debug context tells of the first call that fails.
TEST(ShadowContextInUse, ActiveTransformFeedbackInALaterFrameIsAnErrorSoonAfter) {
  const auto context = gl::make_context(backend_name(), {.debug = false});
  TriangleRenderer renderer;
  const Feedback feedback;
  Follows(renderer).expect_error_afterwards([&] { feedback.begin(); },
                                            [] {
                                              while (gl::glGetError() != GL_NO_ERROR) continue;
                                              Feedback::end();
                                            });
  EXPECT_EQ(gl::glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(ShadowContext, PausedTransformFeedbackGoesOnAfterwards) {
  const Feedback feedback;
  const std::vector<float> expected = mask(0);
  const std::vector<float> found = mask(
      1,
      [&] {
        feedback.begin();
        gl::glPauseTransformFeedback();
      },
      [&] {
        feedback.use();
        gl::glEnable(GL_RASTERIZER_DISCARD);
        gl::glResumeTransformFeedback();
        gl::glDrawArrays(GL_POINTS, 0, 1);
        Feedback::end();
      });
  EXPECT_EQ(found, expected);
  EXPECT_EQ(feedback.written(), (std::array<float, 8>{0, 2, 3, 4, 0, 2, 3, 4}));
}

}  // namespace
}  // namespace penumbra::test
