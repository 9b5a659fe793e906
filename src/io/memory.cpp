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

struct GroupFiles {
  const char *limit, *used, *inactive_cache, *active_cache;
};

// What a control group leaves of its own limit.
std::size_t left_in(const std::filesystem::path& group, const GroupFiles& files) {
  const auto limit = number_in(group / files.limit);
  if (!limit) return unlimited;
  const std::filesystem::path statistics = group / "memory.stat";
  const std::size_t cache = count_in(statistics, files.inactive_cache) + count_in(statistics, files.active_cache);
  return left(*limit, left(number_in(group / files.used).value_or(0), cache));
}

}  // namespace

std::size_t available_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return left(limit.rlim_cur, kilobytes("/proc/self/status", "VmSize:").value_or(0));
}

std::size_t available_in_group(const std::filesystem::path& root) {
  constexpr GroupFiles v2{"memory.max", "memory.current", "inactive_file", "active_file"},
      v1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file", "total_active_file"};
  const std::filesystem::path groups = root / "sys/fs/cgroup";
  std::size_t least = std::min(left_in(groups, v2), left_in(groups / "memory", v1));
  // Lines "number:controllers:/path", of version 2 "0::/path".
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const bool is_v2 = controllers == ",,";
    if (!is_v2 && controllers.find(",memory,") == std::string::npos) continue;
    const std::filesystem::path top = is_v2 ? groups : groups / "memory";
    std::filesystem::path group = std::filesystem::path(line.substr(second + 1)).relative_path().lexically_normal();
    // Inside a container, the path may be one of the host's that is not there.
    for (; !group.empty() && *group.begin() != ".."; group = group.parent_path())
      least = std::min(least, left_in(top / group, is_v2 ? v2 : v1));
  }
  return least;
}

std::size_t available_memory() {
  return std::min({kilobytes("/proc/meminfo", "MemAvailable:").value_or(unlimited), available_address_space(),
                   available_in_group()});
}

}  // namespace penumbra::io
