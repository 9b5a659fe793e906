#include "truth/masked_casters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "truth/posed_triangle.h"

namespace penumbra::truth {

namespace {

constexpr int block = 4;                // texels
constexpr float margin = 0.5f / block;  // a mask is drawn where it covers texel centres

std::size_t index_of(int x, int y, int side) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
}

// A triangle in units of blocks; z is the stored depth.
struct BlockTriangle {
  std::array<glm::vec3, 3> corners;

  // Whether the block's square, widened by the margin, lies outside of one of the edges.
  bool misses(int x, int y) const {
    const glm::vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec2 a(corners[i]), b(corners[(i + 1) % 3]), c(corners[(i + 2) % 3]);
      const glm::vec2 normal(b.y - a.y, a.x - b.x);
      const float third = glm::dot(c - a, normal), own = glm::dot(center - a, normal);
      const float reach = (0.5f + margin) * (std::abs(normal.x) + std::abs(normal.y));
      if (third > 0 ? own < -reach : own > reach) return true;
    }
    return false;
  }
};

void add(std::vector<float>& blocks, int side, const BlockTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const glm::vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  const glm::ivec2 first(glm::clamp(glm::floor(glm::vec2(low) - margin), 0.0f, static_cast<float>(side)));
  const glm::ivec2 last(glm::clamp(glm::floor(glm::vec2(high) + margin), -1.0f, static_cast<float>(side - 1)));
  const float depth = std::clamp(low.z, 0.0f, 1.0f);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      float& least = blocks[index_of(x, y, side)];
      if (depth < least && !triangle.misses(x, y)) least = depth;
    }
  }
}

void add(std::vector<float>& blocks, int side, const scene::PosedSurface& surface, const glm::mat4& world_to_block) {
  const glm::mat4 to_block = world_to_block * surface.world;
  const std::vector<std::uint32_t>& indices = surface.primitive->indices;
  for (std::size_t i = 0; i < triangle_count(surface); ++i) {
    BlockTriangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner)
      triangle.corners[corner] = glm::vec3(to_block * glm::vec4(surface.positions[indices[3 * i + corner]], 1.0f));
    const glm::vec3 sum = triangle.corners[0] + triangle.corners[1] + triangle.corners[2];
    if (std::isfinite(sum.x + sum.y + sum.z)) add(blocks, side, triangle);
  }
}

std::vector<float> coarser(const std::vector<float>& level, int side) {
  std::vector<float> half(level.size() / 4);
  for (int y = 0; y < side / 2; ++y) {
    for (int x = 0; x < side / 2; ++x) {
      const float* row = &level[index_of(2 * x, 2 * y, side)];
      half[index_of(x, y, side / 2)] = std::min({row[0], row[1], row[side], row[side + 1]});
    }
  }
  return half;
}

}  // namespace

MaskedCasters MaskedCasters::of(const scene::PosedGeometry& geometry, const shadow::LightProjection& projection) {
  const auto masked = [](const scene::PosedSurface& surface) { return surface.casts == scene::CastMode::by_alpha; };
  MaskedCasters casters;
  if (std::ranges::none_of(geometry.surfaces, masked)) return casters;
  casters.side = static_cast<int>(std::bit_ceil(static_cast<unsigned>((projection.size() + block - 1) / block)));
  const float blocks_across = static_cast<float>(projection.size()) / block;
  for (int layer = 0; layer < projection.layers(); ++layer) {
    glm::mat4 to_block(1);
    to_block[0].x = to_block[1].y = 0.5f * blocks_across;
    to_block[3] = glm::vec4(0.5f * blocks_across, 0.5f * blocks_across, 0.0f, 1.0f);
    to_block = to_block * projection.world_to_clip(layer);
    const auto blocks = static_cast<std::size_t>(casters.side) * static_cast<std::size_t>(casters.side);
    std::vector<std::vector<float>>& levels = casters.layers.emplace_back(1, std::vector<float>(blocks, 1.0f));
    for (const scene::PosedSurface& surface : geometry.surfaces) {
      if (masked(surface)) add(levels.front(), casters.side, surface, to_block);
    }
    for (int side = casters.side; side > 1; side /= 2) levels.push_back(coarser(levels.back(), side));
  }
  return casters;
}

}  // namespace penumbra::truth
