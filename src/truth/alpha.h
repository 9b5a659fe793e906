#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::truth {

// The alpha channel of a texture's base level, read as GL reads a texture that is magnified: by its wrap modes, the
// nearest texel or the four about a point.
class AlphaTexture {
 public:
  AlphaTexture(const scene::Texture& texture, const scene::Image& image);

  // 0 to 1.
  float at(glm::vec2 uv) const;

 private:
  float texel(int x, int y) const;

  int width_, height_;
  scene::Wrap wrap_s_, wrap_t_;
  bool linear_;
  std::vector<std::uint8_t> alpha_;
};

// Which points of a surface are there: alpha of material × vertex colour × texture against the material's cutoff, as
// the rasteriser's casters (glsl/scene/caster.frag) have it.
class AlphaTest {
 public:
  // Of some triangles of a primitive, which are known by their place in `triangles` from now on. `texture` is the
  // material's base colour, or null if it has none; it must outlive this.
  AlphaTest(const scene::Material& material, const scene::Primitive& primitive, const AlphaTexture* texture,
            std::span<const std::uint32_t> triangles);

  // Whether the point corner 0 + u · (corner 1 − corner 0) + v · (corner 2 − corner 0) of a triangle is there.
  bool passes(std::size_t triangle, float u, float v) const;

 private:
  struct Corner {
    glm::vec2 uv{0};
    float alpha = 1;  // of material and vertex
  };

  const AlphaTexture* texture_;
  float cutoff_;
  std::vector<Corner> corners_;  // three a triangle
};

}  // namespace penumbra::truth
