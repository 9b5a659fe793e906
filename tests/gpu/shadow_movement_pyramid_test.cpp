// The pyramid of a movement map loses no mark, and look-ups find all marks.
#include <algorithm>
#include <random>

#include "gpu/gpu_test.h"
#include "shadow/movement_map.h"
#include "shadow/soft_shadows.h"
#include "shared/shadow_block.h"

namespace penumbra::test {
namespace {

using shadow::MovementForm;

// A movement map whose marks the test uploads instead of drawing them, and the pyramid over it.
class MovementPyramid : public GpuTest {
 protected:
  const gl::Texture& pyramid_of(const std::vector<std::vector<float>>& layers, int size, MovementForm form) {
    const gl::Texture& map = shadow::movement_target(device, "movement", size, static_cast<int>(layers.size()), form);
    for (size_t i = 0; i < layers.size(); ++i) {
      map.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(layers[i])), 0, static_cast<int>(i));
    }
    const shadow::LightProjection projection =
        shadow::Cascades{.size = size, .items = std::vector<shadow::Cascade>(layers.size())};
    shadow::draw_movement(device, {.map = map,
                                   .form = form,
                                   .projection = projection,
                                   .draw = [](const shadow::CasterPass&, gl::Pass&) {},
                                   .present_is_drawn = true});
    return map;
  }

  // Single texels, the corners among them, and a patch.
  static std::vector<float> marks(int size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> any(0, size - 1);
    std::vector<float> texels(static_cast<size_t>(size * size));
    const auto mark = [&](int x, int y) { texels[static_cast<size_t>(y * size + x)] = 1; };
    mark(size - 1, size - 1);
    if (seed % 2 == 0) mark(size - 1, 0);
    for (int i = 0; i < 6; ++i) mark(any(random), any(random));
    for (int i = 0; i < 25; ++i) mark(size / 3 + i % 5, size / 2 + i / 5);
    return texels;
  }

  gl::Device device{gl::ShaderFiles(), gl::Timers::Mode::off};
};

// The texel of a level that covers a texel of level 0.
int texel_over(int base, int size, int level) { return std::min(base >> level, std::max(size >> level, 1) - 1); }

TEST_F(MovementPyramid, MaximumIsExactAtEveryLevelForAnySize) {
  for (const int size : {1, 2, 3, 7, 64, 100, 2048}) {
    std::vector<std::vector<float>> layers;
    for (unsigned i = 0; i < 3; ++i) {
      layers.push_back(size < 8 ? std::vector<float>(static_cast<size_t>(size * size), i == 1 ? 1.0f : 0.0f)
                                : marks(size, i));
    }
    const gl::Texture& map = pyramid_of(layers, size, MovementForm::maximum);
    EXPECT_EQ(std::max(size >> (map.desc().levels - 1), 1), 1);
    for (int layer = 0; layer < 3; ++layer) {
      const std::vector<float>& base = layers[static_cast<size_t>(layer)];
      for (int level = 1; level < map.desc().levels; ++level) {
        const int side = std::max(size >> level, 1);
        std::vector<float> expected(static_cast<size_t>(side * side));
        for (int i = 0; i < size * size; ++i) {
          if (base[static_cast<size_t>(i)] == 0) continue;
          expected[static_cast<size_t>(texel_over(i / size, size, level) * side + texel_over(i % size, size, level))] =
              1;
        }
        EXPECT_EQ(gl::read_floats(map, 1, level, layer), expected) << size << ", level " << level;
      }
    }
  }
}

TEST_F(MovementPyramid, AverageIsTheMeanAndLosesALoneTexelAtLevelNine) {
  for (const int size : {7, 64, 100, 512}) {
    const std::vector<float> base = size < 8 ? std::vector<float>(static_cast<size_t>(size * size), 1) : marks(size, 1);
    const gl::Texture& map = pyramid_of({base}, size, MovementForm::average);
    for (int level = 1; level < map.desc().levels; ++level) {
      const int side = std::max(size >> level, 1);
      std::vector<double> sum(static_cast<size_t>(side * side));
      std::vector<double> count(static_cast<size_t>(side * side));
      for (int i = 0; i < size * size; ++i) {
        const auto at =
            static_cast<size_t>(texel_over(i / size, size, level) * side + texel_over(i % size, size, level));
        sum[at] += base[static_cast<size_t>(i)];
        count[at] += 1;
      }
      const std::vector<float> found = gl::read_floats(map, 1, level);
      for (size_t i = 0; i < found.size(); ++i) {
        // Every level that is stored rounds to 16 bits.
        ASSERT_NEAR(found[i], sum[i] / count[i], 0.51 * level / 65535) << size << ", level " << level << ", " << i;
      }
    }
  }
  std::vector<float> lone(static_cast<size_t>(2048 * 2048));
  lone[1234u * 2048 + 567] = 1;
  for (const MovementForm form : {MovementForm::average, MovementForm::maximum}) {
    const gl::Texture& map = pyramid_of({lone}, 2048, form);
    for (int level = 0; level < map.desc().levels; ++level) {
      const std::vector<float> texels = gl::read_floats(map, 1, level);
      const bool there = std::ranges::any_of(texels, [](float texel) { return texel > 0; });
      EXPECT_EQ(there, form == MovementForm::maximum || level < 9) << level;
    }
  }
}

