#pragma once

#include <memory>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "inputs.h"
#include "light_frame.h"
#include "pass_context.h"
#include "registry.h"

namespace penumbra::shadow {

// A form in which forward surfaces can get their shadows: the file to include, and the defines that it needs.
struct ForwardProgram {
  std::string include;
  std::vector<gl::Define> defines;
};

// Soft shadows for a deferred renderer: depth and normals in, a visibility mask out.
//
// OpenGL state. render() expects none, and saves none. It leaves at OpenGL's initial values what it changes of
//   - capabilities: depth and stencil test, scissor, blend, logic operation, culling, depth clamp, dithering, colour
//     encoding (GL_FRAMEBUFFER_SRGB), rasterizer discard, sample mask, coverage, shading and alpha to coverage or one,
//     line and polygon smoothing, polygon offset, primitive restart, program point size, clip distances 0 to 7;
//   - depth function, mask and range, stencil function, operations and mask, colour mask, front face, culled face,
//     polygon mode, clip control, point and line size;
//   - the program, the vertex array, the draw and read framebuffers, textures and samplers of units 0 to 15, images of
//     units 0 to 7, the buffers of indirect draws and dispatches: nothing is bound.
// It leaves changed: the viewport, the blend function and equation, uniform buffers 0 to 2 and with them the general
// binding GL_UNIFORM_BUFFER. All else stays, pixel-store state and the buffers of pixel transfers included, but for
// what the caster callback and techniques of the caller's own change. After an Error any of these may be changed.
//
// OpenGL errors. A frame that makes nothing reads no error flag: what the caller's own calls have raised stays for the
// caller. To tell whether a texture or buffer found memory, the flags have to be read around the call that makes it;
// those that were there before are logged as warnings, by name (core/log.h), since OpenGL can't be given them back. In
// a context with Penumbra's debug output every pass throws Error for errors so far, the caller's included.
//
// Memory. After the first frame of a size no texture is made, and after the first in which a caster moved (with a
// history) no OpenGL object. Maps, masks and history belong to a view's id until
// forget_view(); a light's go when a frame of its view leaves it out.
//
// Throws Error for bad input (see check()) and for shaders that do not compile. A texture of the caller's is checked
// when its name, its size or its use is another than in the last frame of the view.
class SoftShadows {
 public:
  explicit SoftShadows(gl::Device& device, Registry registry = built_in_registry());
  ~SoftShadows();
  SoftShadows(const SoftShadows&) = delete;
  SoftShadows& operator=(const SoftShadows&) = delete;

  const Registry& registry() const { return registry_; }

  // `params` holds at least registry().params().
  Mask render(const Inputs& inputs, const ParamSet& params);
  // Gives back all that is kept for a view.
  void forget_view(int id);

  // For surfaces drawn forward, after render(). A program of the caller's own takes forward_source(): text to put after
  // its #version 450 line, in which every global name begins with "penumbra_", and which defines
  //   float penumbra_shadow_visibility(vec3 view_position, vec3 geometric_normal_world, vec2 pixel)
  // where `geometric_normal_world` is of unit length and on the viewer's side of the surface, and `pixel` is that of
  // the mask. A program of gl::ShaderLibrary takes forward_program(): the file to include and the defines; the function
  // is shadow_visibility(). `light` is a light that the parameters are overridden by.
  std::string forward_source(const ParamSet& params, const Light& light = {}) const;
  ForwardProgram forward_program(const ParamSet& params, const Light& light = {}) const;
  // Binds what that function reads for a light of the mask: textures and samplers of units 0 to 7, uniform buffers 0 to
  // 2. unbind_forward() frees the units again.
  void bind_forward(const Mask& mask, size_t light);
  void unbind_forward();

  // Every program that render() can build with any parameter, and every form of a technique for forward surfaces, for
  // validation ahead of time. Those without a vertex shader are for CasterKind::geometry: the caster callback's own is
  // to be added to them.
  std::vector<gl::ProgramDesc> all_programs(const ParamSet& defaults) const;
  std::vector<ForwardProgram> all_forward_programs(const ParamSet& defaults) const;

 private:
  struct State;
  std::string view_prefix(int id) const;

  gl::Device& device_;
  Registry registry_;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::shadow
