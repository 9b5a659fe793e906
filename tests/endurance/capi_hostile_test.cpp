// Hostile calls of the C interface in a context, also under sanitizers: every field of a frame and a light takes values
// that it can't have. Each call returns a result, with one line if it is an error, and a right frame is right
// afterwards.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "capi/penumbra.h"
#include "gl/texture.h"
#include "gpu/gpu_test.h"

namespace penumbra::test {
namespace {

constexpr int side = 16;

class CInterfaceHostile : public GpuTest {
 protected:
  void SetUp() override {
    penumbra_device_desc desc;
    ASSERT_EQ(penumbra_device_desc_init(&desc, sizeof desc), PENUMBRA_OK);
    desc.get_proc = [](void*, const char* name) {
      return reinterpret_cast<penumbra_proc>(test_context().get_proc_address()(name));
    };
    desc.log = [](void*, int32_t, const char*) {};
    ASSERT_EQ(penumbra_device_create(&desc, &device_), PENUMBRA_OK) << penumbra_last_error();
    ASSERT_EQ(penumbra_settings_create(&settings_), PENUMBRA_OK);
    ASSERT_EQ(penumbra_settings_select(settings_, "hard"), PENUMBRA_OK);
    for (const char* size : {"cascades.size", "lamps.size"})
      ASSERT_EQ(penumbra_settings_set_number(settings_, size, 16), PENUMBRA_OK);
    depth_ = gl::Texture("depth", {.format = GL_DEPTH_COMPONENT32F, .width = side, .height = side});
    normals_ = gl::Texture("normals", {.format = GL_RGBA16F, .width = side, .height = side});
    const float half = 0.5f;
    gl::glClearTexImage(depth_.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &half);
    gl::glClearTexImage(normals_.id(), 0, GL_RGBA, GL_FLOAT, nullptr);
  }
  void TearDown() override {
    penumbra_settings_destroy(settings_);
    EXPECT_EQ(penumbra_device_destroy(device_), PENUMBRA_OK);
    depth_ = gl::Texture();
    normals_ = gl::Texture();
    GpuTest::TearDown();
  }

  // Orthographic, 20 m wide and deep; `light` must stay.
  penumbra_frame frame(const penumbra_light& light) const {
    penumbra_frame frame;
    EXPECT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
    for (auto* matrix : {&frame.projection, &frame.last_projection}) {
      (*matrix)[0] = (*matrix)[5] = 0.1f;
      (*matrix)[10] = 0.05f;
      (*matrix)[14] = 1;
    }
    frame.depth = {depth_.id(), side, side};
    frame.normals = {normals_.id(), side, side};
    for (penumbra_box* box : {&frame.casters, &frame.receivers}) *box = {{-10, -10, -20}, {10, 10, 0}};
    frame.lights = &light;
    frame.light_count = 1;
    frame.draw = [](void*, const penumbra_caster_pass*) -> int32_t { return 0; };
    return frame;
  }
  static penumbra_light light(int32_t kind) {
    penumbra_light light;
    EXPECT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
    light.kind = kind;
    light.position[1] = 5;
    return light;
  }

  penumbra_result render(const penumbra_frame& frame) {
    penumbra_mask mask{};
    mask.struct_size = sizeof mask;
    const penumbra_result result = penumbra_render(device_, settings_, &frame, &mask);
    const std::string message = penumbra_last_error();
    if (result == PENUMBRA_OK) {
      EXPECT_EQ(mask.width, side);
    } else {
      EXPECT_EQ(mask.texture, 0u);
      EXPECT_FALSE(message.empty());
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_NE(result, PENUMBRA_ERROR_INTERNAL) << message;
    }
    return result;
  }

  penumbra_device* device_ = nullptr;
  penumbra_settings* settings_ = nullptr;
  gl::Texture depth_, normals_;
};

// Each of 4 bytes: what breaks floats, integers and switches.
std::vector<std::uint32_t> hostile_values() {
  std::vector<std::uint32_t> values{0, 1, 2, 0xffffffffu, 0x7fffffffu, 0x80000000u, 0x12345678u};
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 1e30f, -1e30f, 1e-42f, 1e6f}) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    values.push_back(bits);
  }
  return values;
}

bool is_not_finite(std::uint32_t bits) { return (bits & 0x7f800000u) == 0x7f800000u; }

