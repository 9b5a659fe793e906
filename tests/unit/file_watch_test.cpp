#include "session/file_watch.h"

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/temp_folder.h"

namespace {

std::string unwatchable;  // a folder for which the system's limit of watches is reached; empty: none

}  // namespace

// The system's own, in this program.
extern "C" int inotify_add_watch(int descriptor, const char* path, std::uint32_t mask) noexcept {
  if (!unwatchable.empty() && path == unwatchable) {
    errno = ENOSPC;
    return -1;
  }
  return static_cast<int>(syscall(SYS_inotify_add_watch, descriptor, path, mask));
}

namespace penumbra::session {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Paths = std::vector<fs::path>;

// Each test has its own folder, and the paths that it watches lead through it.
class FileWatchTest : public testing::Test {
 protected:
  FileWatchTest() {
    fs::create_directories(glsl() / "lib");
    write(glsl() / "a.glsl", "a");
    write(glsl() / "lib/b.glsl", "b");
  }
  fs::path glsl() const { return root_ / "glsl"; }

  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

  // Waits for the next changes, long enough for a busy machine, and returns as soon as there are some.
  static Paths next(FileWatch& watch) { return watch.poll(20s); }
  // The changes that are reported within 0.4 seconds: none once the watch is idle.
  static Paths rest(FileWatch& watch) { return watch.poll(400ms); }

