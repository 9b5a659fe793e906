#include "warm_up.h"

#include "../core/error.h"
#include "../gl/pass.h"
#include "../gl/texture.h"
#include "../gl/texture_format.h"
#include "check_parts.h"
#include "lib/octahedral.glsl"

namespace penumbra::shadow {

namespace {

// Of the picture, pixels. No power of two, as pictures seldom are: drivers may compile a program anew for such a size.
constexpr int side = 60;
constexpr float half_width = 10, depth_of_view = 20;  // of what the picture shows, metres

bool is_depth(GLenum format) {
  const gl::ChannelKind kind = gl::format_info(format).kind;
  return kind == gl::ChannelKind::depth || kind == gl::ChannelKind::depth_stencil;
}

// That of the given texture, if it is one of numbers that are read as floats; else the usual one.
GLenum format_like(const TextureView& given, GLenum usual) {
  if (given.id == 0 || gl::glIsTexture(given.id) == GL_FALSE) return usual;
  const auto format = static_cast<GLenum>(level_parameter(given.id, GL_TEXTURE_INTERNAL_FORMAT));
  try {
    return gl::format_info(format).kind == gl::ChannelKind::real || is_depth(format) ? format : usual;
  } catch (const Error&) {
    return usual;
  }
}

TextureView cleared(gl::Device& device, const std::string& name, GLenum format, const glm::vec4& value,
                    GLenum target = GL_TEXTURE_2D) {
  const gl::Texture& texture = device.target(name, {.target = target, .format = format, .width = side, .height = side});
  if (is_depth(format)) {
    gl::Pass(device, {.name = "warm-up depth", .depth = gl::Attachment{.texture = &texture, .clear = value}});
  } else {
    gl::glClearTexImage(texture.id(), 0, GL_RGBA, GL_FLOAT, &value);
  }
  return {.id = texture.id(), .width = side, .height = side};
}

// Orthographic: x and y within ±half_width, distances from 0 to depth_of_view.
glm::mat4 projection_for(const Conventions& conventions) {
  const float near = conventions.depth_zero_to_one ? 0.0f : -1.0f;  // of clip space
  const float slope = (1 - near) / depth_of_view;
  glm::mat4 projection(1);
  projection[0][0] = projection[1][1] = 1 / half_width;
  projection[2][2] = conventions.reversed_z ? slope : -slope;  // the camera looks along -z
  projection[3][2] = conventions.reversed_z ? 1 : near;
  return projection;
}

// Towards the first light if it is a sun, so that receivers are not turned away from it.
glm::vec3 normal_for(const FrameKind& kind) {
  const glm::vec3 to_viewer(0, 0, 1);
  if (kind.lights.empty()) return to_viewer;
  const glm::vec4 place = place_of(kind.lights[0].source);
  return place.w == 0 ? glm::normalize(glm::vec3(place)) : to_viewer;
}

void draw_caster(const CasterPass& casters, gl::Pass& pass) {
  if (casters.kind == CasterKind::geometry) return;
  pass.use(warm_up_caster_program());
  pass.draw_full_screen();
}

}  // namespace

gl::ProgramDesc warm_up_caster_program() {
  return {.name = "warm-up caster",
          .vertex = "shadow/drivers/warm_up_caster.vert",
          .fragment = "shadow/drivers/warm_up_caster.frag"};
}

std::vector<Light> warm_up_lights(gl::Device& device, const std::string& prefix, const FrameKind& kind) {
  std::vector<Light> lights(kind.lights.begin(), kind.lights.end());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!lights[i].output) continue;
    const gl::Texture& texture = device.target(prefix + "output", {.target = GL_TEXTURE_2D_ARRAY,
                                                                   .format = GL_R8,
                                                                   .width = side,
                                                                   .height = side,
                                                                   .layers = static_cast<int>(lights.size())});
    lights[i].output = OutputTexture{.id = texture.id(), .layer = static_cast<int>(i)};
  }
  return lights;
}

Inputs warm_up_inputs(gl::Device& device, const std::string& prefix, const FrameKind& kind) {
  Inputs inputs;
  inputs.view.projection = inputs.view.last_projection = projection_for(kind.conventions);
  inputs.conventions = kind.conventions;
  inputs.depth = cleared(device, prefix + "depth", format_like(kind.depth, GL_DEPTH_COMPONENT32F), glm::vec4(0.5f));
  const Conventions& conventions = kind.conventions;
  const glm::vec3 normal = normal_for(kind);
  const glm::vec3 given = conventions.octahedral_normals ? glm::vec3(glsl::octahedral_encode(normal), 0) : normal;
  const glm::vec4 stored((given - conventions.normals_offset) / conventions.normals_scale, 0);
  inputs.normals = cleared(device, prefix + "normals", format_like(kind.normals, GL_RGBA16F), stored);
  inputs.motion = cleared(device, prefix + "motion", format_like(kind.motion, GL_RG16F), glm::vec4(0));
  inputs.lights = kind.lights;
  inputs.casters =
      inputs.receivers = {glm::vec3(-half_width, -half_width, -depth_of_view), glm::vec3(half_width, half_width, 0)};
  inputs.mask_details = kind.mask_details;
  inputs.draw = draw_caster;
  return inputs;
}

Inputs other_warm_up_inputs(gl::Device& device, const std::string& prefix, const FrameKind& kind) {
  Inputs inputs = warm_up_inputs(device, prefix, kind);
  inputs.depth = cleared(device, prefix + "depths", GL_DEPTH_COMPONENT32F, glm::vec4(0.5f), GL_TEXTURE_2D_ARRAY);
  inputs.normals = {};
  return inputs;
}

}  // namespace penumbra::shadow
