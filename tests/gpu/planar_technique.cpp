#include "gpu/planar_technique.h"

#include <gtest/gtest.h>

#include "shadow/denoise_context.h"

namespace penumbra::test {
namespace {

PlanarRecord recorded;

constexpr const char* technique_text = R"(
#include "shadow/light.glsl"
float read_radius(Receiver receiver, Light light) { return 0.0; }
Visibility visibility(Receiver receiver, Light light) { return fully_lit(); }
)";

// Projects triangles onto the ground along the light; triangles that lie on the ground cast nothing on it.
constexpr const char* ground_text = R"(
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(std140, binding = 4) uniform Projection { mat4 plane_to_clip; vec4 to_light; };
void main() {
  vec3 heights = vec3(gl_in[0].gl_Position.y, gl_in[1].gl_Position.y, gl_in[2].gl_Position.y);
  if (max(heights.x, max(heights.y, heights.z)) < 0.01) return;
  for (int i = 0; i < 3; ++i) {
    vec3 position = gl_in[i].gl_Position.xyz;
    gl_Position = plane_to_clip * vec4(position - to_light.xyz * (position.y / to_light.y), 1.0);
    EmitVertex();
  }
  EndPrimitive();
}
)";

constexpr const char* one_text = R"(
layout(location = 0) out float lit;
void main() { lit = 1.0; }
)";

// Writes the number of work groups that covers the mask.
constexpr const char* command_text = R"(
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Command { uint groups[3]; };
void main() {
  uvec2 covering = (uvec2(shadow_size()) + 7u) / 8u;
  groups = uint[3](covering.x, covering.y, 1u);
}
)";

constexpr const char* size_text = R"(
#include "shadow/light.glsl"
ivec2 shadow_size() { return ivec2(shadow.viewport.zw); }
)";

constexpr const char* blur_text = R"(
#include "shadow/drivers/gbuffer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = UNIT_blur_radius) uniform sampler2D blur_radius;
layout(binding = 8) uniform sampler2D lit;
layout(binding = 0, rgba16f) uniform writeonly restrict image2DArray mask;
uniform int layer;
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  Light light = frame_light();
  Scramble scramble = around_scramble(receiver_at(pixel));
  float sum = 0.0;
  for (int i = 0; i < planar_points; ++i) {
    vec2 at = vec2(pixel) + 0.5 + texelFetch(blur_radius, ivec2(0), 0).x * around_point(i, scramble, light);
    sum += texelFetch(lit, clamp(ivec2(floor(at)), ivec2(0), textureSize(lit, 0) - 1), 0).x;
  }
  imageStore(mask, ivec3(pixel, layer), vec4(sum / float(planar_points), 0.0, 0.0, 0.0));
}
)";

constexpr const char* radius_text = R"(
layout(local_size_x = 1) in;
layout(binding = 0, r32f) uniform writeonly restrict image2D radius;
void main() { imageStore(radius, ivec2(0), vec4(float(blur_radius_pixels))); }
)";

// The mean of the last frames, and the number of these frames.
constexpr const char* mean_text = R"(
#include "lib/packed_texel.glsl"
layout(binding = 8) uniform usampler2D now;
layout(binding = 9) uniform sampler2D last;
layout(location = 0) out vec2 mean;
layout(location = 1) out uvec2 texel;
uniform int has_last;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 before = has_last != 0 ? texelFetch(last, pixel, 0).xy : vec2(0.0);
  uvec2 sample_and_depth = texelFetch(now, pixel, 0).xy;
  uint seen = sample_and_depth.x;
  float frames = min(before.y + 1.0, float(mean_most_frames));
  mean = vec2(mix(before.x, texel_visibility(seen), 1.0 / frames), frames);
  texel = uvec2(pack_texel(texel_distance(seen), mean.x, false), sample_and_depth.y);
}
)";

