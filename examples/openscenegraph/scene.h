#pragma once

#include <osg/MatrixTransform>
#include <osg/ref_ptr>

// A round floor with columns, blocks and balls, and a carousel that turns. Metres; z is up.
struct Scene {
  osg::ref_ptr<osg::Group> root;
  osg::ref_ptr<osg::MatrixTransform> carousel;
};

Scene make_scene();

// Turns the carousel to its place at a time in seconds.
void animate(Scene& scene, double time);
