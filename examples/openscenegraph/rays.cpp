#include "rays.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <osg/Viewport>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

namespace {

struct Hit {
  osg::Vec3d place, normal;
};

std::optional<Hit> first_hit(osg::Node& scene, const osg::Vec3d& from, const osg::Vec3d& to) {
  osg::ref_ptr<osgUtil::LineSegmentIntersector> ray = new osgUtil::LineSegmentIntersector(from, to);
  ray->setIntersectionLimit(osgUtil::Intersector::LIMIT_NEAREST);
  osgUtil::IntersectionVisitor visitor(ray);
  scene.accept(visitor);
  if (!ray->containsIntersections()) return std::nullopt;
  const auto hit = ray->getFirstIntersection();
  return Hit{hit.getWorldIntersectPoint(), hit.getWorldIntersectNormal()};
}

bool sees_sun(osg::Node& scene, const Hit& hit, const osg::Vec3d& to_sun) {
  constexpr double clearance = 1e-5, beyond_all = 1e3;  // metres
  if (hit.normal * to_sun <= 0) return false;
  const osg::Vec3d start = hit.place + hit.normal * clearance;
  return !first_hit(scene, start, start + to_sun * beyond_all);
}

}  // namespace

Difference compare_with_rays(const std::vector<float>& mask, const osg::Camera& camera, osg::Node& scene,
                             const osg::Vec3& to_sun) {
  const osg::Viewport& viewport = *camera.getViewport();
  const auto width = static_cast<std::size_t>(viewport.width()), height = static_cast<std::size_t>(viewport.height());
  const osg::Matrixd to_world =
      osg::Matrixd::inverse(camera.getViewMatrix() * camera.getProjectionMatrix() * viewport.computeWindowMatrix());
  Difference difference{};
  double sum = 0;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const double column = static_cast<double>(x) + 0.5, row = static_cast<double>(y) + 0.5;
      const std::optional<Hit> hit =
          first_hit(scene, osg::Vec3d(column, row, 0) * to_world, osg::Vec3d(column, row, 1) * to_world);
      if (!hit) continue;
      const double error = static_cast<double>(mask[y * width + x]) - (sees_sun(scene, *hit, to_sun) ? 1 : 0);
      sum += error * error;
      ++difference.points;
    }
  }
  difference.rms = difference.points == 0 ? 0 : std::sqrt(sum / difference.points);
  return difference;
}
