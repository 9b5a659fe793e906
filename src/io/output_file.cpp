#include "io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"

namespace penumbra::io {

namespace {

namespace fs = std::filesystem;

// Names a signal handler can remove without locks or allocation. A slot is free while `used` is false; the handler
// reads `name` only where `ready` is true.
struct Slot {
  std::atomic<bool> used = false, ready = false;
  std::array<char, PATH_MAX> name{};
};
std::array<Slot, 16> slots;

void remember(const fs::path& path) {
  const std::string& name = path.native();
  if (name.size() >= PATH_MAX) return;
  for (Slot& slot : slots) {
    if (slot.used.exchange(true)) continue;
    std::memcpy(slot.name.data(), name.c_str(), name.size() + 1);
    slot.ready = true;
    return;
  }
}

void forget(const fs::path& path) {
  for (Slot& slot : slots) {
    if (!slot.ready || path.native() != slot.name.data()) continue;
    slot.ready = false;
    slot.used = false;
    return;
  }
}

[[noreturn]] void fail_write(const fs::path& path, std::string_view cause) {
  fail("cannot write {}: {}", quoted(path), cause);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// A new, empty file beside `path`.
fs::path make_temporary(const fs::path& path, const fs::path& folder) {
  constexpr size_t longest = 200;  // bytes of the name, so that it and its ending fit a file system's 255
  const std::string pattern =
      (folder / fmt::format(".{}.XXXXXX", path.filename().string().substr(0, longest))).string();
  std::vector<char> name(pattern.begin(), pattern.end());
  name.push_back('\0');
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) fail_write(path, std::strerror(errno));
  // mkostemp makes files private; a picture is as public as any other file.
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(file, 0666 & ~mask);
  close(file);
  return name.data();
}

// What is there is replaced as a whole: a device or a pipe would be one no more.
void refuse_all_but_files(const fs::path& path) {
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (!path.has_filename() || fs::is_directory(there)) fail_write(path, "it is a folder");
  if (fs::exists(there) && !fs::is_regular_file(there)) fail_write(path, "it is a device or a pipe");
}

}  // namespace

std::string quoted(const fs::path& path) { return fmt::format("'{}'", path.string()); }

OutputFile::OutputFile(fs::path path) : path_(std::move(path)) {
  refuse_all_but_files(path_);
  const fs::path folder = folder_of(path_);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_write(path_, error.message());
  temporary_ = make_temporary(path_, folder);
  remember(temporary_);
}

OutputFile::~OutputFile() {
  if (!committed_) unlink(temporary_.c_str());
  forget(temporary_);
}

void OutputFile::commit() {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail_write(path_, std::strerror(errno));
  committed_ = true;
}

void check_writable(const fs::path& path) {
  refuse_all_but_files(path);
  fs::path folder = folder_of(path);
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder_of(folder);
  if (!fs::is_directory(folder, error)) fail_write(path, quoted(folder) + " is not a folder");
  unlink(make_temporary(path, folder).c_str());
}

fs::path place_of(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(folder_of(path)), error);
  return (error ? folder_of(path).lexically_normal() : real) / path.filename();
}

bool would_replace(const fs::path& result, const fs::path& file) {
  std::error_code error;
  const fs::path place = place_of(result);
  return place == place_of(file) || place == fs::weakly_canonical(file, error);
}

void write_text(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) fail_write(path, std::strerror(errno));
  file.commit();
}

void remove_temporaries() noexcept {
  for (Slot& slot : slots) {
    if (slot.ready) unlink(slot.name.data());
  }
}

}  // namespace penumbra::io
