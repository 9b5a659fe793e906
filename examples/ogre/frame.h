#pragma once

#include <OgreMaterial.h>
#include <OgreRectangle2D.h>
#include <OgreRenderTarget.h>
#include <OgreTexture.h>

#include "soft_shadows.h"

// The targets of a frame: one draws the scene to textures, with the sun's light apart from all other light, whereupon
// shadows are computed; the picture, a window or a texture, then puts all together.
class Frame {
 public:
  Frame(const ShadowScene& scene, penumbra::api::Settings settings, Ogre::RenderTarget& picture);
  ~Frame();
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  // Draws it, in textures of the picture's size.
  void draw();

  // The visible share of the sun at each pixel.
  Ogre::Texture& visibility() { return *textures_.visibility; }

 private:
  void make_target();
  void remove_target();

  Ogre::Camera& camera_;
  SoftShadows shadows_;
  Ogre::RenderTarget& picture_;
  Ogre::MaterialPtr material_;
  Ogre::Rectangle2D rectangle_;
  struct {
    Ogre::TexturePtr sky_light, sun_light, normals, depth, visibility;
  } textures_;
  Ogre::MultiRenderTarget* target_ = nullptr;
};
