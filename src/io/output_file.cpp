#include "io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/stream_output.h"

namespace penumbra::io {

namespace {

namespace fs = std::filesystem;

// Names of temporaries in static memory, so that a signal handler can remove the files without locks or allocation. A
// slot is free while `used` is false; the handler reads `name` only if `ready` is true.
struct Slot {
  std::atomic<bool> used = false, ready = false;
  std::array<char, PATH_MAX> name{};
};
std::array<Slot, 16> slots;

void remember(const std::string& name) {
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

// Blocks signals that end the program while it exists.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&held, signal);
    pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_{};
};

// A signal that ends the program is handled on any thread that doesn't block it. The handler waits until no file is
// being created that the slots don't name yet, and none is created from then on. While a Creation exists, its thread
// neither allocates nor takes a lock: the thread that the handler runs on may hold that lock.
std::atomic<int> creations = 0;
std::atomic<bool> ending = false;

// Exists while a temporary is created and remembered.
class Creation {
 public:
  Creation() {
    ++creations;
    if (!ending) return;
    --creations;
    for (;;) pause();  // the handler ends the program
  }
  ~Creation() { --creations; }
  Creation(const Creation&) = delete;
  Creation& operator=(const Creation&) = delete;

 private:
  HeldSignals held_;  // on this thread: the handler would wait for itself
};

[[noreturn]] void fail_write(const fs::path& path, std::string_view cause) {
  fail("cannot write {}: {}", quoted(path), cause);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Follows the symbolic links of a path's last component, up to a link to an open file, whether the final target exists
// or not. Links in its folders are left to the system. `fault` is set to what is wrong, or stays empty.
fs::path linked_from(fs::path path, std::string& fault) {
  constexpr int most_links = 40;  // same as Linux
  std::error_code error;
  for (int i = 0; i < most_links; ++i) {
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    if (is_open_file(path)) return path;
    const fs::path next = fs::read_symlink(path, error);
    if (error) return fault = error.message(), path;
    path = folder_of(path) / next;  // is `next` itself if that is absolute
  }
  return fault = std::strerror(ELOOP), path;
}

fs::path target_of(const fs::path& path) {
  std::string fault;
  fs::path target = linked_from(path, fault);
  if (!fault.empty()) fail_write(path, fault);
  return target;
}

// The name of a temporary beside `target`, for mkostemp().
std::string pattern_beside(const fs::path& target) {
  constexpr size_t longest = 200;  // bytes of the name, so that it and its ending fit a file system's 255
  const std::string name = fmt::format(".{}.XXXXXX", target.filename().string().substr(0, longest));
  return (folder_of(target) / name).string();
}

// Creates an empty file beside `target` that only this user may read and write, and that a signal handler knows.
fs::path make_temporary(const fs::path& path, const fs::path& target) {
  std::string name = pattern_beside(target);
  int file = -1, fault = 0;
  {
    const Creation creation;
    file = mkostemp(name.data(), O_CLOEXEC);
    fault = errno;
    if (file >= 0) remember(name);
  }
  if (file < 0) fail_write(path, std::strerror(fault));
  close(file);
  return name;
}

// Whether a file can be created beside `target`.
void try_temporary(const fs::path& path, const fs::path& target) {
  const fs::path temporary = make_temporary(path, target);
  unlink(temporary.c_str());
  forget(temporary);
}

// Where what goes to a device, a pipe or an open file is collected.
fs::path temporary_place(const fs::path& target) {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (error) fail("cannot use the folder for temporary files (TMPDIR): {}", error.message());
  return folder / target.filename();
}

// Gives the temporary the owner and permissions of the file that it replaces, as far as this user may set them; a new
// file gets default permissions.
void take_permissions(const fs::path& temporary, const fs::path& target) {
  struct stat old {};
  if (stat(target.c_str(), &old) != 0) {
    const mode_t mask = umask(0);
    umask(mask);
    chmod(temporary.c_str(), 0666 & ~mask);
    return;
  }
  mode_t mode = old.st_mode & 0777;
  const bool same_group = chown(temporary.c_str(), old.st_uid, old.st_gid) == 0 ||
                          chown(temporary.c_str(), static_cast<uid_t>(-1), old.st_gid) == 0;
  if (!same_group) mode &= ~S_IRWXG | (mode & S_IRWXO) << 3;  // a different group gets no more rights than everybody
  chmod(temporary.c_str(), mode);
}

// Throws for anything but a regular file: replacing a device would turn it into a file.
void refuse_all_but_files(const fs::path& path, const fs::path& target) {
  std::error_code error;
  const fs::file_status there = fs::status(target, error);
  if (!path.has_filename() || fs::is_directory(there)) fail_write(path, "it is a folder");
  if (there.type() == fs::file_type::none) fail_write(path, error.message());
  if (!fs::exists(there)) return;
  if (!fs::is_regular_file(there)) fail_write(path, "it is not a file");
  if (access(target.c_str(), W_OK) != 0) fail_write(path, std::strerror(errno));
}

// Waits until a file's content, or a folder's entries, are on the disk. Some network file systems refuse it for
// folders.
void sync(const fs::path& name, const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int fault = file < 0 || fsync(file) != 0 ? errno : 0;
  if (file >= 0) close(file);
  if (fault != 0 && fault != EINVAL) fail_write(name, std::strerror(fault));
}

// The missing folders above a file at `path`, outermost first.
std::vector<fs::path> missing_folders(const fs::path& path) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path folder = folder_of(path); !fs::exists(folder, error) && !error; folder = folder_of(folder))
    missing.insert(missing.begin(), folder);
  return missing;
}

}  // namespace