struct Projection {
  glm::mat4 world_to_clip;
  glm::vec4 to_light;
};

gl::TextureDesc of_mask(const shadow::PassContext& context, GLenum format) {
  const shadow::TextureView& depth = context.inputs().depth;
  return {.format = format, .width = depth.width, .height = depth.height};
}

// The stencil is 1 where casters cover the ground. The library has targets and buffers with the names that are used
// here too: they must be separate ones.
void mark_covered(const shadow::PassContext& context, const gl::Texture& stencil) {
  const shadow::View& view = context.inputs().view;
  const gl::Buffer& projection = context.scratch("params", sizeof(Projection));
  gl::write_value(projection, Projection{view.projection * view.view,
                                         glm::vec4(std::get<shadow::Sun>(context.light().source).to_light, 0)});
  const gl::StencilFace marks{.pass = gl::StencilOp::replace};
  gl::Pass pass(context.device(), {.name = "planar shadows",
                                   .depth = gl::Attachment{.texture = &stencil},
                                   .stencil = gl::Stencil{.front = marks, .back = marks, .reference = 1, .clear = 0}});
  projection.bind_uniform(4);
  context.draw_caster_geometry(pass, "ground", glm::mat4(1));
}

// Visibility is 1 where the stencil is not marked.
const gl::Texture& lit_pixels(const shadow::PassContext& context, const gl::Texture& stencil) {
  const gl::Texture& lit = context.target("samples", of_mask(context, GL_R16F));
  const gl::StencilFace unmarked{.test = gl::StencilTest::equal};
  gl::Pass pass(context.device(), {.name = "planar light",
                                   .colors = {{.texture = &lit, .clear = glm::vec4(0)}},
                                   .depth = gl::Attachment{.texture = &stencil},
                                   .stencil = gl::Stencil{.front = unmarked, .back = unmarked}});
  context.use(pass, "one");
  pass.draw_full_screen();
  return lit;
}

void blur(const shadow::PassContext& context, const gl::Texture& lit) {
  const gl::Buffer& command = context.scratch("light", sizeof(gl::DispatchCommand));
  gl::Pass pass(context.device(), {.name = "planar blur"});
  command.bind_storage(0);
  context.use(pass, "command");
  pass.dispatch(1, 1);
  context.use(pass, "blur").set("layer", context.frame().layer);
  context.device().sampler({}).bind(shadow::first_pass_unit);
  lit.bind(shadow::first_pass_unit);
  context.mask().bind_image(0, GL_WRITE_ONLY);
  pass.dispatch_indirect(command);
}

shadow::Technique planar() {
  return {.name = "planar",
          .summary = "Planar shadows with a blurred edge.",
          .source = "Blinn 1988, Me and my (fake) shadow",
          .glsl = "test/planar.glsl",
          .needs = {"blur_radius"},
          .params = {{"planar.points", 8, 1, 64, "taps", "Points of the blur.", ParamBinding::compiled}},
          .samples = {{.name = "around", .count_parameter = "planar.points"}},
          .resolve =
              [](const shadow::PassContext& context) {
                const gl::Texture& stencil = context.target("shadow map", of_mask(context, GL_DEPTH24_STENCIL8));
                mark_covered(context, stencil);
                blur(context, lit_pixels(context, stencil));
              },
          .programs =
              [](const ParamSet&) {
                return std::vector<gl::ProgramDesc>{
                    {.name = "ground", .geometry = "test/ground.geom"},
                    {.name = "one", .vertex = "shared/full_screen.vert", .fragment = "test/one.frag"},
                    {.name = "command", .compute = "test/command.comp"},
                    {.name = "blur", .compute = "test/blur.comp"}};
              }};
}

