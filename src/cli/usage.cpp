#include "cli/usage.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/names.h"

namespace penumbra::cli {

namespace {

template <class T>
bool parse_whole(std::string_view text, T& value) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

template <std::size_t N>
bool split(std::string_view text, char separator, std::array<std::string_view, N>& parts) {
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t at = text.find(separator);
    if ((at == std::string_view::npos) != (i + 1 == N)) return false;
    parts[i] = text.substr(0, at);
    if (i + 1 < N) text.remove_prefix(at + 1);
  }
  return true;
}

bool parse_in(std::string_view text, double min, double max, double& value) {
  return parse_whole(text, value) && std::isfinite(value) && value >= min && value <= max;
}

bool parse_in(std::string_view text, int min, int max, int& value) {
  return parse_whole(text, value) && value >= min && value <= max;
}

[[noreturn]] void fail_value(std::string_view option, std::string_view text, std::string_view takes) {
  fail_usage("{} can't be '{}': it takes {}", option, text, takes);
}

}  // namespace

double parse_number(std::string_view option, std::string_view text, double min, double max) {
  double value = 0;
  if (!parse_in(text, min, max, value)) fail_value(option, text, fmt::format("a number from {:g} to {:g}", min, max));
  return value;
}

int parse_count(std::string_view option, std::string_view text, int min, int max) {
  int value = 0;
  if (!parse_in(text, min, max, value)) fail_value(option, text, fmt::format("a whole number from {} to {}", min, max));
  return value;
}

void fail_unknown_usage(std::string_view kind, std::string_view name, std::span<const std::string> candidates) {
  try {
    fail_unknown(kind, name, candidates);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

std::string one_of(std::string_view kind, const std::string& text, std::span<const std::string> choices) {
  if (std::ranges::find(choices, text) == choices.end()) fail_unknown_usage(kind, text, choices);
  return text;
}

Size parse_size(std::string_view option, std::string_view text) {
  std::array<std::string_view, 2> parts;
  Size size;
  const bool good = split(text, 'x', parts) && parse_in(parts[0], 1, largest_side, size.width) &&
                    parse_in(parts[1], 1, largest_side, size.height);
  if (!good) fail_value(option, text, fmt::format("WIDTHxHEIGHT, each from 1 to {} pixels", largest_side));
  return size;
}

glm::vec3 parse_point(std::string_view option, std::string_view text) {
  constexpr double farthest = 1e9;  // metres
  std::array<std::string_view, 3> parts;
  glm::dvec3 point{0};
  bool good = split(text, ',', parts);
  for (int i = 0; good && i < 3; ++i)
    good = parse_in(parts[static_cast<std::size_t>(i)], -farthest, farthest, point[i]);
  if (!good) fail_value(option, text, "x,y,z in metres, each at most 1e9 from 0");
  return glm::vec3(point);
}

FrameRange parse_frames(std::string_view option, std::string_view text) {
  constexpr int most = 999'999;
  std::array<std::string_view, 2> parts;
  FrameRange range;
  const bool good = split(text, ':', parts) && parse_in(parts[0], 0, most, range.first) &&
                    parse_in(parts[1], range.first, most, range.last);
  if (!good) fail_value(option, text, fmt::format("FIRST:LAST, whole numbers from 0 to {} in that order", most));
  return range;
}

Direction parse_direction(std::string_view option, std::string_view text) {
  std::array<std::string_view, 2> parts;
  double azimuth = 0, elevation = 0;
  const bool good =
      split(text, ',', parts) && parse_in(parts[0], -360, 360, azimuth) && parse_in(parts[1], -90, 90, elevation);
  if (!good)
    fail_value(option, text, "AZIMUTH,ELEVATION in degrees, from -360 to 360 (from +Z towards +X) and from -90 to 90");
  constexpr double radians = std::numbers::pi / 180.0;
  return {static_cast<float>(azimuth * radians), static_cast<float>(elevation * radians)};
}

}  // namespace penumbra::cli
