#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "../gl/pass.h"
#include "light_projection.h"
#include "sampling.h"
#include "technique.h"

namespace penumbra::shadow {

// The values of sampling.scramble and Technique::scramble.
const std::vector<std::string>& scramble_names();

// How a technique's sample points differ from pixel to pixel: by a rotation (points on a disc), by a toroidal shift
// (points in the unit square), or by keys (see sample_keys.h).
enum class Scramble { rotate, shift, keys };
Scramble scramble_of(const Technique& technique, const ParamSet& params, const LightShape& shape);
// All that it can be for some parameters and shape.
std::vector<Scramble> scrambles_of(const Technique& technique);

// How a frame reads its noise texture, for the blocker step and the filter step.
struct NoiseRead {
  glm::vec4 shift{0};                 // toroidal shift of the values; xy: blocker step; zw: filter step
  std::array<glm::ivec4, 2> place{};  // of each step; xy: pixels that are added to the pixel's; z: the texture's frame;
                                      // w: the keys' frame
};
// Each seed and, for steps that shift from frame to frame, each frame adds a point of a lattice (Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences") that covers the torus evenly to the values. Spatiotemporal
// noise goes on to its next frame, and adds a point after its last one; samples by keys go on to the next ones of their
// 256, and seeds move their tile.
NoiseRead noise_read(const ParamSet& params, int frame);

// How many point sets frames take turns with: several where a step changes its set from frame to frame.
int set_count(const ParamSet& params);
// The number of a frame's set, below that.
int set_number(const ParamSet& params, int frame);

// Number of vec4 elements in a set's table: one for each point, up to the maximum of its count parameter. Only xy is
// used, because two points in an element cost a software rasteriser, which loads it for each pixel, twice the reads.
std::size_t table_size(const SampleSet& set, const ParamSet& params);

// GLSL text: the uniform block at `block_samples` with the tables of a technique's sets one after the other, and the
// functions that SampleSet describes; empty for a technique without sets.
std::string sample_declarations(const Technique& technique, const ParamSet& params);

// Makes sample point sets and noise textures, and caches them.
class Samples {
 public:
  // `prefix`: begins the names of its targets.
  Samples(gl::Device& device, std::string prefix) : device_(device), prefix_(std::move(prefix)) {}

  // The contents of the uniform block in sample_declarations().
  struct Tables {
    int set = 0;  // see set_number()
    Scramble scramble = Scramble::shift;
  };
  std::vector<glm::vec4> tables(const Technique& technique, const ParamSet& params, const Tables& of);
  // The noise texture of that kind: RGBA16, 64 × 64, tileable; spatiotemporal: one frame above another; "none": one
  // texel of value 0. R and G: two values, 0 to 1. Where samples differ by keys, these are the coordinates of the first
  // one; B: the key's y · 256 + x; A: its order; both over 65535.
  const gl::Texture& noise(const std::string& kind);

 private:
  using Key = std::tuple<std::string, int, bool, std::uint64_t>;  // pattern, count, on the disc, seed
  const std::vector<glm::vec2>& points(const Key& key);

  gl::Device& device_;
  std::string prefix_;
  std::map<Key, std::vector<glm::vec2>> points_;
  std::map<std::string, const gl::Texture*> noise_;  // by its kind
};

}  // namespace penumbra::shadow
