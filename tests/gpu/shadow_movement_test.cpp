// The movement map marks what moved and nothing else, its pyramid loses no mark, and a look-up misses none.
#include "shadow/movement_map.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "shadow/shadow_map.h"
#include "shared/shadow_block.h"

namespace penumbra::test {
namespace {

using shadow::MovementForm;

constexpr int map_size = 256;

// All layers of a level.
std::vector<float> level_of(const gl::Texture& texture, int level) {
  std::vector<float> all;
  for (int layer = 0; layer < texture.desc().layers; ++layer) {
    const std::vector<float> texels = gl::read_floats(texture, 1, level, layer);
    all.insert(all.end(), texels.begin(), texels.end());
  }
  return all;
}

std::vector<float> all_levels_of(const gl::Texture& texture) {
  std::vector<float> all;
  for (int level = 0; level < texture.desc().levels; ++level) {
    const std::vector<float> texels = level_of(texture, level);
    all.insert(all.end(), texels.begin(), texels.end());
  }
  return all;
}

size_t count_of(const std::vector<float>& texels, float value) {
  return static_cast<size_t>(std::count(texels.begin(), texels.end(), value));
}

// A box that slid beside, below and above others, on a ground.
struct Slide {
  TriangleScene all = box_on_ground();
  TriangleScene still, now, last;  // what stood still; what moved, at either pose

  explicit Slide(const glm::vec3& by = {0.7f, 0.2f, -0.4f}) {
    all.add_box({-2.5f, 2.5f, 0.5f}, {1.5f, 2.7f, 1.2f});  // hides a part of what follows from the light
    still.triangles = all.triangles;
    const size_t first = all.triangles.size();
    all.add_box({-2.6f, 0.2f, -0.3f}, {-1.4f, 0.9f, 1.6f});
    last.triangles.assign(all.triangles.begin() + static_cast<std::ptrdiff_t>(first), all.triangles.end());
    all.move_from(first, by);
    now.triangles.assign(all.triangles.begin() + static_cast<std::ptrdiff_t>(first), all.triangles.end());
  }

  shadow::Cascades cascades(const glm::vec3& to_light) const {
    const shadow::Box box{{-5, 0, -5}, {5, 3, 5}};
    return shadow::fit_cascades({.view = all.view,
                                 .projection = all.projection,
                                 .to_light = to_light,
                                 .casters = box,
                                 .receivers = box,
                                 .count = 3,
                                 .size = map_size});
  }
};

class ShadowMovement : public GpuTest {
 protected:
  ShadowMovement() { Geometry::put_shaders(device.shaders.files()); }

  std::vector<float> depth_of(const TriangleScene& scene, const shadow::Cascades& cascades) {
    const Geometry geometry(scene);
    const gl::Texture& map =
        shadow::draw_shadow_map(device, {.name = "reference", .cascades = cascades, .draw = geometry.casters()});
    return level_of(map, 0);
  }

  struct How {
    bool second_target = false;
    bool finished_maps = false;  // nothing to test against
    std::optional<shadow::Box> bounds;
    MovementForm form = MovementForm::maximum;
  };
  const gl::Texture& movement_of(const TriangleScene& scene, const shadow::Cascades& cascades, const How& how) {
    const Geometry geometry(scene);
    const shadow::DrawCasters draw = [&](const shadow::CasterPass& casters, gl::Pass& pass) {
      drawn.push_back(casters.kind);
      geometry.casters()(casters, pass);
    };
    const gl::Texture& map =
        shadow::movement_target(device, "movement", cascades.size, static_cast<int>(cascades.items.size()), how.form);
    const float rubbish = 1;
    for (int level = 0; level < map.desc().levels; ++level) {
      gl::glClearTexImage(map.id(), level, GL_RED, GL_FLOAT, &rubbish);
    }
    drawn.clear();
    const gl::Texture& depth = shadow::draw_shadow_map(device, {.name = "depth",
                                                                .cascades = cascades,
                                                                .draw = draw,
                                                                .moved = how.second_target ? &map : nullptr,
                                                                .moved_bounds = how.bounds});
    shadow::draw_movement(device, {.map = map,
                                   .form = how.form,
                                   .cascades = cascades,
                                   .draw = draw,
                                   .depth = how.finished_maps ? nullptr : &depth,
                                   .moved = how.bounds,
                                   .present_is_drawn = how.second_target});
    return map;
  }

  size_t passes_of(shadow::CasterKind kind) const {
    return static_cast<size_t>(std::count(drawn.begin(), drawn.end(), kind));
  }

