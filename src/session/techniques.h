#pragma once

#include <string>

#include "cli/options.h"
#include "session/cache_options.h"
#include "shadow/registry.h"
#include "truth/technique.h"

namespace penumbra::session {

// All techniques of the program, for look-ups and lists: the library's and `truth`.
const shadow::Registry& all_techniques();

// The name for what the parameters select: the preset whose values they all match ("thesis"; the most specific one if
// several match), else the technique.
std::string technique_label(const ParamSet& params);

// What commands draw with where the user names no technique.
constexpr const char* usual_technique = "slices_denoised";

// Chooses a technique or preset. What technique_label() named before goes back to its defaults, so that the filters of
// one preset do not stay with the next.
void choose_technique(ParamSet& params, const shadow::Registry& registry, const std::string& name);

// The technique `truth` as the options have it: where its pictures are kept, how many threads trace. `more` has the
// rest.
truth::TechniqueOptions truth_options(const CacheOptions& cache, const cli::DeviceOptions& device,
                                      truth::TechniqueOptions more = {});

}  // namespace penumbra::session
