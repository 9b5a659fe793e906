#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace penumbra::app {

Progress::Progress(int frames, bool wanted)
    : frames_(frames), shown_(wanted && frames > 1 && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) fmt::print(stderr, "\r\x1b[K");
}

void Progress::step() {
  ++done_;
  if (!shown_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const double each = elapsed.count() / done_;
  const long left = std::lround(each * (frames_ - done_));
  fmt::print(stderr, "\rframe {} of {}, {:.2f} s each, {}:{:02} left\x1b[K", done_, frames_, each, left / 60,
             left % 60);
}

}  // namespace penumbra::app
