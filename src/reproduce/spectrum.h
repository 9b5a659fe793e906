#pragma once

#include <span>
#include <vector>

namespace penumbra::reproduce {

// The power spectrum of a picture of `size` × `size` pixels, with low frequencies in the middle, scaled to a mean of 1;
// the power at frequency 0 is set to 0. It evaluates the definition of the discrete Fourier transform along x and then
// along y, so it is for small pictures.
std::vector<float> power_spectrum(std::span<const float> pixels, int size);

}  // namespace penumbra::reproduce
