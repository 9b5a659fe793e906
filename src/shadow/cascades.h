#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "volume.h"

namespace penumbra::shadow {

constexpr int max_cascades = 8;
constexpr int max_cascade_size = 8192;  // texels along a side

// Light space: metres, origin at `anchor` (the camera, so that floats stay exact near it), axes the rows of
// `world_to_light`: x and y across the light, z along its rays, growing away from the light. It is left-handed: the
// matrix is orthogonal with determinant -1.

// Lowest and highest texel of a layer of a shadow map, both included.
struct TexelRange {
  glm::ivec2 first{0}, last{0};

  bool operator==(const TexelRange&) const = default;
  bool contains(const TexelRange& other) const {
    return glm::all(glm::lessThanEqual(first, other.first)) && glm::all(glm::greaterThanEqual(last, other.last));
  }
};

// Bounds in light space; empty (low > high) by default.
struct LightBounds {
  glm::dvec3 low{1e30}, high{-1e30};

  bool empty() const { return low.x > high.x; }
};

// Directions in light space's x and y, along which receivers are measured: the first is the x axis, each other one is
// turned towards the y axis by the same angle more. They share half a turn.
constexpr int measured_directions = 32;

// The receivers that the view's depth texture shows within a slice of the frustum.
struct ReceiverSlice {
  std::uint32_t pixels = 0;                             // that show them; at least 1
  std::array<glm::dvec2, measured_directions> extents;  // x: lowest, y: highest place along each direction, metres
  glm::dvec2 depths{0};                                 // least and greatest, metres

  // Bounds in a light space whose x axis is a measured direction of the first quarter turn.
  LightBounds bounds(int x_axis) const;
};
using VisibleReceivers = std::vector<ReceiverSlice>;  // nearest slice first; not empty

// One cascade: a layer of the shadow map. The map's depth is linear: 0 at near_z, 1 at far_z.
struct Cascade {
  // Light space, metres; by fit_cascades(), whole texels from the world's origin, and CascadeInputs::jitter.
  glm::vec2 center{0};
  glm::vec2 half_extent{1};  // of the layer, metres
  float near_z = 0;  // nearer to the light than every caster that can shadow the cascade, so depths need no clamping
  float far_z = 1;
  glm::dmat4 world_to_clip{1};  // x, y in -1..1, z in 0..1
  // The texels that casters are drawn to; the others are empty (depth 1). Absent: all. See narrow_to_receivers().
  std::optional<TexelRange> drawn;
};

// Where bounds reach so far that maps made for all of it would be too coarse, in metres, see fit_cascades().
// Bounds that reach less far are never cut off.
constexpr double wide_bounds = 1e4;
// How far shadows then reach from the camera, or ten times as far as receivers begin if that is farther.
constexpr double range_in_wide_bounds = 1e3;

// What cascades leave out because bounds are wide.
struct CutOff {
  bool view = false;   // receivers farther from the camera than range_in_wide_bounds
  bool light = false;  // what is nearer to the light than the receivers by more than wide_bounds

  bool operator==(const CutOff&) const = default;
};

// The cascades of a directional light, finest first. Those of fit_cascades() each contain the whole view frustum up to
// their range, or what the view shows of the receivers up to there. So where a receiver's search disc is not within one
// cascade, a coarser cascade contains all of it. Of an engine's own (light_matrices.h) the last contains all others.
struct Cascades {
  glm::dmat3 world_to_light{1};
  double turn = 0;  // of world_to_light about its z axis, from light_axes(), radians
  glm::dvec3 anchor{0};
  int size = 0;  // texels along a side
  std::vector<Cascade> items;
  bool composed = false;  // an engine's: the map of the last one is made from the others' (see sun_projection())
  CutOff cut_off;

