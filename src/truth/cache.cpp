#include "truth/cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <system_error>

#include "core/log.h"
#include "io/key.h"
#include "io/output_file.h"

namespace penumbra::truth {

namespace {

namespace fs = std::filesystem;

// A file is this header, then visibility, standard error and hard shadow as floats in this machine's byte order.
struct Header {
  std::array<char, 16> magic{'p', 'e', 'n', 'u', 'm', 'b', 'r', 'a', ' ', 't', 'r', 'u', 't', 'h', ' ', '3'};
  Key key, contents;
  std::uint64_t pixels = 0;
  std::int64_t rays = 0, samples = 0;
  double seconds = 0;
};

constexpr std::array layers{&Traced::visibility, &Traced::standard_error, &Traced::hard};

fs::path file_of(const fs::path& folder, const Key& key) { return folder / (key.text() + ".truth"); }

std::uintmax_t bytes_of(std::size_t pixels) { return sizeof(Header) + layers.size() * pixels * sizeof(float); }

// Whether the header belongs to a complete file for `key`.
bool fits(const Header& header, const Key& key, std::size_t pixels, std::uintmax_t bytes) {
  return header.magic == Header{}.magic && header.key == key && header.pixels == pixels && bytes == bytes_of(pixels);
}

std::optional<Traced> read(const fs::path& path, const Key& key, std::size_t pixels) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  Header header;
  file.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!file || !fits(header, key, pixels, bytes)) return std::nullopt;
  Traced traced{.rays = header.rays, .seconds = header.seconds, .samples = static_cast<int>(header.samples)};
  for (const auto layer : layers) {
    std::vector<float>& values = traced.*layer;
    values.resize(pixels);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(pixels * sizeof(float)));
  }
  if (!file || traced.samples != header.samples || key_of(traced) != header.contents) return std::nullopt;
  return traced;
}

// Whether a file is a cached picture, or the temporary that a killed process left behind: KEY.truth or
// .KEY.truth.XXXXXX. The user may keep other files in the folder.
bool is_ours(const fs::path& path) {
  std::string name = path.filename().string();
  if (name.starts_with('.')) name = fs::path(name.substr(1)).stem().string();
  const fs::path picture(name);
  return picture.extension() == ".truth" && io::key_from(picture.stem().string());
}

// Whether another process may still be writing the file.
bool is_being_written(const fs::path& path, fs::file_time_type changed) {
  return path.filename().native().starts_with('.') &&
         fs::file_time_type::clock::now() - changed < std::chrono::hours(1);
}

// Deletes files until `needed` more bytes fit within `largest`.
void shrink(const fs::path& folder, std::uintmax_t needed, std::uintmax_t largest) {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = needed;
  std::error_code end;
  for (fs::directory_iterator at(folder, end), none; !end && at != none; at.increment(end)) {
    if (!is_ours(at->path())) continue;
    std::error_code gone_time, gone_size;  // another process may delete the file meanwhile
    const Entry found{at->last_write_time(gone_time), at->file_size(gone_size), at->path()};
    if (gone_time || gone_size) continue;
    total += found.bytes;
    if (!is_being_written(found.path, found.used)) entries.push_back(found);
  }
  std::ranges::sort(entries, {}, &Entry::used);
  std::error_code error;
  for (const Entry& entry : entries) {
    if (total <= largest) return;
    if (fs::remove(entry.path, error)) total -= entry.bytes;
  }
}

void write(const fs::path& path, const Header& header, const Traced& traced) {
  std::string contents(reinterpret_cast<const char*>(&header), sizeof(header));
  contents.reserve(bytes_of(traced.visibility.size()));
  for (const auto layer : layers) {
    const std::vector<float>& values = traced.*layer;
    contents.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  }
  io::write_text(path, contents);
}

}  // namespace

std::optional<Traced> Cache::find(const Key& key, std::size_t pixels) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path path = file_of(folder_, key);
  std::optional<Traced> traced = read(path, key, pixels);
  std::error_code ignored;
  if (traced) fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return traced;
}

void Cache::keep(const Key& key, const Traced& traced) const {
  const std::uintmax_t bytes = bytes_of(traced.visibility.size());
  if (folder_.empty() || bytes > largest_) return;
  const Header header{.key = key,
                      .contents = key_of(traced),
                      .pixels = traced.visibility.size(),
                      .rays = traced.rays,
                      .samples = traced.samples,
                      .seconds = traced.seconds};
  try {
    shrink(folder_, bytes, largest_);
    write(file_of(folder_, key), header, traced);
  } catch (const std::exception& error) {
    warn("the cache of traced shadows: {}", error.what());
  }
}

std::filesystem::path default_cache_folder() {
  const auto from = [](const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : fs::path();
  };
  if (const fs::path cache = from("XDG_CACHE_HOME"); !cache.empty()) return cache / "penumbra/truth";
  if (const fs::path home = from("HOME"); !home.empty()) return home / ".cache/penumbra/truth";
  return {};
}

}  // namespace penumbra::truth
