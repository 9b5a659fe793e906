// The command `penumbra bench` as a program that needs only an EGL driver, for minimal servers with a GPU.

#include <fmt/format.h>

#include "bench/bench.h"
#include "bench/machine.h"
#include "cli/huge_pages.h"
#include "stb_decoder.h"

int main(int argc, char** argv) {
  namespace cli = penumbra::cli;
  cli::start_with_huge_pages(argv);
  const cli::Arguments arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return cli::run_guarded([&] {
    if (!arguments.empty() && arguments.front() == "--version") {
      fmt::print("{}, commit {}\n", cli::version(), penumbra::bench::commit());
      return 0;
    }
    return penumbra::bench::run("penumbra-bench", arguments, penumbra::stb_decoder,
                                [](int /*threads*/) { return penumbra::shadow::built_in_registry(); });
  });
}
