// Makes keys (see sample_keys.h) as Heitz et al. do. Each pixel's errors in the integrals of many test functions,
// half-planes across the unit square, are a vector. Keys start at random, and pixels swap them under simulated
// annealing, to lessen the power of all vectors' low frequencies: the sum over all pairs of pixels of a Gaussian of
// their distance times the product of their vectors. Vectors hold the errors at several numbers of samples. Below the
// least of them, each power of two chooses a digit of `order`, which halves the samples: the pixel takes the half that
// lessens the same sum. Everything is integers, so that results don't depend on the machine.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../core/error.h"
#include "../core/random.h"
#include "sample_keys.h"

namespace penumbra::shadow {

namespace {

constexpr int kernel_radius = 6;  // pixels: farther ones weigh under 1/1000
constexpr int kernel_side = 2 * kernel_radius + 1;
constexpr int self_weight = 256;
constexpr int test_functions = 192;
constexpr int sweeps = 1600;  // tries to swap, per pixel
constexpr double coldest = 1e-3;

using Vector = std::array<std::int32_t, test_functions>;

// Whether each of 256 × 256 cells is in a half-plane; a and b of its a · x + b · y > c have 12 bits.
struct TestFunction {
  std::vector<std::uint8_t> cells;
  int area = 0;  // cells
};

std::vector<TestFunction> make_test_functions(Random& random) {
  std::vector<TestFunction> functions(test_functions);
  for (TestFunction& function : functions) {
    const double angle = 2 * std::numbers::pi * random.real();
    const auto a = std::lround(4096 * std::cos(angle)), b = std::lround(4096 * std::sin(angle));
    const auto across = [&](std::int64_t x, std::int64_t y) { return a * (2 * x + 1) + b * (2 * y + 1); };
    const std::int64_t column = random.below(256), row = random.below(256);
    function.cells.resize(65536);
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        const bool inside = across(x, y) > across(column, row);
        function.cells[static_cast<std::size_t>(256 * y + x)] = inside ? 1 : 0;
        function.area += inside ? 1 : 0;
      }
    }
  }
  return functions;
}

// Errors of a key's first `count` samples; 4096 is 1.
Vector errors_of(const SampleKey& key, int count, const std::vector<TestFunction>& functions) {
  Vector errors{};
  for (int i = 0; i < count; ++i) {
    const glm::u8vec2 point = keyed_points()[static_cast<std::size_t>(i ^ key.order)];
    const auto cell = static_cast<std::size_t>(256 * (point.y ^ key.y) + (point.x ^ key.x));
    for (std::size_t f = 0; f < errors.size(); ++f) errors[f] += functions[f].cells[cell];
  }
  for (std::size_t f = 0; f < errors.size(); ++f) errors[f] = (errors[f] * (65536 / count) - functions[f].area) / 16;
  return errors;
}

// The pixels' vectors for one number of samples, and at each pixel the sum of all under a Gaussian.
class Field {
 public:
  Field(int size, std::vector<Vector> errors) : size_(size), errors_(std::move(errors)), blurred_(errors_.size()) {
    for (int dy = -kernel_radius; dy <= kernel_radius; ++dy) {
      for (int dx = -kernel_radius; dx <= kernel_radius; ++dx)
        kernel_.push_back(static_cast<std::int32_t>(std::lround(self_weight * std::exp(-(dx * dx + dy * dy) / 4.41))));
    }
    for (int pixel = 0; pixel < size * size; ++pixel) add(pixel, at(errors_, pixel));
  }

  // Scales the vectors so that their components' mean square is about `rms`², such that all fields weigh the same.
  static void level(std::vector<Vector>& errors, double rms) {
    std::int64_t squares = 0;
    for (const Vector& vector : errors) squares += dot(vector, vector);
    const double scale =
        rms * std::sqrt(static_cast<double>(errors.size() * test_functions) / static_cast<double>(squares));
    const auto factor = static_cast<std::int64_t>(std::lround(scale * 1024));
    for (Vector& vector : errors) {
      for (std::int32_t& value : vector) value = static_cast<std::int32_t>(value * factor / 1024);
    }
  }

  // Change of the sum over pairs if the two pixels swapped their vectors.
  std::int64_t of_swap(int p, int q) const {
    const Vector &of_p = at(errors_, p), &of_q = at(errors_, q), &blurred_p = at(blurred_, p),
                 &blurred_q = at(blurred_, q);
    std::int64_t across = 0, squares = 0;
    for (std::size_t f = 0; f < test_functions; ++f) {
      const std::int64_t change = of_q[f] - of_p[f];
      across += change * (blurred_p[f] - blurred_q[f]);
      squares += change * change;
    }
    return 2 * across + 2 * squares * (self_weight - weight(p, q));
  }

  // Change of the sum if the pixel's vector became another. Its own length is no pair of pixels.
  std::int64_t of_change(int pixel, const Vector& to) const {
    const Vector &from = at(errors_, pixel), &blurred = at(blurred_, pixel);
    std::int64_t across = 0;
    for (std::size_t f = 0; f < test_functions; ++f)
      across += static_cast<std::int64_t>(to[f] - from[f]) * (blurred[f] - self_weight * from[f]);
    return 2 * across;
  }

  void change(int pixel, const Vector& to) {
    Vector& own = errors_[static_cast<std::size_t>(pixel)];
    Vector difference{};
    for (std::size_t f = 0; f < test_functions; ++f) difference[f] = to[f] - own[f];
    own = to;
    add(pixel, difference);
  }

