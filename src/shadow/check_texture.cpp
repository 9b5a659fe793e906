#include "check_parts.h"

#include <algorithm>
#include <array>
#include <span>

#include "../core/error.h"
#include "../gl/texture.h"

namespace penumbra::shadow {

GLint level_parameter(unsigned texture, GLenum name, GLint level) {
  GLint value = 0;
  gl::glGetTextureLevelParameteriv(texture, level, name, &value);
  return value;
}

bool holds_depth(unsigned texture) {
  const bool red_alone = level_parameter(texture, GL_TEXTURE_GREEN_SIZE) == 0;
  return level_parameter(texture, GL_TEXTURE_DEPTH_SIZE) > 0 ||
         (red_alone && level_parameter(texture, GL_TEXTURE_RED_TYPE) == GL_FLOAT);
}

void check_given(std::string_view name, const TextureView& view) {
  if (view.id == 0 || view.width < 1 || view.height < 1) fail("soft shadows: no {} texture", name);
}

GLenum target_of_existing(std::string_view name, const TextureView& view) {
  if (gl::glIsTexture(view.id) == GL_FALSE) fail("soft shadows: {}: {} is not the name of a texture", name, view.id);
  return gl::target_of(view.id);
}

void check_size(std::string_view name, const TextureView& view) {
  const GLint width = level_parameter(view.id, GL_TEXTURE_WIDTH);
  const GLint height = level_parameter(view.id, GL_TEXTURE_HEIGHT);
  if (width != view.width || height != view.height) {
    fail("soft shadows: {}: texture {} is {}×{}, not {}×{}", name, view.id, width, height, view.width, view.height);
  }
}

void check_parameters(std::string_view name, unsigned texture, int channels) {
  struct Initial {
    GLenum parameter;
    const char* label;
    GLint value;
  };
  static constexpr std::array initials{
      Initial{GL_TEXTURE_BASE_LEVEL, "GL_TEXTURE_BASE_LEVEL", 0},
      Initial{GL_DEPTH_STENCIL_TEXTURE_MODE, "GL_DEPTH_STENCIL_TEXTURE_MODE", GL_DEPTH_COMPONENT},
      Initial{GL_TEXTURE_SWIZZLE_R, "GL_TEXTURE_SWIZZLE_R", GL_RED},
      Initial{GL_TEXTURE_SWIZZLE_G, "GL_TEXTURE_SWIZZLE_G", GL_GREEN},
      Initial{GL_TEXTURE_SWIZZLE_B, "GL_TEXTURE_SWIZZLE_B", GL_BLUE}};
  constexpr std::size_t of_all_channels = 2;
  for (const Initial& initial : std::span(initials).first(of_all_channels + static_cast<std::size_t>(channels))) {
    GLint value = 0;
    gl::glGetTextureParameteriv(texture, initial.parameter, &value);
    if (value != initial.value)
      fail("soft shadows: {}: {} of texture {} is not OpenGL's initial value", name, initial.label, texture);
  }
}

namespace {

TextureChecks::Key key_of(const OutputTexture& output, const glm::ivec2& size) {
  return {.id = output.id, .width = size.x, .height = size.y, .output = output};
}

}  // namespace

bool TextureChecks::Source::is_plain() const { return target == GL_TEXTURE_2D; }

bool TextureChecks::Source::has_samples() const {
  return target == GL_TEXTURE_2D_MULTISAMPLE || target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
}

const TextureChecks::Source* TextureChecks::known_source(const Key& key) const {
  const auto found = std::ranges::find(last_, key, &Entry::key);
  return found == last_.end() ? nullptr : &found->source;
}

const TextureChecks::Source& TextureChecks::source_of(const TextureView& view) const {
  return std::ranges::find_if(now_,
                              [&](const Entry& entry) {
                                return entry.key.id == view.id && entry.key.layer == view.layer && !entry.key.output &&
                                       entry.key.layers == 0;
                              })
      ->source;
}

const TextureChecks::Source& TextureChecks::source_of(const FinishedMaps& maps) const {
  return std::ranges::find_if(now_,
                              [&](const Entry& entry) { return entry.key.id == maps.depth.id && entry.key.layers > 0; })
      ->source;
}

void TextureChecks::begin() {
  for (Entry& entry : last_) {
    const bool used = std::ranges::find(now_, entry.key, &Entry::key) != now_.end();
    if (!used && ++entry.frames <= remembered_frames) now_.push_back(entry);
  }
  last_.swap(now_);
  now_.clear();
}

bool TextureChecks::takes_known_output(const OutputTexture& output, const glm::ivec2& size) {
  const auto found = std::ranges::find(last_, key_of(output, size), &Entry::key);
  if (found == last_.end()) return false;
  now_.push_back(*found);
  now_.back().frames = 1;
  return true;
}

void TextureChecks::add_output(const OutputTexture& output, const glm::ivec2& size, const gl::TextureDesc& desc) {
  now_.push_back({key_of(output, size), desc});
}

const gl::TextureDesc& TextureChecks::desc_of(const OutputTexture& output) const {
  return std::ranges::find(now_, output, [](const Entry& entry) { return entry.key.output; })->desc;
}

}  // namespace penumbra::shadow
