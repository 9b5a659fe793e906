// The uniform blocks of the shadow passes have the same layout in C++ and in the driver's programs, and each parameter
// gets its value whatever other parameters the registry has.

#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "shared/shadow_block.h"

namespace penumbra::test {
namespace {

struct Block {
  std::map<std::string, int> offsets;
  int bytes = 0;
};

GLint property_of(GLuint program, GLenum interface, GLuint index, GLenum property) {
  GLint value = -1;
  gl::glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &value);
  return value;
}

Block block_of(GLuint program, const char* name) {
  Block block;
  const GLuint index = gl::glGetProgramResourceIndex(program, GL_UNIFORM_BLOCK, name);
  if (index == GL_INVALID_INDEX) return block;
  block.bytes = property_of(program, GL_UNIFORM_BLOCK, index, GL_BUFFER_DATA_SIZE);
  GLint count = 0;
  gl::glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    if (property_of(program, GL_UNIFORM, i, GL_BLOCK_INDEX) != static_cast<GLint>(index)) continue;
    char member[128] = {};
    gl::glGetProgramResourceName(program, GL_UNIFORM, i, sizeof(member), nullptr, member);
    block.offsets[member] = property_of(program, GL_UNIFORM, i, GL_OFFSET);
  }
  return block;
}

void expect_offset(const Block& block, const std::string& glsl, std::size_t cpp) {
  ASSERT_TRUE(block.offsets.contains(glsl)) << glsl;
  EXPECT_EQ(block.offsets.at(glsl), static_cast<int>(cpp)) << glsl;
}

// The built-in techniques in reverse order, after a technique with parameters of every kind.
shadow::Registry reordered() {
  const auto built_in = shadow::built_in_registry().techniques();
  std::vector<shadow::Technique> techniques(built_in.rbegin(), built_in.rend());
  shadow::Technique first = techniques.back();
  first.name = "first";
  first.samples = {};
  first.params = {{"first.flag", true, 0, 1, "", "A switch."},
                  {"first.word", std::string("b"), 0, 0, "", "A word.", ParamBinding::uniform, {"a", "b"}},
                  {"first.host", 3, 0, 9, "", "Not for GLSL.", ParamBinding::host},
                  {"first.constant", 3, 0, 9, "", "Compiled in.", ParamBinding::compiled},
                  {"first.quantity", 0.25f, 0, 1, "", "A quantity."}};
  techniques.insert(techniques.begin(), first);
  return shadow::Registry({.techniques = std::move(techniques), .default_technique = "pcss"});
}

class ShadowLayout : public GpuTest {
 protected:
  static GLuint program_of(TriangleRenderer& renderer, const char* name) {
    for (const gl::ProgramDesc& program : renderer.shadows().all_programs(renderer.params())) {
      if (program.name == name && !program.fragment.empty()) return renderer.device().shaders.get(program).id();
    }
    ADD_FAILURE() << "no program " << name;
    return 0;
  }
};

