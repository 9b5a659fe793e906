#include "io/stream_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/descriptor.h"

namespace penumbra::io {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_stream(const fs::path& name, int code) {
  const bool no_reader = code == ENXIO && fs::is_fifo(name);
  fail("cannot write '{}': {}", name.string(), no_reader ? "no program reads from this pipe" : std::strerror(code));
}

// The descriptor that the path stands for, if it is one of this process.
std::optional<int> own_descriptor(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.parent_path(), error);
  if (error || folder != fmt::format("/proc/{}/fd", getpid())) return {};
  const std::string number = path.filename().string();
  int descriptor = 0;
  const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), descriptor);
  if (fault != std::errc() || end != number.data() + number.size()) return {};
  return descriptor;
}

// An open file of this process is duplicated, since opening its path again would begin at the file's start.
int opened(const fs::path& path) {
  if (const std::optional<int> own = own_descriptor(path)) return fcntl(*own, F_DUPFD_CLOEXEC, 0);
  // Without O_NONBLOCK a pipe would wait for a reader, perhaps forever.
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (file >= 0) fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return file;
}

// While it exists, writing to a pipe that its reader has closed is an error, and does not end the program.
class IgnoredSigpipe {
 public:
  IgnoredSigpipe() {
    struct sigaction ignored {};
    ignored.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignored, &before_);
  }
  ~IgnoredSigpipe() { sigaction(SIGPIPE, &before_, nullptr); }
  IgnoredSigpipe(const IgnoredSigpipe&) = delete;
  IgnoredSigpipe& operator=(const IgnoredSigpipe&) = delete;

 private:
  struct sigaction before_ {};
};

void write_all(int file, std::string_view bytes, const fs::path& name) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN) {  // a pipe that another program has made non-blocking
      pollfd ready{.fd = file, .events = POLLOUT, .revents = 0};
      poll(&ready, 1, -1);
      continue;
    }
    if (written < 0) fail_stream(name, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

bool is_open_file(const fs::path& path) {
  constexpr auto procfs = 0x9FA0;  // PROC_SUPER_MAGIC of linux/magic.h
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  struct statfs about {};
  return statfs(folder.c_str(), &about) == 0 && about.f_type == procfs && folder.filename() == "fd";
}

bool is_stream(const fs::path& path) {
  if (is_open_file(path)) return true;
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  return type == fs::file_type::character || type == fs::file_type::fifo;
}

void check_stream(const fs::path& path, const fs::path& name) {
  const std::optional<int> own = own_descriptor(path);
  if (!own) {
    // Only the permission: opening and closing a pipe would end its reader.
    if (access(path.c_str(), W_OK) != 0) fail_stream(name, errno);
    return;
  }
  const int flags = fcntl(*own, F_GETFL);
  if (flags < 0) fail_stream(name, errno);
  if ((flags & O_ACCMODE) == O_RDONLY) fail_stream(name, EBADF);
}

void write_to_stream(const fs::path& path, const fs::path& name, const fs::path& from) {
  const Descriptor file(opened(path));
  if (file.number() < 0) fail_stream(name, errno);
  const IgnoredSigpipe ignored;
  std::ifstream source(from, std::ios::binary);
  std::array<char, 65536> bytes{};
  while (source) {
    source.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    write_all(file.number(), {bytes.data(), static_cast<std::size_t>(source.gcount())}, name);
  }
  if (!source.eof()) fail_stream(name, EIO);
}

}  // namespace penumbra::io
