#pragma once

#include "pass_desc.h"

namespace penumbra::gl {

// Where a depth attachment goes: with its stencil, where its format has one.
GLenum depth_attachment_point(const Texture& depth);

// Clears, invalidates or keeps what the framebuffer, made of the description's attachments, holds; then sets all state
// that the description speaks of and that passes share. Throws Error for a stencil without a texture that has one.
void begin_raster_state(GLuint framebuffer, const PassDesc& desc);

}  // namespace penumbra::gl
