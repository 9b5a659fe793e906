#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace penumbra {

// Bad input, a bad shader or a missing device: something that the user can fix. what() is one line that
// names the thing and the cause; only what a shader compiler says follows on lines of its own. A bug in Penumbra itself
// is an assertion, never an Error.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws Error with the formatted message.
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace penumbra
