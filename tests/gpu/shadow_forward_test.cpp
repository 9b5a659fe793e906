// Shadows on surfaces that an engine draws forward, in the engine's shader, which declares names of its own.

#include <string>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// Declares names at global scope that the library's GLSL declares too.
constexpr const char* engine_before = R"(
struct Light { vec3 color; };
struct Receiver { float gloss; };
struct Visibility { bool seen; };
uniform vec4 shadow;
uniform sampler2D samples;
const float max_plane_slope = 7.0;
float bilinear(vec4 a, vec2 b) { return a.x * b.x; }
float bias_constant;
#define UNIT_least_depth_pyramid 3
#define HISTORY
)";

constexpr const char* engine_after = R"(
float read_radius(Receiver receiver, Light light) { return receiver.gloss + light.color.x; }
layout(binding = 8) uniform sampler2D engine_depth;
layout(binding = 9) uniform sampler2D engine_normal;
uniform mat4 clip_to_view;
layout(location = 0) out vec4 shaded;

vec3 decode(vec2 e) {
  vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
  return normalize(v);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 ndc = gl_FragCoord.xy / vec2(textureSize(engine_depth, 0)) * 2.0 - 1.0;
  float depth = texelFetch(engine_depth, pixel, 0).x;
  vec4 view = clip_to_view * vec4(ndc, depth, 1.0);
  vec3 normal = decode(texelFetch(engine_normal, pixel, 0).xy);
  shaded = vec4(depth == 0.0 ? 1.0 : penumbra_shadow_visibility(view.xyz / view.w, normal, vec2(pixel)));
}
)";

// The engine's pass: it calls the library's function for every pixel.
std::vector<float> drawn_forward(TriangleRenderer& renderer, const ParamSet& params, const shadow::Light& light = {}) {
  gl::Device& device = renderer.device();
  const TriangleScene scene = box_on_ground();
  device.shaders.files().put("engine.frag",
                             engine_before + renderer.shadows().forward_source(params, light) + engine_after);
  const gl::Program program({.name = "engine", .vertex = "shared/full_screen.vert", .fragment = "engine.frag"},
                            device.shaders.files());
  const gl::Texture& result = device.target("forward", {.format = GL_RGBA16F, .width = 64, .height = 64});
  const gl::TextureDesc depth{.format = GL_DEPTH_COMPONENT32F, .width = 64, .height = 64};
  const gl::TextureDesc normals{.format = GL_RG32F, .width = 64, .height = 64};
  {
    gl::Pass pass(device, {.name = "forward", .colors = {{.texture = &result}}});
    program.use();
    program.set("clip_to_view", glm::inverse(scene.projection));
    renderer.shadows().bind_forward(renderer.mask(), 0);
    device.target("test depth", depth).bind(8);
    device.target("test normals", normals).bind(9);
    gl::glDrawArrays(GL_TRIANGLES, 0, 3);
    renderer.shadows().unbind_forward();
  }
  for (GLuint unit = 0; unit < 8; ++unit) {
    GLint sampler = -1;
    gl::glGetIntegeri_v(GL_SAMPLER_BINDING, unit, &sampler);
    EXPECT_EQ(sampler, 0) << unit;
  }
  return gl::read_floats(result, 1);
}

double mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

// The engine computes positions by other operations than the library, so the result of a tap may change.
constexpr double rounding = 0.001;

using ShadowForward = GpuTest;

TEST_F(ShadowForward, EveryTechniqueServesAnEnginesShaderWithNamesOfItsOwn) {
  TriangleRenderer renderer;
  ParamSet params = renderer.params();
  params.set("sun.angle", 4.0f);
  params.set("cascades.size", 512);
  params.set("brute_force.blocker_taps", 32);
  params.set("brute_force.filter_taps", 32);
  for (const shadow::Technique& technique : renderer.shadows().registry().techniques()) {
    params.set("technique", technique.name);
    const std::vector<float> mask = renderer.render(box_on_ground(), params).visibilities();
    // A stand-in is another method.
    const double allowed = technique.stand_in.empty() ? rounding : 4 * rounding;
    EXPECT_LT(mean_difference(drawn_forward(renderer, params), mask), allowed) << technique.name;
    if (technique.name == "none") continue;
    EXPECT_GT(mean_difference(mask, std::vector<float>(mask.size(), 1)), 10 * rounding) << "there is a shadow";
  }
}

