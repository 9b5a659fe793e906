#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace penumbra::cli {

// A line of progress on the terminal, "frame 12 of 100, 1:14 left", rewritten as parts are done and removed at the end.
// Nothing is written if stderr is not a terminal or if there is only one part. Only the constructor throws.
class Progress {
 public:
  // `part` names one of the `count` parts ("frame"). Without a name the line has a percentage: "12 %, 0:08 left".
  Progress(std::string part, int count, bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more part is done.
  void step() { set_done(done_ + 1); }
  // `done` parts are done; a number less than before is ignored.
  void set_done(int done);

 private:
  std::string part_;
  int count_, done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What any other line on stderr begins with: it removes the line of progress that is shown there; empty if there is
// none.
std::string_view line_start();

}  // namespace penumbra::cli
