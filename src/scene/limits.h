#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "scene/gltf.h"

namespace penumbra::scene {

// One limit of the reader, declared once: `--limit NAME=VALUE`, help and messages come from this row.
struct LimitRow {
  const char* name;  // "images"
  const char* help;  // what is counted
  std::size_t ReadLimits::*value;
  bool bytes = false;  // else a count
};

std::span<const LimitRow> limit_rows();

// Sets the limit of that name. "images=2GiB", "vertices=100000000": a whole number, for bytes with KiB, MiB or GiB
// behind it if you like. Throws Error that names the text and what is allowed.
void set_limit(ReadLimits& limits, std::string_view assignment);

// "1.5 GiB", "200 bytes".
std::string bytes_text(std::size_t bytes);

// Throws Error: "WHAT, over the limit of 1.5 GiB; --limit images=SIZE changes it". `value` says which limit.
[[noreturn]] void fail_over_limit(const std::string& what, const ReadLimits& limits, std::size_t ReadLimits::*value);

}  // namespace penumbra::scene
