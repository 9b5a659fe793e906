#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "render/passes.h"
#include "render/renderer.h"

namespace penumbra::render {

// Means of AOVs over the samples of each pixel: by name, one for each light that the AOV has a picture of.
using AovMeans = std::map<std::string, std::vector<std::vector<float>>, std::less<>>;

// Everything that a frame produced, for the picture and the inspector.
struct FrameParts {
  scene::GpuScene* scene = nullptr;
  double last_time = 0, time = 0;  // seconds
  glsl::ViewBlock view;
  Camera camera;
  GBuffer gbuffer;
  shadow::Mask mask;
  const gl::Texture* color = nullptr;
  const gl::Buffer* exposure = nullptr;
  const gl::Texture* display = nullptr;
  AovMeans means;  // of FrameInputs::averaged_aovs; others are those of the first sample
};

// `knows_moved`: what moved between the inputs' two times is what moved since the view's last frame.
// `sky`: see update_sky(); `noise`: dither_noise().
FrameParts draw_frame(gl::Device& device, shadow::SoftShadows& soft_shadows, scene::GpuScene& scene,
                      const FrameInputs& inputs, bool knows_moved, const ParamSet& params, const Sky& sky,
                      const gl::Texture& noise);

// Adds the motion vectors to the G-buffer of the last frame that was drawn, where nothing in the frame has read them.
void add_motion(gl::Device& device, FrameParts& frame);

// An AOV of a frame, as Renderer::read_aov(); of a single pixel if one is given.
std::vector<float> read_aov(const FrameParts& frame, std::string_view name, int light,
                            std::optional<glm::ivec2> pixel = {});

}  // namespace penumbra::render
