#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "../gl/pass.h"
#include "soft_shadows.h"

namespace penumbra::shadow {

// What outlives a frame of one light in one view, for one technique.
struct LightState {
  ParamSet params;
  bool rotated = true;  // see turns_samples()
  const gl::Texture* noise = nullptr;
  const gl::Buffer* params_block = nullptr;
  const gl::Buffer* shadow_block = nullptr;
  const gl::Buffer* sample_block = nullptr;

  LightSource source;
  int layers = 0;            // of the shadow map
  bool drawn = false;        // in this frame
  bool goes_on = false;      // the last frame of the view drew it, and is the one before this
  std::uint64_t frames = 0;  // drawn
  std::uint64_t age = 0;     // of them, since what is kept began

  // Two textures in turn.
  struct Ring {
    gl::TextureDesc desc;
    int now = 0;
    std::uint64_t filled = 0;  // the last of `frames` that did
  };
  std::map<std::string, Ring, std::less<>> rings;

  std::unique_ptr<LightState> stand_in;  // of the technique that serves forward surfaces, if it is another
};

// What outlives a frame of a view.
struct ViewState {
  glm::mat4 view{1}, projection{1};
  glm::vec2 jitter{0}, last_jitter{0};
  Conventions conventions;
  int width = 0, height = 0;  // of the receivers' textures
  Rect viewport;
  bool drawn = false;  // to its end
  std::map<int, LightState> lights;
};

// Decides whether what is kept of the view's last frame holds in this one.
void begin_frame(ViewState& view, const Inputs& inputs);
// The same for a light, under the technique and the parameters of this frame, which it takes.
void begin_frame(LightState& state, const Technique& technique, const Light& light, const LightFrame& frame,
                 ParamSet params);
// Gives back the rings that this frame has not filled, with the targets whose names begin with `prefix` and theirs.
void drop_unused_rings(LightState& state, gl::Device& device, const std::string& prefix);
// What the names of a ring's textures begin with.
std::string ring_prefix(std::string_view name);

// Binds what every evaluation of a technique reads: blocks, maps, products.
void bind_light(gl::Device& device, const LightFrame& frame, const LightState& state);

}  // namespace penumbra::shadow
