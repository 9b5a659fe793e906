#include <fmt/format.h>

#include <string>
#include <vector>

#include "../core/error.h"
#include "api_table.h"
#include "context.h"

namespace penumbra::gl {

void load_api(GetProcAddress get_proc_address) {
  constexpr std::size_t named = 3;
  std::vector<std::string> missing;
  for (const ApiEntry& entry : api_table()) {
    void* address = get_proc_address(entry.name);
    // OSMesa has the functions of robustness under their extension's names alone.
    if (address == nullptr) address = get_proc_address(fmt::format("{}ARB", entry.name).c_str());
    entry.store(address);
    if (address == nullptr) missing.emplace_back(entry.name);
  }
  if (missing.empty()) return;
  const std::string rest = missing.size() > named ? fmt::format(" and {} more", missing.size() - named) : "";
  if (missing.size() > named) missing.resize(named);
  fail("OpenGL 4.5: the driver lacks {}{}", fmt::join(missing, ", "), rest);
}

}  // namespace penumbra::gl
