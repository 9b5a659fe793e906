#pragma once

#include <string>

namespace penumbra::bench {

// What a measurement records about the machine. It has neither the machine's name nor a path.
struct Machine {
  std::string cpu;  // "AMD EPYC 7B13"; "unknown" if the system does not report it
  int cores = 0;    // that the system offers
};
Machine machine();

// The commit that this program was built from, followed by "-changed" if files differed from it; "unknown" outside of a
// checkout.
const char* commit();

}  // namespace penumbra::bench
