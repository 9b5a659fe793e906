#pragma once

#include "light_work.h"

namespace penumbra::shadow {

// Uploads the uniforms of the view and the light: those that the light's passes bind from then on.
// `name`: of their buffer. `scale`: pixels of the caller's depths from one receiver to the next.
void upload_light(const LightWork& work, const char* name, const glm::vec2& last_jitter, int scale = 1);

// Uploads all that every program reads: the parameters, the sample points, the view and the light.
void upload_blocks(const LightWork& work);

}  // namespace penumbra::shadow
