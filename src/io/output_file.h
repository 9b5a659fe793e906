#pragma once

#include <filesystem>
#include <string_view>

namespace penumbra::io {

// A file that appears whole or not at all: written under a temporary name in its own folder, then renamed.
class OutputFile {
 public:
  // Makes the folder if it is missing. Throws Error naming the file when nothing can be written there.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Where to write; exists and is empty.
  const std::filesystem::path& temporary() const { return temporary_; }
  // Puts the temporary in place of the file.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  bool committed_ = false;
};

// Throws Error unless a file at `path` could be written, its missing folders included. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

void write_text(const std::filesystem::path& path, std::string_view text);

// Where a file written to `path` is put: in a real folder, in place of what has its name there, links included.
std::filesystem::path place_of(const std::filesystem::path& path);

// Would a file written to `result` take the place of `file`, or of what `file` links to?
bool would_replace(const std::filesystem::path& result, const std::filesystem::path& file);

// The error's one line for the user: `path` quoted as given.
std::string quoted(const std::filesystem::path& path);

// Removes the temporaries of all living OutputFiles. Async-signal-safe: for handlers of SIGINT and SIGTERM.
void remove_temporaries() noexcept;

}  // namespace penumbra::io
