#pragma once

// A small engine that does not use Penumbra. It has its own context and GL loader, OpenGL's default depth (near 0, far
// 1, clip space -1..1), and stores normals without an encoding.
#include <GL/glcorearb.h>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace engine {

constexpr int width = 320;
constexpr int height = 240;

// A square that hovers over a large floor.
constexpr glm::vec3 caster_center{0.0f, 1.0f, 0.0f};
constexpr float caster_half = 0.5f;
constexpr float floor_half = 6.0f;

void make_context();  // throws std::runtime_error
void* proc_address(const char* name);

// The end of a fragment shader, to be appended to a function that returns shadows; and a test whether the driver
// compiles the whole shader.
extern const char* const forward_fragment_text;
bool compiles(const std::string& fragment_text);

struct Targets {
  GLuint depth = 0, normals = 0;
};

struct Scene {
  Scene();
  void draw(const glm::mat4& world_to_clip, bool casters_only) const;
  GLuint program = 0, vertices = 0;
};

glm::mat4 view(const glm::vec3& eye);  // towards the square's foot
glm::mat4 projection();

// The depth and normals of a frame, drawn with the engine's conventions.
Targets draw_frame(const Scene& scene, const glm::mat4& view);

// Channel R of layer 0 of a texture array of the size of the targets, rows from bottom to top.
std::vector<float> read_red(GLuint texture);

// Draws the casters into a depth array with one layer per matrix: near 0, far 1, clip-space depth 0..1.
GLuint draw_depth_array(const Scene& scene, const glm::mat4* world_to_clip, int count, int size);

}  // namespace engine