std::string quoted(const fs::path& path) { return fmt::format("'{}'", path.string()); }

OutputFile::OutputFile(fs::path path) : path_(std::move(path)), target_(target_of(path_)), stream_(is_stream(target_)) {
  if (stream_) {
    check_stream(target_, path_);
    temporary_ = make_temporary(path_, temporary_place(target_));
    return;
  }
  refuse_all_but_files(path_, target_);
  made_ = missing_folders(target_);
  std::error_code error;
  fs::create_directories(folder_of(target_), error);
  try {
    if (error) fail_write(path_, error.message());
    temporary_ = make_temporary(path_, target_);
  } catch (const Error&) {
    remove_made_folders();
    throw;
  }
}

OutputFile::~OutputFile() {
  if (!committed_) unlink(temporary_.c_str());
  forget(temporary_);  // last, as a signal may arrive before
  if (!committed_) remove_made_folders();
}

// Removes only empty folders: another program may have written into them meanwhile.
void OutputFile::remove_made_folders() noexcept {
  for (; !made_.empty(); made_.pop_back()) rmdir(made_.back().c_str());
}

void OutputFile::write(std::string_view text) { write_in(std::ios::trunc, text); }

void OutputFile::append(std::string_view text) { write_in(std::ios::app, text); }

void OutputFile::write_in(std::ios::openmode mode, std::string_view text) {
  std::ofstream stream(temporary_, std::ios::binary | mode);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) fail_write(path_, std::strerror(errno));
}

void OutputFile::commit() {
  if (stream_) return write_to_stream(target_, path_, temporary_);
  take_permissions(temporary_, target_);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail_write(path_, std::strerror(errno));
  committed_ = true;
}

void OutputFile::commit_durably() {
  if (stream_) return commit();
  sync(path_, temporary_);
  commit();
  sync(path_, folder_of(target_));
}

void check_writable(const fs::path& path) {
  const fs::path target = target_of(path);
  if (is_stream(target)) {
    check_stream(target, path);
    try_temporary(path, temporary_place(target));
    return;
  }
  refuse_all_but_files(path, target);
  fs::path folder = folder_of(target);
  std::error_code error;
  while (!fs::exists(folder, error) && !error && folder.has_relative_path()) folder = folder_of(folder);
  if (error) fail_write(path, error.message());
  if (!fs::is_directory(folder, error)) fail_write(path, quoted(folder) + " is not a folder");
  try_temporary(path, folder / target.filename());
}

fs::path place_of(const fs::path& path) {
  std::string ignored;
  const fs::path target = linked_from(path, ignored);
  std::error_code error;
  const fs::path folder = fs::absolute(folder_of(target), error);
  if (error) fail("cannot write {}: the working folder can't be read: {}", quoted(path), error.message());
  const fs::path real = fs::weakly_canonical(folder, error);
  return (error ? folder_of(target).lexically_normal() : real) / target.filename();
}

bool would_replace(const fs::path& result, const fs::path& file) { return place_of(result) == place_of(file); }

void write_text(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_files(const fs::path& folder, std::span<const std::pair<std::string, std::string>> files) {
  const HeldSignals held;
  // Destroyed from last to first, so that the folders that the first outputs created are empty when they are removed.
  struct Outputs {
    std::vector<std::unique_ptr<OutputFile>> files;
    ~Outputs() {
      while (!files.empty()) files.pop_back();
    }
  } outputs;
  for (const auto& [name, text] : files) {
    outputs.files.push_back(std::make_unique<OutputFile>(folder / name));
    outputs.files.back()->write(text);
  }
  for (const std::unique_ptr<OutputFile>& file : outputs.files) file->commit();
}

void exit_without_temporaries(int code) noexcept {
  constexpr int longest_wait = 1000;  // milliseconds: no disk may keep the program from ending
  ending = true;
  for (int waited = 0; creations > 0 && waited < longest_wait; ++waited) poll(nullptr, 0, /*milliseconds=*/1);
  for (Slot& slot : slots) {
    if (slot.ready) unlink(slot.name.data());
  }
  _exit(code);
}

}  // namespace penumbra::io
