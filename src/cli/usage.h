#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace penumbra::cli {

// A usage error: the command line is wrong. Ends the program with exit code 2.
struct UsageError : Error {
  using Error::Error;
};

template <class... Args>
[[noreturn]] void fail_usage(fmt::format_string<Args...> format, Args&&... args) {
  throw UsageError(fmt::format(format, std::forward<Args>(args)...));
}

// fail_unknown() (core/names.h) as a UsageError.
[[noreturn]] void fail_unknown_usage(std::string_view kind, std::string_view name,
                                     std::span<const std::string> candidates);

struct Size {
  int width = 1280, height = 720;
};

// The largest picture, supersampling included. A frame holds about 64 bytes a pixel.
constexpr int largest_side = 16384;
constexpr long long largest_area = 1LL << 26;

// The most texels of all shadow maps of a light together.
constexpr long long largest_maps = 1LL << 28;

struct FrameRange {
  int first = 0, last = 0;  // inclusive
  int count() const { return last - first + 1; }
};

// Radians.
struct Direction {
  float azimuth = 0;    // from +Z towards +X
  float elevation = 0;  // over the horizon
};

// Parse the values of options. All are strict: unless the whole text is valid, finite and in range, UsageError names
// the option, the text and what the option takes.
double parse_number(std::string_view option, std::string_view text, double min, double max);
int parse_count(std::string_view option, std::string_view text, int min, int max);
Size parse_size(std::string_view option, std::string_view text);            // "1280x720"
glm::vec3 parse_point(std::string_view option, std::string_view text);      // "x,y,z", metres
FrameRange parse_frames(std::string_view option, std::string_view text);    // "A:B"
Direction parse_direction(std::string_view option, std::string_view text);  // "azimuth,elevation", degrees

// Returns the text if it is one of the choices, else calls fail_unknown_usage().
std::string one_of(std::string_view kind, const std::string& text, std::span<const std::string> choices);

}  // namespace penumbra::cli
