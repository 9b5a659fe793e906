#pragma once

#include <osg/Camera>
#include <osg/Node>
#include <vector>

// What OpenSceneGraph's own rays find at the pixels of a mask.
struct Difference {
  int points;  // pixels that show a surface
  double rms;  // of mask minus rays: 1 where no surface is on the way to the sun, else 0
};

// `mask` has the visibilities of the pixels of the camera's viewport, row 0 at the bottom.
Difference compare_with_rays(const std::vector<float>& mask, const osg::Camera& camera, osg::Node& scene,
                             const osg::Vec3& to_sun);
