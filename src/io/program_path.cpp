#include "program_path.h"

#include <sys/auxv.h>

namespace penumbra::io {

std::filesystem::path program_path(std::error_code& fault) {
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", fault);
  const unsigned long started = fault ? getauxval(AT_EXECFN) : 0;
  if (started == 0) return program;
  // The kernel gives addresses as numbers. NOLINTNEXTLINE(performance-no-int-to-ptr)
  return std::filesystem::canonical(reinterpret_cast<const char*>(started), fault);
}

}  // namespace penumbra::io
