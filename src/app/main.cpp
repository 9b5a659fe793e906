#include "app/commands.h"
#include "cli/huge_pages.h"

int main(int argc, char** argv) {
  penumbra::cli::start_with_huge_pages(argv);
  return penumbra::app::run_program(penumbra::app::Arguments(argv + (argc > 0 ? 1 : 0), argv + argc));
}
