#pragma once

#include <glm/vec2.hpp>
#include <string_view>

#include "../gl/api.h"
#include "check_inputs.h"

namespace penumbra::shadow {

// The parts of check(). Each throws Error in one line; `checks` knows what need not be looked at again.

void check_conventions(const glm::mat4& projection, const Conventions& conventions);
void check_depth(const TextureView& view, TextureChecks& checks);
void check_normals(const Inputs& inputs, TextureChecks& checks);
void check_motion(const Inputs& inputs, TextureChecks& checks);
void check_maps(const Light& light, TextureChecks& checks);
void check_outputs(const Inputs& inputs, TextureChecks& checks);

// Of textures of any use. `name` is what messages call them.

GLint level_parameter(unsigned texture, GLenum name, GLint level = 0);
// Depth, or the first of the colour channels as plain numbers.
bool holds_depth(unsigned texture);
void check_given(std::string_view name, const TextureView& view);
// Refuses what is not a texture.
GLenum target_of_existing(std::string_view name, const TextureView& view);
void check_size(std::string_view name, const TextureView& view);
// Refuses a swizzle of the first `channels`, and other parameters of the texture with which shaders would read others
// than the texels of level 0.
void check_parameters(std::string_view name, unsigned texture, int channels);

}  // namespace penumbra::shadow
