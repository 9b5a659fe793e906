// Output files are written completely or not at all: links, permissions, owners, refused paths, no leftovers.
#include "io/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "support/gltf_files.h"

namespace penumbra::io {
namespace {

namespace fs = std::filesystem;
using test::error_of;

class OutputFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("io_output_file_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Names of all files and folders, in order.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      names.push_back(entry.path().lexically_relative(folder_));
    std::sort(names.begin(), names.end());
    return names;
  }
  fs::path folder_;
};

using Names = std::vector<std::string>;

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The limit of file sizes, as on a disk that is full after `bytes`.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(OutputFileTest, AnUncommittedFileLeavesNothingAndTheOldOneStands) {
  write_text(folder_ / "x.txt", "old");
  {
    OutputFile file(folder_ / "x.txt");
    file.write("new");
    const OutputFile deep(folder_ / "a/b/x.txt");
  }
  EXPECT_EQ(files(), Names{"x.txt"});
  EXPECT_EQ(text_of(folder_ / "x.txt"), "old");
}

TEST_F(OutputFileTest, LinksStayAndWhatTheyLeadToIsWritten) {
  fs::create_directories(folder_ / "real");
  write_text(folder_ / "real/x.txt", "old");
  fs::create_symlink("real/x.txt", folder_ / "near");
  fs::create_symlink(folder_ / "near", folder_ / "far");
  fs::create_symlink("real/new.txt", folder_ / "dangling");
  for (const char* name : {"near", "far", "dangling"}) {
    check_writable(folder_ / name);
    write_text(folder_ / name, name);
    EXPECT_TRUE(fs::is_symlink(folder_ / name)) << name;
    EXPECT_EQ(text_of(folder_ / name), name);
  }
  EXPECT_EQ(text_of(folder_ / "real/x.txt"), "far");
  EXPECT_EQ(text_of(folder_ / "real/new.txt"), "dangling");
  EXPECT_EQ(files(), (Names{"dangling", "far", "near", "real", "real/new.txt", "real/x.txt"}));
  EXPECT_TRUE(would_replace(folder_ / "far", folder_ / "real/x.txt"));
  EXPECT_TRUE(would_replace(folder_ / "real/x.txt", folder_ / "near"));
  EXPECT_FALSE(would_replace(folder_ / "far", folder_ / "dangling"));
}

TEST_F(OutputFileTest, LinksInACircleAreRefused) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_TRUE(error_of([&] { write_text(folder_ / "a", "text"); }).ends_with("Too many levels of symbolic links"));
  EXPECT_THROW(check_writable(folder_ / "b"), Error);
  EXPECT_EQ(files(), (Names{"a", "b"}));
}

TEST_F(OutputFileTest, KeepsPermissionsOfWhatIsReplaced) {
  for (const mode_t mode : {0600, 0640, 0777}) {
    write_text(folder_ / "x.txt", "old");
    chmod((folder_ / "x.txt").c_str(), mode);
    write_text(folder_ / "x.txt", "new");
    EXPECT_EQ(fs::status(folder_ / "x.txt").permissions(), fs::perms(mode));
    EXPECT_EQ(text_of(folder_ / "x.txt"), "new");
  }
}

TEST_F(OutputFileTest, KeepsTheOwnerWhereThatIsAllowed) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may give files away";
  write_text(folder_ / "x.txt", "old");
  ASSERT_EQ(chown((folder_ / "x.txt").c_str(), 12, 34), 0);
  write_text(folder_ / "x.txt", "new");
  struct stat now {};
  ASSERT_EQ(stat((folder_ / "x.txt").c_str(), &now), 0);
  EXPECT_EQ(now.st_uid, 12u);
  EXPECT_EQ(now.st_gid, 34u);
}

TEST_F(OutputFileTest, AWriteProtectedFileIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write all files";
  write_text(folder_ / "x.txt", "old");
  chmod((folder_ / "x.txt").c_str(), 0444);
  EXPECT_TRUE(error_of([&] { check_writable(folder_ / "x.txt"); }).ends_with("Permission denied"));
  EXPECT_EQ(text_of(folder_ / "x.txt"), "old");
}

TEST_F(OutputFileTest, NewFilesHaveTheUsersPermissions) {
  const mode_t mask = umask(022);
  write_text(folder_ / "x.txt", "text");
  umask(mask);
  EXPECT_EQ(fs::status(folder_ / "x.txt").permissions(), fs::perms(0644));
}

TEST_F(OutputFileTest, PipesAreWrittenTo) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder_ / "link");
  EXPECT_NO_THROW(check_writable(folder_ / "link"));
  EXPECT_TRUE(error_of([&] { write_text(folder_ / "pipe", "text"); }).ends_with("no program reads from this pipe"));
  const int reader = open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  for (const char* name : {"pipe", "link"}) {
    EXPECT_NO_THROW(check_writable(folder_ / name));
    write_text(folder_ / name, name);
    std::array<char, 8> bytes{};
    EXPECT_EQ(read(reader, bytes.data(), bytes.size()), 4);
    EXPECT_STREQ(bytes.data(), name);
  }
  close(reader);
  EXPECT_TRUE(fs::is_fifo(folder_ / "link"));
  EXPECT_EQ(files(), (Names{"link", "pipe"}));
}

