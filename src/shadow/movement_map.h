#pragma once

#include <optional>
#include <string_view>

#include "../gl/pass.h"
#include "inputs.h"

namespace penumbra::shadow {

// What the mip levels of a movement map store.
enum class MovementForm {
  // GL_R16: the fraction of the covered level-0 texels in which something moved (thesis 2.5.1). In a map of w texels a
  // side, a single such texel needs 2·log2(w) bits (2.31); with 16 bits it is rounded away at the level whose texels
  // cover 512 × 512 texels, and above.
  average,
  maximum,  // GL_R8: 1 where something moved in any covered texel, else 0; nothing is lost
};

// The texture of the movement map: marks the texels in which a caster that moved since the last frame is, or was: the
// one nearest to the light, or any (MovementInputs::depth). It has the layers of the projection and all mip levels.
// Texel (x, y) of level l covers the 2^l × 2^l texels from (x, y)·2^l on; the last row and column of a level also cover
// the remainder when the map's size is not a power of two.
const gl::Texture& movement_target(gl::Device& device, std::string_view name, int size, int layers, MovementForm form);

struct MovementInputs {
  const gl::Texture& map;  // of movement_target()
  MovementForm form = MovementForm::maximum;
  const LightProjection& projection;
  LightSource source = {};
  const DrawCasters& draw;
  // The finished shadow map, used as depth test so that moved casters count only where nothing nearer to the light
  // hides them. Null: hidden casters count too. So it is where these cast shadows (sees_hidden_casters()), and where
  // the caller drew the map, which rejects more history than necessary.
  const gl::Texture* depth = nullptr;
  std::optional<Box> moved;  // Inputs::moved
  bool present_is_drawn =
      false;  // draw_shadow_map() has already drawn the present positions into `map`, with the same bounds
};

// Draws the casters that moved at their present positions (unless already drawn) and at their last positions, then
// builds the mip levels. If nothing moved, the map is 0 and nothing is drawn.
void draw_movement(gl::Device& device, const MovementInputs& inputs);

// Whether Inputs::moved says that nothing moved.
bool nothing_moved(const std::optional<Box>& moved);
// Conservative: false only if nothing that moved can be in the volume.
bool may_hold_moved(const CullVolume& volume, const std::optional<Box>& moved);

// The program that builds the mip levels; `any_size`: for maps whose size is not a power of two, at higher cost.
gl::ProgramDesc movement_pyramid_program(MovementForm form, bool any_size = false);

}  // namespace penumbra::shadow
