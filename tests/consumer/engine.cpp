#include "engine.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <stdexcept>

namespace engine {

namespace {

// The engine's own loader: one pointer per function, named as in OpenGL.
// clang-format off
#define ENGINE_GL_FUNCTIONS(X) \
  X(PFNGLATTACHSHADERPROC, glAttachShader) \
  X(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer) \
  X(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray) \
  X(PFNGLCLEARBUFFERFVPROC, glClearBufferfv) \
  X(PFNGLCLIPCONTROLPROC, glClipControl) \
  X(PFNGLCOMPILESHADERPROC, glCompileShader) \
  X(PFNGLCREATEFRAMEBUFFERSPROC, glCreateFramebuffers) \
  X(PFNGLCREATEPROGRAMPROC, glCreateProgram) \
  X(PFNGLCREATESHADERPROC, glCreateShader) \
  X(PFNGLCREATETEXTURESPROC, glCreateTextures) \
  X(PFNGLCREATEVERTEXARRAYSPROC, glCreateVertexArrays) \
  X(PFNGLDEPTHFUNCPROC, glDepthFunc) \
  X(PFNGLDEPTHMASKPROC, glDepthMask) \
  X(PFNGLDISABLEPROC, glDisable) \
  X(PFNGLDRAWARRAYSPROC, glDrawArrays) \
  X(PFNGLENABLEPROC, glEnable) \
  X(PFNGLGETPROGRAMIVPROC, glGetProgramiv) \
  X(PFNGLGETSHADERIVPROC, glGetShaderiv) \
  X(PFNGLGETTEXTURESUBIMAGEPROC, glGetTextureSubImage) \
  X(PFNGLLINKPROGRAMPROC, glLinkProgram) \
  X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, glNamedFramebufferTexture) \
  X(PFNGLNAMEDFRAMEBUFFERTEXTURELAYERPROC, glNamedFramebufferTextureLayer) \
  X(PFNGLPROGRAMUNIFORM1FPROC, glProgramUniform1f) \
  X(PFNGLPROGRAMUNIFORM3FPROC, glProgramUniform3f) \
  X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, glProgramUniformMatrix4fv) \
  X(PFNGLSHADERSOURCEPROC, glShaderSource) \
  X(PFNGLTEXTURESTORAGE2DPROC, glTextureStorage2D) \
  X(PFNGLTEXTURESTORAGE3DPROC, glTextureStorage3D) \
  X(PFNGLUSEPROGRAMPROC, glUseProgram) \
  X(PFNGLVIEWPORTPROC, glViewport)
// clang-format on

#define X(type, name) type name = nullptr;
ENGINE_GL_FUNCTIONS(X)
#undef X

constexpr const char* vertex_text = R"(#version 450 core
layout(location = 0) uniform mat4 world_to_clip;
layout(location = 1) uniform vec3 center;
layout(location = 2) uniform float half_side;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  gl_Position = world_to_clip * vec4(center + vec3(corner.x, 0.0, corner.y) * half_side, 1.0);
})";

constexpr const char* fragment_text = R"(#version 450 core
layout(location = 0) out vec4 normal;
void main() { normal = vec4(0.0, 1.0, 0.0, 0.0); })";

GLuint compile(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  return shader;
}

}  // namespace

void* proc_address(const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); }

void make_context() {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) throw std::runtime_error("no EGL display");
  eglBindAPI(EGL_OPENGL_API);
  const std::array<EGLint, 7> attributes{
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    throw std::runtime_error("no OpenGL 4.5 core context");
  }
#define X(type, name) name = reinterpret_cast<type>(eglGetProcAddress(#name));
  ENGINE_GL_FUNCTIONS(X)
#undef X
}

// Names that an engine may declare.
const char* const forward_fragment_text = R"(
struct Light { vec3 to_light; vec3 color; };
struct Receiver { vec3 position; };
in vec3 view_position;
in vec3 world_normal;
uniform Light light;
layout(location = 0) out vec4 color;
vec3 shade(Receiver receiver) {
  return light.color * penumbra_shadow_visibility(receiver.position, world_normal, gl_FragCoord.xy);
}
void main() { color = vec4(shade(Receiver(view_position)), 1.0); })";

bool compiles(const std::string& fragment_text) {
  GLint compiled = 0;
  glGetShaderiv(compile(GL_FRAGMENT_SHADER, fragment_text.c_str()), GL_COMPILE_STATUS, &compiled);
  return compiled != 0;
}

Scene::Scene() {
  program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, vertex_text));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment_text));
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == 0) throw std::runtime_error("the engine's program does not link");
  glCreateVertexArrays(1, &vertices);
}

void Scene::draw(const glm::mat4& world_to_clip, bool casters_only) const {
  glUseProgram(program);
  glBindVertexArray(vertices);
  glProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &world_to_clip[0][0]);
  glProgramUniform3f(program, 1, caster_center.x, caster_center.y, caster_center.z);
  glProgramUniform1f(program, 2, caster_half);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  if (casters_only) return;
  glProgramUniform3f(program, 1, 0, 0, 0);
  glProgramUniform1f(program, 2, floor_half);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

glm::mat4 view(const glm::vec3& eye) { return glm::lookAt(eye, glm::vec3(0), glm::vec3(0, 1, 0)); }

glm::mat4 projection() {
  return glm::perspectiveRH_NO(0.9f, static_cast<float>(width) / static_cast<float>(height), 0.1f, 100.0f);
}

Targets draw_frame(const Scene& scene, const glm::mat4& view) {
  Targets targets;
  glCreateTextures(GL_TEXTURE_2D, 1, &targets.depth);
  glTextureStorage2D(targets.depth, 1, GL_DEPTH_COMPONENT32F, width, height);
  glCreateTextures(GL_TEXTURE_2D, 1, &targets.normals);
  glTextureStorage2D(targets.normals, 1, GL_RGBA16F, width, height);
  GLuint framebuffer = 0;
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, targets.depth, 0);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, targets.normals, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const float far_depth = 1.0f;
  const std::array<float, 4> no_normal{};
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glClearBufferfv(GL_COLOR, 0, no_normal.data());
  scene.draw(projection() * view, /*casters_only=*/false);
  return targets;
}

std::vector<float> read_red(GLuint texture) {
  std::vector<float> values(static_cast<size_t>(width) * height);
  glGetTextureSubImage(texture, 0, 0, 0, 0, width, height, 1, GL_RED, GL_FLOAT,
                       static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
  return values;
}

GLuint draw_depth_array(const Scene& scene, const glm::mat4* world_to_clip, int count, int size) {
  GLuint depth = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &depth);
  glTextureStorage3D(depth, 1, GL_DEPTH_COMPONENT32F, size, size, count);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (int layer = 0; layer < count; ++layer) {
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTextureLayer(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0, layer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size, size);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    const float far_depth = 1.0f;
    glClearBufferfv(GL_DEPTH, 0, &far_depth);
    scene.draw(world_to_clip[layer], /*casters_only=*/false);
  }
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  return depth;
}

}  // namespace engine
