// A technique as an application would add it: a product of a recipe, visibility() that reads
// it, a `resolve` of several passes, and a history.

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gl_calls.h"
#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "session/techniques.h"

namespace penumbra::test {
namespace {

constexpr const char* technique_text = R"(
#include "shadow/light.glsl"

layout(binding = UNIT_level) uniform sampler2DArray levels;

float read_radius(Receiver receiver, Light light) { return 0.0; }

Visibility visibility(Receiver receiver, Light light) {
  return Visibility(counted_scale * texelFetch(levels, ivec3(0), 0).x, 0.0, 0.0, false, false);
}
)";

// The product: one texel that holds the compiled constant.
constexpr const char* fill_text = R"(
layout(local_size_x = 1) in;
layout(binding = 0, r32f) uniform writeonly restrict image2DArray level;
void main() { imageStore(level, ivec3(0), vec4(float(level_eighths) / 8.0)); }
)";

// First pass: adds to the result of visibility() the number of frames in which this pixel has been drawn.
constexpr const char* count_text = R"(
#include "shadow/drivers/gbuffer.glsl"
layout(binding = 8) uniform sampler2DArray raw;
layout(binding = 9) uniform sampler2D last;
uniform int has_last;
layout(location = 0) out vec4 now;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float count = has_last != 0 ? texelFetch(last, pixel, 0).y : 0.0;
  now = vec4(texelFetch(raw, ivec3(pixel, 0), 0).x, is_sky(pixel) ? 0.0 : count + 1.0, 0.0, 0.0);
}
)";

// Second pass: into the mask.
constexpr const char* show_text = R"(
layout(binding = 8) uniform sampler2D now;
layout(location = 0) out vec4 mask;
void main() { mask = texelFetch(now, ivec2(gl_FragCoord.xy), 0); }
)";

shadow::Recipe level() {
  return {
      .name = "level",
      .summary = "A texel that holds a compiled constant.",
      .source = "made up",
      .needs = {},
      .params = {{"level.eighths", 4, 0, 8, "", "Eighths.", ParamBinding::compiled}},
      .build = [](const shadow::PassContext& context) -> const gl::Texture& {
        const gl::Texture& level = context.target("level", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F});
        gl::Pass pass(context.device(), {.name = "fill"});
        context.use(pass, "fill");
        level.bind_image(0, GL_WRITE_ONLY);
        pass.dispatch(1, 1);
        return level;
      },
      .programs =
          [](const ParamSet&) { return std::vector<gl::ProgramDesc>{{.name = "fill", .compute = "test/fill.comp"}}; }};
}

void resolve(const shadow::PassContext& context) {
  const int width = context.mask().width();
  const int height = context.mask().height();
  const gl::Texture& raw =
      context.target("raw", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA16F, .width = width, .height = height});
  context.evaluate(raw, 0);
  const shadow::History counts = context.history("counts", {.format = GL_RGBA16F, .width = width, .height = height});
  {
    gl::Pass pass(context.device(), {.name = "count", .colors = {{.texture = &counts.now}}});
    context.use(pass, "count").set("has_last", counts.valid ? 1 : 0);
    for (const GLuint unit : {8, 9}) context.device().sampler({}).bind(unit);
    raw.bind(8);
    counts.last.bind(9);
    pass.draw_full_screen();
  }
  gl::Pass pass(context.device(),
                {.name = "show", .colors = {{.texture = &context.mask(), .layer = context.frame().layer}}});
  context.use(pass, "show");
  context.device().sampler({}).bind(8);
  counts.now.bind(8);
  pass.draw_full_screen();
}

std::vector<gl::ProgramDesc> programs(const ParamSet& params) {
  std::vector<gl::ProgramDesc> all{
      {.name = "count", .vertex = "shared/full_screen.vert", .fragment = "test/count.frag"}};
  if (params.get_bool("counted.shown")) {
    all.push_back({.name = "show", .vertex = "shared/full_screen.vert", .fragment = "test/show.frag"});
  }
  return all;
}

