#include "frame.h"

#include <OgreHardwarePixelBuffer.h>
#include <OgrePass.h>
#include <OgreRenderTexture.h>
#include <OgreRoot.h>
#include <OgreSceneManager.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>
#include <OgreViewport.h>
#include <string>
#include <utility>

#include "materials.h"

namespace {

Ogre::TexturePtr make_texture(const std::string& name, const Ogre::RenderTarget& size, Ogre::PixelFormat format) {
  return Ogre::TextureManager::getSingleton().createManual(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D, size.getWidth(),
      size.getHeight(), 0, format, Ogre::TU_RENDERTARGET);
}

void remove(Ogre::TexturePtr& texture) {
  Ogre::TextureManager::getSingleton().remove(texture);
  texture.reset();
}

}  // namespace

Frame::Frame(const ShadowScene& scene, penumbra::api::Settings settings, Ogre::RenderTarget& picture)
    : camera_(*scene.camera),
      shadows_(scene, std::move(settings)),
      picture_(picture),
      material_(make_picture("picture")),
      rectangle_(true) {
  camera_.setAutoAspectRatio(true);
  rectangle_.setCorners(-1, 1, 1, -1);
  rectangle_.setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
  rectangle_.setMaterial(material_);
  Ogre::SceneManager& manager = *Ogre::Root::getSingleton().createSceneManager();
  manager.getRootSceneNode()->attachObject(&rectangle_);
  picture_.setAutoUpdated(false);  // it comes last
  picture_.addViewport(manager.createCamera("picture"))->setOverlaysEnabled(false);
}

Frame::~Frame() { remove_target(); }

void Frame::draw() {
  const bool right_size =
      target_ && target_->getWidth() == picture_.getWidth() && target_->getHeight() == picture_.getHeight();
  if (!right_size) {
    remove_target();
    make_target();
  }
  Ogre::Root::getSingleton().renderOneFrame();
  picture_.update();
}

void Frame::make_target() {
  textures_ = {make_texture("sky light", picture_, Ogre::PF_FLOAT16_RGBA),
               make_texture("sun light", picture_, Ogre::PF_FLOAT16_RGBA),
               make_texture("normals", picture_, Ogre::PF_FLOAT16_RGBA),
               make_texture("depth", picture_, Ogre::PF_DEPTH32F),
               make_texture("visibility", picture_, Ogre::PF_FLOAT16_R)};
  target_ = Ogre::Root::getSingleton().getRenderSystem()->createMultiRenderTarget("scene");
  std::size_t attachment = 0;
  for (const auto& texture : {textures_.sky_light, textures_.sun_light, textures_.normals, textures_.depth}) {
    target_->bindSurface(attachment++, texture->getBuffer()->getRenderTarget());
  }
  target_->addViewport(&camera_)->setOverlaysEnabled(false);
  target_->addListener(&shadows_);
  shadows_.use({textures_.depth, textures_.normals, textures_.visibility});

  Ogre::Pass& pass = *material_->getTechnique(0)->getPass(0);
  unsigned short unit = 0;
  for (const auto& texture : {textures_.sky_light, textures_.sun_light, textures_.visibility, textures_.depth}) {
    pass.getTextureUnitState(unit++)->setTexture(texture);
  }
}

void Frame::remove_target() {
  if (!target_) return;
  Ogre::Root::getSingleton().getRenderSystem()->destroyRenderTarget(target_->getName());
  target_ = nullptr;
  for (auto* texture :
       {&textures_.sky_light, &textures_.sun_light, &textures_.normals, &textures_.depth, &textures_.visibility}) {
    remove(*texture);
  }
}
