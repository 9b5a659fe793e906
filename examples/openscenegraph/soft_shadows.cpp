#include "soft_shadows.h"

#include <algorithm>
#include <array>
#include <osg/ComputeBoundsVisitor>
#include <osg/Drawable>
#include <osg/GLExtensions>
#include <osg/Polytope>
#include <osg/Transform>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

// Both store the same 16 numbers in the same order: OpenSceneGraph's row vectors are OpenGL's columns.
void copy(const osg::Matrixd& from, float (&to)[16]) {
  std::transform(from.ptr(), from.ptr() + 16, to, [](double x) { return static_cast<float>(x); });
}

penumbra_box box_of(const osg::BoundingBox& box) {
  return {{box.xMin(), box.yMin(), box.zMin()}, {box.xMax(), box.yMax(), box.zMax()}};
}

penumbra_texture texture_of(const osg::Texture2D& texture, unsigned context) {
  return {texture.getTextureObject(context)->id(), texture.getTextureWidth(), texture.getTextureHeight()};
}

osg::BoundingBox bounds_of(osg::Node& node) {
  osg::ComputeBoundsVisitor visitor;
  node.accept(visitor);
  return visitor.getBoundingBox();
}

osg::Polytope volume_of(const penumbra_caster_pass& pass) {
  osg::Polytope volume;
  for (const auto& plane : pass.cull_planes) volume.add(osg::Plane(plane[0], plane[1], plane[2], plane[3]));
  return volume;
}

// Draws each drawable by its own vertex buffers, with one program. Materials and textures are left out: an alpha test
// would have to be in the program.
class CasterVisitor : public osg::NodeVisitor {
 public:
  CasterVisitor(osg::RenderInfo& info, const osg::Program& program, const penumbra_caster_pass& pass)
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN),
        info_(info),
        program_(*program.getPCP(*info.getState())),
        world_to_clip_(pass.world_to_clip),
        volume_(volume_of(pass)) {}

  using osg::NodeVisitor::apply;
  void apply(osg::Transform& transform) override {
    const osg::Matrixd outer = local_to_world_;
    transform.computeLocalToWorldMatrix(local_to_world_, this);
    traverse(transform);
    local_to_world_ = outer;
  }
  void apply(osg::Drawable& drawable) override {
    osg::BoundingBox box;
    for (unsigned i = 0; i < 8; ++i) box.expandBy(drawable.getBoundingBox().corner(i) * local_to_world_);
    if (!volume_.contains(box)) return;
    local_to_clip_->set(local_to_world_ * world_to_clip_);
    program_.apply(*local_to_clip_);
    drawable.draw(info_);
  }

 private:
  osg::RenderInfo& info_;
  const osg::Program::PerContextProgram& program_;
  osg::Matrixd local_to_world_, world_to_clip_;
  osg::Polytope volume_;
  osg::ref_ptr<osg::Uniform> local_to_clip_ = new osg::Uniform(osg::Uniform::FLOAT_MAT4, "local_to_clip");
};

// The same expression in all programs, so that a caster has the same depths in all passes.
constexpr const char* caster_shader = R"(#version 450 compatibility
uniform mat4 local_to_clip;
invariant gl_Position;
void main() { gl_Position = local_to_clip * gl_Vertex; }
)";

// OpenSceneGraph remembers what it has set, and leaves out what it thinks is set already. What Penumbra changes is at
// OpenGL's initial values after a frame, but not what OpenSceneGraph remembers of it.
void forget_state(osg::State& state) {
  state.dirtyAllModes();
  state.dirtyAllAttributes();
  state.setLastAppliedProgramObject(nullptr);
}

// Also if render() throws.
struct ForgetsAtEnd {
  explicit ForgetsAtEnd(osg::State& of) : state(of) {}
  ~ForgetsAtEnd() { forget_state(state); }
  ForgetsAtEnd(const ForgetsAtEnd&) = delete;
  ForgetsAtEnd& operator=(const ForgetsAtEnd&) = delete;

  osg::State& state;
};

}  // namespace

SoftShadows::SoftShadows(ShadowScene scene, penumbra::api::Settings settings)
    : scene_(scene), settings_(std::move(settings)) {}

void SoftShadows::operator()(osg::RenderInfo& info) const {
  osg::State& state = *info.getState();
  const bool first = !device_;
  if (first) {
    device_.emplace([](const char* name) { return reinterpret_cast<penumbra_proc>(osg::getGLExtensionFuncPtr(name)); });
  }
  const osg::Matrixd view = scene_.view->getViewMatrix(), projection = scene_.view->getProjectionMatrix();
  const osg::BoundingBox moving = bounds_of(*scene_.moving);
  const std::array lights{penumbra::api::sun(0, scene_.to_sun)};

  penumbra::api::Frame frame;
  frame.reversed_z = 0;
  frame.depth_zero_to_one = 0;
  frame.normals_encoding = PENUMBRA_NORMALS_XYZ;
  copy(view, frame.view);
  copy(projection, frame.projection);
  copy(first ? view : last_view_, frame.last_view);
  copy(first ? projection : last_projection_, frame.last_projection);
  frame.depth = texture_of(*scene_.depth, info.getContextID());
  if (scene_.normals) frame.normals = texture_of(*scene_.normals, info.getContextID());
  frame.casters = frame.receivers = box_of(bounds_of(*scene_.casters));
  frame.moved_is_known = 1;
  osg::BoundingBox moved = moving;
  moved.expandBy(last_moving_);
  frame.moved = box_of(moved);
  frame.light_with(lights);
  frame.draw_with([&](const penumbra_caster_pass& pass) { draw_casters(info, pass); });
  const ForgetsAtEnd forgets(state);
  mask_ = device_->render(settings_, frame).texture;
  last_view_ = view;
  last_projection_ = projection;
  last_moving_ = moving;
}

void SoftShadows::draw_casters(osg::RenderInfo& info, const penumbra_caster_pass& pass) const {
  osg::State& state = *info.getState();
  state.get<osg::GLExtensions>()->glBindVertexArray(0);  // the one that OpenSceneGraph thinks is bound
  state.setCurrentVertexArrayObject(0);
  const osg::Program& program = program_of(pass);
  program.apply(state);
  if (!program.getPCP(state)->isLinked()) throw std::runtime_error("the program that draws casters does not link");
  CasterVisitor visitor(info, program, pass);
  scene_.casters->accept(visitor);
}

const osg::Program& SoftShadows::program_of(const penumbra_caster_pass& pass) const {
  if (pass.kind != PENUMBRA_PASS_DEPTH && pass.kind != PENUMBRA_PASS_GEOMETRY) {
    throw std::runtime_error("these settings need passes of casters that this example does not draw: kind " +
                             std::to_string(pass.kind) + " of penumbra.h");
  }
  osg::ref_ptr<osg::Program>& program = programs_[pass.program_id];
  if (!program) {
    program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, caster_shader));
    if (pass.geometry_shader) program->addShader(new osg::Shader(osg::Shader::GEOMETRY, pass.geometry_shader));
    if (pass.fragment_shader) program->addShader(new osg::Shader(osg::Shader::FRAGMENT, pass.fragment_shader));
  }
  return *program;
}
