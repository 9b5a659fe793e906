#include "truth/background_tracer.h"

#include <new>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace penumbra::truth {

void BackgroundTracer::start(PictureRequest request) {
  try {
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stopping) { run(stopping); });
  } catch (const std::system_error& error) {
    fail("ray tracing: no thread for it: {}", error.code().message());
  }
  cancel();
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(request);
    cancel_ = {};
    share_done_ = 0;
  }
  wake_.notify_one();
}

void BackgroundTracer::cancel() {
  const std::lock_guard lock(mutex_);
  cancel_.request_stop();
  next_.reset();
  share_done_.reset();
  error_ = nullptr;
}

void BackgroundTracer::stop() {
  cancel();
  thread_ = {};  // requests stop and joins
}

std::optional<double> BackgroundTracer::share_done() const {
  const std::lock_guard lock(mutex_);
  return share_done_;
}

std::optional<TracedPicture> BackgroundTracer::take() {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return std::exchange(finished_, std::nullopt);
}

void BackgroundTracer::run(const std::stop_token& stopping) {
  while (true) {
    std::unique_lock lock(mutex_);
    if (!wake_.wait(lock, stopping, [&] { return next_.has_value(); })) return;
    PictureRequest request = std::move(*next_);
    next_.reset();
    const std::stop_token cancelled = cancel_.get_token();
    lock.unlock();
    trace(request, cancelled);
  }
}

void BackgroundTracer::trace(PictureRequest& request, const std::stop_token& cancelled) {
  request.options.progress = [&, told = std::move(request.options.progress)](double share) {
    {
      const std::lock_guard lock(mutex_);
      if (cancelled.stop_requested()) return false;
      share_done_ = share;
    }
    return !told || told(share);
  };
  try {
    TracedPicture picture = tracer_.trace(request, cancelled);
    const std::lock_guard lock(mutex_);
    finished_ = std::move(picture);
    if (!cancelled.stop_requested()) share_done_.reset();
  } catch (const std::bad_alloc&) {
    give_up(std::make_exception_ptr(Error("ray tracing: not enough memory for the picture")), cancelled);
  } catch (...) {
    give_up(std::current_exception(), cancelled);
  }
}

// An exception that a cancelled picture throws is ignored.
void BackgroundTracer::give_up(std::exception_ptr error, const std::stop_token& cancelled) {
  const std::lock_guard lock(mutex_);
  if (cancelled.stop_requested()) return;
  error_ = std::move(error);
  share_done_.reset();
}

}  // namespace penumbra::truth
