#pragma once

#include <cstddef>
#include <string>

namespace penumbra::bench {

// What a measurement records about the machine. It has neither the machine's name nor a path.
struct Machine {
  std::string cpu;  // "AMD EPYC 7B13"; "unknown" if the system does not report it
  int cores = 0;    // that the system offers
};
Machine machine();
// What times depend on, in words: "AMD EPYC 7B13 with 2 cores, llvmpipe".
std::string described(const Machine& machine, const std::string& renderer);
// Throws Error if times of an item are of another machine than those of item 0, both as described() has them: they
// can't be compared, so they are not put into one report.
void check_same_machine(const std::string& first, const std::string& other, std::size_t item);

// The commit that this program was built from, followed by "-changed" if files differed from it; "unknown" outside of a
// checkout.
const char* commit();

}  // namespace penumbra::bench
