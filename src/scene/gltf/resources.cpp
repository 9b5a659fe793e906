#include "scene/gltf/resources.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/read_file.h"
#include "scene/limits.h"

namespace penumbra::scene::gltf {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::string_view base64_alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int, 256> base64_values = [] {
  std::array<int, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < base64_alphabet.size(); ++i)
    values[static_cast<unsigned char>(base64_alphabet[i])] = static_cast<int>(i);
  return values;
}();

std::string_view shortened(std::string_view uri) { return uri.substr(0, 80); }

bool has_scheme(std::string_view uri) {
  const auto colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-' ||
           c == '.';
  });
}

bool lies_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end() && in_file != file.end();
}

// The file that a relative URI names.
struct Found {
  std::string name;            // below the folder
  std::filesystem::path file;  // with links resolved, unless they are followed; empty if there is none
  std::error_code cause = {};  // why a name that may exist can't be read
};

// The name is the URI's percent-decoded as the standard says, or unchanged, as many exporters write it, if only that
// exists. Whether it leaves the folder is checked for files that don't exist too, so that a scene can't find out which
// files do.
Found find_file(const std::filesystem::path& folder, std::string_view uri, bool follow_links) {
  std::error_code code;
  const auto base = std::filesystem::canonical(folder.empty() ? "." : folder, code);
  if (code) fail("the scene's folder can't be resolved: {}", code.message());
  Found missing{.name = percent_decoded(uri), .file = {}};
  for (const std::string& name : {missing.name, std::string(uri)}) {
    code.clear();
    if (name.find('\0') != std::string::npos) {
      std::string shown(shortened(uri));
      std::ranges::replace(shown, '\0', ' ');  // an error's text would end there
      fail("'{}' holds a zero byte", shown);
    }
    if (std::filesystem::path(name).is_absolute()) fail("'{}' is an absolute path", shortened(uri));
    const auto named = (base / name).lexically_normal();
    if (!lies_inside(named, base)) fail("'{}' leads out of the scene's folder", shortened(uri));
    auto file = follow_links ? named : std::filesystem::weakly_canonical(base / name, code);
    if (code) missing.cause = code;
    if (code) continue;
    if (!lies_inside(file, base))
      fail("'{}' leads out of the scene's folder by a symbolic link; --follow-links allows it", shortened(uri));
    if (std::filesystem::exists(file, code)) return {.name = name, .file = std::move(file)};
    if (code && code != std::errc::no_such_file_or_directory) missing.cause = code;
  }
  return missing;
}

std::filesystem::path resolve(const std::filesystem::path& folder, std::string_view uri, bool follow_links) {
  const Found found = find_file(folder, uri, follow_links);
  if (found.cause) fail("'{}' can't be read: {}", shortened(uri), found.cause.message());
  if (found.file.empty()) fail("'{}' not found", shortened(uri));
  return found.file;
}

