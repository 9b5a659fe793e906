#pragma once

// Penumbra in a program of OpenSceneGraph: all that such a program adds to have soft shadows.
#include <cstdint>
#include <map>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Camera>
#include <osg/Program>
#include <osg/Texture2D>
#include <penumbra/penumbra.hpp>

// What shadows depend on. The matrices and the depth texture must be those of one camera.
struct ShadowScene {
  const osg::Camera* view;        // whose matrices the textures are drawn with
  const osg::Texture2D* depth;    // any depth format, OpenGL's own conventions: 0 near, 1 far, clip space -1..1
  const osg::Texture2D* normals;  // of triangles, world space, x y z in -1..1; null: made from depth, less precise
  osg::Node* casters;             // what casts and receives shadows; no transforms above it
  osg::Node* moving;              // the part of it that moves; no transforms above it
  osg::Vec3 to_sun;               // direction in world space
};

// The final draw callback of the camera that draws depth: computes the mask of this frame. The viewer must draw on the
// thread that changes the scene (osgViewer::ViewerBase::SingleThreaded). Throws penumbra::api::Error.
class SoftShadows : public osg::Camera::DrawCallback {
 public:
  SoftShadows(ShadowScene scene, penumbra::api::Settings settings);

  using osg::Camera::DrawCallback::operator();
  void operator()(osg::RenderInfo& info) const override;

  // OpenGL's name of a texture array whose layer 0 is the visible share of the sun at each pixel; 0 before the first
  // frame.
  unsigned mask() const { return mask_; }

  // Frees all OpenGL objects, while the context is current.
  void release() const { device_.reset(); }
  // Forgets them, once the context is gone.
  void abandon() const {
    if (device_) device_->abandon();
  }

 private:
  void draw_casters(osg::RenderInfo& info, const penumbra_caster_pass& pass) const;
  const osg::Program& program_of(const penumbra_caster_pass& pass) const;

  ShadowScene scene_;
  penumbra::api::Settings settings_;
  // OpenSceneGraph calls its callbacks as constant objects.
  mutable std::optional<penumbra::api::Device> device_;
  mutable std::map<std::uint64_t, osg::ref_ptr<osg::Program>> programs_;
  mutable osg::Matrixd last_view_, last_projection_;
  mutable osg::BoundingBox last_moving_;
  mutable unsigned mask_ = 0;
};
