// Reads the drawn geometry back from the GPU.
#include "gl/api.h"
#include "scene/gpu_scene.h"
#include "scene/gpu_scene_state.h"

namespace penumbra::scene {

std::vector<glm::vec3> GpuScene::read_deformed() const {
  const gl::Buffer& buffer = state_->now->positions;
  std::vector<glm::vec3> positions(buffer.size() / sizeof(glm::vec3));
  if (!positions.empty()) {
    gl::glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl::glGetNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(buffer.size()), positions.data());
  }
  return positions;
}

PosedGeometry GpuScene::posed_geometry() const {
  PosedGeometry geometry;
  geometry.deformed = read_deformed();
  const std::span<const glm::vec3> deformed(geometry.deformed);
  for (const Instance& instance : state_->instances) {
    const Primitive& primitive = *instance.primitive;
    geometry.surfaces.push_back({.primitive = &primitive,
                                 .positions = instance.job < 0
                                                  ? std::span(primitive.positions)
                                                  : deformed.subspan(instance.base_vertex, primitive.positions.size()),
                                 .world = instance.world,
                                 .casts = instance.faces ? instance.casts : CastMode::never,
                                 .faces = instance.faces.value_or(CasterFaces::both),
                                 .mirrored = instance.mirrored});
  }
  return geometry;
}

}  // namespace penumbra::scene
