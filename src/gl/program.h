#pragma once

#include <compare>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "handle.h"
#include "shader_source.h"

namespace penumbra::gl {

void delete_program(GLuint id);

// What a program is made of: file names under glsl/. Either a vertex shader, with an optional geometry shader and a
// fragment shader (none if only depth is written); or a compute shader.
struct ProgramDesc {
  std::string name;  // the object's label and the name in messages
  std::string vertex, geometry, fragment, compute;
  std::vector<Define> defines;
  auto operator<=>(const ProgramDesc&) const = default;
};

// A linked program. Uniform blocks, samplers and images have explicit bindings in GLSL; the few loose uniforms are set
// by name (unknown names are ignored: the compiler may have removed them).
class Program {
 public:
  // Throws Error: "glsl/lib/kernel.glsl:12: message" lines under one heading that names program and stage.
  Program(const ProgramDesc& desc, const ShaderFiles& files);

  void use() const;  // makes it current
  void set(std::string_view name, int value) const;
  void set(std::string_view name, float value) const;
  void set(std::string_view name, const glm::ivec2& value) const;
  void set(std::string_view name, const glm::ivec4& value) const;
  void set(std::string_view name, const glm::vec2& value) const;
  void set(std::string_view name, const glm::vec3& value) const;
  void set(std::string_view name, const glm::vec4& value) const;
  void set(std::string_view name, const glm::mat4& value) const;

  glm::ivec3 group_size() const { return group_size_; }             // of a compute program
  const std::vector<std::string>& files() const { return files_; }  // every file it depends on
  GLuint id() const { return handle_.id(); }

 private:
  GLint location(std::string_view name) const;

  Handle<delete_program> handle_;
  glm::ivec3 group_size_{1};
  std::vector<std::string> files_;
  mutable std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace penumbra::gl
