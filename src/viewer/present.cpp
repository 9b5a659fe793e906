#include "viewer/present.h"

#include <algorithm>
#include <cmath>

namespace penumbra::viewer {

namespace {

constexpr float tint_share = 0.45f;

// The picture's point in the middle of its part of the window, pixels.
glm::vec2 center_of(const PresentInputs& inputs) { return inputs.zoom.center * glm::vec2(inputs.picture_size); }

CompareMode how_of(const PresentInputs& inputs) {
  return inputs.comparison.on && inputs.b != nullptr ? inputs.comparison.how : CompareMode::a;
}

// Magnified pixels keep their edges, so that single ones can be examined; a picture of less than full size is
// interpolated.
gl::SamplerDesc sampler_for(const PresentInputs& inputs, const gl::Texture& texture) {
  const bool full = texture.width() == inputs.picture_size.x && texture.height() == inputs.picture_size.y;
  const GLenum magnify = full || inputs.values ? GL_NEAREST : GL_LINEAR;
  const GLenum minify = inputs.zoom.factor < 1.0f ? GL_LINEAR : magnify;
  return {.min_filter = minify, .mag_filter = magnify};
}

void bind(gl::Device& device, const PresentInputs& inputs, const gl::Texture& texture, GLuint unit) {
  texture.bind(unit);
  device.sampler(sampler_for(inputs, texture)).bind(unit);
}

}  // namespace

gl::ProgramDesc smooth_edges_program() {
  return {.name = "smooth edges", .vertex = "shared/full_screen.vert", .fragment = "viewer/smooth_edges.frag"};
}

gl::ProgramDesc present_program(bool two, bool tinted) {
  return {.name = "present",
          .vertex = "shared/full_screen.vert",
          .fragment = "viewer/present.frag",
          .defines = {{"PICTURES", two ? "2" : "1"}, {"TINTED", tinted ? "1" : "0"}}};
}

void smooth_edges(gl::Device& device, const gl::Texture& picture, const gl::Texture& smooth) {
  gl::Pass pass(device, {.name = "smooth edges", .colors = {{.texture = &smooth, .dont_care = true}}});
  pass.use(smooth_edges_program());
  picture.bind(0);
  device.sampler({.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR}).bind(0);
  pass.draw_full_screen();
}

const gl::Texture& present(gl::Device& device, const PresentInputs& inputs) {
  const gl::Texture& target =
      device.target("viewer/window", {.width = inputs.window_size.x, .height = inputs.window_size.y});
  const glm::vec2 center = center_of(inputs);
  const CompareMode how = how_of(inputs);
  const bool two = how != CompareMode::a && how != CompareMode::b;
  const bool b_first = how == CompareMode::b;
  const gl::Texture* first = b_first ? inputs.b : inputs.a;
  // A picture without a tint shows itself.
  const auto tint_or = [](const gl::Texture* tint, const gl::Texture* picture) {
    return tint != nullptr ? tint : picture;
  };
  const gl::Texture* first_tint = tint_or(b_first ? inputs.tint_b : inputs.tint_a, first);
  const bool tinted = inputs.tint_a != nullptr || inputs.tint_b != nullptr;
  const gl::SamplerDesc of_tints{.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST};
  {
    gl::Pass pass(device, {.name = "present", .colors = {{.texture = &target}}});
    const gl::Program& program = pass.use(present_program(two, tinted));
    bind(device, inputs, *first, 0);
    first_tint->bind(2);
    device.sampler(of_tints).bind(2);
    if (two) {
      bind(device, inputs, *inputs.b, 1);
      tint_or(inputs.tint_b, inputs.b)->bind(3);
      device.sampler(of_tints).bind(3);
    }
    program.set("tint", tint_share);
    program.set("comparison", static_cast<int>(how));
    program.set("wipe", inputs.comparison.wipe);
    program.set("gain", inputs.comparison.gain);
    program.set("zoom", inputs.zoom.factor);
    program.set("center", glm::vec2(center.x, static_cast<float>(inputs.picture_size.y) - center.y));
    program.set("picture_size", glm::vec2(inputs.picture_size));
    program.set("window_size", glm::vec2(inputs.window_size));
    pass.draw_full_screen();
  }
  return target;
}

std::optional<glm::ivec2> pixel_at(const PresentInputs& inputs, const glm::vec2& window) {
  return texel_at(inputs, window, inputs.picture_size);
}

std::optional<glm::ivec2> texel_at(const PresentInputs& inputs, const glm::vec2& window, const glm::ivec2& size) {
  glm::vec2 middle = glm::vec2(inputs.window_size) * 0.5f;
  if (how_of(inputs) == CompareMode::side_by_side) middle.x *= window.x >= middle.x ? 1.5f : 0.5f;
  const glm::vec2 place = center_of(inputs) + (window - middle) / inputs.zoom.factor;
  const glm::ivec2 texel(glm::floor(place * (glm::vec2(size) / glm::vec2(inputs.picture_size))));
  const bool inside = glm::all(glm::greaterThanEqual(texel, glm::ivec2(0))) && glm::all(glm::lessThan(texel, size));
  return inside ? std::optional(texel) : std::nullopt;
}

glm::ivec2 fitted(const glm::ivec2& texture, const glm::ivec2& window) {
  const glm::vec2 room = glm::vec2(window) / glm::vec2(texture);
  return glm::max(glm::ivec2(glm::round(glm::vec2(texture) * std::min(room.x, room.y))), 1);
}

glm::vec2 place_of(const PresentInputs& inputs, const glm::ivec2& pixel) {
  glm::vec2 middle = glm::vec2(inputs.window_size) * 0.5f;
  if (how_of(inputs) == CompareMode::side_by_side) middle.x *= 0.5f;
  return middle + (glm::vec2(pixel) + 0.5f - center_of(inputs)) * inputs.zoom.factor;
}

}  // namespace penumbra::viewer
