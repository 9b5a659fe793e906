#pragma once

#include "gl/pass.h"
#include "gpu_test.h"

namespace penumbra::test {

// The full-screen triangle at depth 0.5, and a fragment shader that writes one colour.
inline gl::ShaderFiles pass_files() {
  return shader_files(
      {{"triangle.vert",
        "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.5, 1.0); }\n"},
       {"color.frag", "uniform vec4 value;\nlayout(location = 0) out vec4 color;\nvoid main() { color = value; }\n"},
       {"fill.comp",
        "layout(local_size_x = 8, local_size_y = 8) in;\nlayout(r32f, binding = 0) uniform writeonly image2DArray to;\n"
        "void main() {\n  ivec3 p = ivec3(gl_GlobalInvocationID);\n"
        "  imageStore(to, p, vec4(p.x + 10 * p.y + 1000 * p.z));\n}\n"}});
}

inline const gl::ProgramDesc color_program{.name = "color", .vertex = "triangle.vert", .fragment = "color.frag"};
inline const gl::ProgramDesc fill_program{.name = "fill", .compute = "fill.comp"};

// A device with those programs, and a colour and a depth target of 2 × 2 texels.
class GlPassTest : public GpuTest {
 protected:
  void draw(const gl::PassDesc& desc, const glm::vec4& value) {
    gl::Pass pass(device, desc);
    pass.use(color_program).set("value", value);
    pass.draw_full_screen();
  }

  gl::Device device{pass_files(), gl::Timers::Mode::off};
  const gl::Texture& color = device.target("color", {.format = GL_RGBA32F, .width = 2, .height = 2});
  const gl::Texture& depth = device.target("depth", {.format = GL_DEPTH_COMPONENT32F, .width = 2, .height = 2});
};

}  // namespace penumbra::test