  gl::Device device{gl::ShaderFiles(), gl::Timers::Mode::off};
  std::vector<shadow::CasterKind> drawn;  // by the last movement_of()
};

TEST_F(ShadowMovement, MarksWhatMovedAtBothPosesWhereNothingHidesIt) {
  const Slide slide;
  for (const float elevation : {40.0f, 90.0f}) {
    const shadow::Cascades cascades = slide.cascades(sun_direction(60, elevation));
    const std::vector<float> still = depth_of(slide.still, cascades);
    const std::vector<float> now = depth_of(slide.now, cascades);
    const std::vector<float> last = depth_of(slide.last, cascades);
    const std::vector<float> marks = level_of(movement_of(slide.all, cascades, {}), 0);
    size_t seen_now = 0;
    size_t seen_last = 0;
    size_t hidden = 0;
    size_t wrong = 0;
    for (size_t i = 0; i < marks.size(); ++i) {
      const bool is_now = now[i] < 1 && now[i] <= still[i];
      const bool is_last = last[i] < 1 && last[i] <= std::min(still[i], now[i]);
      wrong += marks[i] != (is_now || is_last ? 1.0f : 0.0f) ? 1 : 0;
      seen_now += is_now ? 1 : 0;
      seen_last += is_last && !is_now ? 1 : 0;
      hidden += std::min(now[i], last[i]) < 1 && !is_now && !is_last ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0u) << elevation;
    EXPECT_GT(seen_now, 500u);
    EXPECT_GT(seen_last, 100u);
    EXPECT_GT(hidden, 100u) << "the test's own scene";
  }
}

TEST_F(ShadowMovement, WithoutDepthHiddenCastersCountToo) {
  const Slide slide;
  const shadow::Cascades cascades = slide.cascades(sun_direction(60, 40));
  const std::vector<float> now = depth_of(slide.now, cascades);
  const std::vector<float> last = depth_of(slide.last, cascades);
  const std::vector<float> marks = level_of(movement_of(slide.all, cascades, {.finished_maps = true}), 0);
  size_t wrong = 0;
  for (size_t i = 0; i < marks.size(); ++i) {
    wrong += marks[i] != (std::min(now[i], last[i]) < 1 ? 1.0f : 0.0f) ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST_F(ShadowMovement, SecondTargetAndBoundsChangeNothing) {
  for (const glm::vec3& by : {glm::vec3(0.7f, 0.2f, -0.4f), glm::vec3(-0.31f, 0, 0.27f), glm::vec3(0.05f, 0.4f, 0)}) {
    const Slide slide(by);
    // From above, the box about what moved is no wider than its silhouettes.
    const glm::vec3 to_light = by.y == 0 ? glm::vec3(0, 1, 0) : sun_direction(60, 40);
    const shadow::Cascades cascades = slide.cascades(to_light);
    for (const MovementForm form : {MovementForm::maximum, MovementForm::average}) {
      const std::vector<float> plain = all_levels_of(movement_of(slide.all, cascades, {.form = form}));
      EXPECT_EQ(passes_of(shadow::CasterKind::moved_now), 3u);
      EXPECT_EQ(passes_of(shadow::CasterKind::moved_last), 3u);
      for (const bool second : {true, false}) {
        for (const bool bounds : {true, false}) {
          How how{.second_target = second, .form = form};
          if (bounds) how.bounds = slide.all.moved();
          EXPECT_EQ(all_levels_of(movement_of(slide.all, cascades, how)), plain) << second << bounds;
          EXPECT_EQ(passes_of(shadow::CasterKind::depth_and_moved) > 0, second);
          EXPECT_EQ(passes_of(shadow::CasterKind::moved_now) > 0, !second);
        }
      }
    }
  }
}

TEST_F(ShadowMovement, WhatDidNotMoveCostsNothing) {
  TriangleScene scene = box_on_ground();
  const shadow::Cascades cascades = Slide().cascades(sun_direction(60, 40));
  for (const bool second : {true, false}) {
    const gl::Texture& map = movement_of(scene, cascades, {.second_target = second, .bounds = scene.moved()});
    EXPECT_EQ(passes_of(shadow::CasterKind::depth), 3u);
    EXPECT_EQ(drawn.size(), 3u) << "no pass of the movement map";
    EXPECT_EQ(count_of(all_levels_of(map), 0), all_levels_of(map).size());
    // Nor do casters that moved mark what is not there: the same where nobody says so.
    EXPECT_EQ(count_of(all_levels_of(movement_of(scene, cascades, {.second_target = second})), 0),
              all_levels_of(map).size());
  }
}

TEST_F(ShadowMovement, CascadesWithoutMoversAreClearAndUndrawn) {
  TriangleScene scene = box_on_ground();
  const size_t first = scene.triangles.size();
  scene.add_box({-4.9f, 0, -4.9f}, {-4.7f, 0.1f, -4.7f});  // far from what the finest cascade holds
  scene.move_from(first, {0.05f, 0, 0});
  scene.view = glm::lookAt(glm::vec3(3, 2, 4), glm::vec3(0), glm::vec3(0, 1, 0));
  Slide setting;
  setting.all.view = scene.view;
  const shadow::Cascades cascades = setting.cascades({0, 1, 0});
  ASSERT_FALSE(shadow::cull_volume(cascades, 0).holds(scene.moved()));
  for (const bool second : {true, false}) {
    const gl::Texture& map = movement_of(scene, cascades, {.second_target = second, .bounds = scene.moved()});
    EXPECT_LT(passes_of(shadow::CasterKind::moved_last), 3u);
    for (int level = 0; level < map.desc().levels; ++level) {
      EXPECT_EQ(count_of(gl::read_floats(map, 1, level, 0), 1), 0u) << level;
      EXPECT_GT(count_of(gl::read_floats(map, 1, level, 2), 1), 0u) << level;
    }
  }
}

TEST_F(ShadowMovement, WhatFellFromBeyondThePresentSceneIsMarked) {
  TriangleScene scene = box_on_ground();
  const size_t first = scene.triangles.size();
  scene.add_box({2, 40, 2}, {3, 41, 3});
  scene.move_from(first, {-1, -40, -5});
  const shadow::Cascades cascades = Slide().cascades({0, 1, 0});
  const std::vector<float> marks = level_of(movement_of(scene, cascades, {.bounds = scene.moved()}), 0);
  const shadow::Cascade& coarsest = cascades.items[2];
  size_t uncovered = 0;
  for (int i = 0; i < map_size * map_size; ++i) {
    const glm::dvec2 texel(i % map_size, i / map_size);
    const glm::dvec4 at = glm::inverse(coarsest.world_to_clip) *
                          glm::dvec4((texel + 0.5) / static_cast<double>(map_size) * 2.0 - 1.0, 0, 1);
    if (at.x < 2.01 || at.x > 2.99 || at.z < 2.01 || at.z > 2.99) continue;
    EXPECT_EQ(marks[static_cast<size_t>(2 * map_size * map_size + i)], 1) << at.x << ", " << at.z;
    ++uncovered;
  }
  EXPECT_GT(uncovered, 20u);
}

// A map with marks that nobody drew, and the pyramid over it.
class MovementPyramid : public ShadowMovement {
 protected:
  const gl::Texture& pyramid_of(const std::vector<std::vector<float>>& layers, int size, MovementForm form) {
    const gl::Texture& map = shadow::movement_target(device, "movement", size, static_cast<int>(layers.size()), form);
    for (size_t i = 0; i < layers.size(); ++i) {
      map.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(layers[i])), 0, static_cast<int>(i));
    }
    shadow::Cascades cascades{.size = size, .items = std::vector<shadow::Cascade>(layers.size())};
    shadow::draw_movement(device, {.map = map,
                                   .form = form,
                                   .cascades = cascades,
                                   .draw = [](const shadow::CasterPass&, gl::Pass&) {},
                                   .present_is_drawn = true});
    return map;
  }

  // Lone texels, the corners among them, and a patch.
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
};

// Which texel of a level has one of level 0.
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
      const bool there = count_of(texels, 0) < texels.size();
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
  queries[gl_GlobalInvocationID.x].seen = movement_seen(vec3(query.position, 0.0), query.radius, 1) ? 1u : 0u;
}
)";

