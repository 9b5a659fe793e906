#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "gpu/gpu_test.h"
#include "shadow/soft_shadows.h"

namespace penumbra::test {

struct Triangle {
  glm::vec3 a, b, c;
  glm::vec3 moved_by{0};  // since the last frame
};

// A few triangles, a camera and a sun: enough to fill the shadow library's inputs as an engine would.
struct TriangleScene {
  std::vector<Triangle> triangles;
  glm::mat4 view{1}, projection{1};
  int width = 64, height = 64;
  glm::vec3 to_light{0, 1, 0};
  std::optional<shadow::Box> casters, receivers;  // bounds; else those of all triangles
  // Of the depth buffer, or GL_R16F: depths of 32-bit floats that are then copied to half floats. Depths are those of
  // reversed Z unless the projection and the conventions say otherwise.
  GLenum depth_format = GL_DEPTH_COMPONENT32F;
  shadow::Conventions conventions;
  // How far beside its place the receivers' depth is drawn, pixels: what a rasteriser may do that rounds vertices.
  glm::vec2 drawn_beside{0};

  void add_quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v);
  void add_box(const glm::vec3& min, const glm::vec3& max);
  // Moves the triangles from that one on.
  void move_from(size_t first, const glm::vec3& by);
  // Bounds of the triangles that moved, at their present and last positions; min > max: none moved.
  shadow::Box moved() const;
};

// A scene's triangles on the GPU, and the callback that draws them for the shadow library's passes.
class Geometry {
 public:
  explicit Geometry(const TriangleScene& scene);
  ~Geometry();
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;

  static void put_shaders(gl::ShaderFiles& files);
  void draw() const;
  shadow::DrawCasters casters() const;  // valid as long as this object

 private:
  gl::Buffer buffer_;
  GLuint array_ = 0;
  GLsizei count_ = 0;
};

// A box of 2 m on a ground of 10 m; the picture is `side` pixels wide and high.
TriangleScene box_on_ground(int side = 64);

// A half-plane 5 m above the ground, whose edge is over the middle of the ground (4 m wide), under a sun at the zenith.
// The camera is between them; the picture is `side` pixels wide and high. The caller sets the projection.
TriangleScene half_plane_over_ground(int side);

// Reversed-Z, z in 0..1.
glm::mat4 orthographic(float half_width, float half_height, float near, float far);
glm::mat4 perspective(float fov_y, float aspect, float near);
// OpenGL's own: depth grows with the distance, z in -1..1.
glm::mat4 standard_perspective(float fov_y, float aspect, float near, float far);
glm::vec3 sun_direction(float azimuth_degrees, float elevation_degrees);

// The library's result for a scene, in rows from bottom to top.
struct Shadowed {
  int width = 0, height = 0;
  std::vector<float> mask;        // 4 a pixel: visibility, penumbra radius, blocker distance, layer of the map
  std::vector<float> depth;       // as stored
  std::vector<glm::vec3> points;  // world position under each pixel

  float visibility(int x, int y) const { return mask[4 * static_cast<size_t>(y * width + x)]; }
  std::vector<float> visibilities() const {
    std::vector<float> all;
    for (size_t i = 0; i < mask.size(); i += 4) all.push_back(mask[i]);
    return all;
  }
  float penumbra_radius(int x, int y) const { return mask[4 * static_cast<size_t>(y * width + x) + 1]; }
  const glm::vec3& point(int x, int y) const { return points[static_cast<size_t>(y * width + x)]; }
  float sky_depth = 0;
  bool sky(int x, int y) const { return depth[static_cast<size_t>(y * width + x)] == sky_depth; }
};

// Draws scenes on one device with one facade.
class TriangleRenderer {
 public:
  explicit TriangleRenderer(shadow::Registry registry = shadow::built_in_registry());
  // Parameters at their defaults; change and pass them to render().
  ParamSet params() const { return ParamSet(shadows_.registry().params()); }
  // `adjust` may change the inputs just before the call of the library; `after` is called as soon as it has returned.
  using Adjust = std::function<void(shadow::Inputs&)>;
  Shadowed render(const TriangleScene& scene, const ParamSet& params, const Adjust& adjust = {},
                  const std::function<void()>& after = {});
  gl::Device& device() { return device_; }
  shadow::SoftShadows& shadows() { return shadows_; }
  const shadow::Mask& mask() const { return mask_; }

 private:
  gl::Device device_;
  shadow::SoftShadows shadows_;
  shadow::Mask mask_;
  GLenum depth_format_ = 0;
};

// A test fixture with its own renderer.
class TriangleTest : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    renderer_ = std::make_unique<TriangleRenderer>();
  }
  void TearDown() override {
    renderer_.reset();
    GpuTest::TearDown();
  }
  std::unique_ptr<TriangleRenderer> renderer_;
};

}  // namespace penumbra::test
