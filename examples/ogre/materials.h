#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <string>

// A surface that is lit by the sky and one sun. Draws light of the sky, light of the sun, which is yet to be multiplied
// by the visible share of the sun, and the normals of triangles, to three targets.
Ogre::MaterialPtr make_surface(const std::string& name, const Ogre::ColourValue& colour);

// Puts the picture together. Its texture units are light of the sky, light of the sun, visibility and depth.
Ogre::MaterialPtr make_picture(const std::string& name);
