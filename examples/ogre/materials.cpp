#include "materials.h"

#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>

namespace {

const Ogre::String& group = Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;

constexpr const char* surface_vertex_shader = R"(#version 450
uniform mat4 world, inverse_transpose_world, view_projection;
uniform vec3 camera;
in vec4 vertex;
in vec3 normal;
out vec3 place;
out vec3 smooth_normal;
void main() {
  vec4 in_world = world * vertex;
  place = in_world.xyz - camera;
  smooth_normal = mat3(inverse_transpose_world) * normal;
  gl_Position = view_projection * in_world;
}
)";
constexpr const char* surface_fragment_shader = R"(#version 450
uniform vec3 sun_direction;
uniform vec4 colour;
in vec3 place;
in vec3 smooth_normal;
layout(location = 0) out vec4 sky_light;
layout(location = 1) out vec4 sun_light;
layout(location = 2) out vec4 triangle_normal;
void main() {
  vec3 n = normalize(smooth_normal);
  sky_light = vec4(colour.rgb * mix(vec3(0.12, 0.11, 0.1), vec3(0.17, 0.21, 0.28), 0.5 + 0.5 * n.y), 1.0);
  sun_light = vec4(colour.rgb * vec3(1.05, 0.94, 0.76) * max(dot(n, -sun_direction), 0.0), 1.0);
  vec3 flat_normal = normalize(cross(dFdx(place), dFdy(place)));
  triangle_normal = vec4(faceforward(flat_normal, place, flat_normal), 0.0);
}
)";

constexpr const char* picture_vertex_shader = R"(#version 450
uniform mat4 world_view_projection;
in vec4 vertex;
in vec2 uv0;
out vec2 uv;
void main() {
  uv = uv0;
  gl_Position = world_view_projection * vertex;
}
)";
constexpr const char* picture_fragment_shader = R"(#version 450
uniform sampler2D sky_light, sun_light, visibility, depth;
in vec2 uv;
layout(location = 0) out vec4 colour;
void main() {
  vec3 light = texture(sky_light, uv).rgb + texture(visibility, uv).r * texture(sun_light, uv).rgb;
  if (texture(depth, uv).r == 1.0) light = mix(vec3(0.2, 0.34, 0.55), vec3(0.5, 0.56, 0.62), uv.y);
  colour = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
}
)";

Ogre::GpuProgramParameters& add_program(const std::string& name, Ogre::GpuProgramType type, const char* text) {
  const auto program = Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, group, "glsl", type);
  program->setSource(text);
  program->load();
  return *program->getDefaultParameters();
}

Ogre::MaterialPtr add_material(const std::string& name, const std::string& programs) {
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(name, group);
  Ogre::Pass& pass = *material->getTechnique(0)->getPass(0);
  pass.setVertexProgram(programs + " vertex");
  pass.setFragmentProgram(programs + " fragment");
  return material;
}

}  // namespace

Ogre::MaterialPtr make_surface(const std::string& name, const Ogre::ColourValue& colour) {
  if (!Ogre::HighLevelGpuProgramManager::getSingleton().resourceExists("surface vertex", group)) {
    auto& vertex = add_program("surface vertex", Ogre::GPT_VERTEX_PROGRAM, surface_vertex_shader);
    vertex.setNamedAutoConstant("world", Ogre::GpuProgramParameters::ACT_WORLD_MATRIX);
    vertex.setNamedAutoConstant("inverse_transpose_world",
                                Ogre::GpuProgramParameters::ACT_INVERSE_TRANSPOSE_WORLD_MATRIX);
    vertex.setNamedAutoConstant("view_projection", Ogre::GpuProgramParameters::ACT_VIEWPROJ_MATRIX);
    vertex.setNamedAutoConstant("camera", Ogre::GpuProgramParameters::ACT_CAMERA_POSITION);
    auto& fragment = add_program("surface fragment", Ogre::GPT_FRAGMENT_PROGRAM, surface_fragment_shader);
    fragment.setNamedAutoConstant("sun_direction", Ogre::GpuProgramParameters::ACT_LIGHT_DIRECTION);
    fragment.setNamedAutoConstant("colour", Ogre::GpuProgramParameters::ACT_SURFACE_DIFFUSE_COLOUR);
  }
  const Ogre::MaterialPtr material = add_material(name, "surface");
  material->setDiffuse(colour);
  return material;
}

Ogre::MaterialPtr make_picture(const std::string& name) {
  auto& vertex = add_program("picture vertex", Ogre::GPT_VERTEX_PROGRAM, picture_vertex_shader);
  vertex.setNamedAutoConstant("world_view_projection", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  auto& fragment = add_program("picture fragment", Ogre::GPT_FRAGMENT_PROGRAM, picture_fragment_shader);
  int units = 0;
  for (const char* texture : {"sky_light", "sun_light", "visibility", "depth"}) {
    fragment.setNamedConstant(texture, units++);
  }
  const Ogre::MaterialPtr material = add_material(name, "picture");
  Ogre::Pass& pass = *material->getTechnique(0)->getPass(0);
  pass.setDepthCheckEnabled(false);
  pass.setDepthWriteEnabled(false);
  for (int i = 0; i < units; ++i) pass.createTextureUnitState()->setTextureFiltering(Ogre::TFO_NONE);
  return material;
}
