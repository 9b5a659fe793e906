#include "truth/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace penumbra::truth {

namespace {

// Small enough that all threads finish at nearly the same time.
constexpr std::size_t range_size = 512;

}  // namespace

int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void for_ranges(int threads, std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic_flag failed;
  std::exception_ptr fault;
  const auto run = [&] {
    try {
      for (std::size_t begin = next.fetch_add(range_size); begin < count; begin = next.fetch_add(range_size))
        work(begin, std::min(begin + range_size, count));
    } catch (...) {
      next = count;
      if (!failed.test_and_set()) fault = std::current_exception();
    }
  };
  const std::size_t useful = std::min<std::size_t>(static_cast<std::size_t>(threads), count / range_size + 1);
  {
    std::vector<std::jthread> helpers;
    try {
      for (std::size_t i = 1; i < useful; ++i) helpers.emplace_back(run);
    } catch (const std::exception&) {
      // The system refuses another thread, or memory for it: the existing ones do the work.
    }
    run();
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace penumbra::truth