constexpr const char* look_up_text = R"(
#include "generated/registry0/params.glsl"
#include "shadow/movement.glsl"
layout(local_size_x = 64) in;
struct Query {
  vec2 position;
  float radius;
  uint seen;
};
layout(std430, binding = 0) buffer Queries { Query queries[]; };
void main() {
  Query query = queries[gl_GlobalInvocationID.x];
  Light light = with_layer(frame_light(), 1);
  queries[gl_GlobalInvocationID.x].seen = movement_seen(vec3(query.position, 0.0), query.radius, light) ? 1u : 0u;
}
)";

class MovementLookUp : public MovementPyramid {
 protected:
  struct Query {
    glm::vec2 position;
    float radius;
    unsigned seen = 2;
  };

  // Looks up in cascade 1 of two, whose map is so many metres wide.
  void look_up(std::vector<Query>& queries, const gl::Texture& map, const glm::vec2& center, float width) {
    const auto size = static_cast<float>(map.width());
    device.shaders.files().put("test/look_up.comp", look_up_text);
    glsl::ShadowBlock block{};
    block.layer_count = 2;
    block.map_size = size;
    block.layers[1] = {.center = center,
                       .widths_per_metre = glm::vec2(1 / width),
                       .texel_shares = glm::vec2(1),
                       .texel = width / size};
    const gl::Buffer uniforms = gl::Buffer("light", sizeof(block));
    gl::write_value(uniforms, block);
    const gl::Buffer storage = gl::Buffer::of("queries", std::span<const Query>(queries));
    gl::Pass pass(device, {.name = "look up"});
    pass.use({.name = "look up", .compute = "test/look_up.comp", .defines = {{"SAMPLE_SCRAMBLE", "0"}}});
    uniforms.bind_uniform(1);
    storage.bind_storage(0);
    map.bind(10);
    pass.dispatch(static_cast<int>(queries.size()), 1);
    gl::glGetNamedBufferSubData(storage.id(), 0, static_cast<GLsizeiptr>(storage.size()), queries.data());
  }

  shadow::SoftShadows shadows{device};  // generates the file of the parameters
};

// Distance from a point to the nearest marked texel's square, in texels: Euclidean, and the larger along x or y.
struct Distances {
  float straight = 1e30f, along_axes = 1e30f;
};

Distances nearest_mark(const std::vector<float>& base, int size, const glm::vec2& at) {
  Distances nearest;
  for (int i = 0; i < size * size; ++i) {
    if (base[static_cast<size_t>(i)] == 0) continue;
    const glm::vec2 low(i % size, i / size);
    const glm::vec2 away = glm::max(glm::max(low - at, at - low - 1.0f), 0.0f);
    nearest = {std::min(nearest.straight, glm::length(away)), std::min(nearest.along_axes, std::max(away.x, away.y))};
  }
  return nearest;
}

TEST_F(MovementLookUp, NoMarkWithinTheRadiusIsMissed) {
  const glm::vec2 center(3.5f, -17.25f);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const MovementForm form : {MovementForm::maximum, MovementForm::average}) {
    for (const int size : {64, 100}) {
      const float texel = 0.05f;
      const float width = texel * static_cast<float>(size);
      std::vector<float> base = marks(size, 1);
      const gl::Texture& map = pyramid_of({std::vector<float>(base.size()), base}, size, form);
      std::vector<Query> queries(4096);
      for (Query& query : queries) {
        query = {.position = center + width * (glm::vec2(unit(random), unit(random)) - 0.5f),
                 .radius = texel * std::exp2(unit(random) * 8 - 2)};
      }
      look_up(queries, map, center, width);
      int missed = 0;
      int seen = 0;
      int beyond = 0;
      int clear = 0;
      for (const Query& query : queries) {
        const glm::vec2 at = (query.position - center) / texel + 0.5f * static_cast<float>(size);
        const Distances nearest = nearest_mark(base, size, at);
        const float radius = query.radius / texel;
        const float covering = std::exp2(std::ceil(std::log2(std::max(2 * radius, 1.0f))));
        if (nearest.straight < radius * 0.9999f) {
          ++seen;
          missed += query.seen == 1 ? 0 : 1;
        } else if (nearest.along_axes > radius + 2 * covering) {  // the last texels are up to twice as wide
          ++clear;
          beyond += query.seen == 0 ? 0 : 1;
        }
      }
      EXPECT_EQ(missed, 0) << size;
      EXPECT_EQ(beyond, 0) << size;
      EXPECT_GT(seen, 1000);
      EXPECT_GT(clear, 300);
    }
  }
}

}  // namespace
}  // namespace penumbra::test
