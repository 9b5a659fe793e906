#include "report/number.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace penumbra::report {

namespace {

constexpr std::string_view minus = "\u2212";

std::string not_finite(double value) {
  if (std::isnan(value)) return "–";
  return value > 0 ? "∞" : std::string(minus) + "∞";
}

// Formats digits: "-0.00" becomes "0.00", and a hyphen becomes a minus sign.
std::string with_minus(std::string digits) {
  if (digits.empty() || digits[0] != '-') return digits;
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return (zero ? "" : std::string(minus)) + digits.substr(1);
}

}  // namespace

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? with_minus(fmt::format("{:.{}f}", value, decimals)) : not_finite(value);
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return not_finite(value);
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-4 || size >= 1e6)) return with_minus(fmt::format("{:.{}g}", value, digits));
  const int before = size > 0 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
  std::string text = fmt::format("{:.{}f}", value, std::max(digits - before, 0));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return with_minus(text);
}

}  // namespace penumbra::report
