#include "truth/alpha.h"

#include <algorithm>
#include <cmath>

namespace penumbra::truth {

namespace {

// The floor of x. Faster than std::floor, which is a function call on baseline x86-64. For values too large for an int,
// 0 is an acceptable result.
float whole_part(float x) {
  if (!(std::abs(x) < 1e9f)) return 0;
  const auto towards_zero = static_cast<float>(static_cast<int>(x));
  return towards_zero > x ? towards_zero - 1 : towards_zero;
}

// A texture coordinate, wrapped to 0 to 1. Texels beyond the border, which bilinear reads may need, are handled by
// wrapped_texel().
float wrapped(scene::Wrap wrap, float coordinate) {
  if (wrap == scene::Wrap::repeat) {
    coordinate -= whole_part(coordinate);
  } else if (wrap == scene::Wrap::mirrored_repeat) {
    coordinate -= 2 * whole_part(coordinate * 0.5f);
    if (coordinate > 1) coordinate = 2 - coordinate;
  }
  return coordinate > 0 ? std::min(coordinate, 1.0f) : 0.0f;  // 0 for NaN
}

// Texels along a side of a cell, for which bounds are known.
constexpr int cell_size = 4;
// Of the texture's alpha: more than rounding changes the result of a bilinear read.
constexpr float rounding = 1e-5f;

// `texel` is from −1 to `size`, computed from coordinates that wrapped() returned.
int wrapped_texel(scene::Wrap wrap, int texel, int size) {
  if (wrap != scene::Wrap::repeat) return std::clamp(texel, 0, size - 1);
  return texel < 0 ? texel + size : (texel >= size ? texel - size : texel);
}

float cutoff_of(const scene::Material& material) {
  // Same rule as scene/gpu_scene_materials.cpp: a blended surface casts a shadow where its alpha is above a half.
  if (material.alpha_mode == scene::AlphaMode::blend) return std::nextafter(0.5f, 1.0f);
  return material.alpha_cutoff;
}

// On the GPU vertex colours have 16 bits, so alpha is rounded in the same way.
float stored_alpha(float alpha) { return std::round(std::clamp(alpha, 0.0f, 1.0f) * 65535.0f) / 65535.0f; }

}  // namespace

AlphaTexture::AlphaTexture(const scene::Texture& texture, const scene::Image& image)
    : width_(image.width),
      height_(image.height),
      wrap_s_(texture.wrap_s),
      wrap_t_(texture.wrap_t),
      linear_(texture.mag == scene::Filter::linear),
      cells_x_((image.width + cell_size - 1) / cell_size),
      cells_y_((image.height + cell_size - 1) / cell_size) {
  alpha_.reserve(image.rgba.size() / 4);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) alpha_.push_back(image.rgba[i]);
  cells_.reserve(static_cast<std::size_t>(cells_x_) * static_cast<std::size_t>(cells_y_));
  for (int y = 0; y < cells_y_; ++y) {
    for (int x = 0; x < cells_x_; ++x) cells_.push_back(cell_bounds(x, y));
  }
}

// A bilinear read also needs the texels beside the cell.
AlphaTexture::CellBounds AlphaTexture::cell_bounds(int cell_x, int cell_y) const {
  CellBounds bounds;
  const int x0 = cell_x * cell_size, y0 = cell_y * cell_size;
  for (int y = y0 - 1; y <= std::min(y0 + cell_size, height_); ++y) {
    for (int x = x0 - 1; x <= std::min(x0 + cell_size, width_); ++x) {
      const std::uint8_t alpha =
          alpha_[index_of(wrapped_texel(wrap_s_, x, width_), wrapped_texel(wrap_t_, y, height_))];
      bounds.least = std::min(bounds.least, alpha);
      bounds.greatest = std::max(bounds.greatest, alpha);
    }
  }
  return bounds;
}

std::size_t AlphaTexture::index_of(int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
}

