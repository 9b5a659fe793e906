#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "gl/pass.h"
#include "viewer/comparison.h"

namespace penumbra::viewer {

// Pictures in the window's frame. Pixels count from the upper left.
struct PresentInputs {
  const gl::Texture* a = nullptr;
  const gl::Texture* b = nullptr;  // absent: there is only A
  glm::ivec2 picture_size{1};      // at full resolution; textures in motion are smaller
  glm::ivec2 window_size{1};
  Comparison comparison;
  Zoom zoom;
  bool values = false;  // in false colour: each stands for itself, whatever the texture's size
};

// RGBA8, the size of the window: what is seen.
const gl::Texture& present(gl::Device& device, const PresentInputs& inputs);

// The program that it draws with, for checks of all shaders.
gl::ProgramDesc present_program();

// The picture's pixel that a pixel of the window shows; none outside of the picture.
std::optional<glm::ivec2> pixel_at(const PresentInputs& inputs, const glm::vec2& window);

}  // namespace penumbra::viewer
