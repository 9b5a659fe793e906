#pragma once

#include "pass_desc.h"

namespace penumbra::gl {

// The attachment point for a depth texture: depth and stencil if its format has stencil.
GLenum depth_attachment_point(const Texture& depth);

// Clears, invalidates or keeps what the framebuffer, made of the description's attachments, holds; then sets the state
// that the description gives and the state that all passes share. Throws Error if a stencil is described but the depth
// texture has none.
void begin_raster_state(GLuint framebuffer, const PassDesc& desc);

}  // namespace penumbra::gl
