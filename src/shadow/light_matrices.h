#pragma once

#include <glm/glm.hpp>
#include <span>

#include "light_projection.h"

namespace penumbra::shadow {

// A sun's shadow maps that the caller draws with matrices of its own, as cascades or as a single map.
struct SunMatrices {
  // From world space to each layer's clip space, finest layer first; 1 to max_layers of them. Orthographic: x, y in
  // -1..1 within the map, z growing away from the light. A receiver reads the first layer that holds its search disc,
  // so layers may overlap or contain each other. In the last one receivers look first for how near to the light casters
  // can be: if it does not hold all others, the projection gets one more that does, whose map is made from the given
  // ones in each frame. What lies beyond a far plane casts and receives no shadow.
  std::span<const glm::mat4> world_to_clip;
  bool depth_zero_to_one = true;  // clip-space z in 0..1; else -1..1
  bool reversed = false;          // the map stores 1 near and 0 far; else 0 near and 1 far: see FinishedMaps::reversed
  glm::vec3 to_light{0, 1, 0};    // as in Sun
  int size = 0;                   // width and height of each layer, texels
  glm::vec3 camera{0};            // world: positions near it are kept most exact
  // World bounds of all casters in the maps. What lies before a map's near plane has been clamped to it or cut off, so
  // that its distance from receivers, and with it the penumbra's width, is lost. The default, an empty box (min > max),
  // says that the caller knows of none.
  Box casters{glm::vec3(1), glm::vec3(-1)};
};

// The projection of these maps, for FinishedMaps::projection. Throws Error, in one line that names the layer, where
// they can't serve:
//   - perspective or otherwise warped maps, such as trapezoidal or light-space perspective ones, and skewed ones;
//   - maps that do not look along the sun's rays to a quarter of a texel, are mirrored, are turned against each other,
//     or store 1 near the light and are not said to be reversed;
//   - maps whose near plane lies behind casters above them;
//   - max_layers of them, of which the last does not hold the others, or begins farther from the light than one of
//   them;
//   - a finer layer behind a coarser one, input that is not finite, a wrong number of layers or size.
// With a square sun, render() refuses maps whose x axis is not horizontal: the square is that of light_axes().
LightProjection sun_projection(const SunMatrices& maps);

// How what a given layer's map shows gets into the map of the added one, which holds all.
struct ComposedPart {
  TexelRange texels;  // of the added map: those whose centres the given one holds; none if first > last
  glm::vec4 place;    // xy: scale and zw: offset from texels of the added map to those of the given one
  glm::vec2 depths;   // x: scale and y: offset from stored depths of the given map to those of the added one
  float spread;       // by which stored depths of neighbouring texels of one surface differ at most
};

// `layer`: below LightProjection::given_layers(), of a sun's projection that has one layer more than these.
ComposedPart composed_part(const LightProjection& projection, int layer);

// A spot's shadow map that the caller draws with a matrix of its own.
struct SpotMatrix {
  // From world to clip space: a perspective from the lamp's centre along its axis, of the same angle in x and y, with
  // a near and a far plane. What lies outside of it casts no shadow, so an angle that is wider than the cone serves
  // the penumbrae at the cone's rim.
  glm::mat4 world_to_clip{1};
  bool depth_zero_to_one = true;  // clip-space z in 0..1; else -1..1
  bool reversed = false;          // the map stores 1 near and 0 far: see FinishedMaps::reversed
  Lamp lamp;                      // with an axis
  int size = 0;                   // width and height, texels
};

// The projection of that map. Throws Error, in one line, where it can't serve: a lamp without an axis, whose light
// reaches all six faces of a cube; an orthographic, skewed, off-centre or mirrored map, or one of unequal angles; one
// that does not look along the spot's axis or from its centre to a quarter of a texel, or spans less than its cone; an
// oblique near plane, no far plane, depths that grow towards the lamp and are not said to be reversed.
LightProjection spot_projection(const SpotMatrix& map);

}  // namespace penumbra::shadow
