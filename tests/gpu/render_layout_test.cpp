// Structs that C++ and GLSL share lie alike in both.
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

#define EXPECT_OFFSET(found, glsl, type, member)                                   \
  do {                                                                             \
    ASSERT_TRUE((found).count(glsl)) << glsl;                                      \
    EXPECT_EQ((found).at(glsl), static_cast<int>(offsetof(type, member))) << glsl; \
  } while (false)

TEST_F(LayoutTest, SurfacePrograms) {
  const auto found = offsets(device.shaders.get(program_named(renderer, params, "masked surfaces")).id());
  using glsl::InstanceBlock;
  using glsl::MaterialBlock;
  using glsl::ViewBlock;
  EXPECT_OFFSET(found, "view.world_to_clip", ViewBlock, world_to_clip);
  EXPECT_OFFSET(found, "view.last_world_to_clip", ViewBlock, last_world_to_clip);
  EXPECT_OFFSET(found, "view.camera", ViewBlock, camera);
  EXPECT_OFFSET(found, "view.forward", ViewBlock, forward);
  EXPECT_OFFSET(found, "view.viewport", ViewBlock, viewport);
  EXPECT_OFFSET(found, "instances[0].last_world", InstanceBlock, last_world);
  EXPECT_OFFSET(found, "instances[0].area", InstanceBlock, area);
  EXPECT_OFFSET(found, "instances[0].first_index", InstanceBlock, first_index);
  EXPECT_OFFSET(found, "instances[0].winding", InstanceBlock, winding);
  EXPECT_OFFSET(found, "material.emissive", MaterialBlock, emissive);
  EXPECT_OFFSET(found, "material.alpha_cutoff", MaterialBlock, alpha_cutoff);
  EXPECT_OFFSET(found, "material.occlusion_strength", MaterialBlock, occlusion_strength);
  EXPECT_OFFSET(found, "material.flags", MaterialBlock, flags);
  EXPECT_OFFSET(found, "material.uv_rows[0]", MaterialBlock, uv_rows);
}

TEST_F(LayoutTest, DeformProgram) {
  const auto found = offsets(device.shaders.get(program_named(renderer, params, "deform")).id());
  using glsl::DeformBlock;
  EXPECT_OFFSET(found, "jobs[0].source", DeformBlock, source);
  EXPECT_OFFSET(found, "jobs[0].joint_count", DeformBlock, joint_count);
  EXPECT_OFFSET(found, "jobs[0].target_count", DeformBlock, target_count);
}

TEST_F(LayoutTest, LightingProgram) {
  const auto found = offsets(device.shaders.get(program_named(renderer, params, "lighting")).id());
  using glsl::LightingBlock;
  EXPECT_OFFSET(found, "lighting.to_sun", LightingBlock, to_sun);
  EXPECT_OFFSET(found, "lighting.sun", LightingBlock, sun);
  EXPECT_OFFSET(found, "lighting.sky", LightingBlock, sky);
  EXPECT_OFFSET(found, "lighting.ground", LightingBlock, ground);
}

}  // namespace
}  // namespace penumbra::test
