// Integers modulo 2^64 of two words against the compiler's own.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "lib/wide.glsl"

namespace penumbra::glsl {
namespace {

uvec2 wide(std::uint64_t a) { return {static_cast<uint>(a), static_cast<uint>(a >> 32)}; }
std::uint64_t number(const uvec2& a) { return static_cast<std::uint64_t>(a.y) << 32 | a.x; }

TEST(Wide, IsTheArithmeticOf64Bits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t a = random() >> (i % 64), b = random() >> (i / 64 % 64);
    const auto small = static_cast<uint>(b);
    ASSERT_EQ(number(wide_add(wide(a), wide(b))), a + b);
    ASSERT_EQ(number(wide_subtract(wide(a), wide(b))), a - b);
    ASSERT_EQ(number(wide_product(static_cast<uint>(a), small)), std::uint64_t{static_cast<uint>(a)} * small);
    ASSERT_EQ(number(wide_times(wide(a), small)), a * small);
    const auto exact = static_cast<double>(a);
    ASSERT_NEAR(static_cast<double>(wide_unsigned(wide(a))), exact, exact * 1.3e-7);
    const auto difference = static_cast<double>(static_cast<std::int64_t>(a - b));
    ASSERT_NEAR(static_cast<double>(wide_signed(wide(a - b))), difference, std::abs(difference) * 1.3e-7);
  }
}

}  // namespace
}  // namespace penumbra::glsl
