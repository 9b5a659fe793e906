#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "inputs.h"
#include "light_frame.h"
#include "pass_context.h"
#include "registry.h"

namespace penumbra::shadow {

struct ViewState;

// What a forward shader needs for its shadows: the GLSL file to include, and the defines to compile it with.
struct ForwardProgram {
  std::string include;
  std::vector<gl::Define> defines;
};

// What decides, beside the parameters, which programs a frame needs.
struct FrameKind {
  Conventions conventions;
  std::span<const Light> lights;
  bool mask_details = false;
  bool binds_forward = true;  // Inputs::binds_forward
  // The frame's textures, if there are some yet: drivers may compile a program for the format that it reads.
  TextureView depth, normals, motion;
};

// Soft shadows for a deferred renderer: depth and normals in, a visibility mask out.
//
// OpenGL state. render() relies on no state set before it, and restores none. Of the following, whatever it changes is
// back at OpenGL's initial value afterwards:
//   - capabilities: depth and stencil test, scissor, blend, logic operation, culling, depth clamp, dithering, colour
//     encoding (GL_FRAMEBUFFER_SRGB), rasterizer discard, sample mask, coverage, shading and alpha to coverage or one,
//     line and polygon smoothing, polygon offset, primitive restart, program point size, clip distances 0 to 7;
//   - depth function, mask and range, stencil function, operations and mask, colour mask, front face, culled face,
//     polygon mode, clip control, point and line size;
//   - the program, the vertex array, the draw and read framebuffers, textures and samplers of units 0 to 15, images of
//     units 0 to 7, the buffers of indirect draws and dispatches: all are unbound.
// It changes without resetting: all viewports, the scissor box of viewport 0, the blend function and equation, uniform
// buffer bindings 0 to 2, storage buffer binding 7, and with them the generic bindings GL_UNIFORM_BUFFER and
// GL_SHADER_STORAGE_BUFFER. All other state is unchanged, including pixel-store state and the buffers bound for pixel
// transfers, except for what the caster callback and the caller's own techniques change. The same holds after an Error,
// except for gl::ContextError, after which any of the state named here may have changed.
//
// In a context of the compatibility profile, legacy state that would change what shaders write (alpha test, stipple,
// clamped fragment colours, pixel transfer) has its initial values during render() and is as before afterwards.
//
// OpenGL errors. A frame that creates no texture or buffer reads no error flag, so errors of the caller's own calls
// stay for the caller to read. When render() allocates a texture or buffer, it has to read the flags before and after
// the call to find out whether memory ran out. It logs flags raised earlier as warnings, by name (core/log.h), since
// they can't be put back. In a context with Penumbra's debug output every pass throws Error for all errors so far,
// including the caller's.
//
// Memory. No texture is created after the first frame of a size, unless cascades.fit=visible or penumbrae chooses
// another number of cascades for what a frame shows (which cascades.count of 1 prevents), or maps.overlap a second
// layer, and no OpenGL object at all after the first frame in which a caster moved (where a history is kept). Shadow
// maps, masks and histories are kept for each view id until forget_view(); those of a light are released in the first
// frame of the view that does not list it.
//
// Shadow maps. Layers in which nothing has changed since the view's last frame are not drawn again, and neither are the
// products of recipes that depend on the map alone: see Inputs::moved, which must be right for that, and the parameter
// maps.keep. All are drawn anew after View::cut, after an Error, in frames whose View::last_view or last_projection are
// not the matrices of the view's last frame, and when a shader changed (gl::ShaderLibrary::changed()); those of suns
// also with maps.jitter and a history in frames whose matrices are the last one's, without Inputs::forward_receivers.
//
// Waiting. With the parameter cascades.fit=visible, render() waits once a light until the GPU has finished all earlier
// work and has found what the depth texture shows; with cascades.fit=penumbrae twice where the technique decides tiles
// (Technique::decides_tiles), and small maps are drawn in between, by which maps.overlap counts tiles. No other step of
// the library's own reads back what the GPU computes.
//
// Threads. A device, and all that draws with it, is used on one thread at a time, with its context current there.
// Devices of several contexts, of one driver or of several, can be used on several threads at the same time.
// gl::load_api() is called on the thread that makes a device, and on each that destroys one.
//
// Throws Error for bad input (see check()), for shaders that do not compile, when it is called from a callback of its
// own, when a display list is recorded, in a view's first frame when no context is current or load_api() was not
// called, and in the first call on another thread than before when the current context is not the device's. A caller's
// texture is checked again only when its name, size or use was not in the last three frames of the view.
class SoftShadows {
 public:
  explicit SoftShadows(gl::Device& device, Registry registry = built_in_registry());
  ~SoftShadows();
  SoftShadows(const SoftShadows&) = delete;
  SoftShadows& operator=(const SoftShadows&) = delete;

