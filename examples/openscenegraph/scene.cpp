#include "scene.h"

#include <cmath>
#include <numbers>
#include <osg/Geode>
#include <osg/ShapeDrawable>

namespace {

const osg::Vec4 stone(0.62f, 0.58f, 0.52f, 1), white(0.8f, 0.78f, 0.74f, 1), red(0.72f, 0.17f, 0.11f, 1),
    blue(0.1f, 0.25f, 0.55f, 1), yellow(0.8f, 0.52f, 0.1f, 1), green(0.16f, 0.42f, 0.24f, 1);

void add(osg::Geode& geode, osg::Shape* shape, const osg::Vec4& color) {
  osg::ref_ptr<osg::TessellationHints> smooth = new osg::TessellationHints;
  smooth->setDetailRatio(2);
  osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape, smooth);
  drawable->setColor(color);
  geode.addDrawable(drawable);
}

// Columns in a half circle, with a beam from each to the next.
void add_colonnade(osg::Geode& geode) {
  constexpr int columns = 8;
  constexpr float radius = 7, height = 3.2f;
  osg::Vec3 last;
  for (int i = 0; i < columns; ++i) {
    const float angle = std::numbers::pi_v<float> * (0.02f + static_cast<float>(i) / (columns - 1) * 0.96f);
    const osg::Vec3 foot(radius * std::cos(angle), radius * std::sin(angle), 0);
    add(geode, new osg::Cylinder(foot + osg::Vec3(0, 0, height / 2), 0.28f, height), white);
    add(geode, new osg::Box(foot + osg::Vec3(0, 0, 0.1f), 0.9f, 0.9f, 0.2f), white);
    if (i > 0) {
      const osg::Vec3 along = foot - last;
      osg::ref_ptr<osg::Box> beam =
          new osg::Box((foot + last) / 2 + osg::Vec3(0, 0, height + 0.15f), along.length() + 0.3f, 0.5f, 0.3f);
      beam->setRotation(osg::Quat(std::atan2(along.y(), along.x()), osg::Vec3(0, 0, 1)));
      add(geode, beam, white);
    }
    last = foot;
  }
}

void add_carousel(osg::Geode& geode) {
  constexpr float arm = 2.6f, height = 3.6f;
  const osg::Vec2 directions[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const osg::Vec4 colors[4] = {red, yellow, blue, green};
  add(geode, new osg::Box(osg::Vec3(0, 0, height), 2 * arm, 0.12f, 0.12f), stone);
  add(geode, new osg::Box(osg::Vec3(0, 0, height), 0.12f, 2 * arm, 0.12f), stone);
  for (int i = 0; i < 4; ++i) {
    const osg::Vec3 end(directions[i] * arm, height);
    const float drop = 0.8f + 0.45f * static_cast<float>(i);
    add(geode, new osg::Cylinder(end - osg::Vec3(0, 0, drop / 2), 0.03f, drop), stone);
    add(geode, new osg::Sphere(end - osg::Vec3(0, 0, drop + 0.45f), 0.5f), colors[i]);
  }
}

}  // namespace

Scene make_scene() {
  osg::ref_ptr<osg::Geode> fixed = new osg::Geode, turning = new osg::Geode;
  add(*fixed, new osg::Cylinder(osg::Vec3(0, 0, -0.25f), 10, 0.5f), stone);
  add(*fixed, new osg::Cylinder(osg::Vec3(0, 0, 1.9f), 0.1f, 3.8f), stone);
  add(*fixed, new osg::Cylinder(osg::Vec3(0, 0, 0.15f), 0.8f, 0.3f), white);
  add_colonnade(*fixed);
  add(*fixed, new osg::Box(osg::Vec3(4.4f, -2.6f, 0.6f), 1.2f), blue);
  add(*fixed, new osg::Sphere(osg::Vec3(4.4f, -2.6f, 1.65f), 0.45f), yellow);
  add(*fixed, new osg::Cone(osg::Vec3(-4.2f, -3.4f, 0.5f), 0.8f, 2), green);
  add(*fixed, new osg::Capsule(osg::Vec3(-5.6f, 0.4f, 1.1f), 0.5f, 1.2f), red);
  add(*fixed, new osg::Box(osg::Vec3(1.6f, -5.2f, 0.25f), 2.4f, 0.6f, 0.5f), white);
  add_carousel(*turning);

  Scene scene{new osg::Group, new osg::MatrixTransform};
  scene.carousel->addChild(turning);
  scene.root->addChild(fixed);
  scene.root->addChild(scene.carousel);
  return scene;
}

void animate(Scene& scene, double time) {
  scene.carousel->setMatrix(osg::Matrixd::rotate(0.4 + 0.5 * time, osg::Vec3d(0, 0, 1)));
}