shadow::Technique counted() {
  return {.name = "counted",
          .summary = "Counts frames.",
          .source = "made up",
          .glsl = "test/counted.glsl",
          .needs = {"level"},
          .params = {{"counted.scale", 1.0f, 0, 1, "", "Factor.", ParamBinding::uniform},
                     {"counted.form", 0, 0, 9, "", "Another program each.", ParamBinding::compiled},
                     {"counted.shown", true, 0, 1, "", "Whether there is a last pass.", ParamBinding::compiled}},
          .resolve = resolve,
          .programs = programs};
}

// A technique without visibility(): blended surfaces use that of the other technique.
shadow::Technique cleared() {
  return {.name = "cleared",
          .summary = "One value.",
          .source = "made up",
          .glsl = {},
          .needs = {},
          .params = {{"cleared.value", 0.5f, 0, 1, "", "Visibility.", ParamBinding::host}},
          .resolve =
              [](const shadow::PassContext& context) {
                const glm::vec4 value(context.params().get_float("cleared.value"), 0, 0, 0);
                const gl::Attachment layer{.texture = &context.mask(), .layer = context.frame().layer, .clear = value};
                gl::Pass pass(context.device(), {.name = "clear", .colors = {layer}});
                if (value.x == 0) context.draw_caster_geometry(pass, "volumes", glm::mat4(1));
              },
          .resolve_reads_motion = false,
          .stand_in = "counted"};
}

class ShadowTechnique : public GpuTest {
 protected:
  ShadowTechnique()
      : renderer(shadow::Registry({.techniques = {counted(), cleared()}, .recipes = {level()}})),
        params(renderer.params()) {
    gl::ShaderFiles& files = renderer.device().shaders.files();
    files.put("test/counted.glsl", technique_text);
    files.put("test/fill.comp", fill_text);
    files.put("test/count.frag", count_text);
    files.put("test/show.frag", show_text);
    scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    scene.view = glm::lookAt(glm::vec3(0, 5, 0.1f), glm::vec3(0), glm::vec3(0, 1, 0));
    scene.projection = perspective(0.5f, 1, 0.1f);
    scene.width = scene.height = 16;
    lights[0].source = shadow::Sun{.to_light = {0, 1, 0}};
  }

  // Draws the next frame of a view. Returns visibility and number of frames at the middle of each light's layer.
  std::vector<glm::vec2> frame(const TriangleRenderer::Adjust& adjust = {}) {
    renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.lights = lights;
      inputs.view.last_view = scene.view;
      inputs.view.last_projection = scene.projection;
      if (adjust) adjust(inputs);
    });
    std::vector<glm::vec2> middles;
    for (int layer = 0; layer < static_cast<int>(lights.size()); ++layer) {
      const std::vector<float> texels = gl::read_floats(*renderer.mask().texture, 2, 0, layer);
      const size_t middle = 2 * static_cast<size_t>(8 * scene.width + 8);
      middles.emplace_back(texels[middle], texels[middle + 1]);
    }
    return middles;
  }
  float count(const TriangleRenderer::Adjust& adjust = {}) { return frame(adjust)[0].y; }

  TriangleScene scene;
  TriangleRenderer renderer;
  ParamSet params;
  std::vector<shadow::Light> lights = std::vector<shadow::Light>(1);
};

TEST_F(ShadowTechnique, ProductReachesVisibilityUnderBothDriversAndThePassesFollow) {
  for (const std::string driver : {"fragment", "compute"}) {
    params.set("driver", driver);
    params.set("counted.scale", 0.5f);
    EXPECT_EQ(frame()[0], glm::vec2(0.25f, 1)) << driver;
    params.set("level.eighths", 8);
    EXPECT_EQ(frame()[0], glm::vec2(0.5f, 1)) << driver << ": a compiled constant of the recipe's own program";
    params.reset("level.eighths");
  }
}

TEST_F(ShadowTechnique, HistoryGoesOnWhileNothingBreaksIt) {
  for (int i = 1; i < 5; ++i) EXPECT_EQ(count(), static_cast<float>(i));
}

