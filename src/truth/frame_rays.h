#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/passes.h"
#include "shadow/pass_context.h"
#include "truth/light.h"
#include "truth/receiver.h"

namespace penumbra::truth {

// What techniques that trace rays take from a frame, and give back.

// The renderer's scene. Throws Error, which names the technique, in frames of another program.
const render::FrameScene& frame_scene(const shadow::PassContext& frame, const char* technique);

// Which surface and which of its triangles each pixel shows, rows bottom to top: see receivers_of(). Waits for the GPU.
std::vector<glm::uvec2> drawn_surfaces(gl::Device& device, const render::FrameScene& scene);
EyeRays eye_rays(const render::FrameScene& scene);

// The frame's light.
TracedLight traced_light(const shadow::PassContext& frame);

// Writes visibility to the light's layer of the mask, one value a pixel, rows bottom to top; the frame's viewport is
// the whole mask. Rays give no penumbra radius and no blocker distance: both are 0.
void fill_mask(const shadow::PassContext& frame, const std::vector<float>& visibility);

}  // namespace penumbra::truth
