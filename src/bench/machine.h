#pragma once

#include <string>

namespace penumbra::bench {

// What a measurement records about the machine: neither its name nor a path.
struct Machine {
  std::string cpu;  // "AMD EPYC 7B13", "unknown" where the system does not tell
  int cores = 0;    // that the system offers
};
Machine machine();

// The commit that this program was built from, "-changed" behind it where files differed; "unknown" outside of a
// checkout.
const char* commit();

}  // namespace penumbra::bench
