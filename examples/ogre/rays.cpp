#include "rays.h"

#include <OgreEntity.h>
#include <OgreMesh.h>
#include <OgreSceneQuery.h>
#include <OgreSubMesh.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace {

struct Triangle {
  Ogre::Vector3 a, b, c;
};

struct Hit {
  Ogre::Vector3 place, normal;  // the normal is on the side of the ray's origin
};

std::vector<Ogre::Vector3> read_places(const Ogre::VertexData& vertices, const Ogre::Affine3& to_world) {
  const Ogre::VertexElement& element = *vertices.vertexDeclaration->findElementBySemantic(Ogre::VES_POSITION);
  const Ogre::HardwareVertexBufferSharedPtr& buffer = vertices.vertexBufferBinding->getBuffer(element.getSource());
  const Ogre::HardwareBufferLockGuard lock(buffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
  std::vector<Ogre::Vector3> places;
  for (std::size_t i = 0; i < vertices.vertexCount; ++i) {
    float* place = nullptr;
    element.baseVertexPointerToElement(
        static_cast<std::byte*>(lock.pData) + (vertices.vertexStart + i) * buffer->getVertexSize(), &place);
    places.push_back(to_world * Ogre::Vector3(place));
  }
  return places;
}

std::vector<std::uint32_t> read_indices(const Ogre::IndexData& indices) {
  const Ogre::HardwareBufferLockGuard lock(indices.indexBuffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
  const bool wide = indices.indexBuffer->getType() == Ogre::HardwareIndexBuffer::IT_32BIT;
  std::vector<std::uint32_t> read;
  for (std::size_t i = indices.indexStart; i < indices.indexStart + indices.indexCount; ++i) {
    read.push_back(wide ? static_cast<const std::uint32_t*>(lock.pData)[i]
                        : static_cast<const std::uint16_t*>(lock.pData)[i]);
  }
  return read;
}

std::vector<Triangle> read_triangles(const Ogre::Entity& entity) {
  std::vector<Triangle> triangles;
  for (const Ogre::SubMesh* part : entity.getMesh()->getSubMeshes()) {
    const auto places = read_places(part->useSharedVertices ? *part->parent->sharedVertexData : *part->vertexData,
                                    entity._getParentNodeFullTransform());
    const auto indices = read_indices(*part->indexData);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      triangles.push_back({places[indices[i]], places[indices[i + 1]], places[indices[i + 2]]});
    }
  }
  return triangles;
}

class RayTracer {
 public:
  explicit RayTracer(Ogre::SceneManager& manager) : manager_(manager), query_(*manager.createRayQuery(Ogre::Ray())) {
    query_.setSortByDistance(true);
  }
  ~RayTracer() { manager_.destroyQuery(&query_); }
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  std::optional<Hit> first_hit(const Ogre::Ray& ray) {
    query_.setRay(ray);
    std::optional<Hit> hit;
    float nearest = 1e6f;
    for (const Ogre::RaySceneQueryResultEntry& candidate : query_.execute()) {
      if (candidate.distance > nearest) break;
      const auto* entity = dynamic_cast<const Ogre::Entity*>(candidate.movable);
      if (!entity) continue;
      for (const Triangle& triangle : triangles_of(*entity)) {
        const auto [is_hit, distance] = Ogre::Math::intersects(ray, triangle.a, triangle.b, triangle.c);
        if (!is_hit || distance >= nearest) continue;
        nearest = distance;
        const Ogre::Vector3 normal = (triangle.b - triangle.a).crossProduct(triangle.c - triangle.a).normalisedCopy();
        hit = {ray.getPoint(distance), normal.dotProduct(ray.getDirection()) < 0 ? normal : -normal};
      }
    }
    return hit;
  }

 private:
  const std::vector<Triangle>& triangles_of(const Ogre::Entity& entity) {
    const auto [place, is_new] = triangles_.try_emplace(&entity);
    if (is_new) place->second = read_triangles(entity);
    return place->second;
  }

  Ogre::SceneManager& manager_;
  Ogre::RaySceneQuery& query_;
  std::map<const Ogre::Entity*, std::vector<Triangle>> triangles_;
};

bool sees_sun(RayTracer& tracer, const Hit& hit, const Ogre::Vector3& to_sun) {
  constexpr float clearance = 1e-4f;  // metres
  if (hit.normal.dotProduct(to_sun) <= 0) return false;
  return !tracer.first_hit({hit.place + hit.normal * clearance, to_sun});
}

}  // namespace

Difference compare_with_rays(const Ogre::Image& visibility, const Ogre::Camera& camera, Ogre::SceneManager& manager,
                             const Ogre::Vector3& to_sun) {
  RayTracer tracer(manager);
  const auto width = visibility.getWidth(), height = visibility.getHeight();
  Difference difference{};
  double sum = 0;
  for (unsigned y = 0; y < height; ++y) {
    for (unsigned x = 0; x < width; ++x) {
      const std::optional<Hit> hit =
          tracer.first_hit(camera.getCameraToViewportRay((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                                         (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
      if (!hit) continue;
      const double error =
          static_cast<double>(visibility.getColourAt(x, y, 0).r) - (sees_sun(tracer, *hit, to_sun) ? 1 : 0);
      sum += error * error;
      ++difference.points;
    }
  }
  difference.rms = difference.points == 0 ? 0 : std::sqrt(sum / difference.points);
  return difference;
}
