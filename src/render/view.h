#pragma once

#include <array>
#include <glm/glm.hpp>
#include <variant>

#include "scene/pose.h"
#include "shared/view_block.h"

namespace penumbra::render {

// A camera at one moment, in world space.
struct Camera {
  glm::mat4 view{1};  // world to view: right-handed, -Z forward
  bool orthographic = false;
  float fov_y = 0.8f;        // vertical field of view, radians; perspective only
  float half_height = 1.0f;  // metres; orthographic only
  float near = 0.1f;         // metres; the projection is reversed-Z with an infinite far plane (orthographic: `far`)
  float far = 1000.0f;

  bool operator==(const Camera&) const = default;
};

// An upright camera at `eye` that looks at `target`. Also defined for looking straight up or down.
Camera look_at(const glm::vec3& eye, const glm::vec3& target, float fov_y, float near);

glm::mat4 projection_of(const Camera& camera, float aspect);
glm::vec3 position_of(const Camera& camera);

// A directional light with what it emits; shadow::Sun is its part that shadows depend on.
struct SunLight {
  glm::vec3 to_light{0.4f, 0.8f, 0.4f};  // unit
  glm::vec3 illuminance{100000.0f};      // lux on a plane that faces it, linear RGB

  bool operator==(const SunLight&) const = default;
};

// A direction in the form that --sun takes, in degrees.
struct Angles {
  double azimuth = 0;    // from +Z towards +X
  double elevation = 0;  // over the horizon
};
Angles angles_of(const glm::vec3& to_light);

// A spot or a point lamp with what it emits (KHR_lights_punctual); shadow::Lamp is its part that shadows depend on. Its
// light falls off with the square of the distance.
struct LampLight {
  glm::vec3 position{0};       // world, metres
  float radius = 0.03f;        // of the sphere that emits light, metres
  glm::vec3 axis{0};           // in which a spot shines, unit, world; 0: in all directions
  float inner_cone = 0;        // half angles of a spot, radians: full light within the inner one,
  float outer_cone = 0.7854f;  // none beyond the outer one
  float range = 0;             // metres: no light from there on; 0: unlimited
  glm::vec3 intensity{100};    // candela, linear RGB; of a spot: within the inner cone
  int number = 0;              // of one that the user placed: names it, also when others are taken away

  bool operator==(const LampLight&) const = default;
};

// What can light a frame; shadow_lights() gives the shadow library the part that it needs.
using FrameLight = std::variant<SunLight, LampLight>;

// The most lights of one frame, and the most of them that cast shadows: the first ones.
inline constexpr int max_lights = 64, max_shadowed_lights = 8;

// The uniform block by which passes that draw geometry know the camera. `offset`: from the middle of a pixel to the
// place in it that is drawn, pixels, x to the right and y upwards.
glsl::ViewBlock view_block(const Camera& camera, const Camera& last_camera, int width, int height,
                           const glm::vec2& offset = glm::vec2(0));

// The planes that bound what a camera sees.
class Frustum {
 public:
  explicit Frustum(const glm::mat4& world_to_clip);
  bool holds(const scene::Bounds& box) const;  // conservative: false only if the box is certainly outside

 private:
  std::array<glm::vec4, 6> planes_;  // normal and offset, pointing inwards
};

}  // namespace penumbra::render
