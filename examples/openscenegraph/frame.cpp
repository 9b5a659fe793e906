#include "frame.h"

#include <osg/GL>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Program>
#include <utility>

namespace {

constexpr unsigned mask_unit = 3;

osg::ref_ptr<osg::Program> program_of(const char* vertex_shader, const char* fragment_shader) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex_shader));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment_shader));
  return program;
}

constexpr const char* surface_vertex_shader = R"(#version 450 compatibility
uniform mat4 osg_ViewMatrixInverse;
out vec3 place;
out vec3 normal;
out vec3 albedo;
void main() {
  place = mat3(osg_ViewMatrixInverse) * vec3(gl_ModelViewMatrix * gl_Vertex);  // from the camera, world axes
  normal = mat3(osg_ViewMatrixInverse) * gl_NormalMatrix * gl_Normal;
  albedo = gl_Color.rgb;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";
constexpr const char* surface_fragment_shader = R"(#version 450
uniform vec3 to_sun;
in vec3 place;
in vec3 normal;
in vec3 albedo;
layout(location = 0) out vec4 sky_light;
layout(location = 1) out vec4 sun_light;
layout(location = 2) out vec4 triangle_normal;
void main() {
  vec3 n = normalize(normal);
  sky_light = vec4(albedo * mix(vec3(0.12, 0.11, 0.1), vec3(0.17, 0.21, 0.28), 0.5 + 0.5 * n.z), 1.0);
  sun_light = vec4(albedo * vec3(1.05, 0.94, 0.76) * max(dot(n, to_sun), 0.0), 1.0);
  triangle_normal = vec4(normalize(cross(dFdx(place), dFdy(place))), 0.0);
}
)";

constexpr const char* picture_vertex_shader = R"(#version 450 compatibility
void main() { gl_Position = gl_Vertex; }
)";
constexpr const char* picture_fragment_shader = R"(#version 450
uniform sampler2D sky_light;
uniform sampler2D sun_light;
uniform sampler2D depth;
uniform sampler2DArray mask;
layout(location = 0) out vec4 color;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float visible = texelFetch(mask, ivec3(pixel, 0), 0).r;
  vec3 light = texelFetch(sky_light, pixel, 0).rgb + visible * texelFetch(sun_light, pixel, 0).rgb;
  if (texelFetch(depth, pixel, 0).r == 1.0) {
    light = mix(vec3(0.5, 0.56, 0.62), vec3(0.2, 0.34, 0.55), gl_FragCoord.y / float(textureSize(depth, 0).y));
  }
  color = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
}
)";

osg::ref_ptr<osg::Texture2D> make_target(int width, int height, GLint internal_format, GLenum format) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
  texture->setTextureSize(width, height);
  texture->setInternalFormat(internal_format);
  texture->setSourceFormat(format);
  texture->setSourceType(GL_FLOAT);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  return texture;
}

// Draws with the mask, a texture that OpenSceneGraph does not know.
class DrawWithMask : public osg::Drawable::DrawCallback {
 public:
  explicit DrawWithMask(const SoftShadows& shadows) : shadows_(&shadows) {}
  void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override {
    info.getState()->setActiveTextureUnit(mask_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY_EXT, shadows_->mask());
    drawable->drawImplementation(info);
    glBindTexture(GL_TEXTURE_2D_ARRAY_EXT, 0);
  }

 private:
  osg::ref_ptr<const SoftShadows> shadows_;
};

osg::ref_ptr<osg::Node> make_picture(const FrameGraph& frame, osg::Texture2D* sky_light, osg::Texture2D* sun_light) {
  osg::ref_ptr<osg::Geometry> quad =
      osg::createTexturedQuadGeometry(osg::Vec3(-1, -1, 0), osg::Vec3(2, 0, 0), osg::Vec3(0, 2, 0));
  quad->setUseDisplayList(false);
  quad->setDrawCallback(new DrawWithMask(*frame.shadows));
  osg::StateSet& state = *quad->getOrCreateStateSet();
  state.setAttributeAndModes(program_of(picture_vertex_shader, picture_fragment_shader));
  osg::Texture2D* const textures[3] = {sky_light, sun_light, frame.depth};
  const char* const names[3] = {"sky_light", "sun_light", "depth"};
  for (int unit = 0; unit < 3; ++unit) {
    state.setTextureAttribute(static_cast<unsigned>(unit), textures[unit]);
    state.addUniform(new osg::Uniform(names[unit], unit));
  }
  state.addUniform(new osg::Uniform("mask", static_cast<int>(mask_unit)));
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(quad);
  geode->setCullingActive(false);
  return geode;
}

}  // namespace

FrameGraph make_frame(osgViewer::Viewer& viewer, osg::Node& scene, osg::Node& moving, const osg::Vec3& to_sun,
                      penumbra::api::Settings settings) {
  // OpenSceneGraph may move the near and far plane while it culls; Penumbra needs the projection that is drawn with.
  osg::Camera& view = *viewer.getCamera();
  view.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  const int width = static_cast<int>(view.getViewport()->width()),
            height = static_cast<int>(view.getViewport()->height());

  FrameGraph frame;
  frame.depth = make_target(width, height, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
  frame.normals = make_target(width, height, GL_RGBA16F_ARB, GL_RGBA);
  osg::ref_ptr<osg::Texture2D> sky_light = make_target(width, height, GL_RGBA16F_ARB, GL_RGBA);
  osg::ref_ptr<osg::Texture2D> sun_light = make_target(width, height, GL_RGBA16F_ARB, GL_RGBA);

  frame.scene_camera = new osg::Camera;
  osg::Camera& camera = *frame.scene_camera;
  camera.setRenderOrder(osg::Camera::PRE_RENDER);
  camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera.setReferenceFrame(osg::Transform::RELATIVE_RF);  // the viewer's matrices
  camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera.setViewport(0, 0, width, height);
  camera.attach(osg::Camera::DEPTH_BUFFER, frame.depth);
  camera.attach(osg::Camera::COLOR_BUFFER0, sky_light);
  camera.attach(osg::Camera::COLOR_BUFFER1, sun_light);
  camera.attach(osg::Camera::COLOR_BUFFER2, frame.normals);
  camera.addChild(&scene);
  osg::StateSet& state = *camera.getOrCreateStateSet();
  state.setAttributeAndModes(program_of(surface_vertex_shader, surface_fragment_shader));
  state.addUniform(new osg::Uniform("to_sun", to_sun));

  frame.shadows = new SoftShadows({&view, frame.depth, frame.normals, &scene, &moving, to_sun}, std::move(settings));
  camera.setFinalDrawCallback(frame.shadows);

  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(frame.scene_camera);
  root->addChild(make_picture(frame, sky_light, sun_light));
  viewer.setSceneData(root);
  return frame;
}

void resize(FrameGraph& frame, int width, int height) { frame.scene_camera->resize(width, height); }
