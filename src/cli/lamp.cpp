#include "cli/lamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <vector>

#include "cli/usage.h"

namespace penumbra::cli {

namespace {

constexpr double usual_cone = 40, least_cone = 1e-3;  // degrees
constexpr float brightest = 1e9f;                     // of rgb
constexpr float farthest = 1e9f;                      // of a range, metres
constexpr float inner_share = 0.8f;

std::string text_of(const glm::vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

// What a spot's attributes say before all are known.
struct Spot {
  std::optional<glm::vec3> to;
  std::optional<double> cone, inner;
};

void set(render::LampLight& lamp, Spot& spot, const std::string& option, std::string_view name,
         std::string_view value) {
  const std::string full = fmt::format("{} {}", option, name);
  if (name == "radius") {
    lamp.radius = static_cast<float>(parse_number(full, value, 0, largest_lamp));
  } else if (name == "cd") {
    lamp.intensity *= static_cast<float>(parse_number(full, value, 0, brightest_lamp) / 100);
  } else if (name == "range") {
    lamp.range = static_cast<float>(parse_number(full, value, 0, farthest));
  } else if (name == "rgb") {
    const glm::vec3 color = parse_point(full, value);
    if (glm::any(glm::lessThan(color, glm::vec3(0)))) fail_usage("{} '{}' has a negative part", full, value);
    lamp.intensity *= color;
  } else if (name == "to") {
    spot.to = parse_point(full, value);
  } else if (name == "cone") {
    spot.cone = parse_number(full, value, least_cone, 90);
  } else if (name == "inner") {
    spot.inner = parse_number(full, value, 0, 90);
  } else {
    fail_usage("{}: no attribute '{}'; there are radius, cd, range, rgb, to, cone and inner", option, name);
  }
}

void make_spot(render::LampLight& lamp, const Spot& spot, std::string_view option) {
  if (!spot.to && (spot.cone || spot.inner))
    fail_usage("{}: cone and inner are of a spot, which needs to=X,Y,Z", option);
  if (!spot.to) return;
  const double cone = spot.cone.value_or(usual_cone);
  const glm::vec3 axis = *spot.to - lamp.position;
  if (!(glm::length(axis) > 0)) fail_usage("{}: the lamp stands where it shines to", option);
  lamp.axis = glm::normalize(axis);
  lamp.outer_cone = glm::radians(static_cast<float>(cone));
  lamp.inner_cone = inner_share * lamp.outer_cone;
  if (!spot.inner) return;
  if (*spot.inner > cone) fail_usage("{}: inner={} is wider than the cone of {} degrees", option, *spot.inner, cone);
  lamp.inner_cone = glm::radians(static_cast<float>(*spot.inner));
}

}  // namespace

render::LampLight parse_lamp(std::string_view option, std::string_view text) {
  render::LampLight lamp;
  lamp.position = parse_point(option, text.substr(0, text.find(':')));
  Spot spot;
  std::vector<std::string_view> given;
  for (std::size_t colon = text.find(':'); colon != std::string_view::npos;) {
    const std::size_t end = text.find(':', colon + 1);
    const std::string_view attribute = text.substr(colon + 1, end == std::string_view::npos ? end : end - colon - 1);
    const std::size_t equals = attribute.find('=');
    if (equals == std::string_view::npos) fail_usage("{}: '{}' is not NAME=VALUE", option, attribute);
    const std::string_view name = attribute.substr(0, equals);
    if (std::ranges::find(given, name) != given.end()) fail_usage("{}: {} is given twice", option, name);
    given.push_back(name);
    set(lamp, spot, std::string(option), name, attribute.substr(equals + 1));
    colon = end;
  }
  make_spot(lamp, spot, option);
  return lamp;
}

std::string lamp_text(const render::LampLight& lamp) {
  std::string text = text_of(lamp.position) + fmt::format(":radius={}", lamp.radius);
  const float strongest = std::max({lamp.intensity.r, lamp.intensity.g, lamp.intensity.b});
  if (strongest <= 100 * brightest) {
    text += fmt::format(":rgb={}", text_of(lamp.intensity / 100.0f));
  } else {
    text += fmt::format(":cd={}:rgb={}", std::min(strongest, static_cast<float>(brightest_lamp)),
                        text_of(lamp.intensity / strongest));
  }
  // Exporters write the largest float for a light that reaches everywhere.
  if (lamp.range > 0 && lamp.range <= farthest) text += fmt::format(":range={}", lamp.range);
  if (lamp.axis != glm::vec3(0)) {
    // Far from the origin, a point a metre away would be rounded to another direction.
    const float away = std::max(1.0f, 1e-3f * glm::length(lamp.position));
    text += fmt::format(":to={}:cone={}", text_of(lamp.position + away * lamp.axis),
                        std::max(glm::degrees(lamp.outer_cone), static_cast<float>(least_cone)));
    if (lamp.inner_cone != inner_share * lamp.outer_cone)
      text += fmt::format(":inner={}", glm::degrees(lamp.inner_cone));
  }
  return text;
}

}  // namespace penumbra::cli
