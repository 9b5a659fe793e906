#pragma once

#include <chrono>

namespace penumbra::app {

// "frame 12 of 100, 0.84 s each, 1:14 left" on one line of the terminal; nothing when stderr is no terminal.
class Progress {
 public:
  Progress(int frames, bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // One more frame is done.
  void step();

 private:
  int frames_, done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace penumbra::app
