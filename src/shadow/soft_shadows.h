#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "cascades.h"
#include "technique.h"

namespace penumbra::shadow {

// How the caller's depth buffer and matrices are meant.
struct Conventions {
  bool reversed_z = true;          // the far plane is at depth 0 (else 1); pixels exactly there are sky and lit
  bool depth_zero_to_one = true;   // clip-space z in 0..1 (else -1..1)
  bool octahedral_normals = true;  // normals texture: RG, octahedral map; else RGB(A), xyz in -1..1
};

// A camera now and in the last frame. Projections without jitter; `jitter` is what was added to clip-space xy (in NDC).
struct View {
  glm::mat4 view{1}, projection{1};
  glm::mat4 last_view{1}, last_projection{1};
  glm::vec2 jitter{0};
  int id = 0;  // tells several views apart
};

// A texture of the caller's.
struct TextureView {
  unsigned id = 0;
  int width = 0, height = 0;
};

enum class CasterKind {
  depth,       // all casters that the volume holds, depth only
  moved_now,   // those that moved since the last frame, where they are
  moved_last,  // those that moved, where they were
  geometry,    // all, for techniques that need triangles
};

// One call to the caller's code: draw these casters with these matrices. The framebuffer, viewport, depth test and
// culling state are set; the callback binds its own programs and vertex arrays, both sides of every triangle cast, and
// polygon offset stays off.
struct CasterPass {
  CasterKind kind = CasterKind::depth;
  int cascade = 0;
  glm::mat4 world_to_clip{1};
  CullVolume cull;
};
using DrawCasters = std::function<void(const CasterPass&, gl::Pass&)>;

// Maps that the caller has drawn already: a depth texture array with one layer a cascade, and where each lies.
struct FinishedMaps {
  TextureView depth;
  Cascades cascades;
};

// A directional light. Angle and shape are the parameters sun.angle and sun.shape, which `overrides` can replace.
struct Light {
  int id = 0;
  glm::vec3 to_light{0, 1, 0};         // unit, world
  std::vector<std::string> overrides;  // "name=value"
  std::optional<FinishedMaps> maps;    // absent: drawn by Inputs::draw
};

struct Inputs {
  View view;
  Conventions conventions;
  TextureView depth;    // any depth or R32F texture
  TextureView normals;  // geometric normals, world space
  TextureView motion;   // optional (id 0): RG, where the surface is minus where it was, in NDC
  std::span<const Light> lights;
  Box casters, receivers;  // world bounds
  DrawCasters draw;        // may be empty when every light brings its maps
};

// What the mask holds, layer by layer (one a light): RGBA16F, the size of the depth texture:
// R visibility 0..1; G penumbra radius at the receiver, metres (0: none); B mean distance from receiver to blockers
// along the light, metres (0: none); A cascade index, plus 0.5 where the kernel is smaller than a texel.
struct Mask {
  const gl::Texture* texture = nullptr;
  std::vector<LightFrame> lights;
};

// Soft shadows for a deferred renderer: depth and normals in, a visibility mask out.
//
// render() changes framebuffer, viewport, program, vertex array, texture units 0 to 7, uniform buffer bindings 0 to 3,
// image units 0 and 1, depth, blend, cull, clip-control and polygon state, and restores none. After the first frame of
// a size it allocates nothing. Throws Error for bad input and shaders that do not compile.
class SoftShadows {
 public:
  explicit SoftShadows(gl::Device& device, Registry registry = built_in_registry());
  ~SoftShadows();

  const Registry& registry() const { return registry_; }

  // `params` holds at least registry().params().
  Mask render(const Inputs& inputs, const ParamSet& params);

  // For surfaces drawn forward, after render(): the file to include, which defines
  //   float shadow_visibility(vec3 view_position, vec3 geometric_normal_world, vec2 pixel)
  std::string forward_include(const ParamSet& params) const;
  // Binds what that function reads for a light of the mask, and returns the defines that its program needs.
  std::vector<gl::Define> bind_forward(const Mask& mask, size_t light);

  // Every program that render() can build with any parameter, for validation ahead of time.
  std::vector<gl::ProgramDesc> all_programs(const ParamSet& defaults) const;

 private:
  LightFrame prepare_light(const Inputs& inputs, const Light& light, const ParamSet& params, int layer);
  void upload_light(const Inputs& inputs, const LightFrame& light, size_t index);
  void bind_light(const LightFrame& light, size_t index);
  void draw_mask(const Inputs& inputs, const LightFrame& light, size_t index, const gl::Texture& mask);
  const Technique& forward_technique(const ParamSet& params) const;

  gl::Device& device_;
  Registry registry_;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::shadow
