#pragma once

#include "shadow/registry.h"

namespace penumbra::truth {

// The technique `hybrid`: the shadow map decides the tiles of pixels that no penumbra reaches, and rays the others. It
// works only in frames of a render::Renderer, whose scene it reads. `threads`: of the tracer; 0: one for each core.
shadow::Technique hybrid(int threads);
// The same with small maps, more rays in narrow penumbrae, and a filter.
shadow::Preset hybrid_denoised();

}  // namespace penumbra::truth
