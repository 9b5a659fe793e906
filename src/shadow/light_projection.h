#pragma once

#include <bitset>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "../core/params.h"
#include "cascades.h"
#include "lamp_maps.h"
#include "volume.h"

namespace penumbra::glsl {
struct ShadowBlock;
}

namespace penumbra::shadow {

// All that depends on the kind of light is declared here and in glsl/shadow/projection, and nowhere else:
// the data that describes a light, the projection of its shadow map, and the uniforms for both.

// A directional light at infinite distance, with parallel rays. Its angular size and shape are the parameters sun.angle
// and sun.shape.
struct Sun {
  glm::vec3 to_light{0, 1, 0};  // world; of any length above 0.5

  bool operator==(const Sun&) const = default;
};

// Lamps are at most this far from the world's origin along each axis, metres: beyond, 32-bit floats hold no lengths
// below 6 cm.
inline constexpr float farthest_lamp = 1e6f;

// A light at a place: a sphere that shines in all directions, or within a spot's cone. How bright it is, and how that
// falls off, is left to the caller.
struct Lamp {
  glm::vec3 position{0};  // of its centre, world, metres
  float radius = 0.03f;   // of the sphere, metres, at most farthest_lamp; 0: hard shadows
  glm::vec3 axis{0};      // in which a spot shines, unit, world; 0: in all directions
  float cone = 0;         // half angle of a spot's cone, radians, above 0 and at most π/2; beyond it the mask is 0
  float range = 0;        // metres: beyond it the mask is 0; 0: unlimited

  bool operator==(const Lamp&) const = default;
};

// Most layers that a shadow map can have.
constexpr int max_layers = 8;
using LayerSet = std::bitset<max_layers>;

// Texels by which receivers may read a map beyond their discs, without bias.normal_offset: at least a block of the
// depth pyramid's base (4), the texel beside it, and the 3 texels beside a receiver's own that techniques read.
constexpr double read_margin = 8;

// The kinds of light.
using LightSource = std::variant<Sun, Lamp>;

// The size of a light's emitter, which causes the penumbra.
struct LightShape {
  float extent = 0;     // of a sun: the tangent of half its angular diameter; of a lamp: its radius, metres
  bool square = false;  // else a disc
  bool lamp = false;    // else a sun

  bool operator==(const LightShape&) const = default;
};

// Takes positions in the world, less `anchor`, to clip space. Where the anchor is near them, that is as precise far
// from the world's origin as at it. The difference must be rounded to floats before it is transformed.
struct AnchoredMatrix {
  glm::mat4 to_clip{1};
  glm::vec3 anchor{0};  // world space, metres

  bool operator==(const AnchoredMatrix&) const = default;
};

// Places the layers of a light's shadow map in the world, and converts their depths. A layer stores 0 at its near plane
// and 1 at its far plane: of a sun a linear function of the depth along its rays, of a lamp one of −1 / depth.
class LightProjection {
 public:
  LightProjection() = default;
  // For a sun: one layer for each cascade.
  LightProjection(Cascades cascades) : maps_(std::move(cascades)) {}  // NOLINT(google-explicit-constructor)
  // For a lamp: one layer, or one for each face of a cube.
  LightProjection(const LampMaps& lamp) : maps_(lamp) {}  // NOLINT(google-explicit-constructor)

