#pragma once

#include <span>
#include <string>
#include <vector>

#include "light_work.h"

namespace penumbra::shadow {

// A filter that changes nothing: with filter "none" it unpacks the texels into the mask.
const Filter& unfiltered();

struct FilterInputs {
  const Filter& filter;
  const gl::Texture& texels;          // packed, see PackedMask
  const gl::Texture& notes;           // read only by passes that fill the mask
  const PassContext& context;         // whose targets hold what a pass leaves to the next one
  const gl::Buffer* tiles = nullptr;  // see list_filter_tiles(); null: all pixels are filtered
  int number = 0;                     // of the filters that the frame has run before: part of the targets' names
  bool to_mask = false;               // the last pass fills the mask's layer; else packed texels
};

// Whether the filter runs for all pixels, whatever it can change.
bool filters_all_pixels(const LightWork& work, const Filter& filter);
// Runs all passes of a filter; returns the texture that the last one filled.
const gl::Texture& run_filter(const LightWork& work, const FilterInputs& inputs);

// All programs of these filters, as fragment and as compute shaders, and the program that only unpacks.
std::vector<LibraryProgram> filter_programs(std::span<const Filter> filters);

}  // namespace penumbra::shadow