TEST_F(ShadowForward, EveryGlobalNameOfTheSourceBeginsWithPenumbra) {
  TriangleRenderer renderer;
  const std::string source = renderer.shadows().forward_source(renderer.params());
  for (const char* name : {"struct Light ", "struct Receiver ", " shade(", " pcss_filter_taps", " bias_constant",
                           " ShadowBlock ", "uniform Params", "#version", "#line", "#include"}) {
    EXPECT_EQ(source.find(name), std::string::npos) << name;
  }
  for (const char* name : {"struct penumbra_Light ", "penumbra_shadow_visibility(vec3 view_position"}) {
    EXPECT_NE(source.find(name), std::string::npos) << name;
  }
}

TEST_F(ShadowForward, ALightsOverridesCount) {
  TriangleRenderer renderer;
  const ParamSet params = renderer.params();
  std::vector<shadow::Light> lights(1);
  lights[0].source = shadow::Sun{box_on_ground().to_light};
  lights[0].overrides = {"technique=hard"};
  const std::vector<float> mask =
      renderer.render(box_on_ground(), params, [&](shadow::Inputs& in) { in.lights = lights; }).visibilities();
  EXPECT_LT(mean_difference(drawn_forward(renderer, params, lights[0]), mask), rounding);
}

// A technique that consists only of passes: another one computes the shadows of blended surfaces.
shadow::Technique painted() {
  return {.name = "painted",
          .summary = "Half light everywhere.",
          .source = "made up",
          .glsl = "",
          .needs = {},
          .params = {{"painted.level", 0.5f, 0, 1, "", "Visibility.", ParamBinding::uniform}},
          .resolve =
              [](const shadow::PassContext& work) {
                clear(work.device(), {.name = "paint",
                                      .colors = {{.texture = &work.mask(),
                                                  .layer = work.frame().layer,
                                                  .clear = glm::vec4(work.params().get_float("painted.level"))}}});
              },
          .stand_in = "pcss"};
}

shadow::Registry with_painted() {
  const auto built_in = shadow::built_in_registry().techniques();
  std::vector<shadow::Technique> techniques(built_in.rbegin(), built_in.rend());
  techniques.insert(techniques.begin() + 2, painted());
  return shadow::Registry({.techniques = std::move(techniques), .default_technique = "pcss"});
}

TEST_F(ShadowForward, AStandInServesForwardSurfaces) {
  TriangleRenderer renderer(with_painted());
  ParamSet params = renderer.params();
  params.set("sun.angle", 4.0f);
  const std::vector<float> soft = renderer.render(box_on_ground(), params).visibilities();
  params.set("technique", std::string("painted"));
  const Shadowed shadowed = renderer.render(box_on_ground(), params);
  EXPECT_EQ(shadowed.visibilities(), std::vector<float>(soft.size(), 0.5f));
  EXPECT_LT(mean_difference(drawn_forward(renderer, params), soft), rounding);
}

// The maps take most of the memory, and often most of the time.
TEST_F(ShadowForward, WhereNoForwardSurfacesFollowAStandInHasNoMaps) {
  TriangleRenderer renderer(with_painted());
  ParamSet params = renderer.params();
  params.set("technique", std::string("painted"));
  const auto draw = [&](bool binds_forward) {
    renderer.render(box_on_ground(), params, [&](shadow::Inputs& in) { in.binds_forward = binds_forward; });
    return renderer.device().target_bytes("shadow ");
  };
  const std::size_t without = draw(false), with = draw(true);
  EXPECT_LT(100 * without, with);
  EXPECT_EQ(draw(false), without) << "the maps are freed";
  EXPECT_THROW(renderer.shadows().bind_forward(renderer.mask(), 0), Error);
  params.set("technique", std::string("pcss"));
  draw(false);
  EXPECT_NO_THROW(renderer.shadows().bind_forward(renderer.mask(), 0)) << "it is its own";
  renderer.shadows().unbind_forward();
}

TEST_F(ShadowForward, RegistriesOnOneDeviceDoNotDisturbEachOther) {
  TriangleRenderer renderer;
  ParamSet params = renderer.params();
  params.set("technique", std::string("pcf"));
  params.set("pcf.radius", 0.3f);
  const std::vector<float> alone = renderer.render(box_on_ground(), params).mask;
  const shadow::SoftShadows other(renderer.device(), with_painted());
  ParamSet more = ParamSet(other.registry().params());
  // Another program of the same technique is compiled now, while the files of the other registry exist.
  params.set("pcf.filter_taps", 17);
  const std::vector<float> beside = renderer.render(box_on_ground(), params).mask;
  TriangleRenderer fresh;
  EXPECT_EQ(beside, fresh.render(box_on_ground(), params).mask);
  EXPECT_NE(beside, alone);
  EXPECT_NE(other.forward_source(more), renderer.shadows().forward_source(params));
}

}  // namespace
}  // namespace penumbra::test
