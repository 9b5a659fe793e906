#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/program.h"

namespace penumbra::shadow {

class PassContext;

// Sample points that a technique's GLSL reads. For a set "blocker" the library generates
//   vec2 blocker_point(int index, Scramble scramble, Light light);  // of the light's shape, -1..1
//   Scramble blocker_scramble(Receiver receiver);                   // what differs from pixel to pixel
struct SampleSet {
  // The step of the technique whose parameters, sampling.blocker_* or sampling.filter_*, choose the pattern and what
  // changes from frame to frame.
  enum class Step { blocker, filter };

  std::string name;             // an identifier of GLSL, lower case
  std::string count_parameter;  // a row of whole numbers: how many points there are; its upper bound is the set's size
  Step step = Step::filter;
};

constexpr int most_points = 256;  // of a set

// A technique is a value. Its GLSL file defines
//   float read_radius(Receiver receiver, Light light);
//   Visibility visibility(Receiver receiver, Light light);
// and nothing in the drivers knows its name.
struct Technique {
  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;  // file under glsl/, "shadow/techniques/pcss.glsl"; empty: `resolve` does all, `stand_in` the rest
  // What its GLSL reads of a light, by name: "shadow_map", and recipes, each a texture at the unit UNIT_<name>.
  std::vector<std::string> needs = {"shadow_map"};
  std::vector<Param> params = {};
  std::vector<SampleSet> samples = {};
  // Fixes the patterns of all of its sets, and sampling.scramble; empty leaves them to the parameters.
  std::string pattern = {}, scramble = {};
  // Fills the mask's layer in passes of its own, of which PassContext::evaluate() can be one: methods that are no
  // function of one receiver. Optional.
  std::function<void(const PassContext&)> resolve = {};
  // The programs that `resolve` uses under these parameters, by name. Their files may include all that the technique's
  // GLSL may, and are compiled with its constants. One without vertex and compute shader is for
  // PassContext::draw_caster_geometry(): the caster callback brings the vertex shader.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
  // Whether the denoiser of the parameters is applied to what it computes.
  bool denoisable = true;
  // The technique whose `glsl` serves blended surfaces, where this one's does not: with its own needs and samples.
  std::string stand_in = {};
};

}  // namespace penumbra::shadow
