#include "depth_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check_parts.h"

namespace penumbra::shadow {

namespace {

constexpr double half_ulp = 1.0 / (1 << 24);  // of a 32-bit float, relative

}  // namespace

DepthRounding depth_rounding_of(unsigned texture) {
  const bool is_depth = level_parameter(texture, GL_TEXTURE_DEPTH_SIZE) > 0;
  const GLint bits = level_parameter(texture, is_depth ? GL_TEXTURE_DEPTH_SIZE : GL_TEXTURE_RED_SIZE);
  const GLint type = level_parameter(texture, is_depth ? GL_TEXTURE_DEPTH_TYPE : GL_TEXTURE_RED_TYPE);
  if (type == GL_FLOAT) {
    // Half floats have 11 significant bits; below 2^-14 their spacing is constant.
    return bits >= 32 ? DepthRounding{0, static_cast<float>(half_ulp)} : DepthRounding{0x1p-25f, 0x1p-11f};
  }
  // A whole step: drivers may cut off instead of rounding to the nearest.
  return {static_cast<float>(1 / (std::exp2(bits) - 1)), 0};
}

NdcError ndc_error(const DepthRounding& stored, const Conventions& conventions, const glm::mat4& projection) {
  // z = (a · distance + b) / w, with w the distance for a perspective, else constant. The sum's parts are at most
  // |z| + 2 · (the part that does not depend on the distance once it is divided by w).
  const bool perspective = projection[2][3] != 0;
  const double constant =
      std::abs(perspective ? projection[2][2] / projection[2][3] : projection[3][2] / projection[3][3]);
  // By the caller's matrices, the rasteriser's interpolation and the way back to a position.
  constexpr double roundings = 8;
  const double parts = roundings * half_ulp;
  const double scale = conventions.depth_zero_to_one ? 1 : 2;
  // Where z is in -1..1, it is scaled and moved to 0..1 and back.
  const double moved = conventions.depth_zero_to_one ? 0 : 2 * half_ulp;
  const double offset = conventions.depth_zero_to_one ? 0 : 1;  // stored depths are (z + offset) / scale
  return {static_cast<float>(scale * stored.absolute + offset * stored.relative + moved + 2 * parts * constant),
          static_cast<float>(stored.relative + parts)};
}

std::string depth_warning(const Inputs& inputs, const NdcError& error) {
  const Box& box = inputs.receivers;
  if (glm::any(glm::greaterThan(box.min, box.max))) return "";
  const glm::dmat4 view(inputs.view.view);
  const glm::dmat4 projection(inputs.view.projection);
  if (projection[2][3] == 0) return "";  // equally precise at every distance
  const double distance = std::abs((view * glm::dvec4(0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max)), 1)).z);
  const double w = std::abs(projection[2][3]) * distance;
  const double ndc = (projection[2][2] * distance / projection[2][3] + projection[3][2]) / w;
  // dz/d(distance) = b / (w · distance)
  const double off = (error.absolute + error.relative * std::abs(ndc)) * w * distance / std::abs(projection[3][2]);
  if (!(off > distance / 200)) return "";
  return fmt::format(
      "soft shadows: the depth texture tells positions {:.3g} m from the camera only to {:.2g} m: casters that are "
      "nearer than that to what they shadow cast no shadow there. Move the near plane farther away, or take a depth "
      "format of more bits or reversed Z",
      distance, off);
}

}  // namespace penumbra::shadow
