#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gl/pass.h"
#include "render/renderer.h"

namespace penumbra::viewer {

// What can be looked at besides the picture: AOVs by name, and "target NAME" for every texture that passes draw to.
struct Inspection {
  std::string what;       // empty: the picture
  bool automatic = true;  // the range is that of the values
  float low = 0, high = 1;
  int layer = 0, level = 0, part = 0;  // of a target; parts_of() has the last
};

// Numbers of a picture, rows top to bottom.
struct Values {
  int width = 0, height = 0, channels = 1;
  std::vector<float> numbers;

  const float* at(int x, int y) const;
};

// How numbers become colours.
enum class ColorScale { grey, heat, rgb, vectors, labels };

struct Look {
  ColorScale scale = ColorScale::heat;
  std::string unit;    // "m"; empty for none
  bool fixed = false;  // its range is known: `low` to `high`
  float low = 0, high = 1;
  std::vector<std::string> labels;  // names of 0, 1, …
};
// How an AOV of this name is to be looked at.
Look look_of(std::string_view aov);
// And all else that there is.
Look look_of(const Inspection& inspection, const gl::Device& device);

// Of the last frame that was drawn; throws Error for names that there are none of.
Values read_values(const Inspection& inspection, const render::Renderer& renderer, const gl::Device& device);

// The range in which values are to be seen: fixed, chosen by hand, or round numbers that hold all finite
// values (beyond 100,000 the largest itself).
struct Range {
  float low = 0, high = 1;
};
Range range_of(const Inspection& inspection, const Look& look, const Values& values);

// 8-bit RGBA, rows bottom to top as OpenGL has them.
std::vector<std::uint8_t> colors_of(const Values& values, const Look& look, const Range& range);
// The colour of one value, 0..1 of a range or a label's index, for legends.
glm::vec3 color_at(ColorScale scale, float value);

// |a - b|, of the channel where it is largest. Both are equally large.
Values difference(const Values& a, const Values& b);

}  // namespace penumbra::viewer
