#pragma once

// Penumbra in a program of OGRE: all that such a program adds to have soft shadows.
#include <OgreCamera.h>
#include <OgreLight.h>
#include <OgreRenderSystem.h>
#include <OgreRenderTargetListener.h>
#include <OgreSceneNode.h>
#include <OgreTexture.h>
#include <cstdint>
#include <map>
#include <optional>
#include <penumbra/penumbra.hpp>

// What shadows depend on.
struct ShadowScene {
  Ogre::Camera* camera;            // whose matrices the textures are drawn with
  const Ogre::Light* sun;          // a directional light
  const Ogre::SceneNode* casters;  // what casts and receives shadows
  const Ogre::SceneNode* moving;   // the part of it that moves
};

// Render textures, all of the same size.
struct ShadowTextures {
  Ogre::TexturePtr depth;       // any depth format, as OGRE draws it without its option "Reversed Z-Buffer"
  Ogre::TexturePtr normals;     // of triangles, world space, x y z in -1..1; null: made from depth, less precise
  Ogre::TexturePtr visibility;  // receives the visible share of the sun at each pixel; PF_FLOAT16_R
};

// Computes the visibility after the render target to which it is added has drawn depth. Throws penumbra::api::Error.
class SoftShadows : public Ogre::RenderTargetListener {
 public:
  // OGRE's window, and with it its context, must be there, and outlive the object.
  SoftShadows(const ShadowScene& scene, penumbra::api::Settings settings);
  ~SoftShadows();
  SoftShadows(const SoftShadows&) = delete;
  SoftShadows& operator=(const SoftShadows&) = delete;

  // The textures of the next frames: to be called before the first one, and when the size has changed.
  void use(const ShadowTextures& textures);

  void postRenderTargetUpdate(const Ogre::RenderTargetEvent&) override;

 private:
  struct View {
    Ogre::Affine3 view;
    Ogre::Matrix4 projection;
    Ogre::AxisAlignedBox moving;
  };

  View view_now() const;
  void draw_casters(const penumbra_caster_pass& pass);
  unsigned program_of(const penumbra_caster_pass& pass);

  ShadowScene scene_;
  ShadowTextures textures_;
  Ogre::RenderSystem& renderer_;
  penumbra::api::Settings settings_;
  penumbra::api::Device device_;
  std::map<std::uint64_t, unsigned> programs_;  // OpenGL's names, as is the next
  unsigned vertex_array_ = 0;
  std::optional<View> last_;
};
