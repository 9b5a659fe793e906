#include "soft_shadows.h"

#include <GL/gl3w.h>
#include <GL/glx.h>
#include <OgreGL3PlusHardwareIndexBuffer.h>
#include <OgreGL3PlusHardwareVertexBuffer.h>
#include <OgreGL3PlusRenderSystem.h>
#include <OgreGL3PlusStateCacheManager.h>
#include <OgrePlaneBoundedVolume.h>
#include <OgreRenderOperation.h>
#include <OgreRenderable.h>
#include <OgreRoot.h>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

// OGRE stores rows, OpenGL columns.
void copy(const Ogre::Matrix4& from, float (&to)[16]) {
  const Ogre::Matrix4 columns = from.transpose();
  std::copy(columns[0], columns[0] + 16, to);
}

Ogre::Matrix4 matrix_of(const float (&columns)[16]) {
  Ogre::Matrix4 matrix;
  std::copy(columns, columns + 16, matrix[0]);
  return matrix.transpose();
}

penumbra_box box_of(const Ogre::AxisAlignedBox& box) {
  if (box.isNull()) return {{1, 1, 1}, {-1, -1, -1}};
  const Ogre::Vector3 &min = box.getMinimum(), &max = box.getMaximum();
  return {{min.x, min.y, min.z}, {max.x, max.y, max.z}};
}

unsigned name_of(const Ogre::TexturePtr& texture) {
  unsigned name = 0;
  if (texture) texture->getCustomAttribute("GLID", &name);
  return name;
}

penumbra_texture texture_of(const Ogre::TexturePtr& texture) {
  if (!texture) return {};
  return {name_of(texture), static_cast<int>(texture->getWidth()), static_cast<int>(texture->getHeight())};
}

// OGRE gives its textures a swizzle, if they hold depth, and a highest level; Penumbra takes OpenGL's initial values.
void reset_parameters(const Ogre::TexturePtr& texture) {
  if (!texture) return;
  constexpr GLint swizzle[4] = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
  glTextureParameteriv(name_of(texture), GL_TEXTURE_SWIZZLE_RGBA, swizzle);
  glTextureParameteri(name_of(texture), GL_TEXTURE_MAX_LEVEL, 1000);
}

Ogre::PlaneBoundedVolume volume_of(const penumbra_caster_pass& pass) {
  Ogre::PlaneBoundedVolume volume(Ogre::Plane::NEGATIVE_SIDE);
  for (const auto& plane : pass.cull_planes) {
    volume.planes.emplace_back(static_cast<float>(plane[0]), static_cast<float>(plane[1]), static_cast<float>(plane[2]),
                               static_cast<float>(plane[3]));
  }
  return volume;
}

// The same expression in all programs, so that a caster has the same depths in all passes.
constexpr const char* caster_shader = R"(#version 450
layout(location = 0) uniform mat4 local_to_clip;
layout(location = 0) in vec4 vertex;
invariant gl_Position;
void main() { gl_Position = local_to_clip * vertex; }
)";

// A program of OpenGL's own: those of OGRE can't have uniform blocks that OGRE does not know.
GLuint make_program(const penumbra_caster_pass& pass) {
  const GLuint program = glCreateProgram();
  const auto attach = [program](GLenum type, const char* text) {
    if (!text) return;
    const GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);  // once the program is
  };
  attach(GL_VERTEX_SHADER, caster_shader);
  attach(GL_GEOMETRY_SHADER, pass.geometry_shader);
  attach(GL_FRAGMENT_SHADER, pass.fragment_shader);
  glLinkProgram(program);
  GLint is_linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &is_linked);
  if (!is_linked) throw std::runtime_error("the program that draws casters does not link");
  return program;
}

// Draws OGRE's objects from OGRE's buffers, with the program and the vertex array that are bound. Materials and
// textures are left out: an alpha test would have to be in the program.
class CasterVisitor : public Ogre::Renderable::Visitor {
 public:
  explicit CasterVisitor(const penumbra_caster_pass& pass)
      : world_to_clip_(matrix_of(pass.world_to_clip)), volume_(volume_of(pass)) {}

  void draw(const Ogre::SceneNode& node) {
    for (Ogre::MovableObject* object : node.getAttachedObjects()) {
      if (object->getCastShadows() && volume_.intersects(object->getWorldBoundingBox(true))) {
        object->visitRenderables(this);
      }
    }
    for (const Ogre::Node* child : node.getChildren()) draw(static_cast<const Ogre::SceneNode&>(*child));
  }

 private:
  void visit(Ogre::Renderable* renderable, Ogre::ushort, bool is_debug, Ogre::Any*) override {
    if (is_debug) return;
    if (renderable->getNumWorldTransforms() != 1) throw std::runtime_error("this example draws no skins");
    Ogre::Matrix4 local_to_world;
    renderable->getWorldTransforms(&local_to_world);
    glUniformMatrix4fv(0, 1, GL_TRUE, (world_to_clip_ * local_to_world)[0]);
    Ogre::RenderOperation operation;
    renderable->getRenderOperation(operation);
    draw(operation);
  }

