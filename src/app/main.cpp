#include "app/commands.h"

int main(int argc, char** argv) {
  return penumbra::app::run_program(penumbra::app::Arguments(argv + (argc > 0 ? 1 : 0), argv + argc));
}
