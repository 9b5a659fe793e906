#include <string>

#include "io/report.h"

namespace penumbra::io {

namespace {

const char* to_text(scene::AlphaMode mode) {
  switch (mode) {
    case scene::AlphaMode::opaque:
      return "opaque";
    case scene::AlphaMode::mask:
      return "mask";
    case scene::AlphaMode::blend:
      return "blend";
  }
  return "";
}

Json to_json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json to_json(const scene::MaterialInfo& material) {
  return {{"name", material.name},
          {"alpha", to_text(material.alpha_mode)},
          {"double_sided", material.double_sided},
          {"unlit", material.unlit},
          {"textures", material.textures}};
}

Json to_json(const scene::LightInfo& light) {
  Json json{{"name", light.name}, {"kind", light.kind}, {"intensity", light.intensity}, {"unit", light.unit}};
  if (light.range > 0) json["range_m"] = light.range;
  if (light.cones) json["cone_half_angles_degrees"] = {light.cones->x, light.cones->y};
  if (light.radius) json["radius_m"] = *light.radius;
  if (light.place) json["place_m"] = {light.place->x, light.place->y, light.place->z};
  return json;
}

Json to_json(const scene::CameraInfo& camera) { return {{"name", camera.name}, {"kind", camera.kind}}; }

Json to_json(const scene::AnimationInfo& animation) {
  return {{"name", animation.name},
          {"seconds", animation.duration},
          {"channels", animation.channels},
          {"played", animation.played}};
}

template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(to_json(item));
  return list;
}

}  // namespace

Json to_json(const scene::SceneInfo& scene) {
  Json json = {{"name", scene.name},
               {"nodes", scene.nodes},
               {"drawn_nodes", scene.drawn_nodes},
               {"meshes", scene.meshes},
               {"primitives", scene.primitives},
               {"vertices", scene.vertices},
               {"triangles", scene.triangles},
               {"lines", scene.lines},
               {"points", scene.points},
               {"instances", scene.instances},
               {"morph_targets", scene.morph_targets},
               {"skins", scene.skins},
               {"joints", scene.joints},
               {"textures", scene.textures},
               {"images", scene.images},
               {"image_bytes", scene.image_bytes}};
  json["bounds"] =
      scene.bounds.empty ? Json(nullptr) : Json{{"min", to_json(scene.bounds.min)}, {"max", to_json(scene.bounds.max)}};
  if (scene.animated_bounds)
    json["animated_bounds"] = {{"min", to_json(scene.animated_bounds->min)},
                               {"max", to_json(scene.animated_bounds->max)}};
  json["gpu_vertex_bytes"] = scene.gpu_vertex_bytes;
  json["gpu_texture_bytes"] = scene.gpu_texture_bytes;
  json["materials"] = list_of(scene.materials);
  json["lights"] = list_of(scene.lights);
  json["cameras"] = list_of(scene.cameras);
  json["animations"] = list_of(scene.animations);
  json["extensions"] = scene.extensions;
  json["unsupported_extensions"] = scene.unsupported_extensions;
  return json;
}

}  // namespace penumbra::io
