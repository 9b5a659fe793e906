// How the scene draws casters that moved: which fragments are marked, at the present and at the last position, and the
// bounding box of both.
#include <algorithm>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

constexpr int side = 64;  // texels, over the square from -4 to 4

struct Drawn {
  std::vector<float> marks, depth;
};

// A part of the plane. Its texels are those whose centres lie in it.
struct Rectangle {
  glm::vec2 low, high;

  bool holds(int texel) const {
    const glm::vec2 at = (glm::vec2(texel % side, texel / side) + 0.5f) * 8.0f / static_cast<float>(side) - 4.0f;
    return glm::all(glm::greaterThan(at, low)) && glm::all(glm::lessThan(at, high));
  }
};

Rectangle square_at(const glm::vec2& center) { return {center - 1.0f, center + 1.0f}; }
// What is left of a square whose left half has an alpha of 0.
Rectangle right_half_at(const glm::vec2& center) { return {{center.x, center.y - 1}, center + 1.0f}; }

bool any_holds(const std::vector<Rectangle>& rectangles, int texel) {
  return std::any_of(rectangles.begin(), rectangles.end(), [&](const Rectangle& r) { return r.holds(texel); });
}

// Squares that move, deform or do not move within a second; each uses another code path.
class MovedCasters : public RenderTest {
 protected:
  MovedCasters() {
    const auto place = [&](scene::Primitive primitive, const glm::vec2& center, float z = 0) {
      scene::Node& node = add_node(scene, std::move(primitive), glm::mat4(1));
      node.matrix.reset();
      node.transform.translation = {center, z};
      return static_cast<int>(scene.nodes.size()) - 1;
    };
    place(square(), {-2.5f, 2.5f});
    place(square(), {0, -2}, 1);  // hides half of the next one

    const int slides = place(square(), {-2, -2});
    animate({.node = slides, .times = {0, 1}, .values = {-2, -2, 0, -1, -2, 0}});

    scene::Primitive cut_out = square();
    for (const glm::vec3& position : cut_out.positions) cut_out.colors.emplace_back(1, 1, 1, position.x < 0 ? 0 : 1);
    cut_out.material = 0;
    scene.materials.push_back({.alpha_mode = scene::AlphaMode::mask, .alpha_cutoff = 0.5f});
    const int masked = place(std::move(cut_out), {2, 2});
    animate({.node = masked, .times = {0, 1}, .values = {2, 2, 0, 2, 1, 0}});

    scene::Primitive bent = square();
    bent.targets.resize(1);
    bent.targets[0].positions.assign(4, {0.5f, -1, 0});
    const int morphs = place(std::move(bent), {2, -2});
    scene.meshes.back().default_weights = {0};
    animate({.node = morphs, .path = scene::Path::weights, .times = {0, 1}, .values = {0, 1}, .components = 1});
  }

  void animate(scene::AnimationChannel channel) {
    scene.animations.push_back({.name = "move", .channels = {std::move(channel)}, .duration = 1});
  }

  Drawn drawn(scene::CasterSubset casters) {
    const gl::Texture& marks = device.target("marks", {.format = GL_R8, .width = side, .height = side});
    const gl::Texture& depth = device.target("depth", {.format = GL_DEPTH_COMPONENT32F, .width = side, .height = side});
    {
      gl::PassDesc desc{.name = "casters",
                        .depth = gl::Attachment{.texture = &depth, .clear = glm::vec4(1)},
                        .depth_test = gl::DepthTest::less_equal,
                        .depth_write = true};
      clear(device, {.name = "marks", .colors = {{.texture = &marks, .clear = glm::vec4(0)}}});
      if (casters != scene::CasterSubset::all) desc.colors = {{.texture = &marks}};
      gl::Pass pass(device, desc);
      const glm::mat4 world_to_clip =
          glm::translate(glm::scale(glm::mat4(1), glm::vec3(0.25f, 0.25f, -0.1f)), glm::vec3(0, 0, -5));
      gpu_scene->draw_casters(device, pass, casters, {.to_clip = world_to_clip},
                              [](const scene::Bounds&) { return scene::Overlap::all; });
    }
    return {gl::read_floats(marks, 1), gl::read_floats(depth, 1)};
  }

  static void expect_marks(const std::vector<float>& marks, const std::vector<Rectangle>& where) {
    int wrong = 0;
    for (int i = 0; i < side * side; ++i) {
      wrong += marks[static_cast<std::size_t>(i)] != (any_holds(where, i) ? 1.0f : 0.0f) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0);
  }

  scene::Scene scene;
};

TEST_F(MovedCasters, AreMarkedWhereTheyAreAndWhereTheyWere) {
  gpu_scene.emplace(device, scene);
  gpu_scene->pose(device, 0, 1);
  const std::vector<Rectangle> now{square_at({-1, -2}), right_half_at({2, 1}), square_at({2.5f, -3})};
  const std::vector<Rectangle> last{square_at({-2, -2}), right_half_at({2, 2}), square_at({2, -2})};
  const Drawn depth_only = drawn(scene::CasterSubset::all);
  const Drawn all = drawn(scene::CasterSubset::all_and_moved);
  EXPECT_EQ(all.depth, depth_only.depth);
  EXPECT_LT(*std::min_element(all.depth.begin(), all.depth.end()), 1);
  {
    SCOPED_TRACE("all");
    expect_marks(all.marks, {{{-2, -3}, {-1, -1}}, now[1], now[2]});
  }
  {
    SCOPED_TRACE("moved, now");
    expect_marks(drawn(scene::CasterSubset::moved_now).marks, now);
  }
  SCOPED_TRACE("moved, last");
  expect_marks(drawn(scene::CasterSubset::moved_last).marks, last);
}

TEST_F(MovedCasters, BoundsHoldBothPosesAndNothingElse) {
  gpu_scene.emplace(device, scene);
  gpu_scene->pose(device, 0, 1);
  const scene::Bounds bounds = gpu_scene->moved_bounds();
  ASSERT_FALSE(bounds.empty);
  // The morph's box allows for its whole target to either side.
  EXPECT_EQ(bounds.min.x, -3);
  EXPECT_EQ(bounds.max.y, 3);
  EXPECT_LE(bounds.min.y, -4);
  EXPECT_GE(bounds.max.x, 3.5f);
  gpu_scene->pose(device, 1, 1);
  EXPECT_TRUE(gpu_scene->moved_bounds().empty);
  expect_marks(drawn(scene::CasterSubset::all_and_moved).marks, {});
}

}  // namespace
}  // namespace penumbra::test
