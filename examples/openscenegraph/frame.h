#pragma once

#include <osg/Camera>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include "soft_shadows.h"

// The cameras of a frame: one draws the scene to textures, with the sun's light apart from all other light; the
// viewer's own then puts both together, with the sun's light multiplied by the mask.
struct FrameGraph {
  osg::ref_ptr<osg::Camera> scene_camera;
  osg::ref_ptr<osg::Texture2D> depth, normals;
  osg::ref_ptr<SoftShadows> shadows;
};

// Makes them the scene data of the viewer, whose camera has its place, its lens and its viewport.
FrameGraph make_frame(osgViewer::Viewer& viewer, osg::Node& scene, osg::Node& moving, const osg::Vec3& to_sun,
                      penumbra::api::Settings settings);

void resize(FrameGraph& frame, int width, int height);
