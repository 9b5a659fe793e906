// Work on several threads: all of it is done, and its faults reach the caller.
#include "truth/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "core/error.h"

namespace penumbra::truth {
namespace {

TEST(Parallel, RangesCoverEachItemOnce) {
  std::vector<std::atomic<int>> done(10000);
  for_ranges(3, done.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++done[i];
  });
  for (const std::atomic<int>& times : done) ASSERT_EQ(times, 1);
}

TEST(Parallel, WhatARangeThrowsReachesTheCallerAndEndsTheOthers) {
  std::atomic<int> ranges = 0;
  const auto work = [&](std::size_t, std::size_t) {
    ++ranges;
    fail("out of memory");
  };
  try {
    for_ranges(3, 1'000'000, work);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "out of memory");
  }
  EXPECT_LE(ranges, 3);
}

}  // namespace
}  // namespace penumbra::truth
