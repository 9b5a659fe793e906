#pragma once

#include <OgreCamera.h>
#include <OgreImage.h>
#include <OgreSceneManager.h>

// What rays find at the pixels of a picture. OGRE's own find the boxes that they meet; triangles are read back from its
// meshes.
struct Difference {
  int points;  // pixels that show a surface
  double rms;  // of visibility minus rays: 1 where no surface is on the way to the sun, else 0
};

// `visibility` has what was computed for the pixels of the camera's picture, row 0 at the top.
Difference compare_with_rays(const Ogre::Image& visibility, const Ogre::Camera& camera, Ogre::SceneManager& manager,
                             const Ogre::Vector3& to_sun);
