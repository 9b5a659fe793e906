// The memory that a process may still use is at most what the machine has and what its own limit leaves.
#include "io/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "support/temp_folder.h"

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

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

// A control group's files, under a folder in place of the root.
class AvailableInGroup : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    const std::filesystem::path path = temp_.path() / "sys/fs/cgroup" / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text << "\n";
  }
  void join(const std::string& groups) const {
    const std::filesystem::path path = temp_.path() / "proc/self/cgroup";
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << groups;
  }
  std::size_t available() const { return available_in_group(temp_.path()); }

 private:
  test::TempFolder temp_;
};

TEST_F(AvailableInGroup, IsUnlimitedWithoutFilesAndWithoutALimit) {
  EXPECT_EQ(available(), unlimited);
  write("memory.max", "max");
  write("memory.current", "700");
  EXPECT_EQ(available(), unlimited);
}

TEST_F(AvailableInGroup, DoesNotCountThePageCacheAsUsed) {
  write("memory.max", "1000");
  write("memory.current", "700");
  EXPECT_EQ(available(), 300u) << "without statistics";
  write("memory.stat", "anon 300\nfile 400\nactive_anon 290\ninactive_file 250\nactive_file 150");
  EXPECT_EQ(available(), 700u);
}

TEST_F(AvailableInGroup, ReadsVersion1) {
  write("memory/memory.limit_in_bytes", "1000");
  write("memory/memory.usage_in_bytes", "700");
  write("memory/memory.stat",
        "cache 9\ninactive_file 7\nactive_file 8\ntotal_inactive_file 250\ntotal_active_file 150");
  EXPECT_EQ(available(), 700u) << "with the cache of the groups within it";
}

TEST_F(AvailableInGroup, IsTheLeastOfBothVersions) {
  write("memory.max", "1000");
  write("memory.current", "100");
  write("memory/memory.limit_in_bytes", "9223372036854771712");  // how version 1 writes that there is no limit
  write("memory/memory.usage_in_bytes", "700");
  EXPECT_EQ(available(), 900u);
}

TEST_F(AvailableInGroup, IsTheLeastOfItsGroupAndOfThoseThatHoldIt) {
  join("0::/slurm/job_7/step_0\n");
  write("slurm/job_7/step_0/memory.max", "max");
  EXPECT_EQ(available(), unlimited);
  write("slurm/job_7/memory.max", "1000");
  write("slurm/job_7/memory.current", "400");
  write("slurm/memory.max", "5000");
  write("other/memory.max", "10");
  EXPECT_EQ(available(), 600u);
  join("12:cpu,cpuacct:/slurm\n5:memory:/slurm/job_7\n0::/elsewhere\n");
  EXPECT_EQ(available(), unlimited) << "version 2 has no limit there";
  write("memory/slurm/job_7/memory.limit_in_bytes", "800");
  write("memory/slurm/job_7/memory.usage_in_bytes", "300");
  EXPECT_EQ(available(), 500u);
  write("../../outside/memory.max", "10");
  join("0::/../../outside\nno line of such a file");
  EXPECT_EQ(available(), unlimited);
}

TEST_F(AvailableInGroup, IsNothingWhereMoreIsUsedThanTheLimit) {
  write("memory.max", "1000");
  EXPECT_EQ(available(), 1000u) << "how much is used can't be read";
  write("memory.current", "1200");
  EXPECT_EQ(available(), 0u);
  write("memory.stat", "inactive_file 5000");
  EXPECT_EQ(available(), 1000u) << "the numbers are not of one moment";
}

}  // namespace
}  // namespace penumbra::io
