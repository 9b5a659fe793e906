#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/frame.h"

namespace penumbra::render {

// Adds up AOVs over the samples of each pixel, as their Aov::reduction says.
class AovSums {
 public:
  // `names`: FrameInputs::averaged_aovs. Those that can't be averaged are left out, and "color", which is a mean
  // already. `lights`: how many cast shadows.
  AovSums(std::span<const std::string> names, std::size_t lights);

  bool empty() const { return sums_.empty(); }
  bool read_mask() const;

  void add(const FrameParts& sample);
  AovMeans means() const;

 private:
  struct Sum {
    const Aov* aov = nullptr;
    int light = 0;
    std::vector<double> totals;  // of the values that count
    std::vector<int> counts;     // how many these are
  };
  std::vector<Sum> sums_;
};

}  // namespace penumbra::render
