#include <fmt/format.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api.h"
#include "api_table.h"
#include "compatibility.h"
#include "context.h"

namespace penumbra::gl {
namespace {

// Functions that OSMesa may have only under the names of the extension ARB_robustness.
bool is_of_robustness(std::string_view name) {
  return name.starts_with("glGetn") || name == "glReadnPixels" || name == "glGetGraphicsResetStatus";
}

template <class... Args>
[[noreturn]] void fail_context(fmt::format_string<Args...> format, Args&&... args) {
  throw ContextError(fmt::format(format, std::forward<Args>(args)...));
}

// In this scope the calling thread uses `api`; afterwards what it used before, or what keep() names.
class Trial {
 public:
  explicit Trial(Api& api) : outer_(std::exchange(current_api, &api)) {}
  ~Trial() { current_api = outer_; }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  void keep(Api& api) { outer_ = &api; }

 private:
  Api* outer_;
};

void load_functions(Api& api, const std::function<void*(const char*)>& get_proc_address) {
  constexpr std::size_t named = 3;
  std::vector<std::string> missing;
  for (const ApiEntry& entry : api_table()) {
    void* address = get_proc_address(entry.name);
    if (address == nullptr && is_of_robustness(entry.name)) {
      address = get_proc_address(fmt::format("{}ARB", entry.name).c_str());
    }
    entry.store(api, address);
    if (address == nullptr) missing.emplace_back(entry.name);
  }
  if (missing.empty()) return;
  const std::string rest = missing.size() > named ? fmt::format(" and {} more", missing.size() - named) : "";
  if (missing.size() > named) missing.resize(named);
  fail_context("OpenGL 4.5: the driver lacks {}{}", fmt::join(missing, ", "), rest);
}

// Dispatch libraries such as GLVND return an address for every name, so the context's own version decides.
void check_context() {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major == 0) fail_context("OpenGL 4.5: no context is current");
  const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  const bool embedded = version != nullptr && std::string_view(version).starts_with("OpenGL ES");
  if (embedded || major < 4 || (major == 4 && minor < 5))
    fail_context("OpenGL 4.5: the context is OpenGL {}{}.{}", embedded ? "ES " : "", major, minor);
}

bool is_of_core_profile() {
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  return (static_cast<GLenum>(profile) & GL_CONTEXT_CORE_PROFILE_BIT) != 0;
}

// The table with these entry points: one for each driver and profile. They stay until the program ends, since threads
// and devices of any age may use them.
Api& shared_table(const Api& api) {
  static std::mutex mutex;
  static auto& tables = *new std::vector<std::unique_ptr<Api>>;  // never destroyed: static objects may still draw
  const std::lock_guard lock(mutex);
  for (const auto& table : tables) {
    if (*table == api) return *table;
  }
  return *tables.emplace_back(std::make_unique<Api>(api));
}

}  // namespace

void load_api(const std::function<void*(const char*)>& get_proc_address) {
  if (!get_proc_address) fail_context("OpenGL 4.5: load_api() got no function that finds entry points");
  Api api;
  load_functions(api, get_proc_address);
  Trial trial(api);
  check_context();
  if (!is_of_core_profile()) find_legacy_state(api, get_proc_address);
  trial.keep(shared_table(api));
}

}  // namespace penumbra::gl
