#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "truth/picture_request.h"

namespace penumbra::truth {

// Traces one picture at a time on its own thread. One other thread may call its functions; of these only stop() blocks.
class BackgroundTracer {
 public:
  // Between start() and stop() only the background thread may use `tracer`.
  explicit BackgroundTracer(PictureTracer& tracer) : tracer_(tracer) {}
  ~BackgroundTracer() { stop(); }
  BackgroundTracer(const BackgroundTracer&) = delete;
  BackgroundTracer& operator=(const BackgroundTracer&) = delete;

  // Cancels the previous picture, discards its error, and starts this one. The progress callback is called on the
  // background thread; if it returns false, take() throws Interrupted. Throws Error if the system can't create a
  // thread.
  void start(PictureRequest request);
  // Cancels the picture and returns at once; the thread may still read what the request refers to for a moment.
  void cancel();
  // Cancels the picture and waits until nothing that the request refers to is read any more.
  void stop();

  // The share of the picture that is traced, 0 to 1; absent if no picture is being traced.
  std::optional<double> share_done() const;
  // Returns the last finished picture, once; this may be a picture that finished just before it was cancelled. Throws,
  // once, what tracing threw: Error (including too little memory) or Interrupted.
  std::optional<TracedPicture> take();

 private:
  void run(const std::stop_token& stopping);
  void trace(PictureRequest& request, const std::stop_token& cancelled);
  void give_up(std::exception_ptr error, const std::stop_token& cancelled);

  PictureTracer& tracer_;

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable_any wake_;
  std::optional<PictureRequest> next_;
  std::stop_source cancel_;  // of the picture that was last started
  std::optional<double> share_done_;
  std::optional<TracedPicture> finished_;
  std::exception_ptr error_;

  std::jthread thread_;
};

}  // namespace penumbra::truth
