#include "session/techniques.h"

#include "truth/technique.h"

namespace penumbra::session {

const shadow::Registry& all_techniques() {
  static const shadow::Registry registry = truth::TruthTechnique().registry();
  return registry;
}

}  // namespace penumbra::session
