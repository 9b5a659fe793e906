#include "check_inputs.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "../core/error.h"
#include "check_parts.h"

namespace penumbra::shadow {

namespace {

bool all_finite(const float* values, int count) {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

void check_matrix(std::string_view name, const glm::mat4& matrix) {
  if (!all_finite(glm::value_ptr(matrix), 16)) fail("soft shadows: {} is not finite", name);
  if (glm::determinant(glm::dmat4(matrix)) == 0) fail("soft shadows: {} has no inverse", name);
}

// Where cascades lie and how large pixels are is computed for projections whose x does not depend on view space's y,
// nor y on x, nor w on either.
void check_axes(const glm::dmat4& projection) {
  constexpr double rounding = 1e-5;
  const double least = std::min(std::abs(projection[0][0]), std::abs(projection[1][1]));
  const double others = std::max(
      {std::abs(projection[1][0]), std::abs(projection[0][1]), std::abs(projection[0][3]), std::abs(projection[1][3])});
  if (others > rounding * least || least == 0)
    fail(
        "soft shadows: the projection matrix turns or skews the picture: it may only scale and shift x and y; turn the "
        "view matrix instead");
}

// Shadows are computed in view space, in metres. It may be mirrored, as for a planar reflection.
void check_view(const View& view) {
  check_matrix("the view matrix", view.view);
  constexpr double rounding = 1e-3;
  const glm::dmat4 given(view.view);
  const glm::dmat3 turn(given);
  const glm::dmat3 apart = glm::transpose(turn) * turn - glm::dmat3(1);
  double most = 0;
  for (int i = 0; i < 9; ++i) most = std::max(most, std::abs(apart[i / 3][i % 3]));
  const glm::dvec4 last_row = glm::abs(glm::row(given, 3) - glm::dvec4(0, 0, 0, 1));
  if (most > rounding || glm::any(glm::greaterThan(last_row, glm::dvec4(rounding))))
    fail(
        "soft shadows: the view matrix does more than turn, mirror and move: it must be column-major and have no "
        "scale");
  check_matrix("the projection matrix", view.projection);
  if (view.projection[2][3] > 0)
    fail("soft shadows: the projection is of a camera that looks along +z; in view space it must look along -z");
  check_axes(glm::dmat4(view.projection));
}

void check_finite(std::string_view name, const Box& box) {
  if (!all_finite(glm::value_ptr(box.min), 3) || !all_finite(glm::value_ptr(box.max), 3)) {
    fail("soft shadows: the bounding box of the {} is not finite", name);
  }
}

void check_box(std::string_view name, const Box& box) {
  check_finite(name, box);
  if (glm::any(glm::greaterThan(box.min, box.max))) fail("soft shadows: the bounding box of the {} is empty", name);
}

void check_lights(const Inputs& inputs, TextureChecks& checks) {
  bool draws = false;
  for (const Light& light : inputs.lights) {
    if (!light.maps && !inputs.draw)
      fail("soft shadows: light {} has no maps and there is no caster callback", light.id);
    if (const std::string fault = fault_of(light.source); !fault.empty())
      fail("soft shadows: light {} {}", light.id, fault);
    for (const Light& other : inputs.lights) {
      if (&other != &light && other.id == light.id) fail("soft shadows: two lights have the id {}", light.id);
    }
    check_maps(light, checks);
    draws = draws || !light.maps;
  }
  if (!draws) return;
  check_box("casters", inputs.casters);
  check_box("receivers", inputs.receivers);
}

void check_viewport(const Rect& rect, const TextureView& depth) {
  if (rect == Rect{}) return;
  const bool inside = rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
                      rect.width <= depth.width - rect.x && rect.height <= depth.height - rect.y;
  if (!inside) {
    fail("soft shadows: the viewport of {}×{} at {}, {} is not a part of {}×{}", rect.width, rect.height, rect.x,
         rect.y, depth.width, depth.height);
  }
}

}  // namespace

void check(const Inputs& inputs) {
  TextureChecks nothing_known;
  check(inputs, nothing_known);
}

void check(const Inputs& inputs, TextureChecks& checks) {
  checks.begin();
  check_view(inputs.view);
  check_conventions(inputs.view.projection, inputs.conventions);
  if (!all_finite(glm::value_ptr(inputs.view.jitter), 2)) fail("soft shadows: the jitter is not finite");
  if (glm::any(glm::greaterThan(glm::abs(inputs.view.jitter), glm::vec2(1))))
    fail("soft shadows: the jitter moves the picture by more than half its size");
  check_depth(inputs.depth, checks);
  check_normals(inputs, checks);
  check_motion(inputs, checks);
  check_viewport(inputs.viewport, inputs.depth);
  const Box& forward = inputs.forward_receivers;
  if (!glm::all(glm::greaterThan(forward.min, forward.max))) check_box("forward receivers", forward);
  const bool none_moved = inputs.moved && glm::all(glm::greaterThan(inputs.moved->min, inputs.moved->max));
  if (inputs.moved && !none_moved) check_box("moved casters", *inputs.moved);
  check_lights(inputs, checks);
  check_outputs(inputs, checks);
}

Rect viewport_of(const Inputs& inputs) {
  return inputs.viewport == Rect{} ? Rect{0, 0, inputs.depth.width, inputs.depth.height} : inputs.viewport;
}

}  // namespace penumbra::shadow
