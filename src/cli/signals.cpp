#include "cli/signals.h"

#include <csignal>

#include "io/output_file.h"

namespace penumbra::cli {

namespace {

extern "C" void end_by_signal(int signal) { io::exit_without_temporaries(128 + signal); }

}  // namespace

void clean_up_on_signals() {
  struct sigaction action = {};
  action.sa_handler = end_by_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void fail_writes_past_the_limit() {
  struct sigaction action = {};
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

}  // namespace penumbra::cli