  int layers() const;
  // How many layers have a map of the caller's, where it gives maps: all, or all but the last, which is made from them.
  int given_layers() const;
  int size() const;  // side of each layer, texels
  // Width and height of a layer's texel, metres; of a lamp: at the far plane, where texels are largest.
  glm::vec2 texel(int layer) const;
  // Whether they are smaller for receivers nearer to the light.
  bool texels_vary() const;
  // Metres along the light for the whole range of stored depths; of a lamp: as they are spaced at the far plane.
  float depth_range(int layer) const;
  // From world space to clip space of a layer: x and y in -1..1 within the map, z in 0..1, which is the stored depth.
  glm::mat4 world_to_clip(int layer) const;
  // The matrices that casters are drawn with. They give 1 minus that z where drawn_reversed(), and their passes turn it
  // back: see gl::PassDesc::depth_reversed.
  glm::mat4 casters_to_clip(int layer) const;
  AnchoredMatrix anchored_to_clip(int layer) const;
  bool drawn_reversed() const;
  // World space. Casters outside of it can't shadow any receiver that reads the layer.
  CullVolume cull_volume(int layer) const;
  // Casters outside of it can't shadow any receiver of the view.
  CullVolume cull_volume_of_all() const;
  // The texels of a layer that a box in the world may cover, widened by one texel to each side for rounding; none if
  // the box lies outside of the layer.
  std::optional<TexelRange> texels_of(int layer, const Box& world_box) const;
  // The texels that casters are drawn to; the others are empty: no receiver of the view reads them.
  TexelRange drawn_texels(int layer) const;
  void set_drawn_texels(int layer, const TexelRange& texels);
  // What a sun's layers leave out; nothing for a lamp.
  CutOff cut_off() const;
  // Only for a sun; throws std::bad_variant_access for a lamp.
  const Cascades& cascades() const { return std::get<Cascades>(maps_); }

  // Fills those members of the uniform block that describe the projection, for a camera. `moved`: see Inputs::moved.
  void write(glsl::ShadowBlock& block, const glm::dmat4& view_to_world, const std::optional<Box>& moved) const;

  // Why it can't be used, for an error message ("cascade 2 has no extent"); empty if it can.
  std::string fault() const;

 private:
  std::variant<Cascades, LampMaps> maps_;
};

// What fit_projection() fits the layers to.
struct FitInputs {
  glm::mat4 view{1}, projection{1};  // of the camera
  double nearest = 0;                // see CascadeInputs
  Box casters, receivers;
  bool exact_bounds = false;  // see CascadeInputs
  const ParamSet& params;
  // Where the maps are fitted to what the view shows: that, and the bounds of the receivers that it does not hold.
  std::optional<VisibleReceivers> visible = {};
  std::optional<VisibleReceivers> near_penumbrae = {};  // see CascadeInputs
  Box others{glm::vec3(1), glm::vec3(-1)};
  bool divides_texels = true;  // see CascadeInputs
  glm::dvec2 jitter{0};        // of a sun's layers: see CascadeInputs
};

// What receivers of the view may read besides their discs; see narrowed().
struct ReadBounds {
  glm::vec2 jitter{0};       // of the camera, NDC
  std::optional<Box> moved;  // world bounds of moved casters that a history looks for

  bool operator==(const ReadBounds&) const = default;
};

// How many maps of lamps.size the light has; 0 for a sun.
int lamp_map_count(const LightSource& source);

// Homogeneous coordinates in the world: the direction to a sun (w = 0), or the centre of a lamp (w = 1).
glm::vec4 place_of(const LightSource& source);

// From world directions to those of a sun's light space; throws std::bad_variant_access for a lamp.
glm::dmat3 light_axes(const LightSource& source);

// The layers that the parameters ask for, fitted to the view, the receivers and their casters. The inputs must have
// passed check().
LightProjection fit_projection(const LightSource& source, const FitInputs& inputs);
// The same projection, of which only what receivers of the view can read is drawn: see narrow_to_receivers(). Those of
// a lamp are drawn whole: they then stay valid when the camera moves.
LightProjection narrowed(const LightProjection& projection, const LightSource& source, const FitInputs& inputs,
                         const ReadBounds& read);

// Whether the projection can be fitted to what the view's depth texture shows, and whether the parameters ask for that
// (cascades.fit).
bool fits_to_view(const LightSource& source);
bool fits_to_view(const ParamSet& params);

// The size of the light; that of a sun is in the parameters.
LightShape shape_of(const LightSource& source, const ParamSet& params);

// Why the light can't be used, for an error message ("has no direction"); empty if it can.
std::string fault_of(const LightSource& source);

}  // namespace penumbra::shadow