  test::TempFolder folder_;
  fs::path root_ = folder_.path();
};

TEST_F(FileWatchTest, TellsNothingUntilSomethingChanges) {
  FileWatch watch;
  watch.add_folder(glsl());
  EXPECT_EQ(watch.poll(), Paths());
  EXPECT_EQ(rest(watch), Paths());
  std::ifstream(glsl() / "a.glsl").get();
  EXPECT_EQ(rest(watch), Paths()) << "reading is no change";
}

TEST_F(FileWatchTest, AFileIsToldOnceHoweverItIsSaved) {
  const std::vector<std::pair<const char*, std::function<void(const fs::path&)>>> ways{
      {"in place", [](const fs::path& file) { write(file, "in place"); }},
      {"with the same text", [](const fs::path& file) { write(file, "in place"); }},
      {"renamed over",
       [](const fs::path& file) {
         write(file.string() + ".new", "renamed over");
         fs::rename(file.string() + ".new", file);
       }},
      {"deleted and made",
       [](const fs::path& file) {
         fs::remove(file);
         write(file, "made again");
       }},
      {"old one moved away",
       [](const fs::path& file) {
         fs::rename(file, file.string() + "~");
         write(file, "as vim does");
         fs::remove(file.string() + "~");
       }},
      {"deleted", [](const fs::path& file) { fs::remove(file); }},
      {"made", [](const fs::path& file) { write(file, "new"); }},
  };
  FileWatch watch;
  watch.add_folder(glsl());
  watch.add_file(root_ / "preset.toml");
  write(root_ / "preset.toml", "");
  EXPECT_EQ(next(watch), Paths{root_ / "preset.toml"});
  for (const fs::path& file : {glsl() / "a.glsl", glsl() / "lib/b.glsl", root_ / "preset.toml"}) {
    for (const auto& [way, save] : ways) {
      SCOPED_TRACE(way);
      save(file);
      EXPECT_EQ(next(watch), Paths{file});
    }
  }
  EXPECT_EQ(rest(watch), Paths());
}

TEST_F(FileWatchTest, OthersInTheFolderOfASingleFileAreNoChange) {
  FileWatch watch;
  watch.add_file(glsl() / "a.glsl");
  write(glsl() / "other.glsl", "x");
  write(root_ / "scene.glb", "x");
  EXPECT_EQ(rest(watch), Paths());
}

TEST_F(FileWatchTest, FilesCanBeNamedAnew) {
  FileWatch watch;
  watch.add_file(glsl() / "a.glsl");
  watch.set_files({glsl() / "lib/b.glsl"});
  write(glsl() / "a.glsl", "x");
  EXPECT_EQ(rest(watch), Paths());
  write(glsl() / "lib/b.glsl", "x");
  EXPECT_EQ(next(watch), Paths{glsl() / "lib/b.glsl"});
}

TEST_F(FileWatchTest, ABurstIsOneChange) {
  FileWatch watch;
  watch.add_folder(glsl());
  for (int i = 0; i < 100; ++i) {
    write(glsl() / "a.glsl", std::to_string(i));
    write(glsl() / "lib/b.glsl", std::to_string(i));
    write(glsl() / ".a.glsl.swp", std::to_string(i));
    fs::remove(glsl() / ".a.glsl.swp");
  }
  EXPECT_EQ(next(watch), (Paths{glsl() / "a.glsl", glsl() / "lib/b.glsl"}));
  EXPECT_EQ(rest(watch), Paths());
}

TEST_F(FileWatchTest, AFileThatIsWrittenOnAndOnIsToldMeanwhile) {
  FileWatch watch;
  watch.add_folder(glsl());
  std::ofstream file(glsl() / "a.glsl");
  Paths told;
  for (int i = 0; i < 1000 && told.empty(); ++i) {
    file << i << std::flush;
    told = watch.poll(10ms);
  }
  EXPECT_EQ(told, Paths{glsl() / "a.glsl"});
}

TEST_F(FileWatchTest, NewFoldersAreWatchedWithWhatTheyBring) {
  FileWatch watch;
  watch.add_folder(glsl());
  fs::create_directories(glsl() / "new/deep");
  write(glsl() / "new/deep/c.glsl", "c");
  EXPECT_EQ(next(watch), Paths{glsl() / "new/deep/c.glsl"});
  write(glsl() / "new/deep/c.glsl", "changed");
  EXPECT_EQ(next(watch), Paths{glsl() / "new/deep/c.glsl"});

  fs::create_directories(root_ / "elsewhere");
  write(root_ / "elsewhere/d.glsl", "d");
  fs::rename(root_ / "elsewhere", glsl() / "moved");
  EXPECT_EQ(next(watch), Paths{glsl() / "moved/d.glsl"});
  fs::rename(glsl() / "moved", glsl() / "again");
  EXPECT_EQ(next(watch), (Paths{glsl() / "again/d.glsl", glsl() / "moved/d.glsl"}));
  write(glsl() / "again/d.glsl", "changed");
  EXPECT_EQ(next(watch), Paths{glsl() / "again/d.glsl"});
}

TEST_F(FileWatchTest, HiddenFoldersAreLeftOut) {
  fs::create_directories(glsl() / ".git/objects");
  FileWatch watch;
  watch.add_folder(glsl());
  write(glsl() / ".git/index", "x");
  write(glsl() / ".git/objects/x", "x");
  EXPECT_EQ(rest(watch), Paths());
}

TEST_F(FileWatchTest, AFolderMayGoAndComeBack) {
  FileWatch watch;
  watch.add_folder(glsl());
  const Paths both{glsl() / "a.glsl", glsl() / "lib/b.glsl"};
  fs::remove_all(glsl());
  EXPECT_EQ(next(watch), both);
  fs::create_directories(glsl() / "lib");
  write(glsl() / "a.glsl", "a");
  write(glsl() / "lib/b.glsl", "b");
  std::set<fs::path> told;
  for (int i = 0; i < 2 && told.size() < both.size(); ++i) {
    for (const fs::path& path : next(watch)) told.insert(path);
  }
  EXPECT_EQ(told, std::set<fs::path>(both.begin(), both.end()));
  write(glsl() / "lib/b.glsl", "changed");
  EXPECT_EQ(next(watch), Paths{glsl() / "lib/b.glsl"});

  fs::rename(root_, root_.string() + "-away");
  EXPECT_EQ(next(watch), both);
  fs::rename(root_.string() + "-away", root_);
  EXPECT_EQ(next(watch), both);
  write(glsl() / "a.glsl", "changed");
  EXPECT_EQ(next(watch), Paths{glsl() / "a.glsl"});
}

TEST_F(FileWatchTest, WhatDoesNotExistYetIsToldWhenItDoes) {
  FileWatch watch;
  watch.add_file(root_ / "later/on/preset.toml");
  watch.add_folder(root_ / "later/glsl");
  fs::create_directories(root_ / "later/on");
  EXPECT_EQ(rest(watch), Paths());
  write(root_ / "later/on/preset.toml", "x");
  EXPECT_EQ(next(watch), Paths{root_ / "later/on/preset.toml"});
  fs::create_directories(root_ / "later/glsl");
  write(root_ / "later/glsl/a.glsl", "x");
  EXPECT_EQ(next(watch), Paths{root_ / "later/glsl/a.glsl"});
}

TEST_F(FileWatchTest, LinksAreFollowed) {
  fs::create_directories(root_ / "real/textures");
  write(root_ / "real/scene.gltf", "x");
  write(root_ / "real/textures/t.png", "x");
  write(root_ / "real/other.gltf", "x");
  fs::create_symlink("real/scene.gltf", root_ / "scene.gltf");
  fs::create_symlink(root_ / "real/textures", glsl() / "linked");
  fs::create_symlink("..", glsl() / "lib/cycle");
  FileWatch watch;
  watch.add_file(root_ / "scene.gltf");
  watch.add_folder(glsl());

  write(root_ / "real/scene.gltf", "the target is saved");
  EXPECT_EQ(next(watch), Paths{root_ / "scene.gltf"});
  write(root_ / "real/textures/t.png", "in a linked folder");
  EXPECT_EQ(next(watch), Paths{glsl() / "linked/t.png"});
  fs::remove(root_ / "scene.gltf");
  fs::create_symlink("real/other.gltf", root_ / "scene.gltf");
  EXPECT_EQ(next(watch), Paths{root_ / "scene.gltf"});
  write(root_ / "real/other.gltf", "the new target");
  EXPECT_EQ(next(watch), Paths{root_ / "scene.gltf"});
  write(root_ / "real/scene.gltf", "the old target");
  EXPECT_EQ(rest(watch), Paths());
}

TEST_F(FileWatchTest, AnOverflowTellsAllFiles) {
  std::ifstream limit("/proc/sys/fs/inotify/max_queued_events");
  int events = 0;
  limit >> events;
  if (events <= 0 || events > 100'000) GTEST_SKIP() << "the queue takes " << events << " events";
  FileWatch watch;
  watch.add_folder(glsl());
  for (int i = 0; i <= events; ++i) {
    const fs::path file = glsl() / std::to_string(i % 2);
    write(file, "");
    fs::remove(file);
  }
  EXPECT_EQ(next(watch), (Paths{glsl() / "a.glsl", glsl() / "lib/b.glsl"}));
  write(glsl() / "a.glsl", "after it");
  EXPECT_EQ(next(watch), Paths{glsl() / "a.glsl"});
}

TEST_F(FileWatchTest, ALimitThatIsReachedLosesNoChange) {
  FileWatch watch;
  watch.add_folder(glsl());
  write(glsl() / "a.glsl", "x");
  unwatchable = glsl() / "new";
  fs::create_directory(unwatchable);
  EXPECT_EQ(next(watch), Paths{glsl() / "a.glsl"});
  EXPECT_THROW(next(watch), Error);
  unwatchable.clear();
  EXPECT_EQ(rest(watch), Paths()) << "told once";
  write(glsl() / "a.glsl", "y");
  EXPECT_EQ(next(watch), Paths{glsl() / "a.glsl"});
}

#ifndef __SANITIZE_ADDRESS__  // the address sanitizer needs file descriptors itself
TEST_F(FileWatchTest, TheLimitOfDescriptorsIsOneClearError) {
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{.rlim_cur = 0, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  std::string message;
  try {
    const FileWatch watch;
  } catch (const Error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(message.find("cannot watch files: "), 0u) << message;
  EXPECT_NE(message.find("max_user_instances"), std::string::npos) << message;
}
#endif

}  // namespace
}  // namespace penumbra::session
