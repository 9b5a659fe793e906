#pragma once

#include <cstddef>

namespace penumbra::io {

// How much memory the process may still use. A limit that can't be determined counts as none (the largest number).

// Bytes of address space left under the process's own limit (ulimit -v).
std::size_t available_address_space();

// Bytes of memory that this process can still use before the system or a limit refuses more: the least of what the
// machine has left (MemAvailable in /proc/meminfo), available_address_space(), and what its control group leaves (a
// container's limit).
std::size_t available_memory();

}  // namespace penumbra::io
