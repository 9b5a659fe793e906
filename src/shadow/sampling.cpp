#include "sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "../core/names.h"
#include "../core/random.h"
#include "lib/disc.glsl"

namespace penumbra::shadow {

namespace {

using Points = std::vector<glm::vec2>;

constexpr double golden_ratio = 0.61803398874989484820;

// The point as floats, kept below 1 despite rounding.
glm::vec2 in_square(double x, double y) {
  const float below_one = std::nextafter(1.0f, 0.0f);
  return {std::min(static_cast<float>(x), below_one), std::min(static_cast<float>(y), below_one)};
}

Points vogel(int count, std::uint64_t /*seed*/) {
  Points points;
  for (int k = 0; k < count; ++k)
    points.push_back(in_square((k + 0.5) / count, std::fmod((k + 0.5) * golden_ratio, 1)));
  return points;
}

// Rows of as many cells, as far as the count divides.
Points regular(int count, std::uint64_t /*seed*/) {
  const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(count))));
  Points points;
  for (int row = 0; row < rows; ++row) {
    const int cells = (row + 1) * count / rows - row * count / rows;
    for (int cell = 0; cell < cells; ++cell) points.push_back(in_square((cell + 0.5) / cells, (row + 0.5) / rows));
  }
  return points;
}

Points uniform(int count, std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (int k = 0; k < count; ++k) {
    const double x = random.real();
    points.push_back(in_square(x, random.real()));
  }
  return points;
}

double toroidal_distance(const glm::vec2& a, const glm::vec2& b) {
  double dx = std::abs(static_cast<double>(a.x) - b.x);
  double dy = std::abs(static_cast<double>(a.y) - b.y);
  dx = std::min(dx, 1 - dx);
  dy = std::min(dy, 1 - dy);
  return std::sqrt(dx * dx + dy * dy);
}

// Dart throwing: keeps random points at least `radius` from all earlier ones; after many misses the radius shrinks.
Points throw_darts(int count, double radius, int misses_allowed, double shrinkage, std::uint64_t seed) {
  Random random(seed);
  Points points;
  int misses = 0;
  while (static_cast<int>(points.size()) < count) {
    const double x = random.real();
    const glm::vec2 dart = in_square(x, random.real());
    const bool free = std::ranges::all_of(points, [&](glm::vec2 p) { return toroidal_distance(p, dart) >= radius; });
    if (free) {
      points.push_back(dart);
      misses = 0;
    } else if (++misses == misses_allowed) {
      radius *= shrinkage;
      misses = 0;
    }
  }
  return points;
}

// Distance between the points of the densest packing: a hexagonal lattice.
double packed_distance(int count) { return std::sqrt(2 / (std::sqrt(3.0) * count)); }

// Random packing saturates at 0.78 of the lattice's distance.
Points poisson(int count, std::uint64_t seed) {
  return throw_darts(count, 0.72 * packed_distance(count), 100000, 0.99, seed);
}

Points poisson_hierarchical(int count, std::uint64_t seed) { return throw_darts(count, 0.7, 1000, 0.98, seed); }

Points hammersley(int count, std::uint64_t /*seed*/) {
  Points points;
  for (int k = 0; k < count; ++k) {
    points.push_back(
        in_square((k + 0.5) / count, std::fmod(radical_inverse(2, static_cast<unsigned>(k)) + 0.5 / count, 1)));
  }
  return points;
}

Points halton(int count, std::uint64_t /*seed*/) {
  Points points;
  for (int k = 0; k < count; ++k) {
    points.push_back(
        in_square(radical_inverse(2, static_cast<unsigned>(k)), radical_inverse(3, static_cast<unsigned>(k))));
  }
  return points;
}

struct Pattern {
  const char* name;
  Points (*points)(int count, std::uint64_t seed);
};

constexpr std::array<Pattern, 7> patterns{{{"vogel", vogel},
                                           {"regular", regular},
                                           {"uniform", uniform},
                                           {"poisson", poisson},
                                           {"poisson_hierarchical", poisson_hierarchical},
                                           {"hammersley", hammersley},
                                           {"halton", halton}}};

}  // namespace

const std::vector<std::string>& pattern_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Pattern& pattern : patterns) all.emplace_back(pattern.name);
    return all;
  }();
  return names;
}

double radical_inverse(unsigned base, unsigned k) {
  double value = 0;
  for (double digit = 1.0 / base; k != 0; k /= base, digit /= base) value += digit * (k % base);
  return value;
}

std::vector<glm::vec2> square_points(std::string_view pattern, int count, std::uint64_t seed) {
  const auto* const found = std::ranges::find(patterns, pattern, &Pattern::name);
  if (found == patterns.end()) fail_unknown("pattern", pattern, pattern_names());
  return found->points(count, seed);
}

std::vector<glm::vec2> disc_points(std::string_view pattern, int count, std::uint64_t seed) {
  std::vector<glm::vec2> points;
  for (const glm::vec2& u : square_points(pattern, count, seed)) {
    if (pattern == "vogel") {
      const double angle = 6.283185307179586 * u.y;
      const double radius = std::sqrt(static_cast<double>(u.x));
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    } else {
      points.push_back(glsl::concentric_disc(u));
    }
  }
  return points;
}

double star_discrepancy(std::span<const glm::vec2> points) {
  std::vector<double> xs{1};
  std::vector<double> ys{1};
  for (const glm::vec2& p : points) {
    xs.push_back(p.x);
    ys.push_back(p.y);
  }
  double largest = 0;
  for (const double x : xs) {
    for (const double y : ys) {
      int open = 0;
      int closed = 0;
      for (const glm::vec2& p : points) {
        open += p.x < x && p.y < y ? 1 : 0;
        closed += p.x <= x && p.y <= y ? 1 : 0;
      }
      const auto count = static_cast<double>(points.size());
      largest = std::max({largest, x * y - open / count, closed / count - x * y});
    }
  }
  return largest;
}

double least_toroidal_distance(std::span<const glm::vec2> points) {
  double least = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, toroidal_distance(points[i], points[j]));
  }
  return least;
}

}  // namespace penumbra::shadow