TEST_F(ShadowTechnique, MotionIsReadIfOneLightsParametersAskForIt) {
  params.set("technique", "cleared");
  lights.push_back({.id = 1, .source = lights[0].source});
  EXPECT_FALSE(renderer.shadows().reads_motion(params, lights));
  lights[1].overrides = {"technique=counted"};
  EXPECT_TRUE(renderer.shadows().reads_motion(params, lights));
  std::swap(lights[0].overrides, lights[1].overrides);
  EXPECT_TRUE(renderer.shadows().reads_motion(params, lights));
  lights[0].overrides.clear();
  params.set("technique", "counted");
  EXPECT_TRUE(renderer.shadows().reads_motion(params, lights));
}

TEST_F(ShadowTechnique, NoneOfOursReadsMotionWithoutAHistory) {
  shadow::SoftShadows shadows(renderer.device(), session::all_techniques());
  ParamSet ours(shadows.registry().params());
  ours.set("denoiser", "none");
  for (const shadow::Technique& technique : shadows.registry().techniques()) {
    ours.set("technique", technique.name);
    EXPECT_FALSE(shadows.reads_motion(ours, lights)) << technique.name;
  }
}

TEST_F(ShadowTechnique, BlendedSurfacesGetTheProductsOfTheStandIn) {
  params.set("technique", "cleared");
  params.set("level.eighths", 6);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(frame()[0].x, 0.5f);
    renderer.shadows().bind_forward(renderer.mask(), 0);
    GLint bound = 0;
    gl::glGetIntegeri_v(GL_TEXTURE_BINDING_2D_ARRAY, shadow::first_product_unit, &bound);
    ASSERT_NE(bound, 0);
    float level = 0;
    gl::glGetTextureImage(static_cast<GLuint>(bound), 0, GL_RED, GL_FLOAT, sizeof(level), &level);
    EXPECT_EQ(level, 0.75f);
    renderer.shadows().unbind_forward();
  }
}

TEST_F(ShadowTechnique, CastersThatNobodyDrawsAreAnErrorThatNamesTheTechnique) {
  const gl::Texture maps("maps", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 16, .height = 16});
  const shadow::Cascades cascades{.size = 16, .items = std::vector<shadow::Cascade>(1)};
  lights[0].maps = shadow::FinishedMaps{.depth = {maps.id(), 16, 16}, .projection = cascades};
  params.set("technique", "cleared");
  params.set("cleared.value", 0.0f);
  try {
    frame([](shadow::Inputs& inputs) { inputs.draw = {}; });
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "soft shadows: light 0: technique 'cleared' draws casters, and there is no caster callback");
  }
}

TEST_F(ShadowTechnique, HistoryOutlivesWhatIsNoneOfItsBusiness) {
  count();
  params.set("cleared.value", 0.75f);
  EXPECT_EQ(count(), 2) << "another technique's parameter";
  const size_t bytes = renderer.device().target_bytes();
  params.set("technique", "cleared");
  frame();
  EXPECT_LT(renderer.device().target_bytes(), bytes) << "what no frame fills is given back";
  params.set("technique", "counted");
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(renderer.device().target_bytes(), bytes) << "the stand-in's too";
}

TEST_F(ShadowTechnique, HistoryBeginsAgainWhenItIsVoid) {
  const auto expect_reset = [&](const char* what, const TriangleRenderer::Adjust& adjust = {}) {
    EXPECT_EQ(count(adjust), 1) << what;
    EXPECT_EQ(count(adjust), adjust ? 1 : 2) << what;
  };
  count();
  EXPECT_EQ(count(), 2);
  expect_reset("a cut", [](shadow::Inputs& inputs) { inputs.view.cut = true; });
  expect_reset("a last frame that is not the last",
               [](shadow::Inputs& inputs) { inputs.view.last_view[3][0] += 0.1f; });
  count();
  lights[0].source = shadow::Sun{glm::normalize(glm::vec3(0.1f, 1, 0))};
  expect_reset("another direction of the light");
  params.set("counted.scale", 0.75f);
  expect_reset("another parameter");
  lights[0].overrides = {"counted.scale=0.25"};
  expect_reset("another parameter of the light's own");
  scene.width = scene.height = 20;
  expect_reset("another size");
  lights[0].id = 5;
  expect_reset("another light");
  EXPECT_EQ(count([](shadow::Inputs& inputs) { inputs.viewport = {0, 0, 18, 18}; }), 1) << "another viewport";
  EXPECT_EQ(count(), 1) << "and back";
}

