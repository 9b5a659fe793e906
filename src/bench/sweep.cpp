#include "bench/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace penumbra::bench {

namespace {

constexpr double million = 1e6;

Point point_of(double at, std::string name) { return {.at = {at}, .names = {std::move(name)}}; }

// Figure 4.13 of Deligiannis 2019.
Sweep taps() {
  constexpr std::array counts{8, 32, 64, 128};
  Sweep sweep{.pass = "shadow mask", .axes = {{"blocker_taps", "taps"}, {"filter_taps", "taps"}}};
  for (const int blocker : counts) {
    for (const int filter : counts) {
      sweep.points.push_back({.at = {static_cast<double>(blocker), static_cast<double>(filter)},
                              .names = {std::to_string(blocker), std::to_string(filter)},
                              .values = {{".blocker_taps", blocker}, {".filter_taps", filter}}});
    }
  }
  return sweep;
}

// Fractions and multiples of the requested size.
Sweep resolution(const SweepLimits& limits) {
  constexpr std::array factors{0.25, 0.5, 1.0, 1.5, 2.0, 3.0};
  constexpr double largest_in_software = 1.0;
  Sweep sweep{.axes = {{.name = "pixels", .unit = "million", .of_names = "size"}}};
  for (const double factor : factors) {
    const auto scaled = [factor](int side) { return std::max(1, static_cast<int>(std::lround(side * factor))); };
    const cli::Size size{scaled(limits.size.width), scaled(limits.size.height)};
    const bool too_large = std::max(size.width, size.height) > std::min(limits.max_texture, cli::largest_side) ||
                           1LL * size.width * size.height > cli::largest_area;
    if ((limits.software && factor > largest_in_software) || too_large) break;
    Point point = point_of(size.width * static_cast<double>(size.height) / million,
                           fmt::format("{}x{}", size.width, size.height));
    if (!sweep.points.empty() && sweep.points.back().at == point.at) continue;  // of a tiny picture
    point.size = size;
    sweep.points.push_back(std::move(point));
  }
  return sweep;
}

Sweep map_size(const SweepLimits& limits) {
  constexpr int smallest = 512, largest = 8192, largest_in_software = 4096;
  Sweep sweep{.axes = {{.name = "map_texels", .unit = "million", .of_names = "map side"}}};
  const int last = std::min(limits.software ? largest_in_software : largest, limits.max_texture);
  for (int side = smallest; side <= last; side *= 2) {
    const double texels = static_cast<double>(side) * side * limits.cascades;
    if (texels > static_cast<double>(cli::largest_maps)) break;
    Point point = point_of(texels / million, std::to_string(side));
    point.values = {{"cascades.size", side}};
    sweep.points.push_back(std::move(point));
  }
  return sweep;
}

Sweep cascades() {
  constexpr int most = 4;
  Sweep sweep{.axes = {{"cascades", ""}}};
  for (int count = 1; count <= most; ++count) {
    Point point = point_of(count, std::to_string(count));
    point.values = {{"cascades.count", count}};
    sweep.points.push_back(std::move(point));
  }
  return sweep;
}

Sweep casters(const SweepLimits& limits) {
  constexpr long long fewest = 1'000, most = 10'000'000, most_in_software = 1'000'000;
  Sweep sweep{.axes = {{.name = "caster_triangles", .unit = "million", .log = true, .of_names = "caster triangles"}}};
  const long long first = limits.own_triangles > 0 ? limits.own_triangles : fewest;
  for (long long triangles = first; triangles <= (limits.software ? most_in_software : most); triangles *= 10) {
    Point point = point_of(static_cast<double>(triangles) / million, std::to_string(triangles));
    point.triangles = triangles;
    sweep.points.push_back(std::move(point));
  }
  if (sweep.points.empty()) fail("the scene alone has {} triangles: too many to measure copies of it", first);
  return sweep;
}

Sweep sun_angle() {
  constexpr std::array angles{0.1, 0.25, 0.53, 1.0, 2.0, 4.0, 8.0};
  Sweep sweep{.axes = {{"sun_angle", "deg"}}};
  for (const double angle : angles) {
    Point point = point_of(angle, fmt::format("{}", angle));
    point.values = {{"sun.angle", static_cast<float>(angle)}};
    sweep.points.push_back(std::move(point));
  }
  return sweep;
}

// Powers of two, and all.
Sweep lights(const SweepLimits& limits) {
  if (limits.lights < 2) fail("one light casts shadows: a sweep of lights needs two or more, which --lamp can add");
  Sweep sweep{.axes = {{"lights", ""}}};
  for (int count = 1; count < 2 * limits.lights; count *= 2) {
    const int drawn = std::min(count, limits.lights);
    Point point = point_of(drawn, std::to_string(drawn));
    point.lights = drawn;
    sweep.points.push_back(std::move(point));
  }
  return sweep;
}

std::string full_name(const std::string& name, const ParamSet& params) {
  return name.starts_with('.') ? params.get_word("technique") + name : name;
}

}  // namespace

const std::vector<std::string>& sweep_names() {
  static const std::vector<std::string> names{"taps",    "resolution", "map_size", "cascades",
                                              "casters", "sun_angle",  "lights"};
  return names;
}

Sweep make_sweep(const std::string& name, const SweepLimits& limits) {
  if (is_of_suns(name) && !limits.sun) fail("no sun shines: a sweep of {} would change nothing", name);
  Sweep sweep{.points = {Point{}}};
  if (name == "taps") sweep = taps();
  if (name == "resolution") sweep = resolution(limits);
  if (name == "map_size") sweep = map_size(limits);
  if (name == "cascades") sweep = cascades();
  if (name == "casters") sweep = casters(limits);
  if (name == "sun_angle") sweep = sun_angle();
  if (name == "lights") sweep = lights(limits);
  sweep.name = name;
  return sweep;
}

bool is_of_suns(const std::string& sweep) { return sweep == "map_size" || sweep == "cascades" || sweep == "sun_angle"; }

std::vector<std::string> swept_params(const std::string& sweep, const ParamSet& params) {
  const Sweep made = make_sweep(sweep, {});
  std::vector<std::string> names;
  for (const auto& [name, value] : made.points.front().values) names.push_back(full_name(name, params));
  return names;
}

ParamSet params_at(const Point& point, const ParamSet& params) {
  ParamSet at = params;
  for (const auto& [name, value] : point.values) {
    const std::string full = full_name(name, params);
    if (!at.contains(full))
      cli::fail_usage("--sweep taps: technique '{}' has no parameter {}", params.get_word("technique"), full);
    at.set(full, value);
  }
  return at;
}

}  // namespace penumbra::bench
