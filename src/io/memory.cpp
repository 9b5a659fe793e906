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

// Nothing for a file that is missing or contains "max".
std::optional<std::size_t> number_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::size_t number = 0;
  if (stream >> number) return number;
  return {};
}

// The number behind `label` in a file of lines "label number".
std::size_t count_in(const std::filesystem::path& file, const std::string& label) {
  std::ifstream stream(file);
  std::size_t count = 0;
  for (std::string word; stream >> word >> count;) {
    if (word == label) return count;
  }
  return 0;
}

}  // namespace

std::size_t available_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return left(limit.rlim_cur, kilobytes("/proc/self/status", "VmSize:").value_or(0));
}

// Inside a container, the container's group is visible as the root group.
std::size_t available_in_group(const std::filesystem::path& root) {
  struct Files {
    const char *limit, *used, *statistics, *inactive_cache, *active_cache;
  };
  constexpr Files versions[] = {{"memory.max", "memory.current", "memory.stat", "inactive_file", "active_file"},
                                {"memory/memory.limit_in_bytes", "memory/memory.usage_in_bytes", "memory/memory.stat",
                                 "total_inactive_file", "total_active_file"}};
  const std::filesystem::path folder = root / "sys/fs/cgroup";
  std::size_t least = unlimited;
  for (const Files& files : versions) {
    const auto limit = number_in(folder / files.limit);
    if (!limit) continue;
    const std::filesystem::path statistics = folder / files.statistics;
    const std::size_t cache = count_in(statistics, files.inactive_cache) + count_in(statistics, files.active_cache);
    least = std::min(least, left(*limit, left(number_in(folder / files.used).value_or(0), cache)));
  }
  return least;
}

std::size_t available_memory() {
  return std::min({kilobytes("/proc/meminfo", "MemAvailable:").value_or(unlimited), available_address_space(),
                   available_in_group()});
}

}  // namespace penumbra::io
