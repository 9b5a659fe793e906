#include "program.h"

#include <algorithm>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <sstream>
#include <string>

#include "../core/error.h"
#include "../core/log.h"
#include "debug.h"

namespace penumbra::gl {

void delete_program(GLuint id) { glDeleteProgram(id); }

namespace {

void delete_shader(GLuint id) { glDeleteShader(id); }

struct Stage {
  GLenum kind;
  const char* name;
  const std::string& file;
};

// Reads a driver's log of a shader or program.
template <class GetLength, class GetLog>
std::string read_log(GLuint id, GetLength get_length, GetLog get_log) {
  GLint length = 0;
  get_length(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
  GLsizei written = 0;
  if (length > 0) get_log(id, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

Handle<delete_shader> compile(const ProgramDesc& desc, const Stage& stage, const ShaderSource& source) {
  Handle<delete_shader> shader(glCreateShader(stage.kind));
  label(GL_SHADER, shader.id(), stage.file);
  const char* text = source.text.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  const std::string log = translate_log(read_log(shader.id(), glGetShaderiv, glGetShaderInfoLog), source);
  if (compiled == GL_FALSE) fail("program '{}': the {} shader does not compile\n{}", desc.name, stage.name, log);
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    penumbra::log(LogLevel::debug, fmt::format("program '{}': {}", desc.name, line));
  return shader;
}

void link(const ProgramDesc& desc, GLuint program) {
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  fail("program '{}': the stages do not link\n{}", desc.name, read_log(program, glGetProgramiv, glGetProgramInfoLog));
}

}  // namespace

Program::Program(const ProgramDesc& desc, const ShaderFiles& files) : handle_(glCreateProgram()) {
  assert(desc.compute.empty() != desc.vertex.empty());
  label(GL_PROGRAM, id(), desc.name);
  std::vector<Handle<delete_shader>> shaders;
  for (const Stage& stage :
       {Stage{GL_VERTEX_SHADER, "vertex", desc.vertex}, Stage{GL_GEOMETRY_SHADER, "geometry", desc.geometry},
        Stage{GL_FRAGMENT_SHADER, "fragment", desc.fragment}, Stage{GL_COMPUTE_SHADER, "compute", desc.compute}}) {
    if (stage.file.empty()) continue;
    const ShaderSource source = load_shader_source(files, stage.file, desc.defines);
    files_.insert(files_.end(), source.files.begin(), source.files.end());
    shaders.push_back(compile(desc, stage, source));
    glAttachShader(id(), shaders.back().id());
  }
  link(desc, id());
  for (const auto& shader : shaders) glDetachShader(id(), shader.id());
  std::ranges::sort(files_);
  files_.erase(std::unique(files_.begin(), files_.end()), files_.end());
  if (!desc.compute.empty()) glGetProgramiv(id(), GL_COMPUTE_WORK_GROUP_SIZE, glm::value_ptr(group_size_));
}

void Program::use() const { glUseProgram(id()); }

void Program::set(std::string_view name, int value) const { glProgramUniform1i(id(), location(name), value); }
void Program::set(std::string_view name, float value) const { glProgramUniform1f(id(), location(name), value); }
void Program::set(std::string_view name, const glm::ivec2& value) const {
  glProgramUniform2iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::ivec4& value) const {
  glProgramUniform4iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::vec2& value) const {
  glProgramUniform2fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::vec3& value) const {
  glProgramUniform3fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::vec4& value) const {
  glProgramUniform4fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}

GLint Program::location(std::string_view name) const {
  if (const auto found = locations_.find(name); found != locations_.end()) return found->second;
  const std::string key(name);
  return locations_.emplace(key, glGetUniformLocation(id(), key.c_str())).first->second;
}

}  // namespace penumbra::gl
