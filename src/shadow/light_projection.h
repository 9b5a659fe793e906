#pragma once

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

// What depends on the kind of a light is declared here and in glsl/shadow/light_projection.glsl, and nowhere else: what
// a light is, how its shadow map is projected, and what shaders are told of both.

// A light without end distance, whose rays are parallel. Its angle and shape are the parameters sun.angle and
// sun.shape.
struct Sun {
  glm::vec3 to_light{0, 1, 0};  // unit, world

  bool operator==(const Sun&) const = default;
};

// Most layers that a shadow map can have.
constexpr int max_layers = 8;

// The kinds of light.
using LightSource = std::variant<Sun>;

// Its size, which makes shadows soft.
struct LightShape {
  float extent = 0;     // of a sun: the tangent of half the angle that it spans
  bool square = false;  // else a disc
};

// Lowest and highest texel of a layer, both included.
struct TexelRange {
  glm::ivec2 first{0}, last{0};
};

// Where the layers of a light's shadow map lie in the world, and what their depths mean. A layer stores depths along
// the light, linear: 0 at its nearest, 1 at its farthest.
class LightProjection {
 public:
  LightProjection() = default;
  // A sun's: one layer a cascade.
  LightProjection(Cascades cascades) : cascades_(std::move(cascades)) {}  // NOLINT(google-explicit-constructor)

  int layers() const { return static_cast<int>(cascades_.items.size()); }
  int size() const { return cascades_.size; }  // side of each layer, texels
  // From world space to clip space of a layer: x and y in -1..1 within the map, z in 0..1 as it stores it.
  glm::mat4 world_to_clip(int layer) const;
  // Casters outside of it can't matter to the layer.
  CullVolume cull_volume(int layer) const;
  // Casters outside of it can't reach any receiver of the view.
  CullVolume cull_volume_of_all() const { return cull_volume(layers() - 1); }
  // Texels of a layer in which something within a box can be, none where nothing can. A texel more to each side than
  // the box covers, for rounding.
  std::optional<TexelRange> texels_of(int layer, const Box& world_box) const;
  // Of a sun.
  const Cascades& cascades() const { return cascades_; }

  // Fills the members of the block that tell shaders of the projection, for a camera. `moved`: what moved, as in
  // Inputs.
  void write(glsl::ShadowBlock& block, const glm::dmat4& view_to_world, const std::optional<Box>& moved) const;

  // What keeps it from being used, for an error message ("cascade 2 has no extent"); empty if nothing does.
  std::string fault() const;

 private:
  Cascades cascades_;
};

// What a projection is fitted to.
struct FitInputs {
  glm::mat4 view{1}, projection{1};  // of the camera
  Box casters, receivers;
  const ParamSet& params;
};

LightProjection fit_projection(const LightSource& source, const FitInputs& inputs);

// A light's size by its parameters.
LightShape shape_of(const LightSource& source, const ParamSet& params);

// What keeps a light from being used, for an error message ("has no direction"); empty if nothing does.
std::string fault_of(const LightSource& source);

}  // namespace penumbra::shadow
