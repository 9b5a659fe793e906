#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace penumbra::session {

// Reports which files were saved, using inotify; poll() reads the events, so no thread is needed. A change is reported
// once nothing more has changed for a while, so that a half-written file or a burst of saves is one change. It does not
// matter how an editor saves: in place, by renaming over the file, or by deleting and creating it. Paths are resolved
// through symbolic links, and every folder along a path is watched, so changed links and folders that are removed and
// created again are noticed too.
class FileWatch {
 public:
  using Clock = std::chrono::steady_clock;

  // A change is reported after `idle` without another event, and at the latest `longest_wait` after its first event.
  static constexpr std::chrono::milliseconds idle{50}, longest_wait{300};

  // Throws Error if the system's limit on inotify instances is reached.
  FileWatch();
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  // Watches all files in a folder and its sub-folders, including those created later, except in hidden sub-folders
  // (".git"). Neither a folder nor a file has to exist yet. Throws Error if the system's limit on watches is reached.
  void add_folder(const std::filesystem::path& folder);
  void add_file(const std::filesystem::path& file);
  // The single files to watch from now on, instead of all that add_file() named. Throws Error likewise.
  void set_files(std::vector<std::filesystem::path> files);

  // The files that were written, made, renamed or deleted, each once, sorted, under the names that they were added by
  // (a folder's: folder / "lib/a.glsl"). Waits at most `timeout`; without one it never waits, which is cheap enough for
  // every frame. After an overflow of the system's queue all files are returned. Throws Error as add_folder() does,
  // when a new sub-folder can't be watched any more; changes that were found with it are reported first.
  std::vector<std::filesystem::path> poll(std::chrono::milliseconds timeout = std::chrono::milliseconds(0));

 private:
  // Two states of a file differ if their stamps do.
  struct Stamp {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;
    std::uint32_t mode = 0;
    auto operator<=>(const Stamp&) const = default;
  };
  // A folder, with symbolic links resolved, and the entries of it that are watched.
  struct Place {
    std::set<std::filesystem::path> prefixes;  // names under which a watched folder's entries are reported
    std::map<std::string, std::set<std::filesystem::path>> names;  // single entries, and the files that each one is
  };
  struct Survey {
    std::map<std::filesystem::path, Place> places;
    std::map<std::filesystem::path, Stamp> files;  // those that exist, by the name under which they are reported
  };

  static void survey_path(Survey& survey, const std::filesystem::path& path, const std::filesystem::path& told_as);
  static void survey_folder(Survey& survey, const std::filesystem::path& folder,
                            std::set<std::filesystem::path>& above);
  static void survey_file(Survey& survey, const std::filesystem::path& file);
  Survey survey() const;
  bool watch_places();
  void refresh();
  void throw_fault();

  void read_events(Clock::time_point now);
  void note(int descriptor, std::uint32_t mask, const char* name);
  std::vector<std::filesystem::path> take_changes();

  int inotify_ = -1;
  std::vector<std::filesystem::path> folders_, files_;
  Survey known_;
  std::map<int, std::filesystem::path> descriptors_;  // of known_.places

  bool pending_ = false;
  bool lost_ = false;  // the queue overflowed
  Clock::time_point first_event_, last_event_;
  std::set<std::filesystem::path> touched_;
  std::exception_ptr fault_;  // to be thrown by the next poll()
};

}  // namespace penumbra::session
