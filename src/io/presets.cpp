#include "io/presets.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/descriptor.h"
#include "io/output_file.h"

namespace penumbra::io {

namespace {

[[noreturn]] void fail_read(const std::filesystem::path& path, std::string_view cause) {
  fail("cannot read preset {}: {}", quoted(path), cause);
}

// Waits for a program that has the pipe open for writing. Returns 0 at the end, and if there is no such program.
std::size_t read_part(int file, char* to, std::size_t size, const std::filesystem::path& path) {
  while (true) {
    const ssize_t length = read(file, to, size);
    if (length >= 0) return static_cast<std::size_t>(length);
    if (errno == EAGAIN) {
      pollfd ready{.fd = file, .events = POLLIN, .revents = 0};
      poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      fail_read(path, std::strerror(errno));
    }
  }
}

// Whether it is a named pipe that no program has opened for writing since it was opened here. The end of one that was
// written to is a hang-up.
bool lacks_writer(int file) {
  struct stat about {};
  pollfd ended{.fd = file, .events = POLLIN, .revents = 0};
  return fstat(file, &about) == 0 && S_ISFIFO(about.st_mode) && poll(&ended, 1, 0) == 0;
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail_read(path, "it is a folder");
  // Without O_NONBLOCK a pipe would wait for a writer, perhaps forever.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.number() < 0) fail_read(path, std::strerror(errno));
  std::string text(largest_preset + 1, '\0');
  std::size_t length = 0;
  while (length < text.size()) {
    const std::size_t part = read_part(file.number(), text.data() + length, text.size() - length, path);
    if (part == 0) break;
    length += part;
  }
  if (length > largest_preset) fail_read(path, "it is larger than 1 MiB");
  if (length == 0) fail_read(path, lacks_writer(file.number()) ? "no program writes to this pipe" : "it is empty");
  text.resize(length);
  return text;
}

}  // namespace

void read_preset(const std::filesystem::path& path, ParamSet& params, const SelectTechnique& select) {
  apply_preset(read_text(path), path.string(), params, select);
}

void write_preset(const std::filesystem::path& path, const ParamSet& params) { write_text(path, preset_text(params)); }

}  // namespace penumbra::io
