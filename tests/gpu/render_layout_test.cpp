// Structs that C++ and GLSL share have the same layout in both.
#include <cstddef>
#include <map>

#include "render_scenes.h"
#include "shared/lighting_block.h"
#include "shared/scene_blocks.h"
#include "shared/view_block.h"

namespace penumbra::test {
namespace {

class LayoutTest : public RenderTest {};

// Offsets of a program's buffer and uniform-block members, by name.
std::map<std::string, int> offsets(GLuint program) {
  std::map<std::string, int> all;
  for (const GLenum kind : {GL_BUFFER_VARIABLE, GL_UNIFORM}) {
    GLint count = 0;
    gl::glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
      char name[128] = {};
      gl::glGetProgramResourceName(program, kind, i, sizeof(name), nullptr, name);
      const GLenum property = GL_OFFSET;
      GLint offset = -1;
      gl::glGetProgramResourceiv(program, kind, i, 1, &property, 1, nullptr, &offset);
      if (offset >= 0) all[name] = offset;
    }
  }
  return all;
}

gl::ProgramDesc program_named(render::Renderer& renderer, const ParamSet& params, std::string_view name) {
  for (gl::ProgramDesc& program : renderer.all_programs(params)) {
    if (program.name == name) return program;
  }
  ADD_FAILURE() << "no program " << name;
  return {};
}

void expect_offset(const std::map<std::string, int>& found, const std::string& glsl, std::size_t cpp) {
  ASSERT_TRUE(found.contains(glsl)) << glsl;
  EXPECT_EQ(found.at(glsl), static_cast<int>(cpp)) << glsl;
}

TEST_F(LayoutTest, SurfacePrograms) {
  const auto found = offsets(device.shaders.get(program_named(renderer, params, "surfaces")).id());
  using glsl::InstanceBlock;
  using glsl::MaterialBlock;
  using glsl::ViewBlock;
  expect_offset(found, "view.world_to_clip", offsetof(ViewBlock, world_to_clip));
  expect_offset(found, "view.last_world_to_clip", offsetof(ViewBlock, last_world_to_clip));
  expect_offset(found, "view.camera", offsetof(ViewBlock, camera));
  expect_offset(found, "view.forward", offsetof(ViewBlock, forward));
  expect_offset(found, "view.ray_x", offsetof(ViewBlock, ray_x));
  expect_offset(found, "view.ray_y", offsetof(ViewBlock, ray_y));
  expect_offset(found, "view.viewport", offsetof(ViewBlock, viewport));
  expect_offset(found, "instances[0].last_world", offsetof(InstanceBlock, last_world));
  expect_offset(found, "instances[0].area", offsetof(InstanceBlock, area));
  expect_offset(found, "instances[0].first_index", offsetof(InstanceBlock, first_index));
  expect_offset(found, "instances[0].first_triangle", offsetof(InstanceBlock, first_triangle));
  expect_offset(found, "instances[0].winding", offsetof(InstanceBlock, winding));
  expect_offset(found, "material.emissive", offsetof(MaterialBlock, emissive));
  expect_offset(found, "material.alpha_cutoff", offsetof(MaterialBlock, alpha_cutoff));
  expect_offset(found, "material.occlusion_strength", offsetof(MaterialBlock, occlusion_strength));
  expect_offset(found, "material.has_base_color", offsetof(MaterialBlock, has_base_color));
  expect_offset(found, "material.flags", offsetof(MaterialBlock, flags));
  expect_offset(found, "material.uv_rows[0]", offsetof(MaterialBlock, uv_rows));
}

TEST_F(LayoutTest, DeformProgram) {
  const auto found = offsets(device.shaders.get(program_named(renderer, params, "deform")).id());
  using glsl::DeformBlock;
  expect_offset(found, "jobs[0].source", offsetof(DeformBlock, source));
  expect_offset(found, "jobs[0].joint_count", offsetof(DeformBlock, joint_count));
  expect_offset(found, "jobs[0].target_count", offsetof(DeformBlock, target_count));
  expect_offset(found, "jobs[0].triangle_count", offsetof(DeformBlock, triangle_count));
}

TEST_F(LayoutTest, LightingProgram) {
  const auto found = offsets(device.shaders.get(program_named(renderer, params, "lighting")).id());
  using glsl::LightingBlock;
  expect_offset(found, "lighting.ambient.ground", offsetof(LightingBlock, ambient.ground));
  expect_offset(found, "lighting.ambient.zenith", offsetof(LightingBlock, ambient.zenith));
  expect_offset(found, "lighting.ambient.side", offsetof(LightingBlock, ambient.side));
  expect_offset(found, "lighting.ambient.horizon", offsetof(LightingBlock, ambient.horizon));
  expect_offset(found, "lighting.ambient.vertical", offsetof(LightingBlock, ambient.vertical));
  expect_offset(found, "lighting.ambient.upward", offsetof(LightingBlock, ambient.upward));
  expect_offset(found, "lighting.ambient.shares", offsetof(LightingBlock, ambient.shares));
  expect_offset(found, "lighting.ambient.sun_side", offsetof(LightingBlock, ambient.sun_side));
  expect_offset(found, "lighting.ground_albedo", offsetof(LightingBlock, ground_albedo));
  expect_offset(found, "lighting.room", offsetof(LightingBlock, room));
  expect_offset(found, "lighting.sky", offsetof(LightingBlock, sky));
  expect_offset(found, "lighting.ground_height", offsetof(LightingBlock, ground_height));
  expect_offset(found, "lighting.scene_reach", offsetof(LightingBlock, scene_reach));
  expect_offset(found, "lighting.emission", offsetof(LightingBlock, emission));
  expect_offset(found, "lighting.light_count", offsetof(LightingBlock, light_count));
  for (std::size_t i : {std::size_t{0}, std::size_t{LIGHTING_MAX_LIGHTS - 1}}) {
    using glsl::DirectLightBlock;
    const std::string light = fmt::format("lighting.lights[{}].", i);
    const std::size_t at = offsetof(LightingBlock, lights) + i * sizeof(DirectLightBlock);
    expect_offset(found, light + "place", at + offsetof(DirectLightBlock, place));
    expect_offset(found, light + "least_square", at + offsetof(DirectLightBlock, least_square));
    expect_offset(found, light + "illuminance", at + offsetof(DirectLightBlock, illuminance));
    expect_offset(found, light + "inverse_range", at + offsetof(DirectLightBlock, inverse_range));
    expect_offset(found, light + "axis", at + offsetof(DirectLightBlock, axis));
    expect_offset(found, light + "cone_scale", at + offsetof(DirectLightBlock, cone_scale));
    expect_offset(found, light + "cone_offset", at + offsetof(DirectLightBlock, cone_offset));
  }
}

}  // namespace
}  // namespace penumbra::test
