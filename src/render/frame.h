#pragma once

#include "render/passes.h"
#include "render/renderer.h"

namespace penumbra::render {

// Everything that a frame produced, for the picture and the inspector.
struct FrameParts {
  glsl::ViewBlock view;
  Camera camera;
  GBuffer gbuffer;
  shadow::Mask mask;
  const gl::Texture* lit = nullptr;
  const gl::Buffer* exposure = nullptr;
  const gl::Texture* display = nullptr;
};

FrameParts draw_frame(gl::Device& device, shadow::SoftShadows& soft_shadows, scene::GpuScene& scene,
                      const FrameInputs& inputs, const ParamSet& params);

// An AOV of a frame, as Renderer::read_aov(); of a single pixel if one is given.
std::vector<float> read_aov(const FrameParts& frame, std::string_view name, std::optional<glm::ivec2> pixel = {});

}  // namespace penumbra::render
