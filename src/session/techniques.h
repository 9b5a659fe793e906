#pragma once

#include <string>

#include "cli/options.h"
#include "session/cache_options.h"
#include "shadow/registry.h"
#include "truth/technique.h"

namespace penumbra::session {

// The program's techniques, to look up and to list: the library's and `truth`.
const shadow::Registry& all_techniques();

// How users call what the parameters select: the preset whose values they all have ("thesis"), the most specific one if
// several fit, else the technique.
std::string technique_label(const ParamSet& params);

// The technique `truth` as the options have it: where its pictures are kept, how many threads trace. `more` has the
// rest.
truth::TechniqueOptions truth_options(const CacheOptions& cache, const cli::DeviceOptions& device,
                                      truth::TechniqueOptions more = {});

}  // namespace penumbra::session