bool equals_ignoring_case(std::string_view text, std::string_view lower) {
  return std::ranges::equal(text, lower,
                            [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

// Decodes bytes that are given directly, or as '%' and two hexadecimal digits.
std::vector<std::byte> percent_decoded_bytes(std::string_view text) {
  for (std::size_t i = text.find('%'); i != std::string_view::npos; i = text.find('%', i + 1))
    if (i + 2 >= text.size() || hex_digit(text[i + 1]) < 0 || hex_digit(text[i + 2]) < 0)
      fail("a data URI with a '%' that no two hexadecimal digits follow");
  const std::string decoded = percent_decoded(text);
  const auto bytes = std::as_bytes(std::span(decoded));
  return {bytes.begin(), bytes.end()};
}

void check_size(const std::filesystem::path& file, const ReadLimits& limits) {
  std::error_code code;
  const auto size = std::filesystem::is_regular_file(file, code) ? std::filesystem::file_size(file, code) : 0;
  if (!code && size > limits.file_bytes)
    fail_over_limit(fmt::format("{} bytes", size), limits, &ReadLimits::file_bytes);
}

// What `load` returns for the file that a URI names; an Error begins with the URI.
template <class Load>
auto of_file(const std::filesystem::path& folder, std::string_view uri, const ReadOptions& options, const Load& load) {
  if (uri.empty()) fail("an empty URI");
  if (has_scheme(uri)) fail("'{}' is not a file beside the scene", shortened(uri));
  const auto file = resolve(folder, uri, options.follow_links);
  try {
    return load(file, options.limits);
  } catch (const Error& e) {
    fail("'{}': {}", shortened(uri), e.what());
  }
}

}  // namespace

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    if (low < 0) {
      decoded += text[i];
    } else {
      decoded += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return decoded;
}

std::optional<std::filesystem::path> named_file(const std::filesystem::path& folder, std::string_view uri,
                                                bool follow_links) {
  if (uri.empty() || has_scheme(uri)) return std::nullopt;
  std::error_code unread;
  try {
    const Found found = find_file(folder, uri, follow_links);
    if (found.cause) return std::nullopt;
    const std::filesystem::path name(found.name);
    const auto named = folder / (follow_links ? name.lexically_normal() : name);
    // "none/../a.bin" is no file for the system.
    return found.file.empty() || std::filesystem::exists(named, unread) ? named : found.file;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<std::byte> base64_decoded(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) fail("base64 data has an impossible length");
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() * 3 / 4);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = base64_values[static_cast<unsigned char>(c)];
    if (value < 0) fail("base64 data holds a character that is not base64");
    bits = (bits << 6 | static_cast<uint32_t>(value)) & 0xFFFFFF;
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> count & 0xFF));
    }
  }
  return bytes;
}

bool is_data_uri(std::string_view uri) { return equals_ignoring_case(uri.substr(0, 5), "data:"); }

std::vector<std::byte> data_uri_bytes(std::string_view uri) {
  const auto comma = uri.find(',');
  if (comma == std::string_view::npos) fail("'{}' is a data URI without a comma before its data", uri.substr(0, 30));
  const std::string_view data = uri.substr(comma + 1);
  constexpr std::string_view marker = ";base64";
  const std::string_view type = uri.substr(0, comma);
  const bool base64 =
      type.size() >= marker.size() && equals_ignoring_case(type.substr(type.size() - marker.size()), marker);
  if (!base64) return percent_decoded_bytes(data);
  if (data.find('%') == std::string_view::npos) return base64_decoded(data);
  return base64_decoded(percent_decoded(data));
}

std::vector<std::byte> load_file(const std::filesystem::path& file, const ReadLimits& limits) {
  check_size(file, limits);
  return read_file(file, limits.file_bytes);
}

ReadAt open_file(const std::filesystem::path& file, const ReadLimits& limits) {
  check_size(file, limits);
  const auto parts = std::make_shared<FileParts>(file, limits.file_bytes);
  return [parts](std::size_t offset, std::span<std::byte> to) { return parts->read(offset, to); };
}

std::vector<std::byte> load_uri(const std::filesystem::path& folder, std::string_view uri, const ReadOptions& options) {
  if (is_data_uri(uri)) return data_uri_bytes(uri);
  return of_file(folder, uri, options, load_file);
}

std::filesystem::path file_of_uri(const std::filesystem::path& folder, std::string_view uri,
                                  const ReadOptions& options) {
  if (is_data_uri(uri)) return {};
  return of_file(folder, uri, options, [](const std::filesystem::path& file, const ReadLimits&) {
    std::error_code code;
    auto resolved = std::filesystem::canonical(file, code);
    return code ? file : resolved;
  });
}

ReadAt open_uri(const std::filesystem::path& folder, std::string_view uri, const ReadOptions& options) {
  if (!is_data_uri(uri)) return of_file(folder, uri, options, open_file);
  const auto bytes = std::make_shared<std::vector<std::byte>>(data_uri_bytes(uri));
  return [bytes](std::size_t offset, std::span<std::byte> to) { return reader_of(*bytes)(offset, to); };
}

}  // namespace penumbra::scene::gltf
