#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "../gl/device.h"
#include "inputs.h"

namespace penumbra::shadow {

// What the layers of a light's shadow map were drawn with.
struct MapContent {
  struct Layer {
    glm::mat4 world_to_clip{1};
    AnchoredMatrix anchored;
    CullVolume cull;
    TexelRange drawn;
  };
  std::uint64_t texture = 0;         // its serial; 0: there is no map
  std::uint64_t shader_changes = 0;  // gl::ShaderLibrary::changes()
  LightSource source;
  int count = 0;  // of the layers
  std::array<Layer, max_layers> layers;
};
MapContent content_of(const gl::Device& device, const gl::Texture& map, const LightProjection& projection,
                      const LightSource& source);

// The layers that need not be drawn again: those with the same projection to which no more texels would be drawn, and
// without a caster that moved. `moved`: Inputs::moved.
LayerSet unchanged_layers(const MapContent& last, const MapContent& now, const std::optional<Box>& moved);

}  // namespace penumbra::shadow
