#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/gltf.h"

namespace penumbra::scene {

// One limit of the scene reader. The option `--limit NAME=VALUE`, its help and the error messages all use this row.
struct LimitRow {
  const char* name;  // "images"
  const char* help;  // what is counted
  std::size_t ReadLimits::*value;
  bool bytes = false;  // the limit is in bytes; else it is a count
};

std::span<const LimitRow> limit_rows();

// Sets the limit that an assignment names: "images=2GiB", "vertices=100000000". The value is a whole number, for bytes
// optionally followed by KiB, MiB or GiB. Throws Error that quotes the text and lists what is allowed.
void set_limit(ReadLimits& limits, std::string_view assignment);

// The bytes of a size as text: "1500000000", "1500MiB", "2GiB". Nothing if it is none, or none that memory could have.
std::optional<std::size_t> bytes_from(std::string_view text);

// A size as text: "1.5 GiB", "200 bytes".
std::string bytes_text(std::size_t bytes);

// Throws Error: "WHAT, over the limit of 1.5 GiB; --limit images=SIZE changes it". `value` is the member of the limit
// that was exceeded.
[[noreturn]] void fail_over_limit(const std::string& what, const ReadLimits& limits, std::size_t ReadLimits::*value);

}  // namespace penumbra::scene