TEST_F(ShadowTechnique, ALightThatAFrameLeavesOutBeginsAgain) {
  lights.resize(2);
  lights[1].id = 1;
  frame();
  EXPECT_EQ(frame(), (std::vector<glm::vec2>{{0.5f, 2}, {0.5f, 2}}));
  const shadow::Light second = lights[1];
  const size_t bytes = renderer.device().target_bytes();
  lights.pop_back();
  EXPECT_EQ(count(), 3);
  EXPECT_LT(renderer.device().target_bytes(), bytes);
  lights.insert(lights.begin(), second);
  EXPECT_EQ(frame(), (std::vector<glm::vec2>{{0.5f, 1}, {0.5f, 4}})) << "lights go by id, not by place";
}

TEST_F(ShadowTechnique, ViewsHaveMasksAndHistoriesOfTheirOwn) {
  const auto second = [](shadow::Inputs& inputs) { inputs.view.id = 1; };
  count();
  count();
  const shadow::Mask first = renderer.mask();
  scene.width = scene.height = 24;
  EXPECT_EQ(count(second), 1);
  EXPECT_NE(renderer.mask().texture, first.texture);
  EXPECT_EQ(gl::read_floats(*first.texture, 2)[1], 2) << "the other view's mask stands";
  EXPECT_EQ(count(second), 2);
  scene.width = scene.height = 16;
  EXPECT_EQ(count(), 3);
  const size_t bytes = renderer.device().target_bytes();
  renderer.shadows().forget_view(1);
  EXPECT_LT(renderer.device().target_bytes(), bytes);
  EXPECT_EQ(count(), 4);
  EXPECT_EQ(count(second), 1);
}

TEST_F(ShadowTechnique, AFrameThatThrowsLeavesNoHistory) {
  count();
  EXPECT_EQ(count(), 2);
  gl::ShaderFiles& files = renderer.device().shaders.files();
  files.put("test/show.frag", "nonsense");
  params.set("counted.form", 5);
  EXPECT_THROW(frame(), Error);
  files.put("test/show.frag", show_text);
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(count(), 2);
}

TEST_F(ShadowTechnique, EveryProgramIsListedForTheChecks) {
  int own = 0;
  for (const gl::ProgramDesc& program : renderer.shadows().all_programs(params)) {
    EXPECT_NO_THROW(gl::Program(program, renderer.device().shaders.files())) << program.name;
    if (program.name == "counted: show" || program.name == "counted: count" || program.name == "level: fill") ++own;
  }
  // The recipe's programs are listed once; the technique's with the switch on and off, points rotated and shifted, for
  // suns and for lamps.
  EXPECT_EQ(own, 1 + 2 * 2 * (1 + 2));
}

TEST_F(ShadowTechnique, AProgramThatIsNotListedIsABug) {
  params.set("counted.shown", false);
  EXPECT_THROW(frame(), std::logic_error);
}

TEST_F(ShadowTechnique, MakesNoObjectsAfterTheFirstFrames) {
  // The test's own geometry creates a buffer and a vertex array in each frame.
  for (int i = 0; i < 3; ++i) count();
  const GlCalls creations(GlCalls::Kind::creations);
  for (int i = 0; i < 3; ++i) count();
  EXPECT_EQ(creations.counts(), (std::map<std::string, int>{{"glCreateBuffers", 3}, {"glCreateVertexArrays", 3}}));
}

}  // namespace
}  // namespace penumbra::test
