#include "check_inputs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "../core/error.h"
#include "inputs.h"

namespace penumbra::shadow {

namespace {

bool all_finite(const float* values, int count) {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

void check_matrix(std::string_view name, const glm::mat4& matrix) {
  if (!all_finite(glm::value_ptr(matrix), 16)) fail("soft shadows: {} is not finite", name);
  if (glm::determinant(glm::dmat4(matrix)) == 0) fail("soft shadows: {} has no inverse", name);
}

// At a distance d before the camera, a perspective projection's depth in NDC is at_infinity + change / d.
void check_conventions(const glm::dmat4& projection, const Conventions& conventions) {
  const bool perspective = projection[0][3] == 0 && projection[1][3] == 0 && projection[3][3] == 0;
  const bool oblique = projection[0][2] != 0 || projection[1][2] != 0;
  if (!perspective || oblique || projection[2][3] == 0 || projection[3][2] == 0) return;
  const double at_infinity = projection[2][2] / projection[2][3], change = projection[3][2];
  const bool reversed = change > 0;
  if (reversed != conventions.reversed_z) {
    fail("soft shadows: the projection's depth {} with the distance, but Conventions::reversed_z is {}",
         reversed ? "falls" : "grows", conventions.reversed_z);
  }
  constexpr double rounding = 1e-3;
  if (reversed && !conventions.depth_zero_to_one && at_infinity > -1 + rounding) {
    fail("soft shadows: the projection's depth is above {:.3g} everywhere, but Conventions::depth_zero_to_one is false",
         at_infinity + 0.0);  // not "-0"
  }
}

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

void check_finite(std::string_view name, const Box& box) {
  if (!all_finite(glm::value_ptr(box.min), 3) || !all_finite(glm::value_ptr(box.max), 3)) {
    fail("soft shadows: the bounding box of the {} is not finite", name);
  }
}

void check_box(std::string_view name, const Box& box) {
  check_finite(name, box);
  if (glm::any(glm::greaterThan(box.min, box.max))) fail("soft shadows: the bounding box of the {} is empty", name);
}

GLint level_parameter(unsigned texture, GLenum name, GLint level = 0) {
  GLint value = 0;
  gl::glGetTextureLevelParameteriv(texture, level, name, &value);
  return value;
}

bool is_signed(GLint type) { return type == GL_FLOAT || type == GL_SIGNED_NORMALIZED; }

// Depth, or the first of the colour channels as plain numbers.
bool holds_depth(unsigned texture) {
  return level_parameter(texture, GL_TEXTURE_DEPTH_SIZE) > 0 ||
         level_parameter(texture, GL_TEXTURE_RED_TYPE) == GL_FLOAT;
}

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

// Checks a texture that is new, of receivers, and says how it is read.
TextureChecks::Source check_source(std::string_view name, const TextureView& view) {
  const GLenum target = target_of_existing(name, view);
  const bool array = target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
  if (!array && target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_MULTISAMPLE) {
    fail("soft shadows: {}: texture {} is not a GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY or one of these with samples", name,
         view.id);
  }
  check_size(name, view);
  const GLint layers = array ? level_parameter(view.id, GL_TEXTURE_DEPTH) : 1;
  if (view.layer < 0 || view.layer >= layers) {
    fail("soft shadows: {}: texture {} has no layer {}", name, view.id, view.layer);
  }
  const TextureChecks::Source source{.target = target};
  return source.has_samples() ? nearest_sample(view, target) : source;
}

void check_depth(const TextureView& view, TextureChecks& checks) {
  check_given("depth", view);
  const TextureChecks::Key key{.id = view.id, .width = view.width, .height = view.height, .layer = view.layer};
  const TextureChecks::Source* known = checks.known_source(key);
  const TextureChecks::Source source = known != nullptr ? *known : check_source("depth", view);
  if (known == nullptr) {
    if (!holds_depth(view.id)) fail("soft shadows: depth: texture {} holds no depth", view.id);
    checks.depth = depth_rounding_of(view.id);
  }
  checks.add(key, source);
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
  const TextureChecks::Source source = known ? *found : check_source(texture.name, view);
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

// Whether each layer lies in the atlas.
void check_atlas(const FinishedMaps& maps, int light) {
  const int layers = maps.projection.layers(), size = maps.projection.size();
  if (maps.atlas.size() != static_cast<std::size_t>(layers)) {
    fail("soft shadows: light {} has an atlas of {} maps for {} layers", light, maps.atlas.size(), layers);
  }
  for (const glm::ivec2& corner : maps.atlas) {
    const bool inside =
        corner.x >= 0 && corner.y >= 0 && size <= maps.depth.width - corner.x && size <= maps.depth.height - corner.y;
    if (!inside) {
      fail("soft shadows: light {} has a map of {}×{} at {}, {}, which is not a part of its atlas of {}×{}", light,
           size, size, corner.x, corner.y, maps.depth.width, maps.depth.height);
    }
  }
}

void check_map_texture(const TextureView& depth, GLint count, int light) {
  const GLint layers = level_parameter(depth.id, GL_TEXTURE_DEPTH);
  if (layers < count) fail("soft shadows: light {} has {} maps for {} layers", light, layers, count);
}

void check_maps(const FinishedMaps& maps, int light, TextureChecks& checks) {
  const LightProjection& projection = maps.projection;
  if (const std::string fault = projection.fault(); !fault.empty()) fail("soft shadows: light {}: {}", light, fault);
  const std::string name = fmt::format("maps of light {}", light);
  const TextureView& depth = maps.depth;
  check_given(name, depth);
  const TextureChecks::Key key{.id = depth.id,
                               .width = depth.width,
                               .height = depth.height,
                               .layers = projection.layers(),
                               .atlas = !maps.atlas.empty()};
  const bool known = checks.knows(key), atlas = !maps.atlas.empty();
  if (!known) {
    const GLenum target = target_of_existing(name, depth);
    if (target != (atlas ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY)) {
      fail("soft shadows: {}: texture {} is not a {}", name, depth.id,
           atlas ? "GL_TEXTURE_2D, as an atlas is" : "GL_TEXTURE_2D_ARRAY");
    }
    check_size(name, depth);
    if (!holds_depth(depth.id)) fail("soft shadows: the maps of light {} hold no depth", light);
  }
  if (atlas) {
    check_atlas(maps, light);
  } else if (depth.width != projection.size() || depth.height != projection.size()) {
    fail("soft shadows: light {} has maps of {}×{} and a projection for {}", light, depth.width, depth.height,
         projection.size());
  }
  if (!known && !atlas) check_map_texture(depth, projection.layers(), light);
  checks.add(key);
}

// The channels of a format that outputs may have; 0: of others.
int output_channels(GLenum format) {
  switch (format) {
    case GL_R8:
    case GL_R16F:
      return 1;
    case GL_RG8:
    case GL_RG16F:
      return 2;
    case GL_RGBA8:
    case GL_RGBA16F:
      return 4;
    default:
      return 0;
  }
}

// Whether the driver draws to it: a texture of mutable storage may lack levels, or be limited to other ones.
bool can_be_drawn_to(const OutputTexture& output, GLenum target) {
  GLuint framebuffer = 0;
  gl::glCreateFramebuffers(1, &framebuffer);
  if (target == GL_TEXTURE_2D_ARRAY) {
    gl::glNamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT0, output.id, output.level, output.layer);
  } else {
    gl::glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, output.id, output.level);
  }
  const GLenum status = gl::glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER);
  gl::glDeleteFramebuffers(1, &framebuffer);
  return status == GL_FRAMEBUFFER_COMPLETE;
}

// Of a texture that suits.
gl::TextureDesc output_desc(const OutputTexture& output, const TextureView& depth, int light) {
  const std::string name = fmt::format("soft shadows: the output of light {}", light);
  if (gl::glIsTexture(output.id) == GL_FALSE) fail("{}: {} is not the name of a texture", name, output.id);
  const GLenum target = gl::target_of(output.id);
  if (target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_ARRAY) {
    fail("{}: texture {} is neither a GL_TEXTURE_2D nor a GL_TEXTURE_2D_ARRAY", name, output.id);
  }
  gl::TextureDesc desc{.target = target,
                       .format = static_cast<GLenum>(level_parameter(output.id, GL_TEXTURE_INTERNAL_FORMAT)),
                       .width = level_parameter(output.id, GL_TEXTURE_WIDTH),
                       .height = level_parameter(output.id, GL_TEXTURE_HEIGHT),
                       .layers = level_parameter(output.id, GL_TEXTURE_DEPTH)};
  desc.levels = static_cast<int>(std::bit_width(static_cast<unsigned>(std::max({desc.width, desc.height, 0}))));
  if (output.level < 0 || output.level >= desc.levels) {
    fail("{}: texture {} has no level {}", name, output.id, output.level);
  }
  const auto size_of_level = [&](GLenum size) { return level_parameter(output.id, size, output.level); };
  const glm::ivec2 size(size_of_level(GL_TEXTURE_WIDTH), size_of_level(GL_TEXTURE_HEIGHT));
  if (size != glm::ivec2(depth.width, depth.height)) {
    fail("{}: level {} of texture {} is {}×{}, depth is {}×{}", name, output.level, output.id, size.x, size.y,
         depth.width, depth.height);
  }
  if (output.layer < 0 || output.layer >= desc.layers) {
    fail("{}: texture {} has no layer {}", name, output.id, output.layer);
  }
  const int channels = output_channels(desc.format);
  if (channels == 0) {
    fail("{}: texture {} has the format {:#x}; it must be R8, RG8, RGBA8, R16F, RG16F or RGBA16F", name, output.id,
         desc.format);
  }
  if (output.channel < 0 || output.channel >= channels) {
    fail("{}: texture {} has no channel {}", name, output.id, output.channel);
  }
  if (!can_be_drawn_to(output, target)) {
    fail("{}: texture {} is incomplete, or its level {} is outside of its base and maximum level", name, output.id,
         output.level);
  }
  return desc;
}

void check_outputs(const Inputs& inputs, TextureChecks& checks) {
  const glm::ivec2 size(inputs.depth.width, inputs.depth.height);
  for (const Light& light : inputs.lights) {
    if (!light.output) continue;
    for (const Light& other : inputs.lights) {
      if (&other != &light && other.output == light.output) {
        fail("soft shadows: lights {} and {} have the same output", light.id, other.id);
      }
    }
    if (checks.takes_known_output(*light.output, size)) continue;
    checks.add_output(*light.output, size, output_desc(*light.output, inputs.depth, light.id));
  }
}

void check_lights(const Inputs& inputs, TextureChecks& checks) {
  bool draws = false;
  for (const Light& light : inputs.lights) {
    if (!light.maps && !inputs.draw)
      fail("soft shadows: light {} has no maps and there is no caster callback", light.id);
    if (const std::string fault = fault_of(light.source); !fault.empty())
      fail("soft shadows: light {} {}", light.id, fault);
    for (const Light& other : inputs.lights) {
      if (&other != &light && other.id == light.id) fail("soft shadows: two lights have the id {}", light.id);
    }
    if (light.maps) check_maps(*light.maps, light.id, checks);
    draws = draws || !light.maps;
  }
  if (!draws) return;
  check_box("casters", inputs.casters);
  check_box("receivers", inputs.receivers);
}

void check_viewport(const Rect& rect, const TextureView& depth) {
  if (rect == Rect{}) return;
  const bool inside = rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
                      rect.width <= depth.width - rect.x && rect.height <= depth.height - rect.y;
  if (!inside) {
    fail("soft shadows: the viewport of {}×{} at {}, {} is not a part of {}×{}", rect.width, rect.height, rect.x,
         rect.y, depth.width, depth.height);
  }
}

}  // namespace

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

