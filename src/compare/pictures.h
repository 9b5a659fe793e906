#pragma once

#include "compare/comparison.h"
#include "report/picture.h"

namespace penumbra::compare {

// `display`: RGB, sRGB. Without an error.
ComparedPictures encoded_pictures(const std::vector<std::uint8_t>& display, const std::vector<float>& visibility,
                                  const cli::Size& size);

// The full scale of a scene's error maps, the same for all of them: the smallest of 0.05, 0.1, 0.2, 0.5 and 1 that the
// errors of 99 % of the receivers do not exceed with the best technique. Larger errors have the colour of the scale's
// end.
float error_scale(const ComparedScene& scene);

// Errors as colours: blue where the technique is too dark, red where it is too bright, grey where there is no receiver.
report::ErrorMap error_map(const ComparedPictures& pictures, const std::string& technique, float scale);

}  // namespace penumbra::compare
