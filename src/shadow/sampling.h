#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::shadow {

// The point sets, by name:
//   - vogel: the golden-ratio lattice, which maps to Vogel's spiral on a disc (Vogel 1979);
//   - regular: the centres of a grid's cells, which are as square as the count allows;
//   - uniform: independent and uniform;
//   - poisson: dart throwing on the torus (Cook 1986), no two points closer than a radius;
//   - poisson_hierarchical: the same with a radius that shrinks after many misses, so that each prefix is well spread;
//   - hammersley: (k/n, Φ2(k)), centred in its strata;
//   - halton: (Φ2(k), Φ3(k)), of which each prefix is well spread.
const std::vector<std::string>& pattern_names();

// The radical inverse: k's digits in that base, mirrored at the radix point, in 0..1 (van der Corput 1935).
double radical_inverse(unsigned base, unsigned k);

// `count` points of the unit square in [0, 1)², all different. `seed` affects only patterns that use random numbers.
// Throws Error with near names for an unknown pattern.
std::vector<glm::vec2> square_points(std::string_view pattern, int count, std::uint64_t seed = 0);

// The same on the unit disc, by an equal-area mapping: Vogel's spiral for "vogel", the concentric map for the others.
std::vector<glm::vec2> disc_points(std::string_view pattern, int count, std::uint64_t seed = 0);

// Largest difference between the share of points in a box at the origin and the box's area (Niederreiter 1992, section
// 2.1), over all boxes: exact, in time cubic in the count.
double star_discrepancy(std::span<const glm::vec2> points);

// Least distance between two of the points on the torus.
double least_toroidal_distance(std::span<const glm::vec2> points);

}  // namespace penumbra::shadow