float AlphaTexture::texel(int x, int y) const { return static_cast<float>(alpha_[index_of(x, y)]); }

AlphaTexture::Bounds AlphaTexture::bounds_at(glm::vec2 uv) const {
  const auto x = static_cast<int>(wrapped(wrap_s_, uv.x) * static_cast<float>(width_));
  const auto y = static_cast<int>(wrapped(wrap_t_, uv.y) * static_cast<float>(height_));
  const int cell_x = std::min(x / cell_size, cells_x_ - 1), cell_y = std::min(y / cell_size, cells_y_ - 1);
  const CellBounds& cell =
      cells_[static_cast<std::size_t>(cell_y) * static_cast<std::size_t>(cells_x_) + static_cast<std::size_t>(cell_x)];
  return {static_cast<float>(cell.least) / 255.0f - rounding, static_cast<float>(cell.greatest) / 255.0f + rounding};
}

float AlphaTexture::at(glm::vec2 uv) const {
  const float x = wrapped(wrap_s_, uv.x) * static_cast<float>(width_);
  const float y = wrapped(wrap_t_, uv.y) * static_cast<float>(height_);
  if (!linear_) {
    return texel(std::min(static_cast<int>(x), width_ - 1), std::min(static_cast<int>(y), height_ - 1)) / 255.0f;
  }
  const float left = whole_part(x - 0.5f);
  const float low = whole_part(y - 0.5f);
  const int x0 = wrapped_texel(wrap_s_, static_cast<int>(left), width_);
  const int x1 = wrapped_texel(wrap_s_, static_cast<int>(left) + 1, width_);
  const int y0 = wrapped_texel(wrap_t_, static_cast<int>(low), height_);
  const int y1 = wrapped_texel(wrap_t_, static_cast<int>(low) + 1, height_);
  const float s = x - 0.5f - left;
  const float t = y - 0.5f - low;
  const float first = texel(x0, y0) + s * (texel(x1, y0) - texel(x0, y0));
  const float second = texel(x0, y1) + s * (texel(x1, y1) - texel(x0, y1));
  return (first + t * (second - first)) / 255.0f;
}

AlphaTest::AlphaTest(const scene::Material& material, const scene::Primitive& primitive, const AlphaTexture* texture,
                     std::span<const std::uint32_t> triangles)
    : texture_(texture), cutoff_(cutoff_of(material)) {
  const scene::TextureRef& ref = material.base_color_texture;
  const auto& uvs = primitive.uvs[ref.uv_set == 1 ? 1 : 0];
  corners_.reserve(3 * triangles.size());
  for (const std::uint32_t triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = primitive.indices[3 * std::size_t{triangle} + i];
      const glm::vec2 uv = uvs.empty() ? glm::vec2(0) : uvs[vertex];
      const float color = primitive.colors.empty() ? 1 : stored_alpha(primitive.colors[vertex].a);
      corners_.push_back({ref.uv_transform * glm::vec3(uv, 1.0f), material.base_color.a * color});
    }
  }
}

bool AlphaTest::passes(std::size_t triangle, float u, float v) const {
  // Interpolates by differences, so that a value which all corners share stays exact.
  const Corner* c = &corners_[3 * triangle];
  float alpha = c[0].alpha + u * (c[1].alpha - c[0].alpha) + v * (c[2].alpha - c[0].alpha);
  if (texture_ == nullptr) return alpha >= cutoff_;
  const glm::vec2 uv = c[0].uv + u * (c[1].uv - c[0].uv) + v * (c[2].uv - c[0].uv);
  const AlphaTexture::Bounds bounds = texture_->bounds_at(uv);
  if (alpha >= 0 && alpha * bounds.least >= cutoff_) return true;
  if (alpha >= 0 && alpha * bounds.greatest < cutoff_) return false;
  return alpha * texture_->at(uv) >= cutoff_;
}

}  // namespace penumbra::truth
