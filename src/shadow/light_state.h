#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "../gl/pass.h"
#include "check_inputs.h"
#include "inputs.h"
#include "kept_maps.h"
#include "light_frame.h"
#include "registry.h"
#include "samples.h"

namespace penumbra::shadow {

// The state of one light in one view that is kept between frames.
struct LightState {
  std::string prefix;  // of the names of its targets and buffers

  // The parameters of the last frame, as given and with the light's overrides applied; rebuilt only when either
  // changes.
  ParamSet given, params;
  int asked_layers = 1;  // maps.layers as given; in `params` it is 1 where the second one is left out
  std::vector<std::string> overrides;
  // The programs of techniques, recipes and denoisers under these parameters, by owner.
  std::map<std::string, std::vector<gl::ProgramDesc>, std::less<>> programs;

  // The sample points that a technique's programs read. Each set that its frames take turns with has a place of its
  // own, and is written when it is first used, so that nothing changes that the GPU may still read for the last frame.
  struct SampleTables {
    const gl::Buffer* buffer = nullptr;
    int sets = 0;
    std::uint32_t written = 0;  // bit i: set i
    Scramble scramble = Scramble::shift;
    std::size_t bytes = 0, stride = 0;  // of one set, and from one to the next
    std::size_t offset = 0;             // of the present frame's
  };
  std::map<std::string, SampleTables, std::less<>> samples;  // by technique: the light's technique and its stand-in
  bool uploaded = false;  // `params_block` and `samples` are up to date with `params`
  // A parameter has changed since the last complete frame; `used`: the names that this frame's passes have used since,
  // of which all others are then released.
  bool changed = false;
  std::set<std::string, std::less<>> used;
  const gl::Texture* noise = nullptr;
  const gl::Buffer* params_block = nullptr;
  const gl::Buffer* shadow_block = nullptr;

  gl::Texture shadow_map;  // refers to the map that this frame drew or the caller supplied

  LightSource source;
  LightShape shape;
  int layers = 0;              // see layer_count()
  bool drawn = false;          // in this frame
  bool uninterrupted = false;  // the previous frame of the view drew this light, and its history is valid
  bool follows = false;        // the previous frame of the view drew this light, and Inputs::moved is what moved since
  std::uint64_t frames = 0;    // drawn
  std::uint64_t age = 0;       // of them, since the history began
  std::uint64_t rests = 0;     // of these, those whose view is that of the frame before

  // A double-buffered history: two textures, swapped every frame.
  struct KeptTexture {
    gl::TextureDesc desc;
    int now = 0;
    std::uint64_t filled = 0;  // value of `frames` when it was last written
  };
  std::map<std::string, KeptTexture, std::less<>> kept;  // by the beginning of the textures' names
  MapContent map;                                        // which the library drew or kept in the last frame
  // What the drawn texels of the last frame's layers were computed from under these parameters, and the result.
  struct DrawnTexels {
    glm::mat4 view{1}, projection{1};
    Box casters, receivers;
    bool exact_bounds = false;
    LightSource source;
    glm::dvec2 jitter{0};  // of the maps
    ReadBounds read;
    std::array<TexelRange, max_layers> of_layers;
  };
  std::optional<DrawnTexels> drawn_texels;
  // What recipes that depend only on their needs have made.
  struct KeptProduct {
    const gl::Texture* texture = nullptr;
    std::vector<ParamValue> values;  // of the recipe's parameters
    LightShape shape;
    std::uint64_t shader_changes = 0;
    std::uint64_t frame = 0;  // value of `frames` when it was last used
    bool kept = false;        // in this frame, instead of being made again
  };
  std::map<std::string, KeptProduct, std::less<>> products;  // by recipe
  std::unique_ptr<LightState> first;                         // of the maps that find_near_penumbrae() draws
  bool had_movement_map = false, had_shadow_map = false;     // which the library drew in the last frame
  bool bound_forward = true;                                 // Inputs::binds_forward of the last frame
};

// The state of a view that is kept between frames.
struct ViewState {
  std::string prefix;  // of the names of its targets and buffers
  glm::mat4 view{1}, projection{1};
  glm::vec2 jitter{0}, last_jitter{0};
  Conventions conventions;
  int width = 0, height = 0;  // of the receivers' textures
  Rect viewport;
  bool brings_normals = false;
  bool began = false;                        // a frame has completed without an Error
  bool drawn = false;                        // the last one has
  bool rests = false;                        // this frame has the matrices of the last one
  std::optional<bool> clip_space_of_caller;  // before the first frame: z in 0..1, not in -1..1; absent: unknown
  TextureChecks checked;
  NdcError depth_error;
  bool has_copies = false;               // of receivers' textures
  bool has_normals = false;              // that were made from depths
  const gl::Texture* normals = nullptr;  // made from depths in this frame; null where the caller brings some
  bool warned_of_depth = false, warned_of_bounds = false;
  std::map<int, LightState> lights;
};

// Decides whether the histories and the maps of the view's last frame are valid in this one. `last_completed`: that
// frame did not throw.
void begin_frame(ViewState& view, const Inputs& inputs, bool last_completed);
// The caller's values of the parameters.
struct GivenParams {
  const Registry& registry;
  const ParamSet& defaults;  // the registry's parameters with their default values
  const ParamSet& values;
};
// Sets the light's parameters for this frame, with the light's overrides applied. Returns whether all those that
// concern the chosen technique and denoiser have the values of the last frame.
bool take_params(LightState& state, const GivenParams& given, const Light& light);
// Sets maps.layers for this frame: what is asked for, or 1.
void take_layers(LightState& state, bool second_layer);
// Sets the light's size and shape, which programs and sample points depend on.
void take_shape(LightState& state, const LightShape& shape);
// Decides whether the history of the light's last frame is valid in this one.
void begin_frame(const ViewState& view, LightState& state, const Light& light, int layers, bool same_params);

}  // namespace penumbra::shadow