class MovementLookUp : public MovementPyramid {
 protected:
  struct Query {
    glm::vec2 position;
    float radius;
    unsigned seen = 2;
  };

  // In cascade 1 of two, whose map is so many metres wide.
  void look_up(std::vector<Query>& queries, const gl::Texture& map, const glm::vec2& center, float width) {
    const auto size = static_cast<float>(map.width());
    device.shaders.files().put("test/look_up.comp", look_up_text);
    glsl::ShadowBlock block{};
    block.light = {0, 0, 2, size};
    block.cascades[1].map = {center, 1 / width, width / size};
    const gl::Buffer uniforms = gl::Buffer("light", sizeof(block));
    gl::write_value(uniforms, block);
    const gl::Buffer storage = gl::Buffer::of("queries", std::span<const Query>(queries));
    gl::Pass pass(device, {.name = "look up"});
    pass.use({.name = "look up", .compute = "test/look_up.comp", .defines = {{"SAMPLE_ROTATE", "1"}}});
    uniforms.bind_uniform(1);
    storage.bind_storage(0);
    map.bind(10);
    pass.dispatch(static_cast<int>(queries.size()), 1);
    gl::glGetNamedBufferSubData(storage.id(), 0, static_cast<GLsizeiptr>(storage.size()), queries.data());
  }

  shadow::SoftShadows shadows{device};  // its parameters' file
};

// Texels between a point, in texels, and the nearest mark's square: by Euclid, and by the larger of the two axes.
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
