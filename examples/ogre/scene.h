#pragma once

#include <OgreCamera.h>
#include <OgreLight.h>
#include <OgreRoot.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

// A windmill beside a house, with trees and a fence, in the light of a low sun. Metres; y is up.
struct Scene {
  Ogre::SceneManager* manager;
  Ogre::Camera* camera;
  Ogre::Light* sun;
  Ogre::SceneNode *things, *sails;  // all things, and the part of them that turns
};

Scene make_scene(Ogre::Root& root);

// Turns the sails to their place at a time in seconds.
void animate(Scene& scene, double time);
