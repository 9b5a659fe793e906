#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "cli/progress.h"

namespace penumbra::test {
namespace {

// A terminal in place of stderr.
class Terminal {
 public:
  Terminal() : terminal_(posix_openpt(O_RDWR | O_NOCTTY)), stderr_(dup(STDERR_FILENO)) {
    if (terminal_ < 0 || grantpt(terminal_) != 0 || unlockpt(terminal_) != 0) return;
    const int end = open(ptsname(terminal_), O_RDWR | O_NOCTTY);
    if (end < 0) return;
    is_there_ = dup2(end, STDERR_FILENO) >= 0;
    close(end);
  }
  ~Terminal() {
    dup2(stderr_, STDERR_FILENO);
    close(stderr_);
    close(terminal_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  bool is_there() const { return is_there_; }

 private:
  int terminal_, stderr_;
  bool is_there_ = false;
};

TEST(Progress, IsRemovedByOtherLinesWhileItIsShown) {
  const Terminal terminal;
  if (!terminal.is_there()) GTEST_SKIP() << "no terminal can be opened";
  EXPECT_EQ(cli::line_start(), "");
  {
    cli::Progress progress("frame", 3, true);
    EXPECT_EQ(cli::line_start(), "");
    progress.step();
    progress.step();
    EXPECT_EQ(cli::line_start(), "\r\x1b[K");
    cli::Progress quiet("frame", 3, false);
    quiet.step();
  }
  EXPECT_EQ(cli::line_start(), "");
}

TEST(Progress, IsNotShownWhereThereIsNoTerminal) {
  if (isatty(STDERR_FILENO) != 0) GTEST_SKIP() << "stderr is a terminal";
  cli::Progress progress("frame", 3, true);
  progress.step();
  EXPECT_EQ(cli::line_start(), "");
}

}  // namespace
}  // namespace penumbra::test
