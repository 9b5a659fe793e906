#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gl/pass.h"
#include "render/renderer.h"

namespace penumbra::viewer {

// What is inspected in place of the picture: an AOV by name, or "target NAME", a texture that passes draw to.
struct Inspection {
  std::string what;       // empty: the picture
  bool over = false;      // mix its colours into the lit picture, instead of showing them alone
  bool automatic = true;  // the range of colours follows the values
  float low = 0, high = 1;
  int layer = 0, level = 0, part = 0;  // of a texture; `part` is an index into parts_of()
};

// Begins to show the cascades as a tint of the lit picture, or ends it.
void toggle_cascade_tint(Inspection& inspection);

// Numbers read back from a texture, rows top to bottom.
struct Values {
  int width = 0, height = 0, channels = 1;
  std::vector<float> numbers;

  const float* at(int x, int y) const;
};

// How numbers become colours.
enum class ColorScale { grey, heat, rgb, vectors, labels };

struct ColorMapping {
  ColorScale scale = ColorScale::heat;
  std::string unit;    // "m"; empty for none
  bool fixed = false;  // the range is always `low` to `high`
  float low = 0, high = 1;
  std::vector<std::string> labels;  // names of 0, 1, …
};
// The colours of an AOV.
ColorMapping mapping_of(std::string_view aov);
// The colours of an AOV or a texture.
ColorMapping mapping_of(const Inspection& inspection, const gl::Device& device);

// Reads them back from the last frame. Throws Error for an unknown name.
Values read_values(const Inspection& inspection, const render::Renderer& renderer, const gl::Device& device);

// The range of values that the colours span: fixed, chosen by the user, or round numbers around all finite values
// (beyond 100,000 the largest itself).
struct Range {
  float low = 0, high = 1;
};
Range range_of(const Inspection& inspection, const ColorMapping& mapping, const Values& values);

// 8-bit RGBA, rows bottom to top as OpenGL has them.
std::vector<std::uint8_t> colors_of(const Values& values, const ColorMapping& mapping, const Range& range);
// The colour of one value, 0..1 of a range or a label's index, for legends.
glm::vec3 color_at(ColorScale scale, float value);

// |a - b|, of the channel where it is largest. Both have the same size.
Values difference(const Values& a, const Values& b);

}  // namespace penumbra::viewer
