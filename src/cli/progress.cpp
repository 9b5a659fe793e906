#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace penumbra::cli {

Progress::Progress(std::string part, int count, bool wanted)
    : part_(std::move(part)), count_(count), shown_(wanted && count > 1 && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) std::fputs("\r\x1b[K", stderr);
}

void Progress::set_done(int done) {
  if (done <= done_) return;
  done_ = done;
  if (!shown_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const long left = std::lround(elapsed.count() / done_ * (count_ - done_));
  const std::string amount =
      part_.empty() ? fmt::format("{} %", 100L * done_ / count_) : fmt::format("{} {} of {}", part_, done_, count_);
  std::fputs(fmt::format("\r{}, {}:{:02} left\x1b[K", amount, left / 60, left % 60).c_str(), stderr);
}

}  // namespace penumbra::cli
