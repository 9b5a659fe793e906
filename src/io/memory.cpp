#include "io/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace penumbra::io {
namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

std::size_t left(std::size_t limit, std::size_t used) { return limit > used ? limit - used : 0; }

// The number after `label` in a file with lines "label: number kB".
std::optional<std::size_t> kilobytes(const char* file, const std::string& label) {
  std::ifstream stream(file);
  for (std::string word; stream >> word; stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    std::size_t count = 0;
    if (word == label && stream >> count) return count * 1024;
  }
  return {};
}

std::optional<std::size_t> number_in(const char* file) {
  std::ifstream stream(file);
  std::size_t number = 0;
  if (stream >> number) return number;
  return {};  // missing, or "max"
}

// Memory left in the control group. Inside a container, the container's group is visible as the root group.
std::size_t left_of_group() {
  std::size_t least = unlimited;
  constexpr const char* files[][2] = {
      {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"},
      {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"}};
  for (const auto& [limit_file, used_file] : files) {
    const auto limit = number_in(limit_file);
    if (limit) least = std::min(least, left(*limit, number_in(used_file).value_or(0)));
  }
  return least;
}

}  // namespace

std::size_t available_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return left(limit.rlim_cur, kilobytes("/proc/self/status", "VmSize:").value_or(0));
}

std::size_t available_memory() {
  return std::min(
      {kilobytes("/proc/meminfo", "MemAvailable:").value_or(unlimited), available_address_space(), left_of_group()});
}

}  // namespace penumbra::io
