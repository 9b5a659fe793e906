#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "gl/pass.h"
#include "scene/gpu_scene.h"
#include "scene/pose.h"
#include "shadow/soft_shadows.h"

namespace penumbra::render {

// A camera at rest, in world space.
struct Camera {
  glm::mat4 view{1};
  bool orthographic = false;
  float fov_y = 0.8f;        // radians, of the height
  float half_height = 1.0f;  // orthographic
  float near = 0.1f;         // the projection is reversed-Z with an infinite far plane (orthographic: `far`)
  float far = 1000.0f;
};
glm::mat4 projection_of(const Camera& camera, float aspect);

struct Sun {
  glm::vec3 to_light{0.4f, 0.8f, 0.4f};  // unit
  glm::vec3 illuminance{100000.0f};      // lux, linear RGB
};

// What --camera, --eye, --sun and --ground leave open, chosen from the scene.
struct Setup {
  Camera camera;
  Sun sun;
  bool ground = false;  // a plane under the scene
  float ground_height = 0;
};

// What one frame shows. Cameras, sun and pose of the last frame come with it, for motion vectors.
struct FrameInputs {
  int width = 1280, height = 720;
  Camera camera, last_camera;
  Sun sun;
  double time = 0, last_time = 0;  // seconds
};

// A named picture of the frame for --aov and the inspector.
struct Aov {
  std::string name;                   // "shadow"
  std::string help;                   // meaning and unit
  std::vector<std::string> channels;  // "R","G","B" or "V", …: EXR channel names after the layer's name
};
const std::vector<Aov>& aovs();

// The finished frame; textures live until the next frame.
struct Frame {
  const gl::Texture* display = nullptr;  // RGBA8, sRGB-encoded, tone mapped
  const gl::Texture* color = nullptr;    // RGBA16F or 32F, linear, exposed, before the tone map
  const gl::Texture* depth = nullptr;
  shadow::Mask mask;
};

class Renderer {
 public:
  Renderer(gl::Device& device, shadow::Registry registry);
  ~Renderer();

  // Rows of the shadow library and of the renderer (exposure, sky, …).
  static std::vector<Param> params(const shadow::Registry& registry);

  const Frame& draw(scene::GpuScene& scene, const FrameInputs& inputs, const ParamSet& params);
  // The last frame's AOV as floats, rows top to bottom, aov.channels.size() a pixel. Throws Error for unknown names.
  std::vector<float> read_aov(std::string_view name);

  // Every program that any parameters can build (variants tool, tests).
  std::vector<gl::ProgramDesc> all_programs(const ParamSet& defaults) const;

  const shadow::Registry& registry() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::render
