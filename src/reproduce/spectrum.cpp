#include "reproduce/spectrum.h"

#include <complex>
#include <numbers>

namespace penumbra::reproduce {

namespace {

using Values = std::vector<std::complex<double>>;

// The Fourier transform of each row, written as a column.
Values transformed_rows(const Values& rows, int size) {
  Values result(rows.size());
  const auto at = [size](int row, int column) { return static_cast<std::size_t>(row * size + column); };
  Values turns;
  for (int i = 0; i < size; ++i) turns.push_back(std::polar(1.0, -2 * std::numbers::pi * i / size));
  for (int y = 0; y < size; ++y) {
    for (int frequency = 0; frequency < size; ++frequency) {
      std::complex<double> sum = 0;
      for (int x = 0; x < size; ++x) sum += rows[at(y, x)] * turns[static_cast<std::size_t>(frequency * x % size)];
      result[at(frequency, y)] = sum;
    }
  }
  return result;
}

}  // namespace

std::vector<float> power_spectrum(std::span<const float> pixels, int size) {
  Values values(pixels.begin(), pixels.end());
  values = transformed_rows(transformed_rows(values, size), size);
  values.front() = 0;
  double sum = 0;
  for (const std::complex<double>& value : values) sum += std::norm(value);
  const double mean = sum / static_cast<double>(values.size());
  std::vector<float> power(values.size());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int to = (y + size / 2) % size * size + (x + size / 2) % size;
      power[static_cast<std::size_t>(to)] =
          static_cast<float>(std::norm(values[static_cast<std::size_t>(y * size + x)]) / mean);
    }
  }
  return power;
}

}  // namespace penumbra::reproduce
