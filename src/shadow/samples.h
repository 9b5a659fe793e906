#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "../gl/pass.h"
#include "sampling.h"
#include "technique.h"

namespace penumbra::shadow {

// The values of sampling.scramble and Technique::scramble.
const std::vector<std::string>& scramble_names();

// Whether a technique's sample points are rotated from pixel to pixel (points of a disc), or shifted on the torus
// (points of the unit square).
bool rotates_samples(const Technique& technique, const ParamSet& params);

// Where the noise of a frame is shifted to on the torus: xy of the blocker step, zw of the filter step. Each seed and,
// of steps that shift from frame to frame, each frame adds a point of a lattice (Roberts 2018, "The unreasonable
// effectiveness of quasirandom sequences") that covers the torus evenly.
glm::vec4 noise_shift(const ParamSet& params, int frame);

// The point sets of steps that change from frame to frame are taken in turn: the number of a frame's.
int set_number(const ParamSet& params, int frame);

// Elements of a set's table, two points each: as many as its count parameter's bound allows.
std::size_t table_size(const SampleSet& set, const ParamSet& params);

// GLSL text: the uniform block at `block_samples` with the tables of a technique's sets one after the other, and the
// functions that SampleSet names; empty for a technique without sets.
std::string sample_declarations(const Technique& technique, const ParamSet& params);

// What sample points come from: sets by pattern, and tiles of noise. Keeps what it made.
class Samples {
 public:
  // `prefix`: of its targets' names.
  Samples(gl::Device& device, std::string prefix) : device_(device), prefix_(std::move(prefix)) {}

  // What that block holds.
  std::vector<glm::vec4> tables(const Technique& technique, const ParamSet& params, int set);
  // RG16, 64 × 64; none: one texel, 0.
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
