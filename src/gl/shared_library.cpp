#include "shared_library.h"

#include <dlfcn.h>

namespace penumbra::gl {

SharedLibrary::SharedLibrary(std::string_view subject, std::initializer_list<const char*> names) : subject_(subject) {
  std::string cause;
  for (const char* name : names) {
    library_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library_ != nullptr) {
      name_ = name;
      return;
    }
    if (cause.empty()) cause = dlerror();
  }
  fail("{}: {}", subject, cause);
}

void* SharedLibrary::find(const char* symbol) const { return dlsym(library_, symbol); }

}  // namespace penumbra::gl
