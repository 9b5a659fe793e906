#pragma once

#include <string>

#include "cli/options.h"
#include "session/cache_options.h"
#include "shadow/registry.h"
#include "shadow/selection.h"
#include "truth/technique.h"

namespace penumbra::session {

// All techniques of the program, for look-ups and lists: the library's and `truth`.
const shadow::Registry& all_techniques();

// What the parameters select of these.
shadow::Selection selection_of(const ParamSet& params);

// Its name, such as "thesis" or "thesis (modified)".
std::string technique_label(const ParamSet& params);

// These parameters as they were right after choosing the selection, every other one with its default.
ParamSet unmodified(const ParamSet& params);

// What commands draw with where the user names no technique.
constexpr const char* usual_technique = "slices_denoised";

// Chooses a technique or preset. What selection_of() named before goes back to its defaults, but for values that were
// changed since, so that the filters of one preset do not stay with the next.
void choose_technique(ParamSet& params, const shadow::Registry& registry, const std::string& name);

// Whether shadows are blended with those of the frames before.
bool keeps_history(const ParamSet& params);

// What makes each frame depend on those before it, as the parameter that causes it ("history.reuse"); empty: nothing
// does, so that a sequence can be drawn in parts.
std::string earlier_frames_matter(const ParamSet& params);

// The technique `truth` as the options have it: where its pictures are kept, how many threads trace. `more` has the
// rest.
truth::TechniqueOptions truth_options(const CacheOptions& cache, const cli::DeviceOptions& device,
                                      truth::TechniqueOptions more = {});

}  // namespace penumbra::session
