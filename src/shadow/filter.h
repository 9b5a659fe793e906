#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace penumbra::shadow {

// A filter on the packed texels of a mask (see glsl/lib/packed_texel.glsl). Its GLSL file defines
//   uint filtered(ivec2 pixel);
// in terms of what glsl/shadow/drivers/filter.glsl offers, and nothing there knows its name.
struct Filter {
  // What it changes: the mean blocker distance, before the size of any kernel is taken from it, or the visibility.
  enum class Of { penumbra, visibility };

  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;     // file under glsl/
  Of of = Of::visibility;
  int passes = 1;
  // Pixels that a pass reads to each side of its own, along x and y: what the compute form shares in a group. No more
  // than fits into 32 KiB, else its compute form is the fragment one.
  std::vector<glm::ivec2> reach = {};
};

}  // namespace penumbra::shadow
