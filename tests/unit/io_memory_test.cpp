// What a process can still use: no more than the machine has, and no more than its own limit leaves.
#include "io/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace penumbra::io {
namespace {

TEST(AvailableMemory, IsNoMoreThanTheMachineHas) {
  const auto machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(getpagesize());
  EXPECT_GT(available_memory(), 0u);
  EXPECT_LE(available_memory(), machine);
}

TEST(AvailableMemory, IsNoMoreThanTheLimitOfAddressSpaceLeaves) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  constexpr std::size_t room = std::size_t{64} << 20;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = pages * static_cast<std::size_t>(getpagesize()) + room;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  const std::size_t available = available_memory();
  setrlimit(RLIMIT_AS, &before);
  EXPECT_LE(available, room);
}

}  // namespace
}  // namespace penumbra::io