  void swap(int p, int q) {
    const Vector of_p = at(errors_, p);
    change(p, at(errors_, q));
    change(q, of_p);
  }

  const Vector& errors(int pixel) const { return at(errors_, pixel); }

 private:
  static std::int64_t dot(const Vector& a, const Vector& b) {
    std::int64_t sum = 0;
    for (std::size_t f = 0; f < test_functions; ++f) sum += static_cast<std::int64_t>(a[f]) * b[f];
    return sum;
  }

  static const Vector& at(const std::vector<Vector>& vectors, int pixel) {
    return vectors[static_cast<std::size_t>(pixel)];
  }

  int around(int distance) const { return std::min(distance, size_ - distance); }

  std::int64_t weight(int p, int q) const {
    const int dx = around(std::abs(p % size_ - q % size_)), dy = around(std::abs(p / size_ - q / size_));
    if (dx > kernel_radius || dy > kernel_radius) return 0;
    return kernel_[static_cast<std::size_t>((dy + kernel_radius) * kernel_side + dx + kernel_radius)];
  }

  void add(int pixel, const Vector& vector) {
    for (int i = 0; i < kernel_side * kernel_side; ++i) {
      const int x = (pixel % size_ + i % kernel_side - kernel_radius + size_) % size_;
      const int y = (pixel / size_ + i / kernel_side - kernel_radius + size_) % size_;
      Vector& sum = blurred_[static_cast<std::size_t>(y * size_ + x)];
      const std::int32_t factor = kernel_[static_cast<std::size_t>(i)];
      for (std::size_t f = 0; f < test_functions; ++f) sum[f] += factor * vector[f];
    }
  }

  int size_;
  std::vector<std::int32_t> kernel_;
  std::vector<Vector> errors_, blurred_;
};

std::vector<Vector> all_errors(const std::vector<SampleKey>& keys, int count,
                               const std::vector<TestFunction>& functions) {
  std::vector<Vector> errors;
  for (const SampleKey& key : keys) errors.push_back(errors_of(key, count, functions));
  return errors;
}

void swap_keys(KeyTile& tile, const std::vector<TestFunction>& functions, Random& random, const NoiseProgress& report) {
  std::vector<Field> fields;
  for (const int count : optimised_counts) {
    std::vector<Vector> errors = all_errors(tile.keys, count, functions);
    Field::level(errors, /*rms=*/512);
    fields.emplace_back(tile.size, std::move(errors));
  }
  const auto of_swap = [&](int p, int q) {
    std::int64_t change = 0;
    for (const Field& field : fields) change += field.of_swap(p, q);
    return static_cast<double>(change);
  };
  const auto pixels = static_cast<std::uint32_t>(tile.keys.size());
  const auto any_pixel = [&] { return static_cast<int>(random.below(pixels)); };
  double mean_change = 0;
  constexpr int tries = 1000;
  for (int i = 0; i < tries; ++i) mean_change += std::abs(of_swap(any_pixel(), any_pixel())) / tries;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    // The last sweeps take no step uphill.
    const double progress = static_cast<double>(sweep) / sweeps;
    const double temperature = progress < 0.95 ? 0.25 * mean_change * std::pow(coldest, progress) : 0;
    for (std::uint32_t i = 0; i < pixels; ++i) {
      const int p = any_pixel(), q = any_pixel();
      const double hotness = -std::log(random.real() + 1e-10);
      if (p == q || of_swap(p, q) > temperature * hotness) continue;
      for (Field& field : fields) field.swap(p, q);
      std::swap(tile.keys[static_cast<std::size_t>(p)], tile.keys[static_cast<std::size_t>(q)]);
    }
    if (report) report((sweep + 1.0) / sweeps);
  }
}

// Chooses for each pixel which half of its first 2 · count samples comes first.
void choose_halves(KeyTile& tile, int count, const std::vector<TestFunction>& functions) {
  std::vector<SampleKey> others = tile.keys;
  for (SampleKey& key : others) key.order ^= static_cast<std::uint8_t>(count);
  std::vector<Vector> of_others = all_errors(others, count, functions);
  Field field(tile.size, all_errors(tile.keys, count, functions));
  constexpr int most_sweeps = 60;  // about six are enough
  bool changes = true;
  for (int sweep = 0; sweep < most_sweeps && changes; ++sweep) {
    changes = false;
    for (std::size_t i = 0; i < tile.keys.size(); ++i) {
      const auto pixel = static_cast<int>(i);
      if (field.of_change(pixel, of_others[i]) >= 0) continue;
      const Vector own = field.errors(pixel);
      field.change(pixel, of_others[i]);
      of_others[i] = own;
      std::swap(tile.keys[i], others[i]);
      changes = true;
    }
  }
}

}  // namespace

KeyTile make_sample_keys(int size, std::uint64_t seed, const NoiseProgress& progress) {
  if (size < least_noise_size || size > largest_noise_size || size % least_noise_size != 0) {
    fail("keys of {0} × {0} pixels: the side is a multiple of {1} from {1} to {2}", size, least_noise_size,
         largest_noise_size);
  }
  Random random(seed);
  const std::vector<TestFunction> functions = make_test_functions(random);
  KeyTile tile{.size = size, .keys = {}};
  const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  for (int pixel = 0; pixel < size * size; ++pixel) {
    const std::uint8_t x = byte(), y = byte();
    tile.keys.push_back({.x = x, .y = y, .order = byte()});
  }
  swap_keys(tile, functions, random, progress);
  for (int count = optimised_counts.front() / 2; count >= 1; count /= 2) choose_halves(tile, count, functions);
  return tile;
}

}  // namespace penumbra::shadow
