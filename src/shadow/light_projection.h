#pragma once

#include <bitset>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "../core/params.h"
#include "cascades.h"
#include "volume.h"

namespace penumbra::glsl {
struct ShadowBlock;
}

namespace penumbra::shadow {

// All that depends on the kind of light is declared here and in glsl/shadow/light_projection.glsl, and nowhere else:
// the data that describes a light, the projection of its shadow map, and the uniforms for both.

// A directional light at infinite distance, with parallel rays. Its angular size and shape are the parameters sun.angle
// and sun.shape.
struct Sun {
  glm::vec3 to_light{0, 1, 0};  // unit, world

  bool operator==(const Sun&) const = default;
};

// Most layers that a shadow map can have.
constexpr int max_layers = 8;
using LayerSet = std::bitset<max_layers>;

// Texels by which receivers may read a map beyond their discs, without bias.normal_offset: at least a block of the
// depth pyramid's base (4), the texel beside it, and the 3 texels beside a receiver's own that techniques read.
constexpr double read_margin = 8;

// The kinds of light.
using LightSource = std::variant<Sun>;

// The size of a light's emitter, which causes the penumbra.
struct LightShape {
  float extent = 0;     // of a sun: the tangent of half its angular diameter
  bool square = false;  // else a disc

  bool operator==(const LightShape&) const = default;
};

// Places the layers of a light's shadow map in the world, and converts their depths. A layer stores linear depth along
// the light: 0 at its near plane, 1 at its far plane.
class LightProjection {
 public:
  LightProjection() = default;
  // For a sun: one layer for each cascade.
  LightProjection(Cascades cascades) : cascades_(std::move(cascades)) {}  // NOLINT(google-explicit-constructor)

  int layers() const { return static_cast<int>(cascades_.items.size()); }
  int size() const { return cascades_.size; }  // side of each layer, texels
  // Width and height of a layer's texel, metres.
  glm::vec2 texel(int layer) const { return cascades_.texel(layer); }
  // Distance from a layer's near plane to its far plane along the light, metres.
  float depth_range(int layer) const;
  // From world space to clip space of a layer: x and y in -1..1 within the map, z in 0..1, which is the stored depth.
  glm::mat4 world_to_clip(int layer) const;
  // World space. Casters outside of it can't shadow any receiver that reads the layer.
  CullVolume cull_volume(int layer) const;
  // Casters outside of it can't shadow any receiver of the view.
  CullVolume cull_volume_of_all() const { return cull_volume(layers() - 1); }
  // The texels of a layer that a box in the world may cover, widened by one texel to each side for rounding; none if
  // the box lies outside of the layer.
  std::optional<TexelRange> texels_of(int layer, const Box& world_box) const;
  // The texels that casters are drawn to; the others are empty: no receiver of the view reads them.
  TexelRange drawn_texels(int layer) const { return cascades_.drawn_texels(layer); }
  void set_drawn_texels(int layer, const TexelRange& texels);
  // Only for a sun.
  const Cascades& cascades() const { return cascades_; }

  // Fills those members of the uniform block that describe the projection, for a camera. `moved`: see Inputs::moved.
  void write(glsl::ShadowBlock& block, const glm::dmat4& view_to_world, const std::optional<Box>& moved) const;

  // Why it can't be used, for an error message ("cascade 2 has no extent"); empty if it can.
  std::string fault() const;

 private:
  Cascades cascades_;
};

// What fit_projection() fits the layers to.
struct FitInputs {
  glm::mat4 view{1}, projection{1};  // of the camera
  Box casters, receivers;
  const ParamSet& params;
  // Where the maps are fitted to what the view shows: that, and the bounds of the receivers that it does not hold.
  std::optional<VisibleReceivers> visible = {};
  Box others{glm::vec3(1), glm::vec3(-1)};
};

// What receivers of the view may read besides their discs; see narrowed().
struct ReadBounds {
  glm::vec2 jitter{0};       // of the camera, NDC
  std::optional<Box> moved;  // world bounds of moved casters that a history looks for

  bool operator==(const ReadBounds&) const = default;
};

// From world directions to those of the light's space.
glm::dmat3 light_axes(const LightSource& source);

// The layers that the parameters ask for, fitted to the view, the receivers and their casters. The inputs must have
// passed check().
LightProjection fit_projection(const LightSource& source, const FitInputs& inputs);
// The same projection, of which only what receivers of the view can read is drawn: see narrow_to_receivers().
LightProjection narrowed(const LightProjection& projection, const LightSource& source, const FitInputs& inputs,
                         const ReadBounds& read);

// The size that the parameters give the light.
LightShape shape_of(const LightSource& source, const ParamSet& params);

// Why the light can't be used, for an error message ("has no direction"); empty if it can.
std::string fault_of(const LightSource& source);

}  // namespace penumbra::shadow
