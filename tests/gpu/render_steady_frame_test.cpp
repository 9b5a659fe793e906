// A frame in which nothing changed creates no OpenGL object and makes no OpenGL query.
#include <memory>
#include <utility>

#include "gl_calls.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

using Counts = std::map<std::string, int>;

// A renderer on a context without debugging, as applications use: a debug context queries errors after every step.
class RenderSteadyFrame : public GpuTest {
 protected:
  RenderSteadyFrame() : context(gl::make_context(backend_name(), {.debug = false})) {
    add_node(scene, square(), glm::mat4(1));
    add_node(scene, square(), glm::scale(glm::translate(glm::mat4(1), {0, 0, 1}), glm::vec3(0.25f)));
    scene.materials = {{.name = "glass", .alpha_mode = scene::AlphaMode::blend}};
    scene::Primitive pane = square();
    pane.material = 0;
    add_node(scene, pane, glm::scale(glm::translate(glm::mat4(1), {0.5f, 0, 1.5f}), glm::vec3(0.25f)));
    device = std::make_unique<gl::Device>(gl::ShaderFiles(), gl::Timers::Mode::off);
    renderer = std::make_unique<render::Renderer>(*device);
    params = ParamSet(render::Renderer::params(renderer->registry()));
    params.set("cascades.size", 64);
    params.set("sun.angle", 4.0f);
    inputs.width = inputs.height = 16;
    inputs.camera = inputs.last_camera = render::look_at({0, 0, 4}, {0, 0, 0}, 1.0f, 0.01f);
  }
  void TearDown() override {
    gpu_scene.reset();
    renderer.reset();
    device.reset();
    context.reset();
  }

  void draw() {
    if (!gpu_scene) gpu_scene.emplace(*device, scene);
    renderer->draw(*gpu_scene, inputs, params);
  }

  // The calls of a kind that a frame makes once everything has been allocated.
  Counts steady(GlCalls::Kind kind) {
    for (int i = 0; i < 3; ++i) draw();
    const GlCalls calls(kind);
    draw();
    return calls.counts();
  }

  void expect_steady() {
    EXPECT_EQ(steady(GlCalls::Kind::creations), Counts());
    EXPECT_EQ(steady(GlCalls::Kind::queries), Counts());
  }

  std::unique_ptr<gl::Context> context;
  scene::Scene scene;
  std::unique_ptr<gl::Device> device;
  std::unique_ptr<render::Renderer> renderer;
  ParamSet params;
  render::FrameInputs inputs;
  std::optional<scene::GpuScene> gpu_scene;
};

TEST_F(RenderSteadyFrame, AFrameOfAnotherSizeIsSeenToMakeObjects) {
  draw();
  gpu_scene.reset();
  inputs.width = 20;
  const GlCalls creations(GlCalls::Kind::creations);
  draw();
  EXPECT_FALSE(creations.counts().empty()) << "the counter counts";
}

TEST_F(RenderSteadyFrame, MakesNothingAndAsksNothingUnderAnyTechnique) {
  for (const std::string& name : renderer->registry().names()) {
    for (const bool keep : {true, false}) {
      SCOPED_TRACE(name + (keep ? "" : ", maps drawn anew"));
      renderer->registry().select(params, name);
      params.set("maps.keep", keep);
      expect_steady();
    }
  }
}

// A driver may have to wait for the GPU before it changes a buffer that the last frame reads.
TEST_F(RenderSteadyFrame, WritesNoSamplesWhereFramesTakeTurnsWithSets) {
  constexpr int sets = 16;
  renderer->registry().select(params, "thesis");
  for (int i = 0; i < sets; ++i) draw();
  const Counts with_sets = steady(GlCalls::Kind::writes);
  params.set("sampling.filter_sequence", "shift");
  EXPECT_EQ(with_sets, steady(GlCalls::Kind::writes));
  EXPECT_FALSE(with_sets.empty()) << "the uniforms of the frame";
}

TEST_F(RenderSteadyFrame, MakesNothingAndAsksNothingWithAMaskOfFewerPixels) {
  for (const char* name : {"pcss", "slices_denoised", "thesis"}) {
    renderer->registry().select(params, name);
    params.set("mask.scale", 2);
    expect_steady();
  }
}

TEST_F(RenderSteadyFrame, MakesNothingAndAsksNothingForSeveralSamples) {
  inputs.samples = 3;
  expect_steady();
}

TEST_F(RenderSteadyFrame, GeneratesTheShaderOfBlendedSurfacesOnce) {
  draw();
  gl::ShaderFiles& files = device->shaders.files();
  const shadow::SoftShadows same(*device);
  const std::string name = "generated/blended/" + same.forward_program(params).include;
  ASSERT_TRUE(files.has_generated(name)) << name;
  files.put(name, "not compiled again");
  draw();
  EXPECT_EQ(files.read(name), "not compiled again");
}

// A field of 40 × 40 small squares, which is culled in parts.
scene::Primitive field() {
  scene::Primitive field;
  for (int i = 0; i < 1600; ++i) {
    const glm::vec3 at(i % 40 - 20, i / 40 - 20, 0);
    const auto first = static_cast<std::uint32_t>(field.positions.size());
    for (const glm::vec3& corner : {glm::vec3(0), {0.5f, 0, 0}, {0.5f, 0.5f, 0}, {0, 0.5f, 0}}) {
      field.positions.push_back(at + corner);
      field.normals.emplace_back(0, 0, 1);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) field.indices.push_back(first + corner);
  }
  return field;
}

TEST_F(RenderSteadyFrame, MakesNothingWhileTheCameraShowsMoreAndMore) {
  scene = {};
  add_node(scene, field(), glm::mat4(1));
  for (float distance = 0.5f; distance < 40; distance *= 1.5f) {
    inputs.camera = inputs.last_camera = render::look_at({0, 0, distance}, {0, 0, 0}, 1.0f, 0.01f);
    const GlCalls creations(GlCalls::Kind::creations);
    draw();
    if (distance > 0.5f) {
      EXPECT_EQ(creations.counts(), Counts()) << distance;
    }
  }
}

TEST_F(RenderSteadyFrame, MakesNothingWithHistoryWhileACasterMoves) {
  scene.nodes[1].matrix.reset();
  scene.nodes[1].transform = {.translation = {0, 0, 1}, .scale = glm::vec3(0.25f)};
  scene.animations.push_back({.name = "slide",
                              .channels = {{.node = 1, .times = {0, 100}, .values = {0, 0, 1, 0.5f, 0, 1}}},
                              .duration = 100});
  params.set("history.reuse", true);
  for (const std::string map : {"average", "maximum"}) {
    for (const std::string present : {"own_pass", "shadow_pass"}) {
      SCOPED_TRACE(fmt::format("{} {}", map, present));
      params.set("movement.map", map);
      params.set("movement.present", present);
      for (int i = 0; i < 4; ++i) {
        inputs.last_time = std::exchange(inputs.time, inputs.time + 0.25);
        draw();
      }
      inputs.last_time = std::exchange(inputs.time, inputs.time + 0.25);
      const GlCalls creations(GlCalls::Kind::creations);
      draw();
      EXPECT_EQ(creations.counts(), Counts());
    }
  }
}

}  // namespace
}  // namespace penumbra::test
