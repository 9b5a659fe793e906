#include "render/view.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace penumbra::render {

namespace {

glm::vec3 row(const glm::mat4& m, glm::length_t i) { return {m[0][i], m[1][i], m[2][i]}; }
glm::vec4 full_row(const glm::mat4& m, glm::length_t i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

// The projection in which what lies at `offset` (NDC) is in the middle of the picture.
glm::mat4 shifted(const glm::mat4& projection, const glm::vec2& offset) {
  return glm::translate(glm::mat4(1), glm::vec3(-offset, 0)) * projection;
}

}  // namespace

Camera look_at(const glm::vec3& eye, const glm::vec3& target, float fov_y, float near) {
  const glm::vec3 forward = target - eye;
  const bool vertical = glm::length(glm::vec2(forward.x, forward.z)) < 1e-4f * std::abs(forward.y);
  const glm::vec3 up = vertical ? glm::vec3(0, 0, forward.y < 0 ? -1 : 1) : glm::vec3(0, 1, 0);
  return {.view = glm::lookAt(eye, target, up), .fov_y = fov_y, .near = near};
}

glm::mat4 projection_of(const Camera& camera, float aspect) {
  glm::mat4 m(0.0f);
  if (camera.orthographic) {
    const float range = camera.far - camera.near;
    m[0][0] = 1.0f / (camera.half_height * aspect);
    m[1][1] = 1.0f / camera.half_height;
    m[2][2] = 1.0f / range;
    m[3][2] = camera.far / range;
    m[3][3] = 1.0f;
    return m;
  }
  const float scale = 1.0f / std::tan(camera.fov_y * 0.5f);
  m[0][0] = scale / aspect;
  m[1][1] = scale;
  m[2][3] = -1.0f;
  m[3][2] = camera.near;
  return m;
}

Angles angles_of(const glm::vec3& to_light) {
  const glm::dvec3 v(to_light);
  return {.azimuth = glm::degrees(std::atan2(v.x, v.z)),
          .elevation = glm::degrees(std::atan2(v.y, std::hypot(v.x, v.z)))};
}

glm::vec3 position_of(const Camera& camera) {
  // The view matrix is rigid, so the inverse of its rotation is the transpose.
  return -(glm::transpose(glm::mat3(camera.view)) * glm::vec3(camera.view[3]));
}

glsl::ViewBlock view_block(const Camera& camera, const Camera& last_camera, int width, int height,
                           const glm::vec2& offset) {
  const glm::vec2 size(static_cast<float>(width), static_cast<float>(height));
  const float aspect = size.x / size.y;
  const float turn = camera.orthographic ? 0.0f : std::tan(camera.fov_y * 0.5f);
  const glm::vec2 shift = offset * 2.0f / size;
  const glm::vec3 ray_x = row(camera.view, 0) * turn * aspect, ray_y = row(camera.view, 1) * turn;
  return {.world_to_clip = shifted(projection_of(camera, aspect), shift) * camera.view,
          .last_world_to_clip = shifted(projection_of(last_camera, aspect), shift) * last_camera.view,
          .camera = glm::vec4(position_of(camera), camera.orthographic ? 1.0f : 0.0f),
          .forward = glm::vec4(-row(camera.view, 2) + shift.x * ray_x + shift.y * ray_y, camera.near),
          .ray_x = glm::vec4(ray_x, 0.0f),
          .ray_y = glm::vec4(ray_y, 0.0f),
          .viewport = glm::vec4(size, 1.0f / size)};
}

Frustum::Frustum(const glm::mat4& world_to_clip) {
  const glm::vec4 x = full_row(world_to_clip, 0), y = full_row(world_to_clip, 1);
  const glm::vec4 z = full_row(world_to_clip, 2), w = full_row(world_to_clip, 3);
  planes_ = {w + x, w - x, w + y, w - y, w - z, z};
}

bool Frustum::holds(const scene::Bounds& box) const {
  if (box.empty) return false;
  for (const glm::vec4& plane : planes_) {
    const glm::vec3 furthest(plane.x > 0 ? box.max.x : box.min.x, plane.y > 0 ? box.max.y : box.min.y,
                             plane.z > 0 ? box.max.z : box.min.z);
    if (glm::dot(glm::vec3(plane), furthest) + plane.w < 0) return false;
  }
  return true;
}

}  // namespace penumbra::render
