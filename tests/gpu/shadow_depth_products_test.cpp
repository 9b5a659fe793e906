// What is made from the depths of a shadow map: sums of which nothing is lost, greatest and least depths.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "gpu/triangle_scene.h"
#include "shadow/pass_context.h"

namespace penumbra::test {
namespace {

constexpr const char* technique_text = R"(
#include "shadow/light.glsl"
float read_radius(Receiver receiver, Light light) { return 0.0; }
Visibility visibility(Receiver receiver, Light light) { return fully_lit(); }
)";

// What the technique "reading" saw of the products, by layer.
std::vector<std::vector<unsigned>> sums;
std::vector<std::vector<std::vector<float>>> greatest;  // and by level
std::vector<std::vector<std::vector<float>>> least;     // two channels: of all texels, and of those beside an edge

void read_products(const shadow::PassContext& context) {
  const gl::Texture& table = context.product("depth_sums");
  const gl::Texture& pyramid = context.product("greatest_depth_pyramid");
  const gl::Texture& least_pyramid = context.product("least_depth_pyramid");
  sums.clear();
  greatest.clear();
  least.clear();
  for (int layer = 0; layer < table.desc().layers; ++layer) {
    sums.push_back(gl::read_uints(table, 4, 0, layer));
    greatest.emplace_back();
    for (int level = 0; level < pyramid.desc().levels; ++level)
      greatest.back().push_back(gl::read_floats(pyramid, 1, level, layer));
    least.emplace_back();
    for (int level = 0; level < least_pyramid.desc().levels; ++level)
      least.back().push_back(gl::read_floats(least_pyramid, 2, level, layer));
  }
}

shadow::Registry registry() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  contents.techniques.push_back({.name = "reading",
                                 .summary = "Reads products back.",
                                 .source = "made up",
                                 .glsl = "test/reading.glsl",
                                 .needs = {"shadow_map", "depth_sums", "greatest_depth_pyramid", "least_depth_pyramid"},
                                 .resolve = read_products});
  return shadow::Registry(std::move(contents));
}

std::vector<float> random_depths(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(0, 1);
  std::vector<float> depths(static_cast<size_t>(size) * static_cast<size_t>(size));
  for (float& depth : depths) depth = any(random);
  depths.front() = 0;
  depths.back() = 1;
  return depths;
}

// Of two depths, the farther one with squares of the nearer one here and there; outside of the map all is empty.
class TwoDepths {
 public:
  TwoDepths(int size, unsigned seed)
      : size_(size), depths_(static_cast<size_t>(size) * static_cast<size_t>(size), far) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> place(-3, size), side(1, 5);
    for (int i = 0; i < 1 + size * size / 150; ++i) {
      const int x0 = place(random), y0 = place(random), x1 = x0 + side(random), y1 = y0 + side(random);
      for (int y = std::max(y0, 0); y < std::min(y1, size); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x1, size); ++x)
          depths_[static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x)] = near;
      }
    }
  }

  const std::vector<float>& all() const { return depths_; }

  // The least depth of the texels from (x0, y0) on, that many along each side.
  float least(int x0, int y0, int side) const {
    float found = 1;
    for (int y = y0; y < y0 + side; ++y) {
      for (int x = x0; x < x0 + side; ++x) found = std::min(found, at(x, y));
    }
    return found;
  }
  // The least depth of the pairs of neighbours of which one lies there, that differ.
  float least_beside_edges(int x0, int y0, int side) const {
    float found = 1;
    const auto add = [&](float a, float b) {
      if (a != b) found = std::min({found, a, b});
    };
    for (int along = 0; along < side; ++along) {
      for (int across = -1; across < side; ++across) {
        add(at(x0 + across, y0 + along), at(x0 + across + 1, y0 + along));
        add(at(x0 + along, y0 + across), at(x0 + along, y0 + across + 1));
      }
    }
    return found;
  }

 private:
  static constexpr float near = 0.25f, far = 0.75f;

  float at(int x, int y) const {
    const bool inside = std::min(x, y) >= 0 && std::max(x, y) < size_;
    return inside ? depths_[static_cast<size_t>(y) * static_cast<size_t>(size_) + static_cast<size_t>(x)] : 1;
  }

  int size_;
  std::vector<float> depths_;
};

// The finest level of the pyramid of least depths, in a square whose side is a power of two.
std::vector<glm::vec2> blocks_of(const TwoDepths& map, int size, const shadow::TexelRange& drawn) {
  const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max((size + 3) / 4, 2))));
  std::vector<glm::vec2> blocks(static_cast<size_t>(side) * static_cast<size_t>(side), glm::vec2(1));
  for (int i = 0; i < side * side; ++i) {
    const glm::ivec2 low = 4 * glm::ivec2(i % side, i / side);
    const shadow::TexelRange read{glm::max(low - 1, glm::ivec2(0)), glm::min(low + 4, glm::ivec2(size - 1))};
    if (!drawn.contains(read)) continue;
    blocks[static_cast<size_t>(i)] = {map.least(low.x, low.y, 4), map.least_beside_edges(low.x, low.y, 4)};
  }
  return blocks;
}

