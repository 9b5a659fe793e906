#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "depth_precision.h"
#include "inputs.h"
#include "light_frame.h"
#include "technique.h"

namespace penumbra::shadow {

struct LightWork;

// A texture that is kept from frame to frame, for each light in each view. It is double-buffered.
struct History {
  const gl::Texture& last;  // what the last frame wrote; undefined unless `valid`
  const gl::Texture& now;   // to be written in this frame
  bool valid = false;
};

// The technique, recipe or denoiser whose passes are run.
struct PassOwner {
  enum class Kind { technique, recipe, denoiser };

  Kind kind = Kind::technique;
  const std::string& name;
  const std::vector<std::string>& needs;
  const std::vector<Param>& params;
  const std::function<std::vector<gl::ProgramDesc>(const ParamSet&)>& programs;
  const Technique* technique = nullptr;  // whose sample points its programs read; none for other kinds
};

// One light of one view in one frame, as the functions of a technique, a recipe or a denoiser see it: their inputs, and
// the calls that allocate textures and run passes.
//
// The history is discarded, so that age() is 0 and no History is valid,
//   - in the first frame of a light in a view, and in the first after a frame of the view without it,
//   - with View::cut or View::restart, and when View::last_view or last_projection are not the matrices of the view's
//     last frame,
//   - when the viewport, the size of the textures, the conventions, the light's source or the number of layers
//     of its shadow map changes, or whether the caller brings normals, or a parameter does, except those of techniques
//     and denoisers that are not chosen,
//   - after a frame that ended in an Error.
// So a frame after a cut is the same as the first frame of a run that starts there.
class PassContext {
 public:
  PassContext(const LightWork& work, const PassOwner& owner) : work_(work), owner_(owner) {}

  gl::Device& device() const;
  const Inputs& inputs() const;  // receivers, motion, cameras, caster callback
  const Light& light() const;
  const ParamSet& params() const;   // with the light's overrides applied
  const LightFrame& frame() const;  // projection, maps, products
  const gl::Texture& mask() const;  // this light fills layer frame().layer, within the viewport
  int age() const;                  // how many frames the history goes back; 0: there is none
  // The texture that a recipe in the owner's `needs` made.
  const gl::Texture& product(std::string_view recipe) const;
  // For a recipe that depends only on its needs: the layers of the shadow map that are those from which the recipe made
  // its last texture. It may leave these layers of its texture as they are.
  LayerSet unchanged_layers() const;

  // The most by which the format of the caller's depth texture changes depths; not that of a copy.
  const DepthRounding& depth_rounding() const;
  // The light's shadow map, drawn or supplied by the caller, for products that are another way to read it.
  const gl::Texture& shadow_map() const;

  // A texture or buffer of this light in this view, allocated on first use and again only when the description changes.
  // Contents last until the name is next used in a later frame, but only history() reports whether they are still
  // valid. Each technique, recipe and denoiser has its own names. When a parameter has changed, the first frame that
  // does not use a name releases its memory.
  const gl::Texture& target(std::string_view name, const gl::TextureDesc& desc) const;
  const gl::Buffer& scratch(std::string_view name, std::size_t bytes) const;
  // To be called at most once a frame for each name. A frame that does not call it releases the memory, and the history
  // is lost.
  History history(std::string_view name, const gl::TextureDesc& desc) const;

  // Makes a program of the owner's `programs` current and binds what its GLSL reads: parameters, light, shadow map,
  // noise, receivers, the products that the owner needs and, for a technique, its sample points. The caller then binds
  // the pass's own inputs, from `first_pass_unit` on.
  const gl::Program& use(gl::Pass& pass, std::string_view program) const;
  // Runs the technique's visibility() for every pixel, with fragment or compute shaders as the parameter "driver" says,
  // and writes a layer of an array that has the mask's size and one of its formats, R16F or RGBA16F (see Mask). Written
  // to the mask itself it must stay as it is: with mask.scale, some visibilities have a mark there (ADR 33).
  void evaluate(const gl::Texture& target, int layer) const;
  // Whether the parameters ask for compute shaders.
  bool uses_compute() const;
  // Draws a triangle over the viewport, or dispatches the compute program over it.
  void cover(gl::Pass& pass) const;
  // Draws the caller's casters in a pass whose attachments have the size of a shadow map's layer; not for the kinds
  // `geometry` and `second_depth`. Throws Error without Inputs::draw.
  void draw_casters(gl::Pass& pass, CasterKind kind, int layer) const;
  // Draws them with kind `second_depth`, in a pass that tests for depths greater than the shadow map's and keeps the
  // least colour: of what lies more than `gap` metres behind the map.
  void draw_second_depth(gl::Pass& pass, int layer, float gap) const;
  // Draws the triangles of the caller's casters with the geometry and fragment shaders of one of the owner's
  // `programs`: gl_in[].gl_Position is world_to_clip times the world position. Binds the same inputs as use(). Casters
  // that can't shadow any receiver of the view are culled; a triangle that casts no shadow because of its facing may
  // arrive with all three corners in one place. Throws Error without Inputs::draw.
  void draw_caster_geometry(gl::Pass& pass, std::string_view program, const glm::mat4& world_to_clip) const;

 protected:
  const gl::ProgramDesc& own_program(std::string_view program) const;
  void check_draws() const;
  CasterPass caster_pass(CasterKind kind, int layer) const;
  // The name of a target or buffer within the device. Notes that this frame uses it.
  std::string full_name(std::string_view name) const;

  const LightWork& work_;
  const PassOwner owner_;
};

}  // namespace penumbra::shadow
