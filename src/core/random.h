#pragma once

#include <cstdint>

namespace penumbra {

// Numbers that look random and are the same on every machine: SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable
// pseudorandom number generators"). The standard library's distributions differ from one to another.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint32_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = (state_ ^ (state_ >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<std::uint32_t>((z ^ (z >> 31U)) >> 32U);
  }

  // 0 to 1, 1 excluded.
  double real() { return next() * (1.0 / 4294967296.0); }

  // 0 to count - 1.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * count) >> 32U);
  }

 private:
  std::uint64_t state_;
};

}  // namespace penumbra
