#include "session/techniques.h"

#include "truth/technique.h"

namespace penumbra::session {

const shadow::Registry& all_techniques() {
  static const shadow::Registry registry = truth::TruthTechnique().registry();
  return registry;
}

truth::TechniqueOptions truth_options(const CacheOptions& cache, const cli::DeviceOptions& device,
                                      truth::TechniqueOptions more) {
  more.cache = cache.folder();
  more.threads = device.threads.value_or(0);
  return more;
}

}  // namespace penumbra::session
