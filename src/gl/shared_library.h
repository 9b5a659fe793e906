#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "../core/error.h"

namespace penumbra::gl {

// A library loaded at run time, so that a system without it can still run everything else. It is never unloaded:
// drivers keep threads and thread-local destructors that run its code.
class SharedLibrary {
 public:
  // Opens the first of `names` that can be loaded, else throws Error with the cause for the first of them. Messages
  // begin with `subject`.
  SharedLibrary(std::string_view subject, std::initializer_list<const char*> names);

  void* find(const char* symbol) const;

  // Sets `function` to the symbol; throws Error when the library lacks it.
  template <class Function>
  void require(Function& function, const char* symbol) const {
    function = reinterpret_cast<Function>(find(symbol));
    if (function == nullptr) fail("{}: {} has no {}", subject_, name_, symbol);
  }

 private:
  std::string subject_, name_;
  void* library_ = nullptr;
};

}  // namespace penumbra::gl