  // Width and height of a texel, metres.
  glm::vec2 texel(int index) const {
    return 2.0f * items[static_cast<size_t>(index)].half_extent / static_cast<float>(size);
  }
  // Cascade::drawn, or all texels.
  TexelRange drawn_texels(int index) const {
    return items[static_cast<size_t>(index)].drawn.value_or(TexelRange{glm::ivec2(0), glm::ivec2(size - 1)});
  }
};

struct CascadeInputs {
  glm::mat4 view{1};        // world to view, right-handed, -Z forward
  glm::mat4 projection{1};  // perspective or orthographic; its depth convention does not matter here
  double nearest = 0;       // what the view shows begins there, view depth in metres; not above 0, and below it only
                            // for an orthographic view that shows what lies behind its camera
  glm::vec3 to_light{0, 1, 0};  // world
  float tan_half_angle = 0;     // of the light; a large light and high casters make the last cascade wider
  Box casters;                  // bounds of all casters
  Box receivers;                // bounds of all receivers; limits the last cascade's range
  bool exact_bounds = false;    // both are no larger than what they hold, and nothing is left out
  // Cascades, and texels along a side of each. With `visible` the most cascades, and the most texels of all together:
  // there are fewer and larger ones where that makes the pixels' texels finer in the mean.
  int count = 4;
  int size = 2048;
  bool divides_texels =
      true;  // false: `visible` has maps of that size, too, and of that number if it has as many slices
  float split_blend = 0.75f;  // 0 uniform, 1 logarithmic (Zhang 2006, parallel-split shadow maps, eq. 3)
  // Range of the last cascade, metres from the camera, before it and behind; 0: as far as receivers lie in the view.
  float distance = 0;
  // Absent: the cascades are fitted to the frustum and the receivers' box, and seldom change size. Else they are fitted
  // to these receivers, and `split_blend` has no effect.
  std::optional<VisibleReceivers> visible = {};
  // Those of them that a penumbra may reach; absent: all. Of several cascades all but the last are fitted to these.
  std::optional<VisibleReceivers> near_penumbrae = {};
  bool may_turn = true;  // the x and y axes, to fit `visible`; not for a light whose shape has corners
  // How far each cascade is moved along x and y, in its own texels, 0 to 1: so that frames see edges at other places
  // within a texel.
  glm::dvec2 jitter{0};
  // Bounds of the receivers that `visible` may leave out (min > max: none).
  Box others{glm::vec3(1), glm::vec3(-1)};
};

// The axes of light space as rows: x horizontal, y as close to up as possible, z along the rays; left-handed. `turn`:
// x and y are then turned about z, radians, x towards y.
glm::dmat3 light_axes(const glm::dvec3& to_light, double turn = 0);

// The corner of a projection's frustum at a depth in metres, in view space, for NDC x and y.
glm::dvec3 frustum_corner(const glm::dmat4& projection, double depth, double ndc_x, double ndc_y);

// Cascade::world_to_clip of a cascade whose other members are set.
glm::dmat4 clip_from_world(const Cascades& cascades, const Cascade& cascade);

// The least light-space depth, metres, of the part of a box that is over a cascade; 1e30: none is. `corners`: of the
// box, light space, in the order of Box::corners().
double nearest_within(const Cascade& cascade, const std::array<glm::dvec3, 8>& corners);

// Fits cascades to what the camera sees of the receivers. The inputs must be finite, the matrices invertible.
// Unless the bounds are exact: where receivers reach farther than wide_bounds from the camera, those beyond
// range_in_wide_bounds are left out if no `distance` and no `visible` says how far to go; and so is what lies along the
// light more than wide_bounds before a cascade's receivers or behind them.
Cascades fit_cascades(const CascadeInputs& inputs);

// The column above the drawn part of a cascade, unbounded towards the light. A caster outside of it can't shadow a
// receiver that reads the cascade: a receiver whose search disc is not within the cascade reads a coarser one, and the
// last cascade, which covers the frustum widened by the light's cone up to the highest caster, contains the discs of
// all receivers.
CullVolume cull_volume(const Cascades& cascades, int index);

}  // namespace penumbra::shadow