TEST_F(OutputFileTest, DevicesStayWhatTheyAre) {
  EXPECT_NO_THROW(check_writable("/dev/null"));
  EXPECT_NO_THROW(write_text("/dev/null", "text"));
  EXPECT_TRUE(error_of([] { write_text("/dev/full", "text"); }).ends_with("No space left on device"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// What /dev/stdout is, whatever it was redirected to.
TEST_F(OutputFileTest, OpenFilesAreWrittenToWhereTheyAre) {
  const int file = open((folder_ / "open.txt").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  ASSERT_GE(file, 0);
  ASSERT_EQ(write(file, "first ", 6), 6);
  const fs::path direct = "/proc/self/fd/" + std::to_string(file);
  fs::create_symlink(direct, folder_ / "link");
  for (const fs::path& path : {direct, folder_ / "link"}) {
    EXPECT_NO_THROW(check_writable(path));
    write_text(path, "more ");
  }
  ASSERT_EQ(write(file, "last", 4), 4);
  close(file);
  EXPECT_EQ(text_of(folder_ / "open.txt"), "first more more last");
  EXPECT_EQ(fs::read_symlink(folder_ / "link"), direct);
  EXPECT_TRUE(error_of([&] { check_writable(direct); }).ends_with("Bad file descriptor"));
  EXPECT_EQ(files(), (Names{"link", "open.txt"}));
}

TEST_F(OutputFileTest, ASignalHandlerCanEndTheProcessWithoutLeavingTemporaries) {
  const OutputFile file(folder_ / "x.txt");
  EXPECT_EQ(files().size(), 1u);
  EXPECT_EXIT(exit_without_temporaries(7), testing::ExitedWithCode(7), "");
  EXPECT_TRUE(files().empty());
}

// The process creates files without a pause while the signal arrives on another thread.
[[noreturn]] void create_until_a_signal(const fs::path& folder, useconds_t after) {
  std::signal(SIGTERM, [](int) { exit_without_temporaries(7); });
  const std::thread creator([&] {
    for (;;) const OutputFile file(folder / "x.txt");
  });
  usleep(after);
  std::raise(SIGTERM);
  std::abort();  // the handler does not return
}

TEST_F(OutputFileTest, ASignalWhileFilesAreCreatedLeavesNone) {
  GTEST_FLAG_SET(death_test_style, "fast");
  for (useconds_t run = 0; run < 60; ++run) {
    EXPECT_EXIT(create_until_a_signal(folder_, 1000 + 13 * run), testing::ExitedWithCode(7), "");
    ASSERT_TRUE(files().empty()) << run;
  }
}

TEST_F(OutputFileTest, RefusesPlacesThatCannotBeWritten) {
  write_text(folder_ / "file", "text");
  EXPECT_THROW(check_writable(folder_), Error);
  EXPECT_THROW(check_writable(folder_ / "file/x.png"), Error);
  EXPECT_THROW(check_writable(folder_ / std::string(300, 'x') / "x.png"), Error);
  EXPECT_TRUE(
      error_of([&] { check_writable(folder_ / (std::string(300, 'x') + ".png")); }).ends_with("File name too long"));
  EXPECT_THROW(check_writable("/proc/no/x.png"), Error);
  EXPECT_THROW(write_text("/proc/no/x.png", "text"), Error);
  EXPECT_NO_THROW(check_writable(folder_ / "new/x.png"));
  EXPECT_EQ(files(), Names{"file"});
}

TEST_F(OutputFileTest, AFullDiskLeavesNoFolder) {
  const FileSizeLimit limit(10);
  EXPECT_TRUE(error_of([&] { write_text(folder_ / "a/b/x.txt", "more than ten bytes"); }).ends_with("File too large"));
  EXPECT_TRUE(files().empty());
}

TEST_F(OutputFileTest, SeveralFilesAreWrittenAllOrNone) {
  using Files = std::vector<std::pair<std::string, std::string>>;
  const Files small{{"a.txt", "1"}, {"b/c.txt", "2"}, {"b/d/e.txt", "3"}};
  Files large = small;
  large.emplace_back("b/last.txt", "more than ten bytes");
  const FileSizeLimit limit(10);
  EXPECT_THROW(write_files(folder_ / "new/folder", large), Error);
  EXPECT_TRUE(files().empty());
  write_files(folder_ / "new", small);
  EXPECT_EQ(files(), (Names{"new", "new/a.txt", "new/b", "new/b/c.txt", "new/b/d", "new/b/d/e.txt"}));
  EXPECT_THROW(write_files(folder_ / "new", large), Error);
  EXPECT_EQ(files().size(), 6u);
  EXPECT_EQ(text_of(folder_ / "new/b/c.txt"), "2");
}

}  // namespace
}  // namespace penumbra::io
