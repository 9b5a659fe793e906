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

// The number behind `label` in a file of lines "label number".
std::size_t count_in(const char* file, const std::string& label) {
  std::ifstream stream(file);
  std::size_t count = 0;
  for (std::string word; stream >> word >> count;) {
    if (word == label) return count;
  }
  return 0;
}

// Memory left in the control group. Inside a container, the container's group is visible as the root group. Its usage
// includes the page cache, which the kernel frees when a process needs memory.
std::size_t left_of_group() {
  struct Files {
    const char *limit, *used, *statistics, *inactive_cache, *active_cache;
  };
  constexpr Files versions[] = {
      {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current", "/sys/fs/cgroup/memory.stat", "inactive_file",
       "active_file"},
      {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes",
       "/sys/fs/cgroup/memory/memory.stat", "total_inactive_file", "total_active_file"}};
  std::size_t least = unlimited;
  for (const Files& files : versions) {
    const auto limit = number_in(files.limit);
    if (!limit) continue;
    const std::size_t cache =
        count_in(files.statistics, files.inactive_cache) + count_in(files.statistics, files.active_cache);
    least = std::min(least, left(*limit, left(number_in(files.used).value_or(0), cache)));
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
