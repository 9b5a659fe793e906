#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <set>
#include <span>
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

// The most samples of a pixel of a frame, and how many a finished picture has.
inline constexpr int max_samples = 256, usual_samples = 4;

// What one frame shows. It includes the camera and time of the last frame, for motion vectors; the first frame repeats
// its own values there.
struct FrameInputs {
  int width = 1280, height = 720;
  int view = 0;  // one of several drawn in turn, 0 or more; each has its own maps, mask and history
  Camera camera, last_camera;
  // 1 to max_lights; light i has layer i of the mask, up to max_shadowed_lights
  std::vector<FrameLight> lights{SunLight{}};
  // One for each light: under which its maps and history are kept from frame to frame, whatever other lights there are.
  // Empty: their places in the list.
  std::vector<int> light_ids;
  // What warnings call each light. Empty: its place in the list.
  std::vector<std::string> light_names;
  double time = 0, last_time = 0;  // seconds
  // The view or the time jumps, so nothing of the last frame may be reused: techniques and denoisers drop their
  // history, and the frame equals the first frame of a new run. A change of scene is always a cut, even if this is
  // false.
  bool cut = false;
  glm::vec3 ground_color{ground_albedo};  // albedo of the ground around the scene
  bool on_ground = false;                 // the scene stands on ground, which hides suns that are below the horizon
  // The ids of the lights of which a warning said that the ground hides them, of all frames that one user draws of one
  // scene, with whichever renderer. Null: there is no warning.
  std::shared_ptr<std::set<int>> told_hidden;
  bool restart = false;       // drops the histories alone; shadow maps in which nothing moved are kept
  bool mask_details = false;  // keeps what the AOVs need whose Aov::mask_details is set
  // Of each pixel of the picture, 1 to max_samples: how many are averaged for display and colour, so that edges are
  // smooth. The first is the middle of the pixel, and all that is read of the frame besides is that one's. The others
  // see its shadows, and leave histories as they are.
  int samples = 1;
  // The other samples have shadows of their own instead: each computes a mask at its place in the pixels, with other
  // noise and without a history, under an id that no other view has. So edges of shadows become smooth too, for the
  // time of a mask for each sample.
  bool own_shadows = false;
  // AOVs that are read as the mean of all samples, too, if their Aov::reduction is a mean.
  std::vector<std::string> averaged_aovs;
  // With several samples: called with the display of the first one alone, before the further ones are drawn, for a
  // program that shows it meanwhile. See gl::Device::before_pass for what it may do.
  std::function<void(const gl::Texture& display)> show_first;
};

// With supersampling or FrameInputs::averaged_aovs, how the samples of one pixel become its value.
enum class Reduction {
  mean,            // the mean of all samples
  mean_of_valid,   // the mean of the samples that are not 0, where 0 means "none"
  nearest_center,  // the sample at the centre: for labels, places and unit vectors, whose mean would be neither
};

// A named intermediate picture (AOV) of the frame, for --aov and the inspector.
struct Aov {
  std::string name;                   // "shadow"
  std::string help;                   // meaning and unit
  std::vector<std::string> channels;  // "R","G","B" or "V", …: EXR channel names without the layer's name
  Reduction reduction = Reduction::mean;
  bool in_pixels = false;     // a length in drawn pixels, to be rescaled with supersampling
  bool mask_details = false;  // there only in frames drawn with FrameInputs::mask_details
  bool of_light = false;      // one picture for each light that casts shadows
};
const std::vector<Aov>& aovs();

// The finished frame. The textures are valid until the next frame.
struct Frame {
  const gl::Texture* display = nullptr;  // RGBA8, sRGB-encoded, tone mapped
  // RGBA16F, or RGBA32F of several samples: linear, before the tone map and its automatic exposure
  const gl::Texture* color = nullptr;
  const gl::Texture* depth = nullptr;
  shadow::Mask mask;
};

// The casters that the parameters choose. A ground casts unless all lights are suns whose whole discs are above the
// horizon, and the technique compares depths near receivers alone: mean depths need what lies behind the casters.
scene::CasterChoice caster_choice(const ParamSet& params, std::span<const FrameLight> lights,
                                  const shadow::Registry& registry);

// Throws Error, as Renderer::draw() does, for lamps whose shadows the technique can't compute, and for maps of lamps
// that are larger than those of a sun can be. Nothing is allocated.
void check_lights(const FrameInputs& inputs, const shadow::Registry& registry, const ParamSet& params);

class Renderer {
 public:
  explicit Renderer(gl::Device& device, shadow::Registry registry = shadow::built_in_registry());
  ~Renderer();

  // The parameters of the shadow library and of the renderer (exposure, sky, …).
  static std::vector<Param> params(const shadow::Registry& registry);

  // `params` must have at least the parameters of params(). Throws Error for a frame without lights or with more than
  // max_lights, and for a number of samples that is out of range.
  const Frame& draw(scene::GpuScene& scene, const FrameInputs& inputs, const ParamSet& params);
  // The last frame's AOV as floats, rows top to bottom, aov.channels.size() values for each pixel. Throws Error for
  // unknown names, and for an AOV that this frame did not keep (Aov::mask_details). The frame's scene must still exist:
  // motion vectors that the frame did not need are drawn here. `light`: which one's, where Aov::of_light is set.
  std::vector<float> read_aov(std::string_view name, int light = 0) const;
  // The AOV `shadow` of every light that casts shadows, one picture below the other.
  std::vector<float> read_visibilities() const;
  // The same for one pixel, counted from the upper left, of the first light.
  std::vector<float> read_aov(std::string_view name, const glm::ivec2& pixel) const;
  // The last frame as it is displayed: RGB, 8 bits, sRGB-encoded, rows top to bottom.
  std::vector<std::uint8_t> read_display() const;

  // Releases what is kept for that FrameInputs::view; its next frame is a cut. Its last frame can no longer be read.
  void forget_view(int id);

  // Every program that any choice of parameters can build, for the variants tool and tests.
  std::vector<gl::ProgramDesc> all_programs(const ParamSet& defaults);

  const shadow::Registry& registry() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::render
