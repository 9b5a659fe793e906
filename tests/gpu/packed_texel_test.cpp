// The driver packs texels to the same bits as the same functions compiled as C++.

#include "lib/packed_texel.glsl"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "gpu/gpu_test.h"

namespace penumbra::test {
namespace {

constexpr const char* pack_text = R"(
#include "lib/packed_texel.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { uvec4 outputs[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  uint texel = pack_texel(inputs[i].x, inputs[i].y, inputs[i].z != 0.0);
  outputs[i] = uvec4(texel, floatBitsToUint(texel_distance(texel)), floatBitsToUint(texel_visibility(texel)),
                     texel_invalid(texel) ? 1u : 0u);
}
)";

class PackedTexelGpu : public GpuTest {
 protected:
  PackedTexelGpu() { device_.shaders.files().put("test/pack.comp", pack_text); }

  std::vector<glm::uvec4> packed(const std::vector<glm::vec4>& values) {
    const gl::Buffer inputs("inputs", values.size() * sizeof(glm::vec4));
    const gl::Buffer outputs("outputs", values.size() * sizeof(glm::uvec4));
    inputs.write(std::as_bytes(std::span(values)));
    {
      gl::Pass pass(device_, {.name = "pack"});
      pass.use({.name = "pack", .compute = "test/pack.comp"});
      inputs.bind_storage(0);
      outputs.bind_storage(1);
      pass.dispatch(static_cast<int>(values.size()), 1);
    }
    std::vector<glm::uvec4> result(values.size());
    gl::glGetNamedBufferSubData(outputs.id(), 0, static_cast<GLsizeiptr>(result.size() * sizeof(glm::uvec4)),
                                result.data());
    return result;
  }

  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
};

// Every half float, floats just below and above the middle between it and the next, and random floats; visibilities
// from 0 to 1.
std::vector<glm::vec4> inputs() {
  std::vector<glm::vec4> values;
  Random random(1);
  const auto unit = [&] { return static_cast<float>(random.real()); };
  const auto add = [&](float distance_to) {
    values.emplace_back(distance_to, unit(), static_cast<float>(values.size() % 2), 0);
  };
  for (glm::uint bits = 0; bits < 0x7bffu; ++bits) {
    const float low = glsl::half_value(bits);
    const float middle = 0.5f * (low + glsl::half_value(bits + 1));
    for (const float value : {low, std::nextafter(middle, 0.0f), middle, std::nextafter(middle, 1e9f)}) add(value);
  }
  for (int i = 0; i < 20000; ++i) add(std::exp2(40 * unit() - 20));
  for (const float value : {0.0f, -1.0f, 1e30f, 65504.0f, 65520.0f}) add(value);
  while (values.size() % 64 != 0) add(1);
  return values;
}

TEST_F(PackedTexelGpu, IsThatOfCpp) {
  const std::vector<glm::vec4> values = inputs();
  const std::vector<glm::uvec4> packed = this->packed(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::uint texel = glsl::pack_texel(values[i].x, values[i].y, values[i].z != 0);
    ASSERT_EQ(packed[i].x, texel) << values[i].x << ", " << values[i].y;
    ASSERT_EQ(std::bit_cast<float>(packed[i].y), glsl::texel_distance(texel));
    // GLSL's division may be off in the last bits.
    ASSERT_FLOAT_EQ(std::bit_cast<float>(packed[i].z), glsl::texel_visibility(texel));
    ASSERT_EQ(packed[i].w, glsl::texel_invalid(texel) ? 1u : 0u);
  }
}

// The texture returns the bits that were written, also those that would be NaN as floats.
TEST_F(PackedTexelGpu, TexturesKeepEveryBit) {
  const gl::Texture texture("texels", {.format = GL_R32UI, .width = 4, .height = 2});
  const std::array<unsigned, 8> texels{0xffff7bffu, 0x7f800001u, 0xff800001u, 0x7fc00000u,
                                       0x80000000u, 0x00000001u, 0x00007fffu, 0x12345678u};
  texture.upload(GL_RED_INTEGER, GL_UNSIGNED_INT, std::as_bytes(std::span(texels)));
  const std::vector<unsigned> read = gl::read_uints(texture, 1);
  EXPECT_TRUE(std::equal(read.begin(), read.end(), texels.begin(), texels.end()));
}

}  // namespace
}  // namespace penumbra::test
