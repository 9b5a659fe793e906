#include "read_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <system_error>

#include "error.h"

namespace penumbra {

namespace {

// The size of a regular file; throws Error for others.
std::size_t size_of(const std::filesystem::path& path, std::size_t limit) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (code && code != std::errc::no_such_file_or_directory) fail("can't be read: {}", code.message());
  if (!std::filesystem::exists(status)) fail("file not found");
  // Reading a pipe or device could block forever.
  if (!std::filesystem::is_regular_file(status)) fail("not a regular file");
  const auto size = std::filesystem::file_size(path, code);
  if (code) fail("can't be read: {}", code.message());
  if (size > limit) fail("{} bytes, over the limit of {}", size, limit);
  return size;
}

// Throws Error if the last read failed, rather than met the end of the file.
void check_read(const std::ifstream& stream) {
  if (stream.bad()) fail("can't be read: {}", std::strerror(errno));
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t limit) {
  const std::size_t size = size_of(path, limit);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("can't be read: {}", std::strerror(errno));
  std::vector<std::byte> bytes;
  try {
    bytes.resize(size);
  } catch (const std::bad_alloc&) {
    fail("not enough memory for its {} bytes", size);
  }
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  check_read(stream);
  if (stream.gcount() != static_cast<std::streamsize>(bytes.size())) fail("can't be read to its end");
  const bool has_more = stream.peek() != std::ifstream::traits_type::eof();  // as files of /proc have, of size 0
  check_read(stream);
  if (has_more) fail("longer than the {} bytes of its size", size);
  return bytes;
}

FileParts::FileParts(const std::filesystem::path& path, std::size_t limit) {
  size_of(path, limit);
  stream_.rdbuf()->pubsetbuf(nullptr, 0);  // reads no more than it is asked for
  stream_.open(path, std::ios::binary);
  if (!stream_) fail("can't be read: {}", std::strerror(errno));
}

std::size_t FileParts::read(std::size_t offset, std::span<std::byte> to) {
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(offset));
  stream_.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size()));
  check_read(stream_);
  return static_cast<std::size_t>(stream_.gcount());
}

}  // namespace penumbra
