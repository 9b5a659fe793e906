#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/program.h"

namespace penumbra::shadow {

class PassContext;

// Sample points that a technique's GLSL reads. For a set "blocker" the library generates
//   vec2 blocker_point(int index, Scramble scramble, Light light); // in the light's shape (disc or square), -1..1
//   Scramble blocker_scramble(Receiver receiver); // how the pixel's points differ
struct SampleSet {
  // Which parameters, sampling.blocker_* or sampling.filter_*, choose the set's pattern and how it changes from frame
  // to frame.
  enum class Step { blocker, filter };

  std::string name;             // an identifier of GLSL, lower case
  std::string count_parameter;  // an integer parameter: how many points are used; its maximum is the table's size
  Step step = Step::filter;
};

constexpr int most_points = 256;  // in one set

// A shadow technique, described as a value that a Registry holds. Its GLSL file defines
//   float read_radius(Receiver receiver, Light light);
//   Visibility visibility(Receiver receiver, Light light);
// and the drivers (glsl/shadow/drivers), which call these, are the same for every technique.
struct Technique {
  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;     // file under glsl/, "shadow/techniques/pcss.glsl"; empty: `resolve` fills the mask, `stand_in`
                        // serves blended surfaces
  // The textures of a light that its GLSL reads, by name: "shadow_map", and recipes (recipe.h), each bound at the unit
  // UNIT_<name>.
  std::vector<std::string> needs = {"shadow_map"};
  std::vector<Param> params = {};
  std::vector<SampleSet> samples = {};
  // Overrides the pattern parameters of all its sample sets, and sampling.scramble; empty: the parameters decide.
  std::string pattern = {}, scramble = {};
  // Fills the mask's layer by its own passes, of which PassContext::evaluate() can be one: for methods that can't
  // compute each receiver independently. Optional.
  std::function<void(const PassContext&)> resolve = {};
  // Whether `resolve` reads Inputs::motion. If not, a caller need not draw it for this technique.
  bool resolve_reads_motion = true;
  // The programs that `resolve` uses with these parameters, by name. Their files may include whatever the technique's
  // GLSL may, and are compiled with the same constants. A program with neither vertex nor compute shader is for
  // PassContext::draw_caster_geometry(): the caster callback adds the vertex shader.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
  // Whether the library may decide for it which tiles of pixels no penumbra reaches (see tiles.h). It needs
  // "shadow_map" and "least_depth_pyramid", and its result must be the share of the light that the casters in the map
  // leave free. Under lamps it must moreover read texels as reads_light_discs says.
  bool decides_tiles = false;
  // Whether its visibility() says which results have no noise (`noise_free`): those of decided tiles have none either.
  bool tells_noise = false;
  // Whether the denoiser that the parameters choose is applied to its result.
  bool denoisable = true;
  // Whether its penumbrae get wider with the light's size.
  bool soft = true;
  // Whether it can't compute the shadows of lamps: render() then throws Error for a lamp.
  bool suns_only = false;
  // The name of the technique that computes shadows on blended surfaces instead. Techniques without `glsl` need one.
  // What it needs is made only in frames that it may serve (Inputs::binds_forward).
  std::string stand_in = {};
  // Whether it reads the light's maps only near receivers of the view. Texels: at most read_margin (light_projection.h)
  // texels beyond the disc of search_radius() (glsl/shadow/search.glsl) around the receiver. Pyramids: for discs of at
  // most that radius and 1.5 texels, 2 × 2 texels of the finest level that covers the disc (covering_level() in
  // glsl/lib/kernel.glsl), as bounds_near() does. Casters are then drawn only there, if the same holds for all else
  // that reads the maps; otherwise in the whole maps.
  bool reads_light_discs = false;
  // Whether casters that the first layer of the map does not show cast shadows for it although it does not read the
  // second one, as for rays: where they move, no history is kept.
  bool sees_hidden_casters = false;
};

}  // namespace penumbra::shadow
