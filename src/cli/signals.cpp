#include "cli/signals.h"

#include <csignal>

#include "io/output_file.h"

namespace penumbra::cli {

namespace {

extern "C" void end_by_signal(int signal) { io::exit_without_temporaries(128 + signal); }

}  // namespace

std::vector<int> ending_signals() {
  std::vector<int> signals;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) signals.push_back(signal);
  }
  return signals;
}

void clean_up_on_signals() {
  struct sigaction action = {};
  action.sa_handler = end_by_signal;
  for (const int signal : ending_signals()) sigaction(signal, &action, nullptr);
}

void fail_writes_past_the_limit() {
  struct sigaction action = {};
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

}  // namespace penumbra::cli
