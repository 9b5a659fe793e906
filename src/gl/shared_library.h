#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "../core/error.h"

namespace penumbra::gl {

// A library loaded at run time, so that a system without it still runs the rest. It stays loaded: drivers keep
// threads and thread-local destructors that unloading would pull the code from under.
class SharedLibrary {
 public:
  // Opens the first of `names` that there is; throws Error with the first one's cause. `subject` begins messages.
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
