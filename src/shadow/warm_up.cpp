#include "warm_up.h"

#include <array>

#include "../gl/texture.h"

namespace penumbra::shadow {

namespace {

constexpr int side = 64;                              // of the picture, pixels
constexpr float half_width = 10, depth_of_view = 20;  // of what the picture shows, metres

TextureView cleared(gl::Device& device, const std::string& name, GLenum format, GLenum channels,
                    const std::array<float, 4>& value, GLenum target = GL_TEXTURE_2D) {
  const gl::Texture& texture = device.target(name, {.target = target, .format = format, .width = side, .height = side});
  gl::glClearTexImage(texture.id(), 0, channels, GL_FLOAT, value.data());
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

}  // namespace

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
  inputs.depth = cleared(device, prefix + "depth", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, {0.5f});
  inputs.conventions.normals_scale = 1;
  inputs.conventions.normals_offset = 0;
  // An octahedral map has its centre at z, too.
  const float z = kind.conventions.octahedral_normals ? 0 : 1;
  inputs.normals = cleared(device, prefix + "normals", GL_RGBA16F, GL_RGBA, {0, 0, z, 0});
  inputs.motion = cleared(device, prefix + "motion", GL_RG16F, GL_RG, {});
  inputs.lights = kind.lights;
  inputs.casters =
      inputs.receivers = {glm::vec3(-half_width, -half_width, -depth_of_view), glm::vec3(half_width, half_width, 0)};
  inputs.mask_details = kind.mask_details;
  inputs.draw = [](const CasterPass&, gl::Pass&) {};
  return inputs;
}

Inputs other_warm_up_inputs(gl::Device& device, const std::string& prefix, const FrameKind& kind) {
  Inputs inputs = warm_up_inputs(device, prefix, kind);
  inputs.depth =
      cleared(device, prefix + "depths", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, {0.5f}, GL_TEXTURE_2D_ARRAY);
  inputs.normals = {};
  return inputs;
}

}  // namespace penumbra::shadow
