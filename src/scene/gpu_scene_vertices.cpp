#include "scene/gpu_scene_vertices.h"

#include <array>
#include <cstddef>
#include <glm/gtc/packing.hpp>

#include "gl/debug.h"
#include "lib/triangle_normal.glsl"
#include "scene/smooth_lean.h"
#include "shared/scene_blocks.h"

namespace penumbra::scene {

void delete_vertex_array(GLuint id) { gl::glDeleteVertexArrays(1, &id); }

namespace {

// Buffer bindings of the vertex array.
enum Stream : GLuint {
  stream_position,
  stream_last_position,
  stream_frame,
  stream_surface,
  stream_instance,
  stream_instance_block
};

struct Attribute {
  GLuint location;
  Stream stream;
  int components;
  GLenum type;
  bool normalized;
  std::size_t offset;
};

constexpr std::size_t column = sizeof(glm::vec4);  // of a matrix in a storage buffer

constexpr std::array attributes{
    Attribute{0, stream_position, 3, GL_FLOAT, false, 0},
    Attribute{1, stream_last_position, 3, GL_FLOAT, false, 0},
    Attribute{2, stream_frame, 4, GL_SHORT, true, offsetof(VertexFrame, normal_xy)},
    Attribute{3, stream_frame, 4, GL_SHORT, true, offsetof(VertexFrame, tangent_xy)},
    Attribute{4, stream_surface, 4, GL_FLOAT, false, offsetof(VertexSurface, uv)},
    Attribute{5, stream_surface, 4, GL_UNSIGNED_SHORT, true, offsetof(VertexSurface, color)},
    Attribute{7, stream_instance_block, 4, GL_FLOAT, false, offsetof(glsl::InstanceBlock, world)},
    Attribute{8, stream_instance_block, 4, GL_FLOAT, false, offsetof(glsl::InstanceBlock, world) + column},
    Attribute{9, stream_instance_block, 4, GL_FLOAT, false, offsetof(glsl::InstanceBlock, world) + 2 * column},
    Attribute{10, stream_instance_block, 4, GL_FLOAT, false, offsetof(glsl::InstanceBlock, world) + 3 * column},
    Attribute{11, stream_instance_block, 3, GL_FLOAT, false, offsetof(glsl::InstanceBlock, area)},
    Attribute{12, stream_instance_block, 3, GL_FLOAT, false, offsetof(glsl::InstanceBlock, area) + column},
    Attribute{13, stream_instance_block, 3, GL_FLOAT, false, offsetof(glsl::InstanceBlock, area) + 2 * column},
    Attribute{15, stream_instance_block, 1, GL_FLOAT, false, offsetof(glsl::InstanceBlock, winding)},
};
constexpr GLuint instance_location = 6, first_triangle_location = 14;

VertexFrame pack_frame(const glm::vec3& normal, float lean, const glm::vec4& tangent) {
  return {.normal_xy = glm::packSnorm2x16(glm::vec2(normal)),
          .normal_z_lean = glm::packSnorm2x16({normal.z, lean}),
          .tangent_xy = glm::packSnorm2x16(glm::vec2(tangent)),
          .tangent_zw = glm::packSnorm2x16({tangent.z, tangent.w})};
}

glm::u16vec4 pack_color(const glm::vec4& color) {
  return glm::u16vec4(glm::round(glm::clamp(color, 0.0f, 1.0f) * 65535.0f));
}

// Normals in a file may have any length.
glm::vec3 unit(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : glm::vec3(0.0f);
}

}  // namespace

std::uint32_t VertexStreams::append(const Primitive& primitive) {
  const std::size_t first = positions.size();
  const std::size_t count = primitive.positions.size();
  const std::vector<float> leans = smooth_leans(primitive);
  positions.insert(positions.end(), primitive.positions.begin(), primitive.positions.end());
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec4 tangent = primitive.tangents.empty() ? glm::vec4(0.0f)
                                                         : glm::vec4(unit(glm::vec3(primitive.tangents[i])),
                                                                     primitive.tangents[i].w < 0.0f ? -1.0f : 1.0f);
    frames.push_back(pack_frame(unit(primitive.normals[i]), leans[i], tangent));
    VertexSurface surface;
    for (std::size_t set = 0; set < primitive.uvs.size(); ++set) {
      if (!primitive.uvs[set].empty()) surface.uv[set] = primitive.uvs[set][i];
    }
    if (!primitive.colors.empty()) surface.color = pack_color(primitive.colors[i]);
    surfaces.push_back(surface);
  }
  return static_cast<std::uint32_t>(first);
}

std::vector<glm::vec3> triangle_normals(const Primitive& primitive) {
  std::vector<glm::vec3> normals;
  if (primitive.topology != Topology::triangles) return normals;
  const auto corner = [&](std::size_t index) { return primitive.positions[primitive.indices[index]]; };
  normals.reserve(primitive.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
    normals.push_back(glsl::triangle_normal(corner(i), corner(i + 1), corner(i + 2)));
  return normals;
}

VertexArray::VertexArray(std::string_view label, bool vertices) {
  GLuint id = 0;
  gl::glCreateVertexArrays(1, &id);
  handle_ = gl::Handle<delete_vertex_array>(id);
  gl::label(GL_VERTEX_ARRAY, id, label);
  for (const Attribute& attribute : attributes) {
    if (!vertices) break;
    gl::glEnableVertexArrayAttrib(id, attribute.location);
    gl::glVertexArrayAttribFormat(id, attribute.location, attribute.components, attribute.type,
                                  attribute.normalized ? GL_TRUE : GL_FALSE, static_cast<GLuint>(attribute.offset));
    gl::glVertexArrayAttribBinding(id, attribute.location, attribute.stream);
  }
  gl::glEnableVertexArrayAttrib(id, instance_location);
  gl::glVertexArrayAttribIFormat(id, instance_location, 1, GL_UNSIGNED_INT, 0);
  gl::glVertexArrayAttribBinding(id, instance_location, stream_instance);
  gl::glVertexArrayBindingDivisor(id, stream_instance, 1);
  if (!vertices) return;
  gl::glEnableVertexArrayAttrib(id, first_triangle_location);
  gl::glVertexArrayAttribIFormat(id, first_triangle_location, 1, GL_UNSIGNED_INT,
                                 offsetof(glsl::InstanceBlock, first_triangle));
  gl::glVertexArrayAttribBinding(id, first_triangle_location, stream_instance_block);
  gl::glVertexArrayBindingDivisor(id, stream_instance_block, 1);
}

void VertexArray::set(const VertexSource& source) const {
  const GLuint id = handle_.id();
  gl::glVertexArrayVertexBuffer(id, stream_position, source.positions->id(), 0, sizeof(glm::vec3));
  gl::glVertexArrayVertexBuffer(id, stream_last_position, source.last_positions->id(), 0, sizeof(glm::vec3));
  gl::glVertexArrayVertexBuffer(id, stream_frame, source.frames->id(), 0, sizeof(VertexFrame));
  gl::glVertexArrayVertexBuffer(id, stream_surface, source.surfaces->id(), 0, sizeof(VertexSurface));
  gl::glVertexArrayVertexBuffer(id, stream_instance, source.instances->id(), 0, sizeof(std::uint32_t));
  gl::glVertexArrayVertexBuffer(id, stream_instance_block, source.instance_blocks->id(), 0,
                                sizeof(glsl::InstanceBlock));
  gl::glVertexArrayElementBuffer(id, source.indices->id());
}

void VertexArray::bind() const { gl::glBindVertexArray(handle_.id()); }

}  // namespace penumbra::scene