// All fields but pointers, since the ways to lie with these are undefined, and their counts, which are tested below.
TEST_F(CInterfaceHostile, EveryFieldOfAFrame) {
  const penumbra_light sun = light(PENUMBRA_SUN);
  const penumbra_frame right = frame(sun);
  ASSERT_EQ(render(right), PENUMBRA_OK) << penumbra_last_error();
  std::size_t refused = 0;
  for (std::size_t at = offsetof(penumbra_frame, view_id); at < sizeof(penumbra_frame); at += 4) {
    if (at >= offsetof(penumbra_frame, lights) && at < offsetof(penumbra_frame, exact_bounds)) continue;
    for (const std::uint32_t value : hostile_values()) {
      penumbra_frame wrong = right;
      std::memcpy(reinterpret_cast<unsigned char*>(&wrong) + at, &value, sizeof value);
      const bool is_float =
          (at >= offsetof(penumbra_frame, view) && at < offsetof(penumbra_frame, depth)) ||
          (at >= offsetof(penumbra_frame, casters) && at < offsetof(penumbra_frame, moved_is_known)) ||
          (at >= offsetof(penumbra_frame, normals_scale) && at < offsetof(penumbra_frame, depth_layer));
      const penumbra_result result = render(wrong);
      refused += result == PENUMBRA_OK ? 0 : 1;
      if (is_float && is_not_finite(value)) {
        EXPECT_EQ(result, PENUMBRA_ERROR_ARGUMENT) << "at byte " << at;
      }
      ASSERT_EQ(penumbra_forget_view(device_, wrong.view_id), PENUMBRA_OK);
    }
    ASSERT_EQ(render(right), PENUMBRA_OK) << "after byte " << at << ": " << penumbra_last_error();
  }
  EXPECT_GT(refused, 400u);
}

TEST_F(CInterfaceHostile, EveryFieldOfALight) {
  for (const int32_t kind : {PENUMBRA_SUN, PENUMBRA_LAMP}) {
    const penumbra_light right = light(kind);
    for (std::size_t at = offsetof(penumbra_light, id); at < sizeof(penumbra_light); at += 4) {
      if (at >= offsetof(penumbra_light, overrides) && at < offsetof(penumbra_light, output_texture)) continue;
      for (const std::uint32_t value : hostile_values()) {
        penumbra_light wrong = right;
        std::memcpy(reinterpret_cast<unsigned char*>(&wrong) + at, &value, sizeof value);
        const penumbra_result result = render(frame(wrong));
        const bool read =
            kind == PENUMBRA_SUN ? at < offsetof(penumbra_light, position) : at >= offsetof(penumbra_light, position);
        const bool is_float = at >= offsetof(penumbra_light, to_light) && at < offsetof(penumbra_light, overrides);
        if (read && is_float && is_not_finite(value)) {
          EXPECT_EQ(result, PENUMBRA_ERROR_ARGUMENT) << "at byte " << at;
        }
      }
    }
    EXPECT_EQ(render(frame(right)), PENUMBRA_OK) << penumbra_last_error();
  }
}

// Shadow maps of the engine's: what is said of them, their matrices and their places in an atlas.
TEST_F(CInterfaceHostile, EveryNumberOfGivenMaps) {
  penumbra_light right = light(PENUMBRA_SUN);
  std::array<float, 8 * 16> matrices{};
  for (std::size_t i = 0; i < matrices.size(); ++i) matrices[i] = i % 16 % 5 == 0 ? 0.05f : 0;
  for (std::size_t i = 14; i < matrices.size(); i += 16) matrices[i] = 1;
  std::array<int32_t, 8 * 2> corners{};
  matrices[0] = -0.05f;
  right.to_light[1] = 0;
  right.to_light[2] = -1;
  right.maps = {frame(right).depth.id, 16, 16};
  right.maps_size = 16;
  right.maps_count = 1;
  right.maps_world_to_clip = matrices.data();
  right.maps_atlas = corners.data();
  ASSERT_EQ(render(frame(right)), PENUMBRA_OK) << penumbra_last_error();
  for (std::size_t at = offsetof(penumbra_light, maps); at < offsetof(penumbra_light, maps_world_to_clip); at += 4) {
    for (const std::uint32_t value : hostile_values()) {
      penumbra_light wrong = right;
      std::memcpy(reinterpret_cast<unsigned char*>(&wrong) + at, &value, sizeof value);
      render(frame(wrong));
    }
  }
  for (std::size_t i = 0; i < 16; ++i) {
    for (const std::uint32_t value : hostile_values()) {
      const float kept = std::exchange(matrices[i], std::bit_cast<float>(value));
      const penumbra_result result = render(frame(right));
      if (is_not_finite(value)) {
        EXPECT_EQ(result, PENUMBRA_ERROR_ARGUMENT) << "value " << i << " of a matrix";
      }
      matrices[i] = kept;
    }
  }
  for (int32_t& corner : corners) {
    for (const std::uint32_t value : hostile_values()) {
      const int32_t kept = std::exchange(corner, std::bit_cast<int32_t>(value));
      render(frame(right));
      corner = kept;
    }
  }
  EXPECT_EQ(render(frame(light(PENUMBRA_SUN))), PENUMBRA_OK) << penumbra_last_error();
}