  static void draw(const Ogre::RenderOperation& operation) {
    const Ogre::VertexData& vertices = *operation.vertexData;
    const Ogre::VertexElement& place = *vertices.vertexDeclaration->findElementBySemantic(Ogre::VES_POSITION);
    const auto& buffer = static_cast<const Ogre::GL3PlusHardwareVertexBuffer&>(
        *vertices.vertexBufferBinding->getBuffer(place.getSource()));
    const std::size_t stride = buffer.getVertexSize(), begin = vertices.vertexStart * stride + place.getOffset();
    glBindVertexBuffer(0, buffer.getGLBufferId(), static_cast<GLintptr>(begin), static_cast<GLsizei>(stride));
    const auto mode = static_cast<GLenum>(operation.operationType);  // both have the same numbers
    if (!operation.useIndexes) {
      glDrawArrays(mode, 0, static_cast<GLsizei>(vertices.vertexCount));
      return;
    }
    const Ogre::IndexData& indices = *operation.indexData;
    const auto& index_buffer = static_cast<const Ogre::GL3PlusHardwareIndexBuffer&>(*indices.indexBuffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer.getGLBufferId());
    glDrawElements(mode, static_cast<GLsizei>(indices.indexCount),
                   index_buffer.getType() == Ogre::HardwareIndexBuffer::IT_16BIT ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(indices.indexStart * index_buffer.getIndexSize()));
  }

  Ogre::Matrix4 world_to_clip_;
  Ogre::PlaneBoundedVolume volume_;
};

// OGRE remembers its program, its viewport with the target of that and, if it was built with a cache of OpenGL's state,
// all else that it has set. What Penumbra changes is at OpenGL's initial values after a frame; so is OGRE's cache then.
void forget_state(Ogre::RenderSystem& renderer) {
  auto& gl = static_cast<Ogre::GL3PlusRenderSystem&>(renderer);
  gl._endFrame();  // unbinds programs
  gl._getStateCacheManager()->clearCache();
  gl._getStateCacheManager()->initializeCache();
  gl._oneTimeContextInitialization();  // sets again what OGRE sets but once
  gl._setViewport(nullptr);
}

// Also if render() throws.
struct ForgetsAtEnd {
  explicit ForgetsAtEnd(Ogre::RenderSystem& of) : renderer(of) {}
  ~ForgetsAtEnd() { forget_state(renderer); }
  ForgetsAtEnd(const ForgetsAtEnd&) = delete;
  ForgetsAtEnd& operator=(const ForgetsAtEnd&) = delete;

  Ogre::RenderSystem& renderer;
};

}  // namespace

SoftShadows::SoftShadows(const ShadowScene& scene, penumbra::api::Settings settings)
    : scene_(scene),
      renderer_(*Ogre::Root::getSingleton().getRenderSystem()),
      settings_(std::move(settings)),
      device_([](const char* name) { return glXGetProcAddress(reinterpret_cast<const GLubyte*>(name)); }) {
  glCreateVertexArrays(1, &vertex_array_);
  glEnableVertexArrayAttrib(vertex_array_, 0);
  glVertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(vertex_array_, 0, 0);
}

SoftShadows::~SoftShadows() {
  for (const auto& [id, program] : programs_) glDeleteProgram(program);
  glDeleteVertexArrays(1, &vertex_array_);
}

void SoftShadows::use(const ShadowTextures& textures) {
  textures_ = textures;
  for (const auto& texture : {textures.depth, textures.normals, textures.visibility}) reset_parameters(texture);
  device_.forget_view(0);  // OpenGL may give a new texture the name of an old one
  last_.reset();
}

SoftShadows::View SoftShadows::view_now() const {
  View now{scene_.camera->getViewMatrix(), scene_.camera->getProjectionMatrixWithRSDepth(),
           scene_.moving->_getWorldAABB()};
  for (int column = 0; column < 4; ++column) now.projection[1][column] *= -1;  // OGRE draws textures upside down
  return now;
}

void SoftShadows::postRenderTargetUpdate(const Ogre::RenderTargetEvent&) {
  const View now = view_now(), last = last_.value_or(now);
  const Ogre::Vector3 to_sun = -scene_.sun->getDerivedDirection();
  std::array lights{penumbra::api::sun(0, to_sun)};
  lights[0].output_texture = name_of(textures_.visibility);

  penumbra::api::Frame frame;
  frame.reversed_z = 0;
  frame.depth_zero_to_one = 0;
  frame.normals_encoding = PENUMBRA_NORMALS_XYZ;
  copy(now.view, frame.view);
  copy(now.projection, frame.projection);
  copy(last.view, frame.last_view);
  copy(last.projection, frame.last_projection);
  frame.depth = texture_of(textures_.depth);
  frame.normals = texture_of(textures_.normals);
  frame.casters = frame.receivers = box_of(scene_.casters->_getWorldAABB());
  frame.moved_is_known = 1;
  Ogre::AxisAlignedBox moved = now.moving;
  moved.merge(last.moving);
  frame.moved = box_of(moved);
  frame.light_with(lights);
  frame.draw_with([&](const penumbra_caster_pass& pass) { draw_casters(pass); });
  const ForgetsAtEnd forgets(renderer_);
  device_.render(settings_, frame);
  last_ = now;
}

void SoftShadows::draw_casters(const penumbra_caster_pass& pass) {
  glUseProgram(program_of(pass));
  glBindVertexArray(vertex_array_);
  CasterVisitor(pass).draw(*scene_.casters);
}

unsigned SoftShadows::program_of(const penumbra_caster_pass& pass) {
  if (pass.kind != PENUMBRA_PASS_DEPTH && pass.kind != PENUMBRA_PASS_GEOMETRY) {
    throw std::runtime_error("these settings need passes of casters that this example does not draw: kind " +
                             std::to_string(pass.kind) + " of penumbra.h");
  }
  unsigned& program = programs_[pass.program_id];
  if (program == 0) program = make_program(pass);
  return program;
}
