#include "check_parts.h"

#include <algorithm>
#include <bit>

#include "../core/error.h"
#include "../gl/texture.h"

namespace penumbra::shadow {

namespace {

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

// Refuses what the frame reads: channels of the inputs' own textures, the others of which may be outputs.
void check_not_read(const Inputs& inputs, const Light& light) {
  const OutputTexture& output = *light.output;
  const auto refuse = [&](const std::string& use) {
    fail("soft shadows: the output of light {}: channel {} of texture {} has {}", light.id, output.channel, output.id,
         use);
  };
  const auto is_read = [&](const TextureView& view, int channels) {
    return view.id != 0 && output.id == view.id && output.level == 0 && output.layer == view.layer &&
           output.channel < channels;
  };
  if (is_read(inputs.depth, 1)) refuse("the depths");
  if (is_read(inputs.normals, inputs.conventions.octahedral_normals ? 2 : 3)) refuse("the normals");
  if (is_read(inputs.motion, 2)) refuse("the motion vectors");
  for (const Light& other : inputs.lights) {
    if (other.maps && other.maps->depth.id == output.id) refuse(fmt::format("the maps of light {}", other.id));
  }
}

}  // namespace

void check_outputs(const Inputs& inputs, TextureChecks& checks) {
  const glm::ivec2 size(inputs.depth.width, inputs.depth.height);
  for (const Light& light : inputs.lights) {
    if (!light.output) continue;
    for (const Light& other : inputs.lights) {
      if (&other != &light && other.output == light.output) {
        fail("soft shadows: lights {} and {} have the same output", light.id, other.id);
      }
    }
    check_not_read(inputs, light);
    if (checks.takes_known_output(*light.output, size)) continue;
    checks.add_output(*light.output, size, output_desc(*light.output, inputs.depth, light.id));
  }
}

}  // namespace penumbra::shadow
