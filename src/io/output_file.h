#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace penumbra::io {

// A file that appears whole or not at all: written under a temporary name in its own folder, then renamed. Where `path`
// is a symbolic link, it stays one, and the file that it leads to is written. A file that is replaced hands on its
// permissions, and its owner and group where this user may set them. Refused are folders, devices, pipes, files that
// this user may not write, and links to open files of a process (/dev/stdout): they can't be replaced as a whole.
class OutputFile {
 public:
  // Makes missing folders, which go again unless the file is committed. Throws Error naming the file when nothing can
  // be written there.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Where to write; exists and is empty.
  const std::filesystem::path& temporary() const { return temporary_; }
  // Makes `text` the temporary's content. Throws Error when the disk is full or the file passes a limit.
  void write(std::string_view text);
  // Puts the temporary in place of the file. Throws Error if the system refuses.
  void commit();

 private:
  void remove_made_folders() noexcept;

  std::filesystem::path path_, target_, temporary_;
  std::vector<std::filesystem::path> made_;
  bool committed_ = false;
};

// Throws Error unless a file at `path` could be written, its missing folders included. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

void write_text(const std::filesystem::path& path, std::string_view text);

// Writes files by name within `folder`, each with its text: all or, when one can't be written, none. Signals that end
// the program wait until it is done.
void write_files(const std::filesystem::path& folder, std::span<const std::pair<std::string, std::string>> files);

// Where a file written to `path` is put: links followed, with its real folder. Paths of one file are equal.
std::filesystem::path place_of(const std::filesystem::path& path);

// Would a file written to `result` replace `file`?
bool would_replace(const std::filesystem::path& result, const std::filesystem::path& file);

// The error's one line for the user: `path` quoted as given.
std::string quoted(const std::filesystem::path& path);

// Removes the temporaries of all living OutputFiles. Async-signal-safe: for handlers of SIGINT and SIGTERM.
void remove_temporaries() noexcept;

}  // namespace penumbra::io
