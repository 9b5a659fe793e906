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
  enum class Keeps {
    nothing,
    unblocked,  // those with no blocker distance within 2 pixels
    // And those whose kernel is narrower than least_sigma of glsl/shadow/drivers/kernel.glsl or that have no noise, as
    // is_noise_free() there says: those to which kernel_distance() of filter.glsl gives 0.
    narrow
  };

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
  // Which texels it leaves as they are, whatever their visibility: tiles of the picture that hold such texels alone
  // (see list_filter_tiles) need not be filtered. A filter of blocker distances gives a pixel no greater one than it or
  // a neighbour had.
  Keeps keeps = Keeps::nothing;
};

}  // namespace penumbra::shadow
