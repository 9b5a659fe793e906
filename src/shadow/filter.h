#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace penumbra::shadow {

// A filter on the packed texels of a mask (see glsl/lib/packed_texel.glsl). Its GLSL file defines
//   uint filtered(ivec2 pixel);
// using the functions of glsl/shadow/drivers/filter.glsl, which is the same for every filter.
struct Filter {
  // What it filters: the mean blocker distance, from which the visibility filter's kernel size is computed later, or
  // the visibility.
  enum class Of { penumbra, visibility };

  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;     // file under glsl/
  Of of = Of::visibility;
  int passes = 1;
  // For each pass, how many pixels it reads to each side of the filtered one, along x and y. In the compute driver a
  // work group loads its pixels with this border into shared memory; if they do not fit into 32 KiB, its invocations
  // read textures instead.
  std::vector<glm::ivec2> border = {};
  // Whether it leaves a texel as it is if neither that one nor any within 2 pixels of it has a blocker distance. Tiles
  // of the picture that hold such texels alone (see list_filter_tiles) need not be filtered then. A filter of blocker
  // distances spreads them at most to neighbouring pixels.
  bool keeps_unblocked = false;
};

}  // namespace penumbra::shadow
