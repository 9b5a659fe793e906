#pragma once

#include <chrono>
#include <string>

namespace penumbra::cli {

// "frame 12 of 100, 1:14 left" on one line of the terminal; nothing when stderr is no terminal. It never throws once it
// is made.
class Progress {
 public:
  // `part` is what there are `count` of. Parts without a name are told as a share: "12 %, 0:08 left".
  Progress(std::string part, int count, bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more part is done.
  void step() { reach(done_ + 1); }
  // So many are done.
  void reach(int done);

 private:
  std::string part_;
  int count_, done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace penumbra::cli