// The next level: the least of 2 × 2.
std::vector<glm::vec2> halved(const std::vector<glm::vec2>& level, int side) {
  std::vector<glm::vec2> halved;
  for (int y = 0; y + 1 < side; y += 2) {
    for (int x = 0; x + 1 < side; x += 2) {
      const auto at = [&](int i, int j) {
        return level[static_cast<size_t>(j) * static_cast<size_t>(side) + static_cast<size_t>(i)];
      };
      halved.push_back(glm::min(glm::min(at(x, y), at(x + 1, y)), glm::min(at(x, y + 1), at(x + 1, y + 1))));
    }
  }
  return halved;
}

class DepthProducts : public GpuTest {
 protected:
  void make(const std::vector<std::vector<float>>& layers, int size, int shrink,
            const std::optional<shadow::TexelRange>& drawn = {}) {
    renderer.device().shaders.files().put("test/reading.glsl", technique_text);
    const gl::Texture maps("maps", {.target = GL_TEXTURE_2D_ARRAY,
                                    .format = GL_R32F,
                                    .width = size,
                                    .height = size,
                                    .layers = static_cast<int>(layers.size())});
    for (size_t i = 0; i < layers.size(); ++i)
      maps.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(layers[i])), 0, static_cast<int>(i));
    // So deep that the light sees an edge wherever stored depths differ.
    const shadow::Cascade deep{.far_z = 1e5f, .drawn = drawn};
    const shadow::Cascades cascades{.size = size, .items = std::vector<shadow::Cascade>(layers.size(), deep)};
    const TriangleScene scene = box_on_ground(8);
    const shadow::Light light{.source = shadow::Sun{scene.to_light},
                              .maps = shadow::FinishedMaps{.depth = {maps.id(), size, size}, .projection = cascades}};
    ParamSet params = renderer.params();
    params.set("technique", std::string("reading"));
    params.set("depth_sums.shrink", shrink);
    renderer.render(scene, params, [&light](shadow::Inputs& inputs) { inputs.lights = std::span(&light, 1); });
  }

  // Sums of depth and of its square over table texels from (x0, y0) up to but without (x1, y1).
  static std::pair<std::uint64_t, std::uint64_t> inside(int layer, int side, int x0, int y0, int x1, int y1) {
    const auto at = [&](int x, int y, size_t channel) -> std::uint64_t {
      if (x == 0 || y == 0) return 0;
      const std::vector<unsigned>& table = sums.at(static_cast<size_t>(layer));
      const size_t texel = 4 * (static_cast<size_t>(y - 1) * static_cast<size_t>(side) + static_cast<size_t>(x - 1));
      return table.at(texel + channel) | static_cast<std::uint64_t>(table.at(texel + channel + 1)) << 32;
    };
    const auto sum = [&](size_t channel) {
      return at(x1, y1, channel) - at(x0, y1, channel) - at(x1, y0, channel) + at(x0, y0, channel);
    };
    return {sum(0), sum(2)};
  }
  // The fixed-point number of depth 1.
  static double most(int size) {
    return std::exp2(std::min(32 - static_cast<int>(std::bit_width(static_cast<unsigned>(size - 1) | 1u)), 24)) - 1;
  }

  TriangleRenderer renderer{registry()};
};

TEST_F(DepthProducts, EachTexelComesBackFromTheTableOfAnySize) {
  for (const int size : {2, 3, 64, 255, 257, 700}) {
    const std::vector<std::vector<float>> layers{random_depths(size, 1), random_depths(size, 2)};
    make(layers, size, 1);
    for (int layer = 0; layer < 2; ++layer) {
      for (int i = 0; i < size * size; ++i) {
        const int x = i % size, y = i / size;
        const auto [depth, square] = inside(layer, size, x, y, x + 1, y + 1);
        const double exact =
            static_cast<double>(layers[static_cast<size_t>(layer)][static_cast<size_t>(i)]) * most(size);
        ASSERT_NEAR(static_cast<double>(depth), exact, 0.51 + exact * 1e-7) << size << ": " << x << ", " << y;
        ASSERT_EQ(square, depth * depth) << size << ": " << x << ", " << y;
      }
    }
  }
}

// Of a map of empty texels the sum of squares is as large as it can be. Blocks of three texels reach beyond these maps.
TEST_F(DepthProducts, EmptyMapsDoNotOverflow) {
  for (const int shrink : {1, 2, 3}) {
    for (const int size : {2, 16, 128, 256, 512}) {
      make({std::vector<float>(static_cast<size_t>(size) * static_cast<size_t>(size), 1.0f)}, size, shrink);
      const int side = (size - 1) / shrink + 1, covered = side * shrink;
      const auto [depth, square] = inside(0, side, 0, 0, side, side);
      const double texels = static_cast<double>(covered) * covered, greatest_depth = most(covered);
      EXPECT_EQ(static_cast<double>(depth), texels * greatest_depth) << size << ", " << shrink;
      EXPECT_NEAR(static_cast<double>(square) / (texels * greatest_depth * greatest_depth), 1, 1e-9)
          << size << ", " << shrink;
    }
  }
}

