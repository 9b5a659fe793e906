#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "gl/pass.h"
#include "viewer/comparison.h"

namespace penumbra::viewer {

// Pictures in the window's frame. Pixels count from the upper left.
struct PresentInputs {
  const gl::Texture* a = nullptr;
  const gl::Texture* b = nullptr;       // absent: there is only A
  const gl::Texture* tint_a = nullptr;  // colours to mix into it
  const gl::Texture* tint_b = nullptr;
  glm::ivec2 picture_size{1};  // that all of them have where they are not magnified, whatever their own sizes are
  glm::ivec2 window_size{1};
  Comparison comparison;
  Zoom zoom;
  bool values = false;  // the textures are values in false colour: never interpolated

  bool operator==(const PresentInputs&) const = default;
};

// Draws them into a texture of the window's size, RGBA8.
const gl::Texture& present(gl::Device& device, const PresentInputs& inputs);

// The program that present() uses to show one picture, or two, for the check that compiles all shaders.
gl::ProgramDesc present_program(bool two, bool tinted);

// Draws the picture, which has one sample of each pixel, with smooth edges into a texture of the same size, RGBA8.
void smooth_edges(gl::Device& device, const gl::Texture& picture, const gl::Texture& smooth);

// The program of smooth_edges(), for the same check.
gl::ProgramDesc smooth_edges_program();

// The picture's pixel that a pixel of the window shows; nothing outside of the picture.
std::optional<glm::ivec2> pixel_at(const PresentInputs& inputs, const glm::vec2& window);
// The texel of a texture of that size, shown as a picture, that a pixel of the window shows.
std::optional<glm::ivec2> texel_at(const PresentInputs& inputs, const glm::vec2& window, const glm::ivec2& size);
// The size at which a texture of its own shape fills the window as far as it can.
glm::ivec2 fitted(const glm::ivec2& texture, const glm::ivec2& window);
// The middle of a pixel of picture A in the window, which may lie outside of it.
glm::vec2 place_of(const PresentInputs& inputs, const glm::ivec2& pixel);

}  // namespace penumbra::viewer