TEST_F(CInterfaceHostile, SizesCountsAndNulls) {
  const penumbra_light sun = light(PENUMBRA_SUN);
  const penumbra_frame right = frame(sun);
  constexpr std::size_t first_frame_size = 488;  // in the first version of the interface
  for (std::size_t size = 0; size < first_frame_size; ++size) {
    penumbra_frame wrong = right;
    wrong.struct_size = size;
    EXPECT_EQ(render(wrong), PENUMBRA_ERROR_ARGUMENT) << size;
  }
  penumbra_frame earlier = right;  // of a program that knows no later fields: none of their bytes is read
  earlier.struct_size = first_frame_size;
  std::memset(reinterpret_cast<unsigned char*>(&earlier) + first_frame_size, 0xff, sizeof earlier - first_frame_size);
  EXPECT_EQ(render(earlier), PENUMBRA_OK) << penumbra_last_error();
  for (const std::size_t size : {std::size_t{65536}, std::numeric_limits<std::size_t>::max()}) {
    penumbra_frame wrong = right;
    wrong.struct_size = size;
    EXPECT_EQ(render(wrong), PENUMBRA_ERROR_ARGUMENT) << size;
  }
  constexpr std::size_t first_light_size = 80;
  for (std::size_t size = 0; size < first_light_size; ++size) {
    penumbra_light wrong = sun;
    wrong.struct_size = size;
    EXPECT_EQ(render(frame(wrong)), PENUMBRA_ERROR_ARGUMENT) << size;
  }
  penumbra_mask mask{};
  EXPECT_EQ(penumbra_render(device_, settings_, &right, &mask), PENUMBRA_ERROR_ARGUMENT);
  mask.struct_size = sizeof mask;
  EXPECT_EQ(penumbra_render(device_, nullptr, &right, &mask), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_render(device_, settings_, nullptr, &mask), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_render(device_, settings_, &right, nullptr), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_warm_up(device_, nullptr, &right), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_warm_up(device_, settings_, nullptr), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_reads_motion(device_, settings_, &sun, 1, nullptr), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_forward_source(device_, nullptr, nullptr, nullptr, 0, nullptr), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_forward_source(device_, settings_, nullptr, nullptr, 8, nullptr), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_bind_forward(device_, 99, 0), PENUMBRA_ERROR_ARGUMENT);

  penumbra_frame wrong = right;
  wrong.lights = nullptr;
  EXPECT_EQ(render(wrong), PENUMBRA_ERROR_ARGUMENT);
  wrong.light_count = 0;
  EXPECT_EQ(render(wrong), PENUMBRA_OK) << penumbra_last_error();
  wrong = right;
  wrong.light_count = 257;  // more than there may be: none is read
  EXPECT_EQ(render(wrong), PENUMBRA_ERROR_ARGUMENT);
  wrong.light_count = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(render(wrong), PENUMBRA_ERROR_ARGUMENT);
  wrong = right;
  wrong.draw = nullptr;
  EXPECT_EQ(render(wrong), PENUMBRA_ERROR_REFUSED);
  EXPECT_EQ(penumbra_warm_up(device_, settings_, &wrong), PENUMBRA_OK) << penumbra_last_error();

  const std::array<const char*, 3> overrides{"sun.angle=2", nullptr, "technique=nothing"};
  penumbra_light light = sun;
  light.override_count = 1;
  EXPECT_EQ(render(frame(light)), PENUMBRA_ERROR_ARGUMENT);
  light.overrides = overrides.data();
  EXPECT_EQ(render(frame(light)), PENUMBRA_OK) << penumbra_last_error();
  light.override_count = 2;
  EXPECT_EQ(render(frame(light)), PENUMBRA_ERROR_ARGUMENT);
  light.overrides = overrides.data() + 2;
  light.override_count = 1;
  EXPECT_EQ(render(frame(light)), PENUMBRA_ERROR_REFUSED);
  EXPECT_EQ(penumbra_forward_source(device_, settings_, &light, nullptr, 0, nullptr), PENUMBRA_ERROR_REFUSED);
  EXPECT_EQ(render(right), PENUMBRA_OK) << penumbra_last_error();
}

TEST_F(CInterfaceHostile, OneSizeForAllLightsOfAnArray) {
  std::array<penumbra_light, 2> lights{light(PENUMBRA_SUN), light(PENUMBRA_LAMP)};
  lights[1].id = 1;
  penumbra_frame given = frame(lights[0]);
  given.light_count = 2;
  EXPECT_EQ(render(given), PENUMBRA_OK) << penumbra_last_error();
  lights[1].struct_size += 8;
  EXPECT_EQ(render(given), PENUMBRA_ERROR_ARGUMENT);
  EXPECT_EQ(penumbra_last_error(),
            fmt::format("penumbra_render(): penumbra_light.struct_size is {} in lights[1] and {} in lights[0]",
                        sizeof(penumbra_light) + 8, sizeof(penumbra_light)));
}

}  // namespace
}  // namespace penumbra::test
