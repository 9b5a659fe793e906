#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

namespace penumbra::cli {

namespace {

constexpr const char remove_line[] = "\r\x1b[K";
std::atomic<int> lines_shown = 0;

}  // namespace

std::string_view line_start() { return lines_shown > 0 ? remove_line : ""; }

Progress::Progress(std::string part, int count, bool wanted)
    : part_(std::move(part)), count_(count), shown_(wanted && count > 1 && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (!shown_ || done_ == 0) return;
  std::fputs(remove_line, stderr);
  --lines_shown;
}

void Progress::set_done(int done) {
  if (done <= done_) return;
  const bool first = done_ == 0;
  done_ = done;
  if (!shown_) return;
  if (first) ++lines_shown;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const long left = std::lround(elapsed.count() / done_ * (count_ - done_));
  const std::string amount =
      part_.empty() ? fmt::format("{} %", 100L * done_ / count_) : fmt::format("{} {} of {}", part_, done_, count_);
  std::fputs(fmt::format("\r{}, {}:{:02} left\x1b[K", amount, left / 60, left % 60).c_str(), stderr);
}

}  // namespace penumbra::cli
