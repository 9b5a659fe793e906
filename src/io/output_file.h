#pragma once

#include <filesystem>
#include <ios>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace penumbra::io {

// A file that is written atomically: under a temporary name in its own folder, then renamed. If `path` is a symbolic
// link, the link stays and the file that it leads to is written. A replaced file keeps its permissions, and its owner
// and group where this user may set them. Character devices, pipes and links to open files of a process (/dev/stdout)
// can't be replaced: commit() writes the temporary's content to them (see stream_output.h). Folders, other devices and
// files that this user may not write are refused.
class OutputFile {
 public:
  // Creates missing folders, and removes them again unless the file is committed. Throws Error that names the file if
  // nothing can be written there.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // The temporary file to write to; it exists and is empty.
  const std::filesystem::path& temporary() const { return temporary_; }
  // Writes `text` as the content of the temporary, or adds it to that. Throws Error if the disk is full or the file
  // exceeds a limit.
  void write(std::string_view text);
  void append(std::string_view text);
  // Puts the temporary in place of the file, or writes its content to a device, a pipe or an open file. Throws Error if
  // the system refuses.
  void commit();
  // The same, and waits until content and name are on the disk: what happens to the machine afterwards, the file is
  // whole.
  void commit_durably();

 private:
  void write_in(std::ios::openmode mode, std::string_view text);
  void remove_made_folders() noexcept;

  std::filesystem::path path_, target_, temporary_;
  bool stream_ = false;  // the target is written to instead of being replaced
  std::vector<std::filesystem::path> made_;
  bool committed_ = false;
};

// Throws Error unless a file could be written to `path`, missing folders included. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

void write_text(const std::filesystem::path& path, std::string_view text);

// Writes files, given as names within `folder` and text: all of them or, if one can't be written, none. Signals that
// end the program are blocked until it is done.
void write_files(const std::filesystem::path& folder, std::span<const std::pair<std::string, std::string>> files);

// The path at which a file written to `path` ends up: links followed, with its real folder. Paths that lead to the same
// file give the same result.
std::filesystem::path place_of(const std::filesystem::path& path);

// Whether a file written to `result` would replace `file`.
bool would_replace(const std::filesystem::path& result, const std::filesystem::path& file);

// `path` for an error message: in quotes, as the user gave it.
std::string quoted(const std::filesystem::path& path);

// Removes the temporaries of all existing OutputFiles and ends the process at once with that exit code.
// Async-signal-safe: for handlers of signals, on any thread.
[[noreturn]] void exit_without_temporaries(int code) noexcept;

}  // namespace penumbra::io
