#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/log.h"
#include "scene/gltf/read.h"

// Reads cameras and punctual lights.

namespace penumbra::scene::gltf {
namespace {

Camera read_camera(const tinygltf::Camera& in) {
  Camera camera{.name = in.name, .orthographic = in.type == "orthographic"};
  double near = 0, far = 0;
  if (camera.orthographic) {
    near = in.orthographic.znear;
    far = in.orthographic.zfar;
    camera.half_width = static_cast<float>(std::abs(in.orthographic.xmag));
    camera.half_height = static_cast<float>(std::abs(in.orthographic.ymag));
    if (!(camera.half_width > 0 && camera.half_height > 0)) fail("xmag and ymag must not be zero");
  } else {
    near = in.perspective.znear;
    far = in.perspective.zfar;  // 0: infinite
    camera.fov_y = static_cast<float>(in.perspective.yfov);
  }
  if (far != 0 && far <= near) fail("zfar {} is not beyond znear {}", far, near);
  camera.near = static_cast<float>(near);
  if (far != 0) camera.far = static_cast<float>(far);
  return camera;
}

// The size of a lamp, which the extension leaves out: a number among the light's custom properties, which exporters of
// modelling programs write to its extras.
std::optional<float> radius_of_extras(const tinygltf::Value& extras, std::size_t number) {
  constexpr double most = 1000;  // metres
  if (!extras.IsObject() || !extras.Has("radius")) return {};
  const tinygltf::Value& value = extras.Get("radius");
  const double radius = value.IsNumber() ? value.GetNumberAsDouble() : -1;
  if (radius >= 0 && radius <= most) return static_cast<float>(radius);
  warn("light {}: the radius of its extras is not a number from 0 to {}; not used", number, most);
  return {};
}

PunctualLight read_light(const tinygltf::Light& in, std::size_t number) {
  PunctualLight light{.name = in.name};
  if (in.type == "point") light.kind = LightKind::point;
  if (in.type == "spot") light.kind = LightKind::spot;
  if (in.color.size() == 3) light.color = glm::vec3(in.color[0], in.color[1], in.color[2]);
  light.intensity = static_cast<float>(in.intensity);
  light.range = static_cast<float>(in.range);
  light.radius = radius_of_extras(in.extras, number);
  if (light.kind != LightKind::spot) return light;
  light.inner_cone = static_cast<float>(in.spot.innerConeAngle);
  light.outer_cone = static_cast<float>(in.spot.outerConeAngle);
  // Equal angles are a cone with a hard edge.
  if (light.inner_cone > light.outer_cone) {
    warn("light {}: innerConeAngle {} is outside of outerConeAngle {}; taken as equal to it", number, light.inner_cone,
         light.outer_cone);
    light.inner_cone = light.outer_cone;
  }
  return light;
}

}  // namespace

void read_cameras(Document& document, Scene& scene) {
  for (const tinygltf::Camera& in : document.model.cameras) {
    Camera camera;
    try {
      camera = read_camera(in);
    } catch (const Error& e) {
      document.left_out.add("cameras", scene.cameras.size(), e.what());
    }
    scene.cameras.push_back(std::move(camera));
  }
}

std::vector<int> read_lights(Document& document, Scene& scene) {
  std::vector<int> light_of;
  for (const tinygltf::Light& light : document.model.lights) {
    const std::size_t number = light_of.size();
    if (light.type != "directional" && light.type != "point" && light.type != "spot") {
      warn("light {} is of the unknown type '{}'; left out", number, light.type);
      light_of.push_back(-1);
      continue;
    }
    try {
      scene.lights.push_back(read_light(light, number));
    } catch (const Error& e) {
      document.left_out.add(lights_array, number, e.what());
      light_of.push_back(-1);
      continue;
    }
    light_of.push_back(static_cast<int>(scene.lights.size()) - 1);
  }
  return light_of;
}

}  // namespace penumbra::scene::gltf
