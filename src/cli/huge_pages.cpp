#include "cli/huge_pages.h"

#include <cstdlib>
#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <sys/auxv.h>
#include <unistd.h>
#endif

namespace penumbra::cli {

#ifdef __GLIBC__

namespace {

constexpr const char* variable = "GLIBC_TUNABLES";

// Whether the kernel gives huge pages to programs that ask for them, and to no others.
bool kernel_waits_to_be_asked() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string line;
  return std::getline(file, line) && line.find("[madvise]") != std::string::npos;
}

// Whether the kernel has started the program itself, not the loader with the program's name.
bool is_own_process() { return getauxval(AT_BASE) != 0; }

}  // namespace

void start_with_huge_pages(char** arguments) {
  if (std::getenv(variable) != nullptr || !is_own_process() || !kernel_waits_to_be_asked()) return;
  if (setenv(variable, "glibc.malloc.hugetlb=1", 1) != 0) return;
  // By the name that it was started by, which stays the process's name. It returns only where it fails: then the
  // program goes on with small pages.
  const auto* name = reinterpret_cast<const char*>(getauxval(AT_EXECFN));  // NOLINT(performance-no-int-to-ptr)
  execv(name, arguments);
}

#else

void start_with_huge_pages(char** /*arguments*/) {}

#endif

}  // namespace penumbra::cli
