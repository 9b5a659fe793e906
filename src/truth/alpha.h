#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::truth {

// The alpha channel of a texture's base level, sampled as OpenGL samples a magnified texture: with its wrap modes, and
// nearest or bilinear filtering.
class AlphaTexture {
 public:
  AlphaTexture(const scene::Texture& texture, const scene::Image& image);

  // 0 to 1.
  float at(glm::vec2 uv) const;

  struct Bounds {
    float least = 0, greatest = 1;
  };
  // Of at() near that place. Takes less time, and settles most alpha tests.
  Bounds bounds_at(glm::vec2 uv) const;

 private:
  // Of the texels that reads in a cell of the texture need.
  struct CellBounds {
    std::uint8_t least = 255, greatest = 0;
  };

  std::size_t index_of(int x, int y) const;
  float texel(int x, int y) const;
  CellBounds cell_bounds(int cell_x, int cell_y) const;

  int width_, height_;
  scene::Wrap wrap_s_, wrap_t_;
  bool linear_;
  std::vector<std::uint8_t> alpha_;
  int cells_x_, cells_y_;
  std::vector<CellBounds> cells_;
};

// The alpha test of a surface: whether alpha of material × vertex colour × texture reaches the material's cutoff, as in
// the rasterised casters (glsl/scene/caster.frag).
class AlphaTest {
 public:
  // Tests the triangles of a primitive that `triangles` lists; passes() takes an index into that list. `texture` is the
  // material's base colour texture, or null if it has none; it must outlive this object.
  AlphaTest(const scene::Material& material, const scene::Primitive& primitive, const AlphaTexture* texture,
            std::span<const std::uint32_t> triangles);

  // Whether the surface is opaque at the point corner 0 + u · (corner 1 − corner 0) + v · (corner 2 − corner 0) of a
  // triangle.
  bool passes(std::size_t triangle, float u, float v) const;

 private:
  struct Corner {
    glm::vec2 uv{0};
    float alpha = 1;  // material alpha × vertex alpha
  };

  const AlphaTexture* texture_;
  float cutoff_;
  std::vector<Corner> corners_;  // three for each triangle
};

}  // namespace penumbra::truth
