#pragma once

#include <cstddef>

namespace penumbra::io {

// Bytes of memory that this process can still use before the system or a limit refuses more: the least of what the
// machine has left (MemAvailable in /proc/meminfo), what the process's limit of address space leaves (ulimit -v) and
// what its control group leaves (a container's limit). What can't be found out limits nothing.
std::size_t available_memory();

}  // namespace penumbra::io
