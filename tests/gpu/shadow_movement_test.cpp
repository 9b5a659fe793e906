// The movement map marks what moved and nothing else.
#include "shadow/movement_map.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "shadow/shadow_map.h"

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

// A box that moved beside, below and above others, on a ground.
struct Slide {
  TriangleScene all = box_on_ground();
  TriangleScene still, now, last;  // casters that did not move; those that did, at both positions

  explicit Slide(const glm::vec3& by = {0.7f, 0.2f, -0.4f}) {
    all.add_box({-2.5f, 2.5f, 0.5f}, {1.5f, 2.7f, 1.2f});  // hides a part of the moved box from the light
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

  std::vector<float> depth_of(const TriangleScene& scene, const shadow::LightProjection& projection) {
    const Geometry geometry(scene);
    const gl::Texture& map = shadow::shadow_map_target(device, "reference", projection);
    shadow::draw_shadow_map(device, {.map = map, .projection = projection, .draw = geometry.casters()});
    return level_of(map, 0);
  }

  struct How {
    bool second_target = false;
    bool finished_maps = false;  // as if the caller had drawn the maps: then there is no depth to test against
    std::optional<shadow::Box> bounds;
    MovementForm form = MovementForm::maximum;
  };
  const gl::Texture& movement_of(const TriangleScene& scene, const shadow::LightProjection& projection,
                                 const How& how) {
    const Geometry geometry(scene);
    const shadow::DrawCasters draw = [&](const shadow::CasterPass& casters, gl::Pass& pass) {
      drawn.push_back(casters.kind);
      geometry.casters()(casters, pass);
    };
    const gl::Texture& map =
        shadow::movement_target(device, "movement", projection.size(), projection.layers(), how.form);
    const float rubbish = 1;
    for (int level = 0; level < map.desc().levels; ++level) {
      gl::glClearTexImage(map.id(), level, GL_RED, GL_FLOAT, &rubbish);
    }
    drawn.clear();
    const gl::Texture& depth = shadow::shadow_map_target(device, "depth", projection);
    shadow::draw_shadow_map(device, {.map = depth,
                                     .projection = projection,
                                     .draw = draw,
                                     .moved = how.second_target ? &map : nullptr,
                                     .moved_bounds = how.bounds});
    shadow::draw_movement(device, {.map = map,
                                   .form = how.form,
                                   .projection = projection,
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
    // Seen from above, the bounding box of the moved caster is no wider than its silhouettes.
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
    // The map is also clear if the inputs do not say that casters moved.
    EXPECT_EQ(count_of(all_levels_of(movement_of(scene, cascades, {.second_target = second})), 0),
              all_levels_of(map).size());
  }
}

TEST_F(ShadowMovement, CascadesWithoutMoversAreClearAndUndrawn) {
  TriangleScene scene = box_on_ground();
  const size_t first = scene.triangles.size();
  scene.add_box({-4.9f, 0, -4.9f}, {-4.7f, 0.1f, -4.7f});  // far outside of the finest cascade
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

}  // namespace
}  // namespace penumbra::test
