#pragma once

#include <span>
#include <string>
#include <vector>

#include "light_work.h"

namespace penumbra::shadow {

// What "none" is where texels have to become a mask all the same.
const Filter& unfiltered();

struct FilterInputs {
  const Filter& filter;
  const gl::Texture& texels;  // packed, see PackedMask
  const gl::Texture& notes;   // read where the mask is filled
  std::string prefix;         // of the names of its targets
  bool to_mask = false;       // the last pass fills the mask's layer; else packed texels
};

// All passes of a filter; returns what the last one filled.
const gl::Texture& run_filter(const LightWork& work, const FilterInputs& inputs);

// All programs of these filters, under both drivers, and that which only unpacks.
std::vector<LibraryProgram> filter_programs(std::span<const Filter> filters);

}  // namespace penumbra::shadow
