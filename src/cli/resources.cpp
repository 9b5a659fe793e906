#include "cli/resources.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/text.h"
#include "core/error.h"
#include "io/memory.h"

namespace penumbra::cli {

namespace {

// Mesa's software rasteriser, LLVM and a picture of 640 x 360 together take up to 700 MiB of address space. With less,
// the process ends in a segmentation fault or in LLVM's abort, or hangs.
constexpr std::size_t least_address_space = std::size_t{768} << 20;
constexpr int most_rasteriser_threads = 32;  // Mesa starts no more, however many cores there are
constexpr int other_threads = 3;             // the scene's loader and the driver's compiler and cache

// How many more threads can be started, up to `wanted`.
int startable_threads(int wanted) {
  std::atomic<bool> over = false;
  std::vector<std::jthread> threads;
  threads.reserve(static_cast<std::size_t>(wanted));
  try {
    while (static_cast<int>(threads.size()) < wanted) threads.emplace_back([&over] { over.wait(false); });
  } catch (const std::exception&) {
    // The limit is reached: the threads started so far are the answer.
  }
  over = true;
  over.notify_all();
  return static_cast<int>(threads.size());
}

}  // namespace

void check_resources(int threads) {
  const std::size_t left = io::available_address_space();
  if (left < least_address_space)
    fail("too little memory for OpenGL: the limit of address space (ulimit -v) leaves {}, less than {}",
         bytes_text(static_cast<double>(left)), bytes_text(static_cast<double>(least_address_space)));
  const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  const int needed = std::min(threads > 0 ? threads : cores, most_rasteriser_threads) + other_threads;
  const int found = startable_threads(needed);
  if (found < needed) fail("OpenGL needs {} more threads and can start {}: {}", needed, found, threads_refused());
}

std::string memory_refused() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    return fmt::format("not enough memory: the limit of address space (ulimit -v) is {}",
                       bytes_text(static_cast<double>(limit.rlim_cur)));
  return fmt::format("not enough memory: {} are left", bytes_text(static_cast<double>(io::available_memory())));
}

std::string threads_refused() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NPROC, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    return fmt::format("no more threads can be started under the limit of {} (ulimit -u) or that of a container",
                       limit.rlim_cur);
  return "no more threads can be started under the limits of this machine or container";
}

}  // namespace penumbra::cli
