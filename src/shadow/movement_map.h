#pragma once

#include <optional>
#include <string_view>

#include "../gl/pass.h"
#include "inputs.h"

namespace penumbra::shadow {

// What the pyramid over a movement map holds.
enum class MovementForm {
  // GL_R16: share of the texels below in which something moved (thesis 2.5.1). A lone texel of a map of w texels a
  // side needs 2·log2(w) bits (2.31): 16 lose it from the level on that covers 512 × 512 texels.
  average,
  maximum,  // GL_R8: 1 where something moved in any texel below, else 0; nothing is lost
};

// Where casters that moved since the last frame are, or were, the nearest to the light: the layers of
// the projection, all levels. Texel (x, y) of level l is that of the 2^l texels squared from (x, y)·2^l on; the last
// ones of a level have the rest of the map too, whose size need not be a power of two.
const gl::Texture& movement_target(gl::Device& device, std::string_view name, int size, int layers, MovementForm form);

struct MovementInputs {
  const gl::Texture& map;  // of movement_target()
  MovementForm form = MovementForm::maximum;
  const LightProjection& projection;
  const DrawCasters& draw;
  // The finished shadow map, of which nothing nearer may hide what moved. Null: it is a name of the caller's, which no
  // pass of ours can test against; then hidden casters count too, which drops more history than need be.
  const gl::Texture* depth = nullptr;
  std::optional<Box> moved;       // Inputs::moved
  bool present_is_drawn = false;  // draw_shadow_map() had `map` as its second target, with the same bounds
};

// Draws what moved at its present position, unless that is there already, and at its last one; then the pyramid. Where
// nothing moved the map is zero, and nothing is drawn.
void draw_movement(gl::Device& device, const MovementInputs& inputs);

// Inputs::moved says that nothing did.
bool nothing_moved(const std::optional<Box>& moved);
// False only if nothing that moved can be in the volume.
bool may_hold_moved(const CullVolume& volume, const std::optional<Box>& moved);

// The program of the pyramid; `any_size`: for maps whose size is no power of two, at more cost.
gl::ProgramDesc movement_pyramid_program(MovementForm form, bool any_size = false);

}  // namespace penumbra::shadow
