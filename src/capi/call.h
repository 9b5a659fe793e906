#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "penumbra.h"

namespace penumbra::capi {

// A failure of a call, with the result that it returns.
class Failure : public std::runtime_error {
 public:
  Failure(penumbra_result result, const std::string& message) : std::runtime_error(message), result_(result) {}
  penumbra_result result() const { return result_; }

 private:
  penumbra_result result_;
};

template <class... Args>
[[noreturn]] void fail_with(penumbra_result result, fmt::format_string<Args...> format, Args&&... args) {
  throw Failure(result, fmt::format(format, std::forward<Args>(args)...));
}

// The result for the exception that is being handled; keeps its message for penumbra_last_error(). `function` begins
// the messages of failures that would not name what they are about.
penumbra_result keep_failure(const char* function) noexcept;

// Runs the body of a function of the C interface: no exception leaves it.
template <class Body>
penumbra_result run(const char* function, const Body& body) noexcept {
  try {
    body();
    return PENUMBRA_OK;
  } catch (...) {
    return keep_failure(function);
  }
}

// Refuses a null pointer; `name` is the argument's.
template <class T>
T& required(T* pointer, const char* name) {
  if (pointer == nullptr) fail_with(PENUMBRA_ERROR_ARGUMENT, "'{}' is null", name);
  return *pointer;
}

// Refuses numbers that are not finite. `name`: "penumbra_frame.view".
template <std::size_t count>
void require_finite(const float (&values)[count], const char* name) {
  for (const float value : values) {
    if (!std::isfinite(value)) fail_with(PENUMBRA_ERROR_ARGUMENT, "{} is not finite", name);
  }
}

// Writes a text to a caller's buffer, as penumbra_settings_get() describes.
void write_text(const std::string& text, char* buffer, std::size_t capacity, std::size_t* length);

}  // namespace penumbra::capi
