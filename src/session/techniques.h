#pragma once

#include "shadow/registry.h"

namespace penumbra::session {

// The program's techniques, to look up and to list: the library's and `truth`.
const shadow::Registry& all_techniques();

}  // namespace penumbra::session