TEST_F(ShadowLayout, BlocksLieAsTheDriverReadsThem) {
  TriangleRenderer renderer;
  const GLuint program = program_of(renderer, "pcss");
  using glsl::LayerBlock;
  using glsl::ShadowBlock;
  const Block light = block_of(program, "ShadowData");
  EXPECT_EQ(light.bytes, static_cast<int>(sizeof(ShadowBlock)));
  expect_offset(light, "shadow.clip_to_view", offsetof(ShadowBlock, clip_to_view));
  expect_offset(light, "shadow.view_to_light", offsetof(ShadowBlock, view_to_light));
  expect_offset(light, "shadow.world_to_light", offsetof(ShadowBlock, world_to_light));
  expect_offset(light, "shadow.viewport", offsetof(ShadowBlock, viewport));
  expect_offset(light, "shadow.jitter", offsetof(ShadowBlock, jitter));
  expect_offset(light, "shadow.noise_shift", offsetof(ShadowBlock, noise_shift));
  expect_offset(light, "shadow.noise_place[0]", offsetof(ShadowBlock, noise_place));
  expect_offset(light, "shadow.depth_to_ndc", offsetof(ShadowBlock, depth_to_ndc));
  expect_offset(light, "shadow.sky_depth", offsetof(ShadowBlock, sky_depth));
  expect_offset(light, "shadow.octahedral_normals", offsetof(ShadowBlock, octahedral_normals));
  expect_offset(light, "shadow.normal_decode", offsetof(ShadowBlock, normal_decode));
  expect_offset(light, "shadow.light_extent", offsetof(ShadowBlock, light_extent));
  expect_offset(light, "shadow.light_is_square", offsetof(ShadowBlock, light_is_square));
  expect_offset(light, "shadow.layer_count", offsetof(ShadowBlock, layer_count));
  expect_offset(light, "shadow.map_size", offsetof(ShadowBlock, map_size));
  expect_offset(light, "shadow.history_valid", offsetof(ShadowBlock, history_valid));
  expect_offset(light, "shadow.has_motion", offsetof(ShadowBlock, has_motion));
  expect_offset(light, "shadow.casters_moved", offsetof(ShadowBlock, casters_moved));
  expect_offset(light, "shadow.moved_depth", offsetof(ShadowBlock, moved_depth));
  expect_offset(light, "shadow.axes_turn", offsetof(ShadowBlock, axes_turn));
  expect_offset(light, "shadow.light_stretch", offsetof(ShadowBlock, light_stretch));
  expect_offset(light, "shadow.light_is_lamp", offsetof(ShadowBlock, light_is_lamp));
  expect_offset(light, "shadow.lamp", offsetof(ShadowBlock, lamp));
  expect_offset(light, "shadow.widest.texel", offsetof(ShadowBlock, widest) + offsetof(LayerBlock, texel));
  for (std::size_t i : {std::size_t{0}, std::size_t{SHADOW_MAX_LAYERS - 1}}) {
    const std::string layer = fmt::format("shadow.layers[{}].", i);
    const std::size_t at = offsetof(ShadowBlock, layers) + i * sizeof(LayerBlock);
    expect_offset(light, layer + "center", at + offsetof(LayerBlock, center));
    expect_offset(light, layer + "widths_per_metre", at + offsetof(LayerBlock, widths_per_metre));
    expect_offset(light, layer + "texel_shares", at + offsetof(LayerBlock, texel_shares));
    expect_offset(light, layer + "texel", at + offsetof(LayerBlock, texel));
    expect_offset(light, layer + "near_depth", at + offsetof(LayerBlock, near_depth));
    expect_offset(light, layer + "depth_range", at + offsetof(LayerBlock, depth_range));
    expect_offset(light, layer + "rounding", at + offsetof(LayerBlock, rounding));
  }
  // Tables of 256 points, one after the other.
  const Block samples = block_of(program, "SamplePoints");
  EXPECT_EQ(samples.bytes, 3 * 256 * 16);
  expect_offset(samples, "blocker_points[0]", 0);
  expect_offset(samples, "filter_points[0]", std::size_t{256} * 16);
  expect_offset(samples, "disocclusion_points[0]", std::size_t{2} * 256 * 16);
}

TEST_F(ShadowLayout, ParametersLieInTheOrderOfTheirRows) {
  for (const shadow::Registry& registry : {shadow::built_in_registry(), reordered()}) {
    TriangleRenderer renderer(registry);
    const ParamSet params = renderer.params();
    const Block block = block_of(program_of(renderer, "pcf"), "Params");
    std::size_t offset = 0;
    for (const Param& row : params.rows()) {
      if (row.binding != ParamBinding::uniform) continue;
      expect_offset(block, glsl_name(row), offset);
      offset += 4;
    }
    EXPECT_EQ(block.offsets.size(), offset / 4);
    EXPECT_GE(uniform_bytes(params).size(), static_cast<std::size_t>(block.bytes));
  }
}

TEST_F(ShadowLayout, RowsInAnotherOrderGiveTheSameMask) {
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  scene.add_box({-1, 0, -1}, {1, 2, 1});
  scene.view = glm::lookAt(glm::vec3(2, 5, 6), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 1, 0.1f);
  scene.to_light = sun_direction(60, 40);
  TriangleRenderer as_built;
  TriangleRenderer turned(reordered());
  for (const std::string technique : {"pcf", "pcss"}) {
    ParamSet a = as_built.params();
    ParamSet b = turned.params();
    for (ParamSet* params : {&a, &b}) {
      params->set("technique", technique);
      params->set("pcf.radius", 0.3f);
      params->set("sampling.seed", 11);
      params->set("bias.slope", 0.5f);
    }
    EXPECT_EQ(as_built.render(scene, a).mask, turned.render(scene, b).mask) << technique;
  }
}

}  // namespace
}  // namespace penumbra::test
