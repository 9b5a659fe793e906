#include "check_parts.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "../core/error.h"

namespace penumbra::shadow {

namespace {

// Whether a scale or an offset says how what a texture holds becomes -1..1.
bool decodes_normals(const Conventions& conventions) {
  return conventions.normals_scale != 1 || conventions.normals_offset != 0;
}

void check_decoding(const Conventions& conventions) {
  if (std::isfinite(conventions.normals_scale) && std::isfinite(conventions.normals_offset) &&
      conventions.normals_scale != 0) {
    return;
  }
  fail("soft shadows: the normals' scale is {} and their offset {}; both must be finite, and the scale not 0",
       conventions.normals_scale, conventions.normals_offset);
}

bool is_signed(GLint type) { return type == GL_FLOAT || type == GL_SIGNED_NORMALIZED; }

// R11F_G11F_B10F and RGB9_E5: floats without a sign.
bool holds_unsigned_floats(unsigned texture) {
  const GLint format = level_parameter(texture, GL_TEXTURE_INTERNAL_FORMAT);
  return format == GL_R11F_G11F_B10F || format == GL_RGB9_E5;
}

// At least that many channels of numbers. Unsigned ones are refused unless the caller says how they map to -1..1.
bool holds_numbers(unsigned texture, int channels, bool may_be_unsigned) {
  constexpr GLenum types[] = {GL_TEXTURE_RED_TYPE, GL_TEXTURE_GREEN_TYPE, GL_TEXTURE_BLUE_TYPE};
  for (int i = 0; i < channels; ++i) {
    const GLint type = level_parameter(texture, types[i]);
    if (!is_signed(type) && !(may_be_unsigned && type == GL_UNSIGNED_NORMALIZED)) return false;
  }
  return true;
}

// The sample that is nearest to the centre of a pixel.
TextureChecks::Source nearest_sample(const TextureView& view, GLenum target) {
  const GLenum attachment =
      level_parameter(view.id, GL_TEXTURE_DEPTH_SIZE) > 0 ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0;
  GLuint framebuffer = 0;
  gl::glCreateFramebuffers(1, &framebuffer);
  gl::glNamedFramebufferTexture(framebuffer, attachment, view.id, 0);
  gl::glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  TextureChecks::Source nearest{.target = target};
  float least = 2;
  const GLint samples = level_parameter(view.id, GL_TEXTURE_SAMPLES);
  for (GLint i = 0; i < samples; ++i) {
    glm::vec2 place(0.5f);
    gl::glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), glm::value_ptr(place));
    const float away = glm::distance(place, glm::vec2(0.5f));
    if (away >= least) continue;
    least = away;
    nearest.sample = i;
    nearest.place = place;
  }
  gl::glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  gl::glDeleteFramebuffers(1, &framebuffer);
  return nearest;
}

// Checks a texture that is new, of receivers, and says how its first `channels` are read.
TextureChecks::Source check_source(std::string_view name, const TextureView& view, int channels) {
  const GLenum target = target_of_existing(name, view);
  const bool array = target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
  if (!array && target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_MULTISAMPLE) {
    fail("soft shadows: {}: texture {} is not a GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY or one of these with samples", name,
         view.id);
  }
  check_size(name, view);
  check_parameters(name, view.id, channels);
  const GLint layers = array ? level_parameter(view.id, GL_TEXTURE_DEPTH) : 1;
  if (view.layer < 0 || view.layer >= layers) {
    fail("soft shadows: {}: texture {} has no layer {}", name, view.id, view.layer);
  }
  const TextureChecks::Source source{.target = target};
  return source.has_samples() ? nearest_sample(view, target) : source;
}

// Checks a texture of values in -1..1 with one texel for each receiver; `texels`: what messages call it.
struct ReceiverTexture {
  std::string_view name, texels;
  const TextureView& view;
  int channels = 0;
  bool may_be_unsigned = false;
};

void check_receivers(const ReceiverTexture& texture, const TextureView& depth, TextureChecks& checks) {
  const TextureView& view = texture.view;
  check_given(texture.name, view);
  const TextureChecks::Key key{.id = view.id,
                               .width = view.width,
                               .height = view.height,
                               .channels = texture.channels,
                               .layer = view.layer,
                               .may_be_unsigned = texture.may_be_unsigned};
  const TextureChecks::Source* found = checks.known_source(key);
  const bool known = found != nullptr;
  const TextureChecks::Source source = known ? *found : check_source(texture.name, view, texture.channels);
  if (view.width != depth.width || view.height != depth.height) {
    fail("soft shadows: {} are {}×{}, depth is {}×{}", texture.texels, view.width, view.height, depth.width,
         depth.height);
  }
  if (!known && holds_unsigned_floats(view.id)) {
    fail("soft shadows: {}: texture {} has floats without a sign (R11F_G11F_B10F or RGB9_E5), which are too coarse",
         texture.texels, view.id);
  }
  if (!known && !holds_numbers(view.id, texture.channels, texture.may_be_unsigned)) {
    fail("soft shadows: {}: texture {} has not {} channels of a float or SNORM format{}", texture.texels, view.id,
         texture.channels, texture.may_be_unsigned ? ", or of a UNORM one" : "");
  }
  checks.add(key, source);
}

}  // namespace

void check_depth(const TextureView& view, TextureChecks& checks) {
  check_given("depth", view);
  const TextureChecks::Key key{.id = view.id, .width = view.width, .height = view.height, .layer = view.layer};
  const TextureChecks::Source* known = checks.known_source(key);
  TextureChecks::Source source = known != nullptr ? *known : check_source("depth", view, 1);
  if (known == nullptr) {
    if (!holds_depth(view.id)) fail("soft shadows: depth: texture {} holds no depth", view.id);
    source.rounding = depth_rounding_of(view.id);
  }
  checks.depth = source.rounding;
  checks.add(key, source);
}

void check_normals(const Inputs& inputs, TextureChecks& checks) {
  check_decoding(inputs.conventions);
  if (inputs.normals.id != 0) {
    check_receivers({.name = "normals",
                     .texels = "normals",
                     .view = inputs.normals,
                     .channels = inputs.conventions.octahedral_normals ? 2 : 3,
                     .may_be_unsigned = decodes_normals(inputs.conventions)},
                    inputs.depth, checks);
  }
  if (inputs.makes_normals() && checks.depth.relative >= 0x1p-11f) {
    fail("soft shadows: {}, and depths of half floats are too coarse to make normals from",
         inputs.normals.id == 0 ? "no normals texture" : "the normals are those of shading");
  }
}

void check_motion(const Inputs& inputs, TextureChecks& checks) {
  if (inputs.motion.id == 0) return;
  check_receivers({.name = "motion", .texels = "motion vectors", .view = inputs.motion, .channels = 2}, inputs.depth,
                  checks);
}

}  // namespace penumbra::shadow
