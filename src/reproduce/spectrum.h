#pragma once

#include <span>
#include <vector>

namespace penumbra::reproduce {

// Power of a picture's frequencies, `size` a side, those near 0 in the middle; the mean is 1 and frequency 0 itself
// counts as 0. By the definition of the discrete Fourier transform, along x and then along y: for small pictures.
std::vector<float> power_spectrum(std::span<const float> pixels, int size);

}  // namespace penumbra::reproduce