TEST_F(DepthProducts, RectanglesOfALargeMapAreThoseOfDoubles) {
  constexpr int size = 4096;
  const std::vector<float> depths = random_depths(size, 3);
  for (const int shrink : {2, 3, 8}) {
    make({depths}, size, shrink);
    const int side = size / shrink;  // whole blocks; of the table there can be one more
    const int table_side = (size - 1) / shrink + 1;
    const double greatest_depth = most(table_side * shrink);
    std::mt19937 random(4);
    std::uniform_int_distribution<int> corner(0, side - 1), small(1, 6);
    for (int i = 0; i < 300; ++i) {
      int x0 = corner(random), y0 = corner(random), x1 = x0 + small(random), y1 = y0 + small(random);
      if (i % 3 == 0) x1 = x0 + 1 + corner(random) / 8;
      if (i == 0) x0 = y0 = 0, x1 = y1 = side;
      x1 = std::min(x1, side), y1 = std::min(y1, side);
      double depth = 0, square = 0;
      for (int y = y0 * shrink; y < y1 * shrink; ++y) {
        for (int x = x0 * shrink; x < x1 * shrink; ++x) {
          const double one = static_cast<double>(depths[static_cast<size_t>(y * size + x)]) * greatest_depth;
          depth += one;
          square += one * one;
        }
      }
      const auto [found, found_square] = inside(0, table_side, x0, y0, x1, y1);
      // The roundings of single texels, at most half a step each, add up as those of a random walk.
      const double texels = static_cast<double>(x1 - x0) * (y1 - y0) * shrink * shrink;
      ASSERT_NEAR(static_cast<double>(found), depth, 2 * std::sqrt(texels));
      ASSERT_NEAR(static_cast<double>(found_square), square, 4 * greatest_depth * std::sqrt(texels));
    }
  }
}

TEST_F(DepthProducts, GreatestDepthsAreExactAtEveryLevel) {
  for (const int size : {4, 30, 64, 100}) {
    std::vector<float> depths = random_depths(size, 5);
    for (float& depth : depths) depth *= 0.5f;
    make({depths}, size, 1);
    for (size_t level = 0; level < greatest.at(0).size(); ++level) {
      const std::vector<float>& found = greatest[0][level];
      const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(found.size()))));
      const int block = 4 << level;
      for (int i = 0; i < side * side; ++i) {
        const int x0 = i % side * block, y0 = i / side * block;
        float expected = std::max(x0, y0) + block > size ? 1.0f : 0.0f;
        for (int y = y0; y < std::min(y0 + block, size); ++y) {
          for (int x = x0; x < std::min(x0 + block, size); ++x)
            expected = std::max(expected, depths[static_cast<size_t>(y * size + x)]);
        }
        ASSERT_EQ(found[static_cast<size_t>(i)], expected) << size << ", level " << level << ", " << i;
      }
    }
  }
}

// Of maps that are drawn whole, and of maps that are drawn in part: blocks that are not, or whose neighbouring texels
// are not, count as empty.
TEST_F(DepthProducts, LeastDepthsAndThoseBesideEdgesAreExactAtEveryLevel) {
  for (const int size : {1, 3, 4, 5, 8, 9, 12, 64, 100, 136, 530}) {
    const std::vector<TwoDepths> maps{{size, 6}, {size, 7}, {size, 8}};
    for (const bool in_part : {false, true}) {
      shadow::TexelRange drawn{glm::ivec2(0), glm::ivec2(size - 1)};
      if (in_part) drawn = {{size / 5, size / 3}, {size - 1 - size / 4, size - 1 - size / 7}};
      make({maps[0].all(), maps[1].all(), maps[2].all()}, size, 1, drawn);
      for (size_t layer = 0; layer < 3; ++layer) {
        std::vector<glm::vec2> expected = blocks_of(maps[layer], size, drawn);
        for (size_t level = 0; level < least.at(layer).size(); ++level) {
          const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(expected.size()))));
          const std::vector<float>& found = least[layer][level];
          ASSERT_EQ(found.size(), 2 * expected.size());
          for (int i = 0; i < side * side; ++i) {
            if ((std::max(i % side, i / side) * 4 << level) >= size) continue;  // nothing is read beyond the map
            const auto at = static_cast<size_t>(i);
            ASSERT_EQ(glm::vec2(found[2 * at], found[2 * at + 1]), expected[at])
                << size << (in_part ? " in part" : "") << ", level " << level << ", " << i % side << ", " << i / side;
          }
          expected = halved(expected, side);
        }
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test
