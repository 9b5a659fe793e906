#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <utility>

namespace penumbra::app {

Progress::Progress(std::string part, int count, bool wanted)
    : part_(std::move(part)), count_(count), shown_(wanted && count > 1 && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) fmt::print(stderr, "\r\x1b[K");
}

void Progress::reach(int done) {
  if (done <= done_) return;
  done_ = done;
  if (!shown_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const long left = std::lround(elapsed.count() / done_ * (count_ - done_));
  fmt::print(stderr, "\r{} {} of {}, {}:{:02} left\x1b[K", part_, done_, count_, left / 60, left % 60);
}

}  // namespace penumbra::app
