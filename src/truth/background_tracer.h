#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "truth/picture_request.h"

namespace penumbra::truth {

// Traces one picture at a time on a thread of its own. All functions are for one other thread, and only stop() waits.
class BackgroundTracer {
 public:
  // From start() to stop() `tracer` is the thread's.
  explicit BackgroundTracer(PictureTracer& tracer) : tracer_(tracer) {}
  ~BackgroundTracer() { stop(); }
  BackgroundTracer(const BackgroundTracer&) = delete;
  BackgroundTracer& operator=(const BackgroundTracer&) = delete;

  // Starts this picture instead of the one before, whose error is forgotten. Progress is called on the
  // tracer's thread; when it says to stop, that is an error. Throws Error if the system has no thread.
  void start(PictureRequest request);
  // Cancels the picture and returns at once; the thread may still read what the picture refers to for a while.
  void cancel();
  // Cancels, and returns when nothing is read any more.
  void stop();

  // The share of the picture's work that is done; absent if none is being traced.
  std::optional<double> share_done() const;
  // The picture that was finished last, once; also one that was cancelled too late. Throws, once, what tracing threw:
  // Error, also for too little memory, or Interrupted.
  std::optional<TracedPicture> take();

 private:
  void run(const std::stop_token& stopping);
  void trace(PictureRequest& request, const std::stop_token& cancelled);
  void give_up(std::exception_ptr error, const std::stop_token& cancelled);

  PictureTracer& tracer_;

  mutable std::mutex mutex_;  // of the following
  std::condition_variable_any wake_;
  std::optional<PictureRequest> next_;
  std::stop_source cancel_;  // of the picture that start() was last given
  std::optional<double> share_done_;
  std::optional<TracedPicture> finished_;
  std::exception_ptr error_;

  std::jthread thread_;
};

}  // namespace penumbra::truth
