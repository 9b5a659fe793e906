#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gl/buffer.h"
#include "scene/scene.h"

namespace penumbra::scene {

// Normal and tangent, signed 16-bit: accurate to 3e-5 radians.
struct VertexFrame {
  std::uint32_t normal_xy = 0, normal_z_lean = 0, tangent_xy = 0, tangent_zw = 0;
};

// Vertex attributes that do not depend on the pose.
struct VertexSurface {
  glm::vec2 uv[2]{};
  glm::u16vec4 color{0xffff};
};

// Vertices of many primitives in one set of arrays.
struct VertexStreams {
  std::vector<glm::vec3> positions;
  std::vector<VertexFrame> frames;
  std::vector<VertexSurface> surfaces;

  // Appends a primitive's vertices; returns the index of its first.
  std::uint32_t append(const Primitive& primitive);
};

// A normal for each triangle of a primitive, not of unit length: see glsl/lib/triangle_normal.glsl. Empty for lines and
// points.
std::vector<glm::vec3> triangle_normals(const Primitive& primitive);

// The buffers that a draw reads its vertices from. Without deformation `last_positions` is `positions`.
struct VertexSource {
  const gl::Buffer* positions = nullptr;
  const gl::Buffer* last_positions = nullptr;
  const gl::Buffer* frames = nullptr;
  const gl::Buffer* surfaces = nullptr;
  const gl::Buffer* instances = nullptr;  // 0, 1, 2, …: a draw's base instance selects the first one that it reads
  const gl::Buffer* instance_blocks = nullptr;  // their data, likewise
  const gl::Buffer* indices = nullptr;
};

void delete_vertex_array(GLuint id);

// The vertex format of glsl/scene/surface.vert and caster.vert. Without `vertices` it has the instance numbers alone,
// for vertex shaders that read the rest from storage buffers.
class VertexArray {
 public:
  explicit VertexArray(std::string_view label, bool vertices = true);
  void set(const VertexSource& source) const;
  void bind() const;

 private:
  gl::Handle<delete_vertex_array> handle_;
};

}  // namespace penumbra::scene
