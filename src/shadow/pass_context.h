#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "inputs.h"
#include "light_frame.h"
#include "technique.h"

namespace penumbra::shadow {

struct LightWork;

// A texture that lives from frame to frame, one for each light in each view.
struct History {
  const gl::Texture& last;  // as the last frame left it; undefined unless `valid`
  const gl::Texture& now;   // to be filled in this frame
  bool valid = false;
};

// The technique, recipe or denoiser whose passes are drawn.
struct PassOwner {
  enum class Kind { technique, recipe, denoiser };

  Kind kind = Kind::technique;
  const std::string& name;
  const std::vector<std::string>& needs;
  const std::function<std::vector<gl::ProgramDesc>(const ParamSet&)>& programs;
  const Technique* technique = nullptr;  // whose sample points its programs read; none for other kinds
};

// One light of one view in one frame: what the functions of a technique, a recipe or a denoiser read, make and draw
// with.
//
// Whatever was kept of earlier frames is void, so that age() is 0 and no history is valid,
//   - in the first frame of a light in a view, and in the first after a frame of the view without it,
//   - with View::cut, and when View::last_view or last_projection are not the matrices of the view's last frame,
//   - when the viewport, the size of the textures, the conventions, the light's source or the number of its map's
//   layers
//     change, or a parameter, except those of techniques and denoisers that are not chosen,
//   - after a frame that ended in an Error.
// So the frame after a cut is that of a run that starts there.
class PassContext {
 public:
  PassContext(const LightWork& work, const PassOwner& owner) : work_(work), owner_(owner) {}

  gl::Device& device() const;
  const Inputs& inputs() const;  // receivers, motion, cameras, caster callback
  const Light& light() const;
  const ParamSet& params() const;   // the light's own values included
  const LightFrame& frame() const;  // projection, maps, products
  const gl::Texture& mask() const;  // frame().layer of it is this light's, within the viewport
  int age() const;                  // frames since what is kept began; 0: nothing is kept
  // A product that the owner needs.
  const gl::Texture& product(std::string_view recipe) const;

  // A texture or buffer of this light in this view: nothing is allocated while descriptions stay. Contents last until
  // the name's next use in a later frame, but only history() says whether they are still good. Techniques share their
  // names with each other, each recipe has its own.
  const gl::Texture& target(std::string_view name, const gl::TextureDesc& desc) const;
  const gl::Buffer& scratch(std::string_view name, std::size_t bytes) const;
  // Once a frame for each name. After a frame that does not ask for it, it is void and its memory is given back.
  History history(std::string_view name, const gl::TextureDesc& desc) const;

  // Makes a program of the owner's `programs` current, with all bound that its GLSL reads: parameters, light, shadow
  // map, noise, receivers, the products that the owner needs and, for a technique, its sample points. The pass's own
  // inputs come after it, from `first_pass_unit` on.
  const gl::Program& use(gl::Pass& pass, std::string_view program) const;
  // Runs the technique's visibility() under the driver of the parameters, into a layer of an RGBA16F array of the
  // size of the mask, which is laid out like it (see Mask).
  void evaluate(const gl::Texture& target, int layer) const;
  // Whether the parameters ask for compute shaders.
  bool uses_compute() const;
  // Draws, or dispatches, over the viewport.
  void cover(gl::Pass& pass) const;
  // The caller's casters, into a pass that is open on a layer of the shadow map's size; not for kind `geometry`. Throws
  // Error without Inputs::draw.
  void draw_casters(gl::Pass& pass, CasterKind kind, int layer) const;
  // The triangles of the caller's casters, through the geometry and fragment shaders of one of the owner's `programs`:
  // gl_in[].gl_Position is world_to_clip times the world position. All that use() binds is bound. Casters that can't
  // reach a receiver of the view are left out. Throws Error without Inputs::draw.
  void draw_caster_geometry(gl::Pass& pass, std::string_view program, const glm::mat4& world_to_clip) const;

 protected:
  const gl::ProgramDesc& own_program(std::string_view program) const;
  void check_draws() const;
  std::string full_name(std::string_view name) const;

  const LightWork& work_;
  const PassOwner owner_;
};

}  // namespace penumbra::shadow
