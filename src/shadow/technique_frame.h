#pragma once

#include <string>
#include <string_view>

#include "../core/params.h"
#include "../gl/pass.h"
#include "inputs.h"
#include "technique.h"

namespace penumbra::shadow {

class Programs;
struct LightState;

// A texture that lives from frame to frame, one for each light in each view.
struct History {
  const gl::Texture& last;  // as the last frame left it; undefined unless `valid`
  const gl::Texture& now;   // to be filled in this frame
  bool valid = false;
};

// One light of one view in one frame: what a technique's functions read, make and draw with.
//
// Whatever was kept of earlier frames is void, so that age() is 0 and no history is valid,
//   - in the first frame of a light in a view, and in the first after a frame of the view without it,
//   - with View::cut, and when View::last_view or last_projection are not the matrices of the view's last frame,
//   - when the viewport, the size of the textures, the conventions, the light's source or the number of its map's
//     layers change, or a parameter of the library's or the technique's own (other techniques' do not matter), and
//     after a frame that ended in an Error.
// So the frame after a cut is that of a run that starts there.
class TechniqueFrame {
 public:
  struct Parts {
    gl::Device& device;
    const Programs& programs;
    const Technique& technique;
    const Inputs& inputs;
    const Light& light;
    const gl::Texture& mask;
    LightFrame& frame;
    LightState& state;
    std::string prefix;  // of names
  };
  explicit TechniqueFrame(Parts parts) : parts_(std::move(parts)) {}

  gl::Device& device() const { return parts_.device; }
  const Inputs& inputs() const { return parts_.inputs; }  // receivers, motion, cameras, caster callback
  const Light& light() const { return parts_.light; }
  const ParamSet& params() const;                          // the light's own values included
  LightFrame& frame() const { return parts_.frame; }       // projection, maps, products
  const gl::Texture& mask() const { return parts_.mask; }  // `resolve` fills frame().layer of it, within the viewport
  int age() const;                                         // frames since what is kept began; 0: nothing is kept

  // A texture or buffer of this light in this view: nothing is allocated while descriptions stay. Contents last until
  // the name's next use in a later frame, but only history() says whether they are still good.
  const gl::Texture& target(std::string_view name, const gl::TextureDesc& desc) const;
  const gl::Buffer& scratch(std::string_view name, std::size_t bytes) const;
  // Once a frame for each name. After a frame that does not ask for it, it is void and its memory is given back.
  History history(std::string_view name, const gl::TextureDesc& desc) const;

  // Makes a program of Technique::programs() current, with all bound that a technique's GLSL reads: parameters, light,
  // sample points, maps, receivers, products. The pass's own inputs come after it, from `first_pass_unit` on.
  const gl::Program& use(gl::Pass& pass, std::string_view program) const;
  // Runs the technique's visibility() under the driver of the parameters, into a layer of an RGBA16F array of the
  // size of the mask, which is laid out like it (see Mask).
  void evaluate(const gl::Texture& target, int layer) const;
  // Whether the parameters ask for compute shaders.
  bool uses_compute() const;
  // Draws, or dispatches, over the viewport.
  void cover(gl::Pass& pass) const;
  // The caller's casters, into a pass that is open on a layer of the shadow map's size; not for kind `geometry`.
  // Throws Error without Inputs::draw.
  void draw_casters(gl::Pass& pass, CasterKind kind, int layer) const;
  // The triangles of the caller's casters, through the geometry and fragment shaders of a program of
  // Technique::programs(): gl_in[].gl_Position is world_to_clip times the world position. All that use() binds is
  // bound. Casters that can't reach a receiver of the view are left out. Throws Error without Inputs::draw.
  void draw_caster_geometry(gl::Pass& pass, std::string_view program, const glm::mat4& world_to_clip) const;

 protected:
  void bind_inputs() const;
  gl::ProgramDesc own_program(std::string_view name) const;
  void check_draws() const;

  Parts parts_;
};

}  // namespace penumbra::shadow
