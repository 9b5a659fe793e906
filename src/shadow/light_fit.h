#pragma once

#include <optional>
#include <string>
#include <vector>

#include "light_work.h"

namespace penumbra::shadow {

// What the view shows of the receivers, where maps are fitted to that: see find_visible_receivers() and
// find_near_penumbrae().
struct ShownReceivers {
  std::optional<VisibleReceivers> visible, near_penumbrae;
};

// The caller's projection of the light's maps, or one fitted to the view; throws Error if none fits. `recipes`: those
// that the frame makes. Maps that are averaged have the size that the parameters say, since what is made of them has a
// power of two as its size.
LightProjection projection_of(const LightWork& work, const ShownReceivers& shown,
                              const std::vector<const Recipe*>& recipes);

// Where a frame's maps lie within a texel: at Halton's points, which cover it evenly however many there are, and of
// which the first is 0. The seed shifts them on the torus, by the generalised golden ratio (Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences"): a pixel's samples, which differ by it, are themselves at
// Halton's points.
glm::dvec2 map_jitter(const LightWork& work);

// Whether that is another place than in the frame or sample before, so that a mean over these sees more than one map.
bool moves_maps(const LightWork& work);

// How many layers the caller's maps have, or the most that the parameters allow. A change of it ends the history;
// another number of fitted cascades does not.
int layer_count(const Light& light, const ParamSet& params);

// A warning of one line if a sun's maps leave something out because bounds are wide (Inputs::exact_bounds); else empty.
std::string bounds_warning(const CutOff& cut_off);

// Limits what is drawn of the maps that the library draws to what is read of them, if all that reads them declares
// where it does (Technique::reads_light_discs). `recipes`: those that the frame makes.
void narrow_projection(const LightWork& work, const std::vector<const Recipe*>& recipes);

}  // namespace penumbra::shadow
