#include "bench/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <thread>

#include "core/error.h"

namespace penumbra::bench {

namespace {

// The first "model name : …" of Linux's list of processors.
std::string cpu_name() {
  std::ifstream list("/proc/cpuinfo");
  for (std::string line; std::getline(list, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown";
}

}  // namespace

Machine machine() {
  return {.cpu = cpu_name(), .cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U))};
}

std::string described(const Machine& machine, const std::string& renderer) {
  return fmt::format("{} with {} cores, {}", machine.cpu, machine.cores, renderer);
}

void check_same_machine(const std::string& first, const std::string& other, std::size_t item) {
  if (other != first)
    fail("item {} was measured on another machine ({}) than item 0 ({}): their times can't be compared", item, other,
         first);
}

}  // namespace penumbra::bench