shadow::Recipe blur_radius() {
  return {.name = "blur_radius",
          .summary = "A texel that holds a radius in pixels.",
          .source = "made up",
          .needs = {},
          .params = {{"blur_radius.pixels", planar_blur_radius, 1, 32, "px", "Radius.", ParamBinding::compiled}},
          .build = [](const shadow::PassContext& context) -> const gl::Texture& {
            ++recorded.builds;
            const gl::Texture& texel = context.target("texel", {.format = GL_R32F});
            gl::Pass pass(context.device(), {.name = "blur radius"});
            context.use(pass, "fill");
            texel.bind_image(0, GL_WRITE_ONLY);
            pass.dispatch(1, 1);
            return texel;
          },
          .programs =
              [](const ParamSet&) {
                return std::vector<gl::ProgramDesc>{{.name = "fill", .compute = "test/radius.comp"}};
              }};
}

void average(const shadow::DenoiseContext& context) {
  const shadow::PackedMask seen = context.evaluate_packed();
  const shadow::History means = context.remembered("mean");
  const gl::Texture& texels = context.target("samples", of_mask(context, shadow::packed_format));
  {
    gl::Pass pass(context.device(), {.name = "average", .colors = {{.texture = &means.now}, {.texture = &texels}}});
    context.use(pass, "mean").set("has_last", means.valid ? 1 : 0);
    for (const GLuint unit : {8, 9}) context.device().sampler({}).bind(unit);
    seen.texels.bind(8);
    means.last.bind(9);
    pass.draw_full_screen();
  }
  context.filter_to_mask("none", {texels, seen.notes});
}

shadow::Denoiser averaging() {
  return {.name = "averaging",
          .summary = "The mean of the last frames.",
          .source = "made up",
          .needs = {"blur_radius"},
          .params = {{"mean.most_frames", 1000, 1, 1000, "", "Frames at most.", ParamBinding::compiled}},
          .remembers =
              [](const ParamSet&) {
                return std::vector<shadow::Denoiser::Remembered>{{"mean", GL_RG32F}};
              },
          .denoise = average,
          .programs =
              [](const ParamSet&) {
                return std::vector<gl::ProgramDesc>{
                    {.name = "mean", .vertex = "shared/full_screen.vert", .fragment = "test/mean.frag"}};
              }};
}

// A technique that reads a product, but no shadow map, and has no passes of its own.
shadow::Technique planar_read() {
  return {.name = "planar_read", .glsl = "test/planar.glsl", .needs = {"blur_radius"}};
}

shadow::Denoiser filtering_twice() {
  return {.name = "filters_twice",
          .summary = "The same filter, once more on its own result.",
          .source = "made up",
          .denoise = [](const shadow::DenoiseContext& context) {
            const shadow::PackedMask seen = context.evaluate_packed();
            const gl::Texture& once = context.filter("box", seen);
            const gl::Texture& twice = context.filter("box", {once, seen.notes, seen.distances});
            recorded.filtered = {&seen.texels, &once, &twice};
            context.filter_to_mask("none", {twice, seen.notes});
          }};
}

}  // namespace

PlanarRecord& planar_record() { return recorded; }

shadow::Registry with_planar() {
  const shadow::Registry& built_in = shadow::built_in_registry();
  shadow::Registry::Contents contents{
      .techniques = {planar(), planar_read(), built_in.find("none"), built_in.find("pcss")}};
  contents.denoisers.push_back(averaging());
  contents.denoisers.push_back(filtering_twice());
  contents.recipes.push_back(blur_radius());
  return shadow::Registry(std::move(contents));
}

void put_planar_shaders(gl::ShaderFiles& files) {
  files.put("test/planar.glsl", technique_text);
  files.put("test/ground.geom", ground_text);
  files.put("test/one.frag", one_text);
  files.put("test/size.glsl", size_text);
  files.put("test/command.comp", std::string("#include \"test/size.glsl\"\n") + command_text);
  files.put("test/blur.comp", blur_text);
  files.put("test/radius.comp", radius_text);
  files.put("test/mean.frag", mean_text);
}

}  // namespace penumbra::test
