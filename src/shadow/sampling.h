#pragma once

#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

namespace penumbra::shadow {

// k's binary digits mirrored about the point, in 0..1 (van der Corput 1935).
float radical_inverse_2(unsigned k);

// `count` points of the unit square, all different, well spread: "hammersley" (k/n, Φ2(k)), centred in its strata, or
// "vogel": the golden-ratio lattice, which maps to Vogel's spiral on a disc.
std::vector<glm::vec2> square_points(std::string_view pattern, int count);

// The same on the unit disc, equal areas to equal areas: Vogel's spiral (Vogel 1979) or the concentric map.
std::vector<glm::vec2> disc_points(std::string_view pattern, int count);

}  // namespace penumbra::shadow