  const Registry& registry() const { return registry_; }

  // `params` holds at least registry().params().
  Mask render(const Inputs& inputs, const ParamSet& params);
  // Whether render() reads Inputs::motion with these parameters and lights, whose overrides apply: where the denoiser
  // keeps a history, and where a technique has passes of its own that read it (Technique::resolve_reads_motion). Else
  // the caller need not draw motion vectors.
  bool reads_motion(const ParamSet& params, std::span<const Light> lights) const;
  // Compiles the programs and makes the tables that frames of that kind need with these parameters, so that none of
  // them has to. Draws three frames of 60 × 60 pixels, with maps.overlap six, with one caster of its own and maps of
  // the parameters' size, which are released afterwards. Leaves OpenGL and throws as render() does.
  void warm_up(const FrameKind& kind, const ParamSet& params);
  // Releases everything that is kept for a view.
  void forget_view(int id);
  // For callers that could not make Inputs of a view's frame: the next one begins anew, as after an Error of render().
  // Else what moved in the frame that is missing would be unknown.
  void interrupt_view(int id);

  // For surfaces drawn forward, after render(). The caller's own programs use forward_source(): text to put after the
  // #version 450 line, in which every global name begins with "penumbra_", and which defines
  //   float penumbra_shadow_visibility(vec3 view_position, vec3 geometric_normal_world, vec2 pixel)
  // where `geometric_normal_world` has unit length and points to the viewer's side of the surface, and `pixel` is the
  // pixel's position in the mask; `view_position` must lie in the view and in Inputs::receivers. Programs of
  // gl::ShaderLibrary use forward_program(): the file to include and the defines; there the function is called
  // shadow_visibility(). `light`: its overrides are applied to the parameters.
  // Both throw Error for overrides that name no parameter or an invalid value.
  std::string forward_source(const ParamSet& params, const Light& light = {}) const;
  ForwardProgram forward_program(const ParamSet& params, const Light& light = {}) const;
  // Binds what that function reads for one light of the mask, by its index in Mask::lights: textures and samplers of
  // units 0 to 7, uniform buffers 0 to 2. unbind_forward() unbinds the textures and samplers. Throws Error where the
  // light's technique has a stand-in and Inputs::binds_forward was off.
  void bind_forward(const Mask& mask, size_t light);
  void unbind_forward();

  // Every program that render() can build with any parameter values, and every variant of every technique for forward
  // surfaces, so that a build can validate them in advance. Programs without a vertex shader are for
  // CasterKind::geometry: the caster callback adds its own.
  std::vector<gl::ProgramDesc> all_programs(const ParamSet& defaults) const;
  std::vector<ForwardProgram> all_forward_programs(const ParamSet& defaults) const;

 private:
  struct State;
  std::string view_prefix(int id) const;
  void check_earlier_frames();
  Mask render_view(const Inputs& inputs, const ParamSet& params);
  Mask draw(const Inputs& inputs, const ParamSet& params, ViewState& view);
  void make_tables(const ViewState& view);

  gl::Device& device_;
  Registry registry_;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::shadow
