#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.h"
#include "gl/pass.h"
#include "render/setup.h"
#include "render/view.h"
#include "scene/gpu_scene.h"
#include "shadow/soft_shadows.h"

namespace penumbra::render {

// What one frame shows. Camera and time of the last frame come with it, for motion vectors; a first frame gives its
// own.
struct FrameInputs {
  int width = 1280, height = 720;
  int view = 0;  // tells pictures apart that are drawn in turn: each has maps, a mask and a history of its own
  Camera camera, last_camera;
  std::vector<Light> lights{Sun{}};  // 1 to max_lights; each has a layer of the mask, in this order
  double time = 0, last_time = 0;    // seconds
  // Nothing of the last frame belongs to this one: the view or the time jumps. What a technique remembers is dropped,
  // so that the frame is that of a run which starts here. A scene other than the last frame's is a cut without being
  // told.
  bool cut = false;
};

// What one pixel is made of where several were drawn for it.
enum class Reduction {
  mean,            // all of them
  mean_of_valid,   // those that are not 0, which stands for "none"
  nearest_center,  // the one at the middle: what has no mean, as labels, or none that is its own kind, as unit vectors
};

// A named picture of the frame for --aov and the inspector.
struct Aov {
  std::string name;                   // "shadow"
  std::string help;                   // meaning and unit
  std::vector<std::string> channels;  // "R","G","B" or "V", …: EXR channel names after the layer's name
  Reduction reduction = Reduction::mean;
  bool in_pixels = false;  // a length in drawn pixels
};
const std::vector<Aov>& aovs();

// The finished frame; textures live until the next frame.
struct Frame {
  const gl::Texture* display = nullptr;  // RGBA8, sRGB-encoded, tone mapped
  const gl::Texture* color = nullptr;    // RGBA16F, linear, before the tone map and its automatic exposure
  const gl::Texture* depth = nullptr;
  shadow::Mask mask;
};

class Renderer {
 public:
  explicit Renderer(gl::Device& device, shadow::Registry registry = shadow::built_in_registry());
  ~Renderer();

  // Rows of the shadow library and of the renderer (exposure, sky, …).
  static std::vector<Param> params(const shadow::Registry& registry);

  // `params` holds at least the rows of params(). Throws Error for a frame without lights or with too many.
  const Frame& draw(scene::GpuScene& scene, const FrameInputs& inputs, const ParamSet& params);
  // The last frame's AOV as floats, rows top to bottom, aov.channels.size() a pixel. Throws Error for unknown names.
  std::vector<float> read_aov(std::string_view name) const;
  // The same of one pixel, counted from the upper left.
  std::vector<float> read_aov(std::string_view name, const glm::ivec2& pixel) const;
  // The last frame as it is shown: RGB, 8 bits, sRGB, rows top to bottom.
  std::vector<std::uint8_t> read_display() const;

  // Gives back what is kept for FrameInputs::view; its next frame is a cut. Nothing is to be read of its last one any
  // more.
  void forget_view(int id);

  // Every program that any parameters can build (variants tool, tests).
  std::vector<gl::ProgramDesc> all_programs(const ParamSet& defaults);

  const shadow::Registry& registry() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::render
