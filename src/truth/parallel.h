#pragma once

#include <cstddef>
#include <functional>

namespace penumbra::truth {

// The number of threads to start: one for each core if `wanted` is 0.
int thread_count(int wanted);

// Calls `work(begin, end)` for ranges that cover 0 to `count`, on so many threads, of which the caller's is one, or on
// fewer if the system refuses more. Returns when all is done. What `work` throws first ends the other ranges, too, and
// is thrown on the caller's thread.
void for_ranges(int threads, std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace penumbra::truth
