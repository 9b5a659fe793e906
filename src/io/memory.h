#pragma once

#include <cstddef>
#include <filesystem>

namespace penumbra::io {

// How much memory the process may still use. A limit that can't be determined counts as none (the largest number).

// Bytes of address space left under the process's own limit (ulimit -v).
std::size_t available_address_space();

// Bytes that the process's control group (a container's limit) leaves, by cgroup v1 or v2. What the kernel counts as
// used includes the page cache, which it frees when a process needs memory, so the cache does not count here. The
// groups that hold it have limits too. `root`: the folder in which proc/self/cgroup and sys/fs/cgroup are looked up.
std::size_t available_in_group(const std::filesystem::path& root = "/");

// Bytes of memory that this process can still use before the system or a limit refuses more: the least of what the
// machine has left (MemAvailable in /proc/meminfo), available_address_space() and available_in_group().
std::size_t available_memory();

}  // namespace penumbra::io