bool TextureChecks::takes_known_output(const OutputTexture& output, const glm::ivec2& size) {
  const auto found = std::ranges::find(last_, key_of(output, size), &Entry::key);
  if (found == last_.end()) return false;
  now_.push_back(*found);
  return true;
}

void TextureChecks::add_output(const OutputTexture& output, const glm::ivec2& size, const gl::TextureDesc& desc) {
  now_.push_back({key_of(output, size), desc});
}

const gl::TextureDesc& TextureChecks::desc_of(const OutputTexture& output) const {
  return std::ranges::find(now_, output, [](const Entry& entry) { return entry.key.output; })->desc;
}

void check(const Inputs& inputs) {
  TextureChecks nothing_known;
  check(inputs, nothing_known);
}

void check(const Inputs& inputs, TextureChecks& checks) {
  checks.begin();
  check_matrix("the view matrix", inputs.view.view);
  check_matrix("the projection matrix", inputs.view.projection);
  check_conventions(inputs.view.projection, inputs.conventions);
  if (!all_finite(glm::value_ptr(inputs.view.jitter), 2)) fail("soft shadows: the jitter is not finite");
  check_depth(inputs.depth, checks);
  const int normal_channels = inputs.conventions.octahedral_normals ? 2 : 3;
  check_decoding(inputs.conventions);
  if (inputs.normals.id != 0) {
    check_receivers({.name = "normals",
                     .texels = "normals",
                     .view = inputs.normals,
                     .channels = normal_channels,
                     .may_be_unsigned = decodes_normals(inputs.conventions)},
                    inputs.depth, checks);
  } else if (checks.depth.relative >= 0x1p-11f) {
    fail("soft shadows: no normals texture, and depths of half floats are too coarse to make normals from");
  }
  if (inputs.motion.id != 0) {
    check_receivers({.name = "motion", .texels = "motion vectors", .view = inputs.motion, .channels = 2}, inputs.depth,
                    checks);
  }
  check_viewport(inputs.viewport, inputs.depth);
  const Box& forward = inputs.forward_receivers;
  if (!glm::all(glm::greaterThan(forward.min, forward.max))) check_box("forward receivers", forward);
  const bool none_moved = inputs.moved && glm::all(glm::greaterThan(inputs.moved->min, inputs.moved->max));
  if (inputs.moved && !none_moved) check_finite("moved casters", *inputs.moved);
  check_lights(inputs, checks);
  check_outputs(inputs, checks);
}

Rect viewport_of(const Inputs& inputs) {
  return inputs.viewport == Rect{} ? Rect{0, 0, inputs.depth.width, inputs.depth.height} : inputs.viewport;
}

}  // namespace penumbra::shadow
